#!/usr/bin/env python3
"""Instructions per trial, and whether they are within what bench/instructions.csv allows.

usage: instructions.py RIDGELOC_BENCH

A count does not depend on the machine, nor on what else it does, as a time would. Counted by valgrind, which has AVX2 and
not AVX-512; the difference of two runs leaves starting and reading out. Exit code 1 where a count is beyond its bound.
"""

import csv
import pathlib
import re
import subprocess
import sys
import tempfile

TRIALS_OF_A_PASS = 4096
FEW, MANY = 1, 3


def instructions(program, work, passes):
    """Of a whole run."""
    with tempfile.TemporaryDirectory() as folder:
        run = subprocess.run(
            ["valgrind", "--tool=callgrind", f"--callgrind-out-file={folder}/out", program, "--pass", work, str(passes)],
            capture_output=True, text=True, check=False)
    counted = re.search(r"Collected : (\d+)", run.stderr)
    if run.returncode != 0 or counted is None:
        sys.exit(f"instructions: {program} --pass {work} {passes} under valgrind: exit code {run.returncode}\n{run.stderr}")
    return int(counted[1])


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__.split("\n")[2])
    within = True
    with open(pathlib.Path(__file__).with_suffix(".csv"), newline="") as file:
        rows = list(csv.DictReader(file))
    for row in rows:
        difference = instructions(sys.argv[1], row["work"], MANY) - instructions(sys.argv[1], row["work"], FEW)
        per_trial = difference / ((MANY - FEW) * TRIALS_OF_A_PASS)
        bound = float(row["at_most"])
        verdict = "within" if per_trial <= bound else "BEYOND"
        print(f"{row['work']}: {per_trial:.0f} instructions a trial, {verdict} the bound of {bound:.0f}")
        within = within and per_trial <= bound
    return 0 if within else 1


if __name__ == "__main__":
    sys.exit(main())
