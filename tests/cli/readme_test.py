#!/usr/bin/env python3
"""Does what the tour of README.md says, and checks that the program prints what stands there.

Usage: readme_test.py PROGRAM README [python]

Each indented block of the tour with lines "$ COMMAND" is run in the order of the page, all in one folder, and what
follows a command is what it prints. With the third argument the Python code of the page is run on the result too, which
needs xarray and h5netcdf.
"""

import difflib
import os
import pathlib
import re
import subprocess
import sys
import tempfile

TOUR = "## A tour of five minutes"
PYTHON = "## Reading a result from Python"

# What depends on the machine.
MASKS = [
    (r"\d+(?:\.\d+)? (?:ns|us|ms|s|min|h|days|years)\b", "TIME"),
    (r"\d+(?:\.\d+)? [KMG]iB(?=, and | in parts)", "SIZE"),
    (r"\bon \d+ threads?(?:, \d+ of them at work)?", "on THREADS"),
    (r"\bwith (?:baseline|avx2|avx512)\b", "with INSTRUCTIONS"),
    (r"(per trial and thread, .*) \(\d+ trials\)", r"\1 (TRIALS)"),
]


def section(page, heading):
    start = page.index(heading)
    end = page.find("\n## ", start)
    return page[start : end if end > 0 else len(page)]


def blocks(text):
    """The indented blocks of a section, without their indentation."""
    found = re.findall(r"(?:^    .*\n(?:\n*(?=    ))?)+", text, re.MULTILINE)
    return [re.sub(r"^    ", "", block, flags=re.MULTILINE) for block in found]


def commands(block):
    """Each command of a block with what it prints."""
    found = re.findall(r"^\$ (.*)\n((?:(?!\$ ).*\n)*)", block, re.MULTILINE)
    return [(command, printed.rstrip("\n").splitlines()) for command, printed in found]


def masked(lines, has_fused):
    out = []
    for line in lines:
        for pattern, replacement in MASKS:
            line = re.sub(pattern, replacement, line)
        # Without a fused multiply-add last digits differ.
        out.append(line.rstrip() if has_fused else re.sub(r"[\d.e+-]+", "N", " ".join(line.split())))
    return out


def compare(what, expected, printed, has_fused):
    expected, printed = masked(expected, has_fused), masked(printed, has_fused)
    if expected == printed:
        print(f"as printed: {what}")
        return True
    print(f"DIFFERENT: {what}")
    print("\n".join(difflib.unified_diff(expected, printed, "the page", "the program", lineterm="")))
    return False


def main(program, readme, *options):
    program, page = pathlib.Path(program).resolve(), pathlib.Path(readme).read_text(encoding="utf-8")
    environment = os.environ | {"PATH": f"{program.parent}:{os.environ['PATH']}"}
    with tempfile.TemporaryDirectory() as folder:

        def run(command, shell=True):
            done = subprocess.run(
                command, shell=shell, executable="/bin/bash" if shell else None, cwd=folder, env=environment,
                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False,
            )  # fmt: skip
            assert done.returncode == 0, f"{command}: exit code {done.returncode}\n{done.stdout}"
            return done.stdout

        probe = 'experiment = "ranging"\ntrials = 1\n[[method]]\nsolver = "ols"\n'
        pathlib.Path(folder, "probe.toml").write_text(probe, encoding="utf-8")
        has_fused = "with baseline" not in run("ridgeloc run probe.toml && rm probe.*")

        tour = [command for block in blocks(section(page, TOUR)) for command in commands(block)]
        assert len(tour) > 10, "the tour has become too short to be read rightly"
        good = [compare(command, expected, run(command).splitlines(), has_fused) for command, expected in tour]
        if "python" in options:
            *_, code, expected = blocks(section(page, PYTHON))
            printed = run([sys.executable, "-c", code], shell=False)
            good.append(compare("the Python code", expected.splitlines(), printed.splitlines(), has_fused))
        else:
            print("without xarray: the Python code is left out")
    sys.exit(0 if all(good) else 1)


if __name__ == "__main__":
    main(*sys.argv[1:])
