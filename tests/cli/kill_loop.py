#!/usr/bin/python3
"""Kills a running sweep again and again, lets the next run go on, and checks that nothing finished was lost.

Usage: kill_loop.py PROGRAM [--kills N] [--seed S]

Sweeps of two studies, one that keeps all its trials and one that keeps few, are topped up in steps. Each run is killed (SIGKILL) at a random moment, told to
stop (SIGTERM), or told to stop and killed a moment later, and the same command goes on. Some kills wait until a file shows
that the program is at something that takes little time: a part or the result under its temporary name, the new result.

A block is finished once a part or the result that holds it has its name. All of them (cell, method, block, its trials, and
whether the values of its trials are there) are listed after each run: one that is there no more, or with fewer trials, is
lost. Each sealed result must have the data digest of an unbroken run. The exit code is 0 if nothing was lost and no
digest differs. Files lie in a folder under TMPDIR; a file system in memory (TMPDIR=/dev/shm) is faster.
"""

import argparse
import collections
import hashlib
import os
import pathlib
import random
import signal
import subprocess
import sys
import tempfile
import time

import h5py

# All trials are kept: parts of 32 MiB, a result of 80 MB. The last block of a cell grows from step to step, and from the
# second on the result is there already.
LARGE = """experiment = "ranging"
audit = 0
[store]
trial_columns_mib = 4096
[sweep]
points = [3, 5]
[[method]]
solver = "ols"
[[method]]
solver = "linear"
[[method]]
solver = "bancroft"
"""
# Few trials are kept and blocks take their time, so that stopped runs leave small parts; many of these become one.
SMALL = """experiment = "ranging"
audit = 0.03
[store]
trial_columns_mib = 1
[scene]
points = 4
[[method]]
solver = "ols"
"""
STUDIES = {"large": LARGE, "small": SMALL}
STEPS = {"large": [100000, 110000, 240000], "small": [50000, 1500000]}
CHECKSUM_DIGITS = 64
SMALL_PARTS = 64  # so many small parts become one


class Files:
    """The result and the parts beside it."""

    def __init__(self, result):
        self.result = result
        self.folder = pathlib.Path(f"{result}.parts")
        self.cache = {}

    def parts(self):
        return [self.folder / name for name in sorted(self.names()) if name.endswith(".h5")]

    def names(self):
        try:
            return os.listdir(self.folder)
        except FileNotFoundError:  # a run removes the folder at its end
            return []

    def inode(self):
        return self.result.stat().st_ino if self.result.exists() else 0

    def unfinished_part(self):
        return any(name.endswith(".ridgeloc-tmp") for name in self.names())

    def unfinished_result(self):
        return any(self.result.parent.glob(f"{self.result.name}.*.ridgeloc-tmp"))

    def blocks(self):
        """(cell, method, block) -> (trials, whether the values of its trials are there), of all files together."""
        union = {}
        for path in self.parts() + [self.result] * self.result.exists():
            status = path.stat()
            key = (path, status.st_ino, status.st_size, status.st_mtime_ns)
            if key not in self.cache:
                self.cache[key] = read_blocks(path, is_part=path != self.result)
            for name, content in self.cache[key].items():
                union[name] = max(union.get(name, (0, False)), content)
        return union


def read_blocks(path, is_part):
    """What one file holds; nothing if it is a damaged part."""
    if is_part:
        content = path.read_bytes()
        if hashlib.sha256(content[:-CHECKSUM_DIGITS]).hexdigest().encode() != content[-CHECKSUM_DIGITS:]:
            return {}
    blocks = {}
    with h5py.File(path, "r") as file:
        cells = file["cells/hash"][:]
        methods = file["methods/hash"][:]
        labels = file["methods/label"].asstr()[:]
        block_trials = int(file.attrs["block_trials"])
        with_values = set()
        if is_part:
            with_values.update(zip(*(file["columns"][name][:].tolist() for name in ("cell", "method", "block"))))
        else:
            for cell in range(len(cells)):
                for method, label in enumerate(labels):
                    kept = file.get(f"trials/{cell}/{label}/block", [])
                    with_values.update((cell, method, int(block)) for block in kept)
        rows = zip(*(file["ledger"][name][:].tolist() for name in ("cell", "method", "first_block", "blocks", "trials")))
        for cell, method, first, count, trials in rows:
            for block in range(first, first + count):
                of_block = min(trials, block_trials) if count == 1 else block_trials
                blocks[cells[cell], methods[method], block] = (of_block, (cell, method, block) in with_values)
    return blocks


class Loop:
    def __init__(self, program, folder, kills, seed):
        self.program = program
        self.folder = folder
        self.kills = kills
        self.random = random.Random(seed)
        self.reference = {}  # study, trials -> (digest, seconds)
        self.seconds_to_begin = 0.03  # until a run has computed something, as far as is known
        self.phases = collections.Counter()
        self.stops = 0
        self.killed = 0
        self.sealed = 0
        self.most_finished = 0
        self.problems = []

    def command(self, study, trials, result):
        return [self.program, "run", f"{study}.toml", "--trials", str(trials), "--threads", "2", "-o", result.name]

    def start(self, study, trials, result):
        return subprocess.Popen(self.command(study, trials, result), cwd=self.folder, stdout=subprocess.DEVNULL,
                                stderr=subprocess.PIPE, text=True)

    def finish(self, study, trials, result):
        """An undisturbed run; returns the seconds it took."""
        begin = time.monotonic()
        subprocess.run(self.command(study, trials, result), cwd=self.folder, check=True, capture_output=True)
        return time.monotonic() - begin

    def digest(self, result):
        shown = subprocess.run([self.program, "verify", "--digest", result.name], cwd=self.folder, capture_output=True,
                               text=True, check=True)
        return shown.stdout.strip()

    def make_references(self):
        for study, steps in STEPS.items():
            for trials in steps:
                result = self.folder / "unbroken.h5"
                seconds = self.finish(study, trials, result)
                self.reference[study, trials] = (self.digest(result), seconds)
                result.unlink()

    def wait_for(self, happened, process):
        while process.poll() is None and not happened():
            time.sleep(0.0002)

    def disturb(self, process, files, inode, seconds):
        """Lets the process run for a while and then kills or stops it."""
        def later(most):
            time.sleep(self.random.uniform(0, most))

        way = self.random.choices(["any", "early", "part", "result", "sealed", "stop", "stop and kill"],
                                  [6, 1, 3, 3, 2, 2, 3])[0]
        if len(files.parts()) >= SMALL_PARTS - 1:  # the next part makes the program unite them
            way = "unite"
        # Runs that go on have less left to do: short times more often.
        seconds *= self.random.random()
        if way == "any":
            later(seconds)
        elif way == "early":
            later(0.05)
        elif way == "part":
            self.wait_for(files.unfinished_part, process)
            later(0.03)
        elif way == "result":
            self.wait_for(files.unfinished_result, process)
            later(0.4 * seconds)
        elif way == "sealed":
            self.wait_for(lambda: files.inode() != inode, process)
            later(0.01)
        elif way == "unite":
            time.sleep(self.seconds_to_begin)
            later(self.seconds_to_begin)
            process.send_signal(signal.SIGTERM)
            self.wait_for(files.unfinished_part, process)
            later(0.05)
        else:
            later(seconds)
            process.send_signal(signal.SIGTERM)
            if way == "stop":
                return
            later(0.05)
        process.kill()

    def phase(self, files, inode, parts):
        """What the killed program was at, from what it left."""
        now = set(files.parts())
        if files.unfinished_part():
            return "uniting small parts" if len(now) >= SMALL_PARTS else "writing a part"
        if files.unfinished_result():
            return "sealing"
        if files.inode() != inode:
            return "removing parts after sealing" if now else "after removing parts"
        if parts - now:
            return "removing small parts"
        return "computing or starting"

    def run_once(self, study, trials, files):
        """Returns whether the run ended by itself."""
        before = files.blocks()
        inode, parts = files.inode(), set(files.parts())
        process = self.start(study, trials, files.result)
        self.disturb(process, files, inode, self.reference[study, trials][1])
        message = process.communicate()[1].strip()
        after = files.blocks()
        lost = [name for name, content in before.items() if after.get(name, (0, False)) < content]
        if lost:
            self.problems.append(f"{len(lost)} of {len(before)} finished blocks lost: {lost[:3]}")
        self.most_finished = max(self.most_finished, len(after))
        if "warning" in message:
            self.problems.append(message)
        code = process.returncode
        if code == -signal.SIGKILL:
            self.killed += 1
            self.phases[self.phase(files, inode, parts)] += 1
            if self.killed % 100 == 0:
                print(f"{self.killed} kills, {self.sealed} results sealed", file=sys.stderr)
        elif code in (4, -signal.SIGTERM):  # the latter before the program listens to signals
            self.stops += 1
            if code == -signal.SIGTERM:
                self.adapt(1.1)
        elif code != 0:
            self.problems.append(f"exit code {code}: {message}")
        return code == 0

    def adapt(self, factor):
        self.seconds_to_begin = min(factor * self.seconds_to_begin, 0.5)

    def make_small_parts(self, study, trials, files):
        """Stops runs as soon as they have computed something, which leaves a small part each."""
        ended = False
        while not ended and len(files.parts()) < SMALL_PARTS - 1:
            before = len(files.parts())
            process = self.start(study, trials, files.result)
            time.sleep(self.seconds_to_begin)
            process.send_signal(signal.SIGTERM)
            process.communicate()
            self.stops += 1
            ended = process.returncode == 0
            self.adapt(1.2 if len(files.parts()) == before else 0.95)

    def sweep(self, number):
        study = "small" if number % 4 == 0 else "large"
        files = Files(self.folder / f"sweep-{number}.h5")
        for trials in STEPS[study]:
            if study == "small" and files.result.exists():
                self.make_small_parts(study, trials, files)
            while self.killed < self.kills:
                if self.run_once(study, trials, files) or self.problems:
                    break
            if self.problems:
                return
            self.finish(study, trials, files.result)
            self.sealed += 1
            if self.digest(files.result) != self.reference[study, trials][0]:
                self.problems.append(f"another digest of the {study} study with {trials} trials")
                return
        left = [path.name for path in self.folder.glob(f"*{files.result.name}.*")]
        if left:
            self.problems.append(f"left behind: {left}")
        files.result.unlink()

    def run(self):
        self.make_references()
        begin = time.monotonic()
        number = 0
        while self.killed < self.kills and not self.problems:
            self.sweep(number)
            number += 1
        seconds = time.monotonic() - begin
        print(f"{self.killed} kills and {self.stops} stops in {seconds:.0f} s; {self.sealed} results sealed, "
              f"all with the digest of an unbroken run: {'no' if self.problems else 'yes'}")
        for phase, count in sorted(self.phases.items()):
            print(f"  {count:5}  {phase}")
        print(f"finished blocks lost: {'see below' if self.problems else 0} (of up to {self.most_finished})")
        for problem in self.problems:
            print(problem)
        return 1 if self.problems else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--kills", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="ridgeloc-kills-") as folder:
        for name, text in STUDIES.items():
            (pathlib.Path(folder) / f"{name}.toml").write_text(text)
        loop = Loop(arguments.program.resolve(), pathlib.Path(folder), arguments.kills, arguments.seed)
        return loop.run()


if __name__ == "__main__":
    sys.exit(main())
