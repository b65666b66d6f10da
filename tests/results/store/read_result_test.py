#!/usr/bin/env python3
"""Reads a sample result with h5py and xarray alone, by docs/file-format.md, and checks it against itself.

Usage: read_result_test.py PROGRAM    where PROGRAM writes the sample result to its argument and prints its digest.
"""

import hashlib
import math
import pathlib
import subprocess
import sys
import tempfile

import h5py
import numpy as np
import xarray as xr

TYPES = {"<f8": "f64", "<i8": "i64", "<u8": "u64", "<u4": "u32", "|u1": "u8"}


def data_digest(file):
    """The digest over all datasets but those under /provenance."""
    datasets = {}

    def visit(name, item):
        if isinstance(item, h5py.Dataset) and not name.startswith("provenance/"):
            datasets["/" + name] = item

    file.visititems(visit)
    manifest = hashlib.sha256()
    for path in sorted(datasets, key=lambda p: p.encode()):
        item = datasets[path]
        if h5py.check_string_dtype(item.dtype):
            kind = "text"
            values = b"".join(len(t).to_bytes(8, "little") + t for t in item[()].tolist())
        else:
            kind = TYPES[item.dtype.str]
            values = item[()].tobytes()
        shape = "x".join(str(size) for size in item.shape)
        manifest.update(f"{path} {kind} {shape} {hashlib.sha256(values).hexdigest()}\n".encode())
    return manifest.hexdigest()


def bin_of(value):
    """Number of the histogram bin of a value: the upper 17 bits of a positive double."""
    return int(np.float64(value).view(np.uint64) >> np.uint64(47)) if value > 0 else 0


def texts(dataset):
    return [text.decode() for text in dataset[()].tolist()]


def check_root(file, digest):
    assert file.attrs["filetype"] == "ridgeloc-result"
    assert file.attrs["version"][0] == 2
    assert file.attrs["title"] == "Sample: µ and σ"
    assert file.attrs["seed"] == 2**64 - 1
    assert file.attrs["data_sha256"] == digest
    assert data_digest(file) == digest
    assert file["provenance"].attrs["study"].startswith("title = ")
    assert file["provenance/libraries"].attrs["HDF5"]
    assert file["provenance/wall_time_s"].attrs["run"] == 1.5
    assert list(file["figures/0"].attrs["y"]) == ["error_m", "success"]


def check_ledger(file):
    """The rows tile the blocks, and their moments and histograms are those of the kept trials."""
    ledger = file["ledger"]
    metrics = texts(file["metrics/name"])
    block_trials = int(file.attrs["block_trials"])
    kept_trials = int(file.attrs["kept_trials"])
    rows = len(ledger["cell"])
    for cell in range(len(file["cells/hash"])):
        for method, label in enumerate(texts(file["methods/label"])):
            mine = [r for r in range(rows) if ledger["cell"][r] == cell and ledger["method"][r] == method]
            assert sum(ledger["trials"][r] for r in mine) == file.attrs["trials"]
            assert [ledger["first_block"][r] for r in mine] == [0, 4, 5]
            assert [ledger["blocks"][r] for r in mine] == [4, 1, 1]
            trials = file[f"trials/{cell}/{label}"]
            assert list(trials["block"]) == [0, 1, 2]
            assert list(trials["block_trials"]) == [block_trials, block_trials, kept_trials - 2 * block_trials]
            for m, name in enumerate(metrics):
                counts = [sum(histogram(ledger, r, m, len(metrics)).values()) for r in mine]
                assert counts == [ledger["n"][r, m] + ledger["beyond"][r, m] for r in mine]
                if name not in trials:
                    assert sum(counts) == 0
                    continue
                values = trials[name][:]
                assert len(values) == kept_trials
                check_bins(values, histogram(ledger, mine[0], m, len(metrics)))
            digests = np.diff(ledger["digest_offset"][()])
            assert list(digests) == list(ledger["blocks"][()])


def histogram(ledger, row, metric, metrics):
    i = row * metrics + metric
    begin, end = ledger["histogram_offset"][i], ledger["histogram_offset"][i + 1]
    return dict(zip(ledger["histogram_bin"][begin:end].tolist(), ledger["histogram_count"][begin:end].tolist()))


def check_bins(values, counts):
    """Most of the row's trials are kept: each of their values is counted in its bin."""
    for value in values[~np.isnan(values)]:
        bin_number = bin_of(value)
        assert counts.get(bin_number, 0) > 0, (value, bin_number)


def check_summary(path, engine):
    """One point of the grid is no cell, so the values are along cells, with the axes as coordinates."""
    with xr.open_dataset(path, group="summary", engine=engine) as summary:
        assert summary.error_m.dims == ("cell", "method", "statistic")
        assert list(summary.cell.values) == [0, 1, 2, 3, 4]
        assert list(summary.points.values) == [3, 3, 4, 4, 7]
        assert np.allclose(summary.sigma_m, [0.1, 1 / 3, 0.1, 1 / 3, 1 / 3], rtol=1e-15)
        assert {"points", "sigma_m"} <= set(summary.error_m.coords)
        assert summary.points.attrs["long_name"] == "number of points"
        assert summary.error_m.attrs["units"] == "m"
        assert summary.error_m.attrs["long_name"] == "position error"
        assert set(summary.data_vars) == {
            "error_m", "iterations", "crb_m", "not_run", "converged", "diverged", "success"
        }
        cells = summary.set_index(cell=["points", "sigma_m"])
        # As a mapping: `method=` is an argument of sel() itself.
        point = cells.sel({"cell": (4, 0.1), "method": "rrr k=0.5", "statistic": "mean"})
        with h5py.File(path) as file:
            ledger = file["ledger"]
            mine = (ledger["cell"][()] == 2) & (ledger["method"][()] == 1)
            rate = ledger["events"][()][mine, 1].sum() / ledger["trials"][()][mine].sum()
            n = ledger["n"][()][mine, 1]
            mean = (ledger["mean"][()][mine, 1] * n).sum() / n.sum()
        assert math.isclose(float(point.converged), rate, rel_tol=1e-12)
        assert math.isclose(float(point.iterations), mean, rel_tol=1e-12)
        # What a method does not report is NaN.
        assert np.isnan(summary.converged.sel({"method": "scene"})).all()
        assert float(summary.error_m.sel({"method": "ols", "statistic": "n"})[1]) > 0


def main(program):
    with tempfile.TemporaryDirectory() as folder:
        path = str(pathlib.Path(folder) / "sample.h5")
        digest = subprocess.run([program, path], check=True, capture_output=True, text=True).stdout.strip()
        with h5py.File(path) as file:
            check_root(file, digest)
            check_ledger(file)
        check_summary(path, "h5netcdf")
        try:
            import netCDF4  # noqa: F401
        except ModuleNotFoundError:
            print("netCDF4 is not installed: read with h5py and h5netcdf alone")
        else:
            check_summary(path, "netcdf4")


if __name__ == "__main__":
    main(sys.argv[1])
