"""Usage: export_json_test.py PROGRAM

`export --json` holds what `export --csv` holds, row by row, and numbers with the same bits.
"""

import csv
import io
import json
import math
import pathlib
import subprocess
import sys
import tempfile

STUDY = """title = "A \\"study\\", quoted"
experiment = "ranging"
trials = 50
audit = 0
[scene]
points = 3
[sweep]
range_sigma_m = [0.1, 0.3]
noise_model = ["normal", "student_t"]
[[method]]
solver = "ols"
[[method]]
solver = "rrr"
"""


def same(text, value):
    number = float(text)
    if value is None:
        return not math.isfinite(number)
    return number == float(value)


def main(program):
    with tempfile.TemporaryDirectory() as folder:
        pathlib.Path(folder, "s.toml").write_text(STUDY)

        def run(*arguments):
            return subprocess.run([program, *arguments], cwd=folder, capture_output=True, text=True, check=True).stdout

        run("run", "s.toml", "-o", "r.h5")
        rows = list(csv.DictReader(io.StringIO(run("export", "r.h5", "--csv"))))
        result = json.loads(run("export", "r.h5", "--json"))
        assert result["title"] == 'A "study", quoted' and result["trials"] == 50 and result["seed"] == 2018
        axes = {axis["name"]: axis["values"] for axis in result["axes"]}
        assert axes == {"range_sigma_m": [0.1, 0.3], "noise_model": ["normal", "student_t"]}
        assert len(rows) == len(result["rows"]) > 50
        for row, item in zip(rows, result["rows"]):
            assert set(row) == set(item) - {"cell"} | set(item["cell"]), (row, item)
            for name in ("method", "metric", "unit"):
                assert row[name] == item[name]
            assert float(row["range_sigma_m"]) == item["cell"]["range_sigma_m"]
            assert row["noise_model"] == item["cell"]["noise_model"]
            for flag in ("trusted", "rms_trusted"):
                assert row[flag] == ("1" if item[flag] else "0")
            for name, value in item.items():
                if name not in ("cell", "method", "metric", "unit", "trusted", "rms_trusted"):
                    assert same(row[name], value), (name, row[name], value)
        refused = subprocess.run([program, "export", "r.h5", "--json", "--csv"], cwd=folder, capture_output=True, text=True)
        assert refused.returncode == 2, refused


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]).resolve())
