#!/usr/bin/env python3
"""Usage: scripts/table1.py RESULT.h5

Sets a result of the catalog's study table1 beside Table 1 of the RRR paper, as a Markdown table: the paper's value, ours
with its Monte Carlo standard error, and where 95 % of studies of 80 photos (47, 22, 7, 3, 1 with 3 to 7 detections) would
lie, drawn 4000 times from the trials of the result. The last column says whether the paper's value lies there.

As in the paper: success is the share of photos located; error and iterations are averaged over located photos;
convergence is the share of all starts of a column, and in total the mean of the columns weighted by their located photos.
Last, the errors on those photos that all four methods locate. Needs h5py and numpy, and a result whose trials were kept.
"""

import sys

import h5py
import numpy as np

PHOTOS = {3: 47, 4: 22, 5: 7, 6: 3, 7: 1}
STUDIES = 4000
METHODS = ["ols", "lm", "rr", "rrr"]
NONE = float("nan")
PAPER = {
    ("ols", "success %"): [61.7, 50.0, 42.8, 0, 0, 53.8],
    ("ols", "error m"): [1.8, 2.1, 2.4, NONE, NONE, 1.9],
    ("ols", "convergence %"): [42.1, 37.5, 23.1, 0, 0, 39.6],
    ("ols", "iterations"): [8, 8, 9, NONE, NONE, 8],
    ("lm", "success %"): [66.0, 68.2, 42.8, 33.0, 0, 62.5],
    ("lm", "error m"): [1.6, 2.0, 2.0, 1.2, NONE, 1.7],
    ("lm", "convergence %"): [45.7, 42.5, 34.6, 9.0, 0, 43.3],
    ("rr", "success %"): [70.2, 63.6, 71.4, 66.0, 0, 67.5],
    ("rr", "error m"): [1.5, 1.9, 1.9, 1.0, NONE, 1.6],
    ("rr", "convergence %"): [56.0, 50.9, 53.8, 36.4, 0, 53.7],
    ("rr", "iterations"): [7, 7, 9, 9, NONE, 7],
    ("rrr", "success %"): [80.9, 81.8, 85.7, 100, 100, 82.5],
    ("rrr", "error m"): [1.4, 1.3, 1.3, 0.5, 0.6, 1.3],
    ("rrr", "convergence %"): [62.9, 62.1, 57.7, 45.5, 40.0, 61.1],
    ("rrr", "iterations"): [8, 9, 11, 13, 12, 9],
}


def read(path):
    """Columns of trials by (detections, label): a dictionary of arrays."""
    with h5py.File(path) as file:
        axes = [file[f"axes/{i}"] for i in range(len(file["axes"]))]
        names = [axis.attrs["name"] for axis in axes]
        if names != ["detections"]:
            sys.exit(f"{path}: the sweep must be over detections alone, not over {', '.join(names)}")
        values = [int(value) for value in axes[0]["value"][()].tolist()]
        columns = {}
        for number, (index,) in enumerate(file["cells/index"][()].tolist()):
            for label, group in file.get(f"trials/{number}", {}).items():
                columns[values[index], label] = {name: group[name][()] for name in group}
    for detections in PHOTOS:
        for label in [*METHODS, "photo"]:
            if (detections, label) not in columns:
                sys.exit(f"{path}: there are no trials of {label} with {detections} detections; run the study table1")
    return columns


def quantities(columns, label, rows):
    """The four quantities of each column and in total, from some trials (`rows`, by number of detections).

    The total is that of 80 photos of which each column has the paper's share, estimated from all trials of the column.
    """
    success, error, convergence, iterations, located = [], [], [], [], []
    for detections, chosen in rows.items():
        photos = columns[detections, label]
        starts = columns[detections, "photo"]["start_count"][chosen].sum()
        found = photos["status"][chosen] == 0
        located.append(PHOTOS[detections] * found.mean())
        success.append(100 * found.mean())
        convergence.append(100 * photos["converged_starts"][chosen].sum() / starts if starts else NONE)
        with_position = chosen[found]
        error.append(photos["error_m"][with_position].mean() if len(with_position) else NONE)
        iterations.append(photos["iterations"][with_position].mean() if len(with_position) else NONE)
    located = np.array(located, float)
    photos_of = np.array([PHOTOS[detections] for detections in rows], float)

    def weighted(values):
        known = located > 0
        return (np.array(values)[known] * located[known]).sum() / located.sum() if located.sum() else NONE

    return {
        "success %": success + [(np.array(success) * photos_of).sum() / photos_of.sum()],
        "error m": error + [weighted(error)],
        "convergence %": convergence + [weighted(convergence)],
        "iterations": iterations + [weighted(iterations)],
    }


def main(path):
    columns = read(path)
    random = np.random.default_rng(2018)
    size = min(len(columns[detections, METHODS[0]]["status"]) for detections in PHOTOS)
    whole = {d: np.arange(size) for d in PHOTOS}
    studies = [{d: random.integers(size, size=n) for d, n in PHOTOS.items()} for _ in range(STUDIES)]
    # Standard errors from fifty parts of the trials.
    parts = [{d: np.array_split(whole[d], 50)[i] for d in PHOTOS} for i in range(50)]
    inside, compared = 0, 0
    print("| | detections | paper | ours | 95 % of studies of 80 photos | paper inside |")
    print("|---|---|---:|---:|---:|---|")
    for label in METHODS:
        ours = quantities(columns, label, whole)
        spread = [quantities(columns, label, part) for part in parts]
        drawn = [quantities(columns, label, study) for study in studies]
        for quantity in ["success %", "error m", "convergence %", "iterations"]:
            paper = PAPER.get((label, quantity))
            for i, name in enumerate([*map(str, PHOTOS), "total"]):
                value = ours[quantity][i]
                error = np.nanstd([s[quantity][i] for s in spread], ddof=1) / np.sqrt(len(spread))
                studies_values = np.array([s[quantity][i] for s in drawn], float)
                known = studies_values[np.isfinite(studies_values)]
                low, high = np.quantile(known, [0.025, 0.975])
                none = 1 - len(known) / len(studies_values)
                band = f"{low:.3g} to {high:.3g}" + (f" (none in {100 * none:.0f} %)" if none > 0.005 else "")
                printed, verdict = "", ""
                if paper is not None:
                    compared += 1
                    if np.isnan(paper[i]):
                        printed, good = "-", none >= 0.025
                    else:
                        rounding = 0.5 if quantity == "iterations" else 0.05
                        printed, good = f"{paper[i]:g}", low - rounding <= paper[i] <= high + rounding
                    inside += good
                    verdict = "yes" if good else "no"
                print(f"| {label} {quantity} | {name} | {printed} | {value:.3g} ± {error:.1g} | {band} | {verdict} |")
    print(f"\n{inside} of the paper's {compared} values lie inside.\n")
    print("Photos that all four methods locate, error in m: mean ± standard error (median)\n")
    print("| | " + " | ".join(f"{d}" for d in PHOTOS) + " |\n|---|" + "---|" * len(PHOTOS))
    common = {d: np.all([columns[d, m]["status"][:size] == 0 for m in METHODS], axis=0) for d in PHOTOS}
    print("| share of photos | " + " | ".join(f"{100 * common[d].mean():.1f} %" for d in PHOTOS) + " |")
    for label in sorted({label for _, label in columns if label != "photo"}):
        cells = []
        for d in PHOTOS:
            error = columns[d, label].get("error_m")
            values = error[:size][common[d]] if error is not None else np.array([])
            values = values[np.isfinite(values)]
            if not len(values):
                break
            cells.append(f"{values.mean():.2f} ± {values.std(ddof=1) / np.sqrt(len(values)):.2f} ({np.median(values):.2f})")
        if cells and " - " not in label:
            print(f"| {label} | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
