#!/usr/bin/env python3
"""Usage: scripts/paired_trends.py RESULT.h5 METRIC

Does a metric rise or fall along each axis of the sweep? For every method and every two neighbouring cells: the mean of
the paired difference over the kept trials (cells share their random numbers, so pairs are far more exact than the two
means), its standard error and z. Needs h5py and numpy, and a result whose trials were kept:
ridgeloc run fig3a --trials 1e6 --set store.trial_columns_mib=3750
"""

import sys

import h5py
import numpy as np


def texts(dataset):
    return [value.decode() for value in dataset[()].tolist()]


def main(path, metric):
    with h5py.File(path) as file:
        axes = [file[f"axes/{i}"] for i in range(len(file["axes"]))]
        names = [axis.attrs["name"] for axis in axes]
        values = [texts(axis["value"]) for axis in axes]
        cells = [tuple(row) for row in file["cells/index"][()].tolist()]
        for label in texts(file["methods/label"]):
            columns = {}
            for number, cell in enumerate(cells):
                name = f"trials/{number}/{label}/{metric}"
                if name in file:
                    columns[cell] = file[name][()]
            if not columns:
                continue
            print(f"{label}: {metric}, {len(next(iter(columns.values())))} trials a cell")
            for axis, axis_name in enumerate(names):
                for cell in cells:
                    after = tuple(index + (i == axis) for i, index in enumerate(cell))
                    if cell not in columns or after not in columns:
                        continue
                    where = ", ".join(f"{n} = {v[j]}" for n, v, j in zip(names, values, cell))
                    difference = columns[after] - columns[cell]
                    difference = difference[np.isfinite(difference)]
                    error = difference.std(ddof=1) / np.sqrt(len(difference))
                    step = f"{axis_name} {values[axis][cell[axis]]} -> {values[axis][after[axis]]}"
                    mean = difference.mean()
                    print(f"  {where}: {step}: {mean:+.5f} +- {error:.5f}, z = {mean / error:+.1f}")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2])
