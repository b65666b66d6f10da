#!/usr/bin/env python3
"""Prints the results of ridgeloc_bench, and of scipy_peer.py, as Markdown tables.

Usage: table.py FILE.json...

The time of a row is the median over its repetitions of the CPU time per trial; "spread" is the distance of the
quartiles over the median. "x Ceres" and "x Tiny" say how many times faster a row is than Ceres with DENSE_QR and than
TinySolver, both stopped by our rule. Read no ratio without the three columns before it.
"""

import json
import statistics
import sys

CERES = "ceres-qr/matched"
TINY = "tinysolver/matched"
STD = "generate/mt19937_64"
SCAN = "coarse/scan"


class Row:
    """All repetitions of one benchmark."""

    def __init__(self, order):
        self.order = order
        self.seconds = []
        self.accuracy = None

    def add(self, entry):
        self.seconds.append(entry["per_trial"])
        if "steps" in entry:
            self.accuracy = (entry["steps"], entry["rms_error_m"], entry["converged"])

    def median(self):
        return statistics.median(self.seconds)

    def spread(self):
        if len(self.seconds) < 2:
            return float("nan")
        low, _, high = statistics.quantiles(self.seconds, n=4, method="inclusive")
        return (high - low) / self.median()


def read(paths):
    """{points: {name: Row}}: interleaved repetitions come in any order, rows are listed as the program has them."""
    tables = {}
    for file_number, path in enumerate(paths):
        with open(path, encoding="utf-8") as file:
            entries = json.load(file)["benchmarks"]
        for entry in entries:
            if entry["run_type"] != "iteration":
                continue
            name, _, points = entry["run_name"].rpartition("/")
            order = (file_number, entry["family_index"])
            tables.setdefault(int(points), {}).setdefault(name, Row(order)).add(entry)
    return tables


def nanoseconds(seconds):
    return f"{seconds * 1e9:.{1 if seconds < 1e-7 else 0}f}"


def ratio(rows, reference, row):
    if reference not in rows:
        return "-"
    return f"{rows[reference].median() / row.median():.3g}"


def print_table(title, header, lines):
    print(f"### {title}\n")
    print("| " + " | ".join(header) + " |")
    print("|---|" + "---:|" * (len(header) - 1))
    for line in lines:
        print("| " + " | ".join(line) + " |")
    print()


def print_solvers(points, rows):
    lines = []
    for name, row in sorted(rows.items(), key=lambda item: item[1].order):
        steps, error, converged = row.accuracy
        lines.append([name, nanoseconds(row.median()), f"{row.spread():.1%}", f"{steps:.2f}", f"{error:.3f}",
                      f"{converged:.2%}", ratio(rows, CERES, row), ratio(rows, TINY, row)])
    header = ["solver", "ns per trial", "spread", "iterations", "RMS error (m)", "converged", "x Ceres", "x Tiny"]
    print_table(f"Solving, n = {points}", header, lines)


def print_times(title, rows, reference):
    lines = [[name, nanoseconds(row.median()), f"{row.spread():.1%}", ratio(rows, reference, row)]
             for name, row in sorted(rows.items(), key=lambda item: item[1].order)]
    print_table(title, ["row", "ns per trial", "spread", f"x {reference.rpartition('/')[2]}"], lines)


def main(paths):
    if not paths:
        sys.exit(__doc__)
    for points, rows in sorted(read(paths).items()):
        solvers = {name: row for name, row in rows.items() if row.accuracy}
        coarse = {name: row for name, row in rows.items() if name.startswith("coarse/")}
        generators = {name: row for name, row in rows.items() if not row.accuracy and name not in coarse}
        if solvers:
            print_solvers(points, solvers)
        if generators:
            print_times(f"Drawing, and whole blocks, n = {points}", generators, STD)
        if coarse:
            print_times(f"Coarse positioning, a photo among {points} graphs", coarse, SCAN)


if __name__ == "__main__":
    main(sys.argv[1:])
