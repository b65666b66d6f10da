"""What a result and the parts beside it hold, read without ridgeloc."""

import ctypes
import os
import pathlib
import re

import h5py

CHECKSUM_DIGITS = 16
CHECKSUM_BEFORE = re.compile(rb"[0-9a-f]{64}\Z")  # a SHA-256, of parts up to format 3
XXH3 = ctypes.CDLL("libxxhash.so.0").XXH3_64bits  # which the program itself needs
XXH3.argtypes, XXH3.restype = [ctypes.c_char_p, ctypes.c_size_t], ctypes.c_uint64


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
        return any(name.startswith("part-") and name.endswith(".ridgeloc-tmp") for name in self.names())

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
    """What one file holds; nothing if it is a damaged part. A part of an earlier format is none that a run can have."""
    if is_part:
        content = path.read_bytes()
        if CHECKSUM_BEFORE.search(content):
            raise ValueError(f"{path} is a part of format 3 or older, which this program does not write")
        if f"{XXH3(content, len(content) - CHECKSUM_DIGITS):016x}".encode() != content[-CHECKSUM_DIGITS:]:
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
