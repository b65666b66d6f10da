#!/usr/bin/env python3
"""Times a study from end to end: `ridgeloc run` on sweep.toml, start of the program and storing included.

Usage: sweep.py PROGRAM [--trials N] [--repetitions N]

Runs with one and with two threads alternate in random order, so that a busy phase of the machine meets both. Prints the
median wall time of each, trials per second, and how many times faster two threads are. "cores" is CPU time over wall
time: where it is well below the number of threads, something else was running and the times mean nothing.
"""

import argparse
import pathlib
import random
import resource
import statistics
import subprocess
import tempfile
import time

STUDY = pathlib.Path(__file__).with_name("sweep.toml")
THREADS = (1, 2)


def cpu_seconds():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def run(program, trials, threads):
    """Wall time in seconds, and the cores that the run had."""
    # A new folder each time: a result that is there already would not be computed again.
    with tempfile.TemporaryDirectory() as folder:
        command = [program, "run", str(STUDY), "--trials", str(trials), "--threads", str(threads),
                   "-o", str(pathlib.Path(folder) / "sweep.h5")]
        begin, cpu_begin = time.perf_counter(), cpu_seconds()
        subprocess.run(command, check=True, capture_output=True)
        seconds = time.perf_counter() - begin
        return seconds, (cpu_seconds() - cpu_begin) / seconds


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--trials", type=lambda text: int(float(text)), default=1_000_000)
    parser.add_argument("--repetitions", type=int, default=21)
    arguments = parser.parse_args()

    runs = [threads for threads in THREADS for _ in range(arguments.repetitions)]
    random.shuffle(runs)
    times = {threads: [] for threads in THREADS}
    cores = {threads: [] for threads in THREADS}
    for threads in runs:
        seconds, used = run(arguments.program, arguments.trials, threads)
        times[threads].append(seconds)
        cores[threads].append(used)

    print(f"{arguments.trials} trials, medians of {arguments.repetitions} runs\n")
    print("| threads | s | best s | M trials/s | cores |\n|---:|---:|---:|---:|---:|")
    medians = {threads: statistics.median(seconds) for threads, seconds in times.items()}
    for threads, median in medians.items():
        rate = arguments.trials / median / 1e6
        print(f"| {threads} | {median:.3f} | {min(times[threads]):.3f} | {rate:.3f} | {statistics.median(cores[threads]):.2f} |")
    print(f"\n2 threads are {medians[1] / medians[2]:.2f} times faster than 1")


if __name__ == "__main__":
    main()
