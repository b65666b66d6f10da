#!/usr/bin/python3
"""Kills a running sweep again and again, lets the next run go on, and checks that nothing finished was lost.

Usage: kill_loop.py PROGRAM [--kills N] [--seed S]

Sweeps of two studies, one that keeps all its trials and one that keeps few, are topped up in steps. Each run is killed
(SIGKILL) at a random moment, told to stop (SIGTERM), or told to stop and killed a moment later, and the same command goes
on. Some kills wait until a file shows that the program is at something that takes little time: a part or the result under
its temporary name, the new result.

A block is finished once a part or the result that holds it has its name. All of them (cell, method, block, its trials, and
whether the values of its trials are there) are listed after each run: one that is there no more, or with fewer trials, is
lost. Each sealed result must have the data digest of an unbroken run. The exit code is 0 if nothing was lost and no
digest differs. Files lie in a folder under TMPDIR; a file system in memory (TMPDIR=/dev/shm) is faster.
"""

import collections
import signal
import sys
import time

import loop
from result_files import Files

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
SMALL_PARTS = 64  # so many small parts become one


class KillLoop(loop.Loop):
    def __init__(self, program, folder, seed):
        super().__init__(program, folder, seed)
        self.kills = 0
        self.reference = {}  # study, trials -> (digest, seconds)
        self.seconds_to_begin = 0.03  # until a run has computed something, as far as is known
        self.phases = collections.Counter()
        self.stops = 0
        self.killed = 0
        self.sealed = 0
        self.most_finished = 0

    @staticmethod
    def command(study, trials, result):
        return ["run", f"{study}.toml", "--trials", str(trials), "--threads", "2", "-o", result.name]

    def finish(self, study, trials, result):
        """An undisturbed run; returns the seconds it took."""
        begin = time.monotonic()
        self.require(*self.command(study, trials, result))
        return time.monotonic() - begin

    def make_references(self):
        for study, steps in STEPS.items():
            for trials in steps:
                result = self.folder / "unbroken.h5"
                seconds = self.finish(study, trials, result)
                self.reference[study, trials] = (self.digest(result.name), seconds)
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
        process = self.start(*self.command(study, trials, files.result))
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
        self.seconds_to_begin = min(factor * self.seconds_to_begin, 2.0)

    def make_small_parts(self, study, trials, files):
        """Stops runs as soon as they have computed something, which leaves a small part each."""
        ended = False
        while not ended and len(files.parts()) < SMALL_PARTS - 1:
            before = len(files.parts())
            process = self.start(*self.command(study, trials, files.result))
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
            if self.digest(files.result.name) != self.reference[study, trials][0]:
                self.problems.append(f"another digest of the {study} study with {trials} trials")
                return
        left = [path.name for path in self.folder.glob(f"*{files.result.name}.*")]
        if left:
            self.problems.append(f"left behind: {left}")
        files.result.unlink()

    def run(self, kills):
        self.kills = kills
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


if __name__ == "__main__":
    sys.exit(loop.main(KillLoop, __doc__, {f"{name}.toml": text for name, text in STUDIES.items()}, "kills"))
