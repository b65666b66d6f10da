#!/usr/bin/env python3
"""Runs the code of docs/reading-results.md on a result and checks that it prints what `ridgeloc export` says.

Usage: read_documented_test.py PROGRAM PAGE READER...

The code for a reader is the fenced block of the page that is labelled with its language and the reader's name. The
block "make" writes the results, and "prints" is what the page says that all of them print. A reader may have a second block
for a sweep that is no grid, "<reader>_cells", which finds the same numbers there.
"""

import csv
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile

COMMANDS = {"python": [sys.executable], "r": ["Rscript"], "sh": ["bash", "-euo", "pipefail"], "octave": ["octave-cli"]}
# Every reader prints seven digits or more: half a unit of the seventh is at most this share of a number.
ROUNDING = 5e-7


def blocks(page):
    """Language and code of each labelled block, by its label."""
    found = re.findall(r"^```(\w+) (\w+)\n(.*?)^```$", page.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)
    return {label: (language, code) for language, label, code in found}


def run(block, folder, program):
    language, code = block
    script = folder / "script"
    script.write_text(code, encoding="utf-8")
    environment = os.environ | {"PATH": f"{program.parent}:{os.environ['PATH']}"}
    return subprocess.run(
        [*COMMANDS[language], script], cwd=folder, env=environment, check=True, stdout=subprocess.PIPE, text=True
    ).stdout


def exported(folder, program):
    """The numbers that the page reads, from the CSV of the same result."""
    text = subprocess.run([program, "export", "first.h5"], cwd=folder, check=True, capture_output=True, text=True).stdout
    wanted = {"points": "5", "range_sigma_m": "0.1", "method": "rrr", "metric": "error_m"}
    (row,) = [row for row in csv.DictReader(text.splitlines()) if wanted.items() <= row.items()]
    return [float(row[name]) for name in ("p50", "p50_lo", "p50_hi", "n", "mean")], row["unit"]


def check(who, text, numbers, unit):
    printed = [float(number) for number in re.findall(r"\b\d+(?:\.\d+)?\b", text)]
    same = len(printed) == len(numbers) and all(
        math.isclose(a, b, rel_tol=ROUNDING) for a, b in zip(printed, numbers)
    )
    assert same and re.search(rf"\b{unit}\b", text), f"{who}: printed\n{text}but the result has {numbers} {unit}"
    print(f"{who}: as exported")


def main(program, page, *readers):
    program, documented = pathlib.Path(program).resolve(), blocks(pathlib.Path(page))
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        run(documented["make"], folder, program)
        numbers, unit = exported(folder, program)
        check("the page", documented["prints"][1], numbers, unit)
        for reader in readers:
            for label in (reader, f"{reader}_cells"):
                if label == reader or label in documented:
                    check(label, run(documented[label], folder, program), numbers, unit)


if __name__ == "__main__":
    main(*sys.argv[1:])
