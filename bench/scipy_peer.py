#!/usr/bin/env python3
"""Times what Python users would write, on the problems that `ridgeloc_bench --write-problems` wrote.

Usage: scipy_peer.py PROBLEMS.csv [--repetitions N]    (JSON for table.py on standard output)

- numpy-gn/matched: Gauss-Newton on all problems at once, finished ones dropped, stopped by our rule.
- scipy-lm/default: scipy.optimize.least_squares(method="lm") with the analytic Jacobian, one problem at a time, on the
  first 512 problems only; its iterations and errors are those of these 512.
"""

import argparse
import json
import sys
import time

import numpy as np
from scipy.optimize import least_squares

STEP_TOLERANCE_M = 0.05  # as in stop.hpp
MAX_STEPS = 30
CLIP_M = 10.0  # as in answer.hpp; the truth is the origin
SCIPY_TRIALS = 512


def read_problems(path):
    """Starts (3, trials), points (3, n, trials) and measured ranges (n, trials)."""
    values = np.loadtxt(path, delimiter=",").T
    observations = values[3:].reshape(-1, 4, values.shape[1])
    return values[:3].copy(), observations[:, :3].swapaxes(0, 1).copy(), observations[:, 3].copy()


def gauss_newton(start, points, measured):
    """Estimates, steps and convergence of all problems; the 3 x 3 equations are solved by Cramer's rule."""
    estimate = start.copy()
    steps = np.zeros(start.shape[1])
    converged = np.zeros(start.shape[1], dtype=bool)
    active = np.arange(start.shape[1])
    x = start
    for _ in range(MAX_STEPS):
        d = x[:, None] - points
        r = np.sqrt((d * d).sum(axis=0))
        e = r - measured
        d /= r
        (xx, xy, xz), (yy, yz), zz = (d[0] * d).sum(axis=1), (d[1] * d[1:]).sum(axis=1), (d[2] * d[2]).sum(axis=0)
        gx, gy, gz = (d * e).sum(axis=1)
        cxx, cxy, cxz = yy * zz - yz * yz, xz * yz - xy * zz, xy * yz - xz * yy
        cyy, cyz, czz = xx * zz - xz * xz, xy * xz - xx * yz, xx * yy - xy * xy
        dx = np.stack([cxx * gx + cxy * gy + cxz * gz, cxy * gx + cyy * gy + cyz * gz,
                       cxz * gx + cyz * gy + czz * gz]) / (xx * cxx + xy * cxy + xz * cxz)
        x = x - dx
        length = np.sqrt((dx * dx).sum(axis=0))
        estimate[:, active] = x
        steps[active] += 1
        converged[active] = length < STEP_TOLERANCE_M
        going = (length >= STEP_TOLERANCE_M) & np.isfinite(length)
        active, x, points, measured = active[going], x[:, going], points[:, :, going], measured[:, going]
        if active.size == 0:
            break
    return estimate, steps, converged


def levenberg_marquardt(start, points, measured):
    """The same by scipy, one problem after the other. One of the evaluations that it counts is at the start."""
    estimate = np.empty_like(start)
    steps = np.empty(start.shape[1])
    converged = np.empty(start.shape[1], dtype=bool)
    for trial in range(start.shape[1]):
        p, m = points[trial], measured[trial]

        def residuals(x):
            d = x - p
            return np.sqrt((d * d).sum(axis=1)) - m

        def jacobian(x):
            d = x - p
            return d / np.sqrt((d * d).sum(axis=1))[:, None]

        found = least_squares(residuals, start[:, trial], jac=jacobian, method="lm")
        estimate[:, trial], steps[trial], converged[trial] = found.x, found.nfev - 1, found.success
    return estimate, steps, converged


def repetitions_of(name, family, repetitions, solve, trials):
    """Entries as Google Benchmark writes them."""
    for repetition in range(repetitions):
        begin = time.process_time()
        estimate, steps, converged = solve()
        seconds = time.process_time() - begin
        error = np.fmin(np.sqrt((estimate * estimate).sum(axis=0)), CLIP_M)
        yield {
            "run_name": name,
            "run_type": "iteration",
            "family_index": family,
            "repetition_index": repetition,
            "per_trial": seconds / trials,
            "steps": steps.mean(),
            "rms_error_m": np.sqrt((error * error).mean()),
            "converged": converged.mean(),
        }


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("problems")
    parser.add_argument("--repetitions", type=int, default=5)
    arguments = parser.parse_args()

    np.seterr(all="ignore")  # diverging trials are part of the problem
    start, points, measured = read_problems(arguments.problems)
    n, trials = measured.shape
    few = min(SCIPY_TRIALS, trials)
    # One problem's points lie together for scipy, one coordinate's trials for numpy.
    by_trial = np.ascontiguousarray(points.transpose(2, 1, 0))
    measured_by_trial = np.ascontiguousarray(measured.T)
    entries = [
        *repetitions_of(f"numpy-gn/matched/{n}", 0, arguments.repetitions,
                        lambda: gauss_newton(start, points, measured), trials),
        *repetitions_of(f"scipy-lm/default/{n}", 1, arguments.repetitions,
                        lambda: levenberg_marquardt(start[:, :few], by_trial, measured_by_trial), few),
    ]
    json.dump({"benchmarks": entries}, sys.stdout, indent=1)


if __name__ == "__main__":
    main()
