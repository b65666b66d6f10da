"""Reads parts without ridgeloc: damaged ones hold nothing, those of earlier formats are refused."""

import pathlib
import subprocess
import sys
import tempfile

from result_files import Files, read_blocks

STUDY = """experiment = "ranging"
trials = 1000000000
audit = 0
[[method]]
solver = "ols"
"""


def main(program):
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "s.toml").write_text(STUDY)
        subprocess.run([program, "run", "s.toml", "--time-limit", "1s"], cwd=folder, stderr=subprocess.DEVNULL)
        files = Files(folder / "s.h5")
        part = files.parts()[0]
        assert len(files.blocks()) > 0
        content = part.read_bytes()
        part.write_bytes(content[:-1] + b"x")
        assert read_blocks(part, is_part=True) == {}
        part.write_bytes(content[:-16] + b"a" * 64)
        try:
            read_blocks(part, is_part=True)
        except ValueError as error:
            assert "format 3 or older" in str(error)
        else:
            raise AssertionError("a part of an earlier format was read")


main(pathlib.Path(sys.argv[1]).resolve())
