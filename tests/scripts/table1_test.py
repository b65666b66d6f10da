#!/usr/bin/env python3
"""Checks the totals of scripts/table1.py against what they must be for made-up trials.

Usage: table1_test.py SCRIPT
"""

import importlib.util
import sys

import numpy as np

TRIALS = 160


def columns_of(detections):
    """Photos of which the second half is located, the later the worse."""
    number = np.arange(TRIALS)
    located = number >= TRIALS // 2
    photos = {
        "status": np.where(located, 0, 1),
        "converged_starts": np.where(located, 1, 0),
        "error_m": np.where(located, detections * number, np.nan),
        "iterations": np.where(located, detections, 30.0),
    }
    return {(detections, "ols"): photos, (detections, "photo"): {"start_count": np.full(TRIALS, 2)}}


def main(script):
    spec = importlib.util.spec_from_file_location("table1", script)
    table1 = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(table1)
    columns = {}
    for detections in table1.PHOTOS:
        columns |= columns_of(detections)
    found = table1.quantities(columns, "ols", {d: np.arange(TRIALS) for d in table1.PHOTOS})
    # Half of the photos of every column are located, so that columns count as the paper has photos of them.
    weights = np.array(list(table1.PHOTOS.values())) / sum(table1.PHOTOS.values())
    mean_detections = (weights * list(table1.PHOTOS)).sum()
    mean_number = np.arange(TRIALS // 2, TRIALS).mean()
    assert np.isclose(found["success %"][-1], 50.0), found
    assert np.isclose(found["convergence %"][-1], 25.0), found
    assert np.isclose(found["iterations"][-1], mean_detections), found
    assert np.isclose(found["error m"][-1], mean_detections * mean_number), found
    # A study of some photos counts them all, whatever the other columns have.
    drawn = {d: np.arange(n) + TRIALS // 2 - n + (1 if d == 3 else 0) for d, n in table1.PHOTOS.items()}
    assert np.isclose(table1.quantities(columns, "ols", drawn)["success %"][-1], 100.0 / 80), drawn


if __name__ == "__main__":
    main(sys.argv[1])
