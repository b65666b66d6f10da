#!/usr/bin/python3
"""A run under everything that can happen to its surroundings, in small: it must end with the digest of an unbroken run.

Usage: hostile_hour.py PROGRAM [--seconds N] [--seed S]

For N seconds a run is begun again and again and topped up, each time in a pseudo-terminal that vanishes under it, with a log on
a full disk, with standard output in a pipe whose reader has left, or with a reader that leaves later; all the while it is
stopped and continued (SIGSTOP, SIGCONT), and now and then looked at, told to stop (SIGTERM) or killed. Then it is brought to its end
and its digest compared. Prints what happened how often; the exit code is 0 if nothing was lost.
"""

import argparse
import collections
import os
import pathlib
import pty
import random
import signal
import subprocess
import sys
import tempfile
import time

STUDY = """experiment = "ranging"
trials = 400000
[store]
trial_columns_mib = 8
[sweep]
points = [3, 5, 7]
range_sigma_m = [0.1, 0.3]
[[method]]
solver = "ols"
[[method]]
solver = "rrr"
"""
# What a run may end with: done, output that nobody reads, stopped in time.
ALLOWED = {0, 3, 4}


class HostileHour:
    def __init__(self, program, folder, seed):
        self.program = program
        self.folder = folder
        self.random = random.Random(seed)
        self.happened = collections.Counter()
        self.problems = []

    def command(self, trials):
        return [self.program, "run", "s.toml", "-o", "r.h5", "--trials", str(trials)]

    def start(self, trials):
        """A run whose terminal, log or reader is of one kind, and what is to be closed under it later."""
        kind = self.random.choice(["terminal", "full log", "no reader", "leaving reader"])
        self.happened[kind] += 1
        if kind == "terminal":
            master, slave = pty.openpty()
            run = subprocess.Popen(self.command(trials), cwd=self.folder, stdin=slave, stdout=slave, stderr=slave,
                                   start_new_session=True)
            os.close(slave)
            return run, [master]
        if kind == "full log":
            with open("/dev/full", "wb") as full:
                return subprocess.Popen(self.command(trials), cwd=self.folder, stdout=full, stderr=full), []
        reader, writer = os.pipe()
        run = subprocess.Popen(self.command(trials), cwd=self.folder, stdout=writer, stderr=writer)
        os.close(writer)
        if kind == "leaving reader":
            return run, [reader]
        os.close(reader)
        return run, []

    def torment(self, run, later):
        """Stops and continues the run for a while, and takes away what it writes to."""
        for _ in range(self.random.randrange(1, 6)):
            time.sleep(self.random.uniform(0.02, 0.5))
            if run.poll() is not None:
                break
            run.send_signal(signal.SIGSTOP)
            time.sleep(self.random.uniform(0.01, 0.3))
            run.send_signal(signal.SIGCONT)
            self.happened["stopped and continued"] += 1
            if later and self.random.random() < 0.5:
                os.close(later.pop())
                self.happened["taken away"] += 1
            if self.random.random() < 0.2:
                self.look()
        for descriptor in later:
            os.close(descriptor)

    def look(self):
        self.happened["looked at"] += 1
        done = subprocess.run([self.program, "status", "r.h5"], cwd=self.folder, capture_output=True)
        if done.returncode not in (0, 2):
            self.problems.append(f"status ends with {done.returncode}: {done.stderr.decode()}")

    def end(self, run):
        """Lets the run go on, stops it or kills it."""
        kind = self.random.choice(["let go on", "SIGTERM", "SIGKILL"])
        if run.poll() is None and kind != "let go on":
            self.happened[kind] += 1
            run.send_signal(signal.SIGTERM if kind == "SIGTERM" else signal.SIGKILL)
        try:
            code = run.wait(timeout=300)
        except subprocess.TimeoutExpired:
            run.kill()
            self.problems.append("a run has not ended within 300 s")
            return
        killed = code == -signal.SIGKILL and kind == "SIGKILL"
        if code not in ALLOWED and not killed:
            self.problems.append(f"a run ends with {code}")
        self.happened[f"ended with {code}"] += 1

    def digest(self, name):
        done = subprocess.run([self.program, "verify", "--digest", name], cwd=self.folder, capture_output=True, text=True)
        return done.stdout.strip() or done.stderr.strip()

    def run(self, seconds):
        (self.folder / "s.toml").write_text(STUDY)
        trials, most = 20000, 400000
        deadline = time.monotonic() + seconds
        while time.monotonic() < deadline:
            run, later = self.start(trials)
            self.torment(run, later)
            self.end(run)
            trials = min(most, int(trials * 1.2))
        for name in ("r.h5", "whole.h5"):
            done = subprocess.run([self.program, "run", "s.toml", "--trials", str(most), "-o", name], cwd=self.folder,
                                  capture_output=True, text=True)
            if done.returncode != 0:
                self.problems.append(f"the last run ends with {done.returncode}: {done.stderr}")
        if self.digest("r.h5") != self.digest("whole.h5"):
            self.problems.append(f"digests differ: {self.digest('r.h5')}, unbroken {self.digest('whole.h5')}")
        print(", ".join(f"{count} {what}" for what, count in sorted(self.happened.items())))
        for problem in self.problems:
            print(problem)
        return 1 if self.problems else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--seconds", type=float, default=3600)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="ridgeloc-hour-") as folder:
        return HostileHour(arguments.program.resolve(), pathlib.Path(folder), arguments.seed).run(arguments.seconds)


if __name__ == "__main__":
    sys.exit(main())
