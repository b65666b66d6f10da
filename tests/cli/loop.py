"""What kill_loop.py and damage_loop.py share: a program that is called again and again in a folder of its own."""

import argparse
import pathlib
import random
import subprocess
import sys
import tempfile


class Loop:
    def __init__(self, program, folder, seed):
        self.program = program
        self.folder = folder
        self.random = random.Random(seed)
        self.problems = []

    def call(self, *arguments, timeout=None):
        """Exit code, output and message; no exit code if it takes longer than the timeout."""
        try:
            done = subprocess.run([self.program, *arguments], cwd=self.folder, capture_output=True, timeout=timeout)
        except subprocess.TimeoutExpired:
            return None, b"", b""
        return done.returncode, done.stdout, done.stderr

    def require(self, *arguments):
        """The output of a call that must succeed."""
        code, output, message = self.call(*arguments)
        if code != 0:
            sys.exit(f"ridgeloc {' '.join(arguments)} failed: {message.decode()}")
        return output

    def start(self, *arguments):
        return subprocess.Popen([self.program, *arguments], cwd=self.folder, stdout=subprocess.DEVNULL,
                                stderr=subprocess.PIPE, text=True)

    def digest(self, name):
        """That of the data of a result; empty if it is none."""
        return self.call("verify", "--digest", name)[1].strip()


def main(loop, description, studies, counted):
    """Reads the command line, writes the studies (file name -> text) into a new folder, and runs a loop there: its exit
    code. `counted` is what the loop does a number of times."""
    parser = argparse.ArgumentParser(description=description.splitlines()[0])
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument(f"--{counted}", type=int, default=1000, dest="count")
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="ridgeloc-loop-") as folder:
        for name, text in studies.items():
            (pathlib.Path(folder) / name).write_text(text)
        return loop(arguments.program.resolve(), pathlib.Path(folder), arguments.seed).run(arguments.count)
