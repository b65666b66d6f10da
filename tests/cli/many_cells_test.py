#!/usr/bin/python3
"""Usage: many_cells_test.py PROGRAM

A study of 998 000 cells: `plan` answers, and `run` comes to its first blocks, within a GiB of memory each. Prints memory and
seconds, which are not compared with anything: that is for whoever has the machine to himself.
"""

import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

STUDY = """experiment = "ranging"
trials = 1
audit = 0
[store]
trial_columns_mib = 0
[sweep]
points = { from = 3, to = 1000, step = 1 }
range_sigma_m = { from = 0.001, to = 1.0, step = 0.001 }
[[method]]
solver = "ols"
"""
MOST_MEMORY = 1 << 30
PATIENCE_S = 600


def peak_of(process):
    """Its largest memory so far, in bytes."""
    for line in pathlib.Path(f"/proc/{process}/status").read_text().splitlines():
        if line.startswith("VmHWM:"):
            return int(line.split()[1]) << 10
    return 0


def watched(program, folder, arguments, is_enough):
    """Peak memory and seconds until the program ends or has done enough, and whether either came in time."""
    begin = time.monotonic()
    process = subprocess.Popen([program, *arguments], cwd=folder, stdout=subprocess.DEVNULL)
    peak = 0
    while process.poll() is None and not is_enough() and time.monotonic() - begin < PATIENCE_S:
        try:
            peak = max(peak, peak_of(process.pid))
        except OSError:  # it has ended just now
            break
        time.sleep(0.02)
    seconds = time.monotonic() - begin
    process.send_signal(signal.SIGKILL)
    code = process.wait()
    return peak, seconds, code == 0 or is_enough()


def begun(folder):
    """Whether a run has computed blocks, as it says in its record."""
    try:
        lines = (folder / "s.h5.parts" / "run.txt").read_text().splitlines()
    except OSError:
        return False
    return any(line.startswith("blocks_done ") and line != "blocks_done 0" for line in lines)


def main(program):
    problems = []
    with tempfile.TemporaryDirectory(prefix="ridgeloc-cells-") as name:
        folder = pathlib.Path(name)
        (folder / "s.toml").write_text(STUDY)
        calls = {"plan": (["plan", "s.toml"], lambda: False), "run": (["run", "s.toml"], lambda: begun(folder))}
        for verb, (arguments, is_enough) in calls.items():
            peak, seconds, done = watched(os.path.abspath(program), folder, arguments, is_enough)
            print(f"{verb}: {peak / 2 ** 20:.0f} MiB, {seconds:.1f} s")
            if not done:
                problems.append(f"{verb} has not come that far")
            if peak > MOST_MEMORY:
                problems.append(f"{verb} takes {peak >> 20} MiB")
    for problem in problems:
        print(problem)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
