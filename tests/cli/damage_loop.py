#!/usr/bin/python3
"""Damages a result and a part at random, and checks what every verb makes of them.

Usage: damage_loop.py PROGRAM [--files N] [--seed S]

Each damaged file has a flipped bit, is cut short, has a range of zeros or ones, or garbage behind it. A verb that reads the
damaged result must either say so in one line with exit code 2 or 3, or give what it gives for the whole one. A run that
finds the damaged part must say so and end with the data digest of an undisturbed run. Crashes, hangs of more than 10 s,
wrong outputs and other messages are counted; the exit code is 0 if there are none. Files lie in a folder under TMPDIR.
"""

import collections
import signal
import sys
import time

import loop

STUDY = """experiment = "ranging"
audit = 0
trials = 40
[sweep]
points = [3, 5]
[[method]]
solver = "rrr"
[[method]]
solver = "ols"
[[figure]]
x = "points"
y = "error_m"
"""
# What is called, and the file that the call writes, if any.
VERBS = {
    "summary": (["summary", "result.h5"], None),
    "export": (["export", "result.h5"], None),
    "export --trials": (["export", "--trials", "result.h5"], None),
    "export --failures": (["export", "--failures", "result.h5"], None),
    "verify": (["verify", "--blocks", "0", "result.h5"], None),
    "compare": (["compare", "result.h5", "whole.h5"], None),
    "report": (["report", "result.h5", "-o", "report.html"], "report.html"),
    "plot": (["plot", "result.h5", "-o", "figure.svg"], "figure.svg"),
    "replay": (["replay", "result.h5", "--cell", "0", "--trial", "3"], None),
    "audit": (["audit", "result.h5"], None),
    "merge": (["merge", "result.h5", "-o", "merged.h5"], "merged.h5"),
    "run": (["run", "study.toml", "--trials", "50", "-o", "result.h5"], "result.h5"),
}
PART_TRIALS = "40000"
HANG_SECONDS = 10


def damaged(content, chance):
    """The content with one kind of damage, and what it is."""
    place = chance.randrange(len(content))
    kind = chance.choices(["flip", "cut", "fill", "append"], [7, 1, 1, 1])[0]
    if kind == "flip":
        bit = chance.randrange(8)
        return content[:place] + bytes([content[place] ^ 1 << bit]) + content[place + 1:], f"bit {bit} of byte {place}"
    if kind == "cut":
        return content[:place], f"cut at {place}"
    size = 2 ** chance.randrange(13)
    if kind == "fill":
        filled = content[:place] + chance.choice([b"\0", b"\xff"]) * size + content[place + size:]
        return filled[:len(content)], f"{size} bytes filled from {place}"
    return content + chance.randbytes(size), f"{size} bytes appended"


class DamageLoop(loop.Loop):
    def __init__(self, program, folder, seed):
        super().__init__(program, folder, seed)
        self.counts = collections.defaultdict(collections.Counter)

    def value(self, name):
        """What counts of a written file: the data of a result, all of another."""
        if name is None:
            return b""
        if name.endswith(".h5"):
            return self.digest(name)
        return (self.folder / name).read_bytes()

    def count(self, who, outcome, what, message):
        self.counts[who][outcome] += 1
        if outcome not in ("told", "harmless"):
            self.problems.append(f"{who}, {what}: {outcome}: {message.decode(errors='replace').strip()}")

    def outcome(self, code, message, same):
        if code is None:
            return "hang"
        if code < 0:
            return f"crash by signal {-code}"
        if code == 0:
            return "harmless" if same() else "wrong output"
        return "told" if code in (2, 3) and message.count(b"\n") == 1 else f"exit code {code}, not one line"

    def damage_results(self, files):
        result = self.folder / "result.h5"
        self.require("run", "study.toml", "-o", "whole.h5")
        whole = (self.folder / "whole.h5").read_bytes()
        expected = {}
        for round_number in range(files + 1):  # the first is not damaged and says what is right
            content, what = damaged(whole, self.random) if round_number > 0 else (whole, "")
            for verb, (arguments, written) in VERBS.items():
                result.write_bytes(content)
                if written and written != result.name:
                    (self.folder / written).unlink(missing_ok=True)
                code, output, message = self.call(*arguments, timeout=HANG_SECONDS)
                if round_number == 0:
                    if code != 0:
                        sys.exit(f"{verb} fails on a whole result: {message.decode()}")
                    expected[verb] = (code, output, self.value(written))
                    continue
                same = lambda: (code, output, self.value(written)) == expected[verb]
                self.count(verb, self.outcome(code, message, same), what, message)
                if code != 0 and result.read_bytes() != content:
                    self.problems.append(f"{verb}, {what}: the damaged file was replaced")

    def damage_parts(self, files):
        """Some blocks in a part, the others missing."""
        arguments = ["run", "study.toml", "--trials", PART_TRIALS, "-o", "parted.h5"]
        self.require(*arguments)
        expected = self.value("parted.h5")
        (self.folder / "parted.h5").unlink()
        part = self.folder / "parted.h5.parts" / "part-000000.h5"
        seconds = 0.02
        while not part.exists():
            (self.folder / "parted.h5").unlink(missing_ok=True)
            process = self.start(*arguments, "--threads", "1")
            time.sleep(seconds)
            process.send_signal(signal.SIGTERM)
            process.communicate()
            seconds += 0.01
        whole = part.read_bytes()
        for _ in range(files):
            content, what = damaged(whole, self.random)
            part.parent.mkdir(exist_ok=True)
            part.write_bytes(content)
            code, _, message = self.call(*arguments, timeout=HANG_SECONDS)
            is_told = b"warning: ignored, its blocks are computed again: " in message
            outcome = self.outcome(code, b"", lambda: self.value("parted.h5") == expected)
            if outcome == "harmless":
                outcome = "told" if is_told or content == whole else "not told"
            self.count("run with a part", outcome, what, message)
            (self.folder / "parted.h5").unlink(missing_ok=True)

    def run(self, files):
        begin = time.monotonic()
        self.damage_results(files)
        self.damage_parts(files)
        return self.report(time.monotonic() - begin)

    def report(self, seconds):
        print(f"in {seconds:.0f} s, of each verb with damaged files:")
        for who, outcomes in self.counts.items():
            print(f"  {who:18}", ", ".join(f"{count} {outcome}" for outcome, count in sorted(outcomes.items())))
        for problem in self.problems:
            print(problem)
        return 1 if self.problems else 0


if __name__ == "__main__":
    sys.exit(loop.main(DamageLoop, __doc__, {"study.toml": STUDY}, "files"))
