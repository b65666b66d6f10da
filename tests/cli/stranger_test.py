#!/usr/bin/python3
"""Studies and results made by somebody who means harm, given to every verb: what SECURITY.md promises.

Usage: stranger_test.py PROGRAM CLAUSE

CLAUSE is reads, writes, starts or ends. The files of a stranger lie in a folder of their own, in which the program runs; what
it is not to read, write or start lies beside it.
"""

import os
import pathlib
import resource
import subprocess
import sys
import tempfile

import h5py
import numpy

import result_digests

STUDY = """title = "of a stranger"
experiment = "ranging"
trials = 20
audit = 0
[sweep]
points = [3, 5]
[[method]]
solver = "ols"
[[method]]
solver = "rr"
[[figure]]
name = "figure"
x = "points"
y = "error_m"
"""
SECRET = "4711.25"
PATIENCE_S = 120
MOST_MEMORY = 3 << 30

RESULT_VERBS = [
    "summary r.h5", "summary --all r.h5", "export r.h5", "export --json r.h5", "export --latex r.h5",
    "export --trials r.h5", "export --failures r.h5", "export --study r.h5", "export --against points=3 r.h5",
    "plot r.h5", "plot r.h5 -o plotted", "report r.h5 -o report.html", "replay r.h5 --cell 0 --trial 1 -o replay.svg",
    "audit r.h5", "verify r.h5", "verify --digest r.h5", "verify --blocks 0 r.h5", "merge r.h5 -o merged.h5",
    "compare r.h5 r.h5", "status r.h5", "run own.toml -o r.h5", "plan r.h5", "run r.h5"]
SHOWING_VERBS = [verb for verb in RESULT_VERBS if verb.split()[0] in ("summary", "export", "plot", "report", "replay")]
STUDY_VERBS = ["plan s.toml", "run s.toml -o s.h5", "replay s.toml --cell 0 --trial 1 -o replay.svg"]
SAID = "what it says"
OUTPUTS = ["plotted", "report.html", "replay.svg", "merged.h5", "s.h5", "figure.svg"]


class Stranger:
    def __init__(self, program, place):
        self.program = program
        self.outside = place
        self.folder = place / "inside"
        self.folder.mkdir()
        self.problems = []
        self.is_harmful = lambda name, text: False

    def call(self, verb):
        """Exit code and all that is said."""
        def limit():
            resource.setrlimit(resource.RLIMIT_AS, (4 * MOST_MEMORY, 4 * MOST_MEMORY))
        try:
            done = subprocess.run([self.program, *verb.split()], cwd=self.folder, capture_output=True, preexec_fn=limit,
                                  timeout=PATIENCE_S, stdin=subprocess.DEVNULL)
        except subprocess.TimeoutExpired:
            self.problems.append(f"{verb}: has not ended after {PATIENCE_S} s")
            return None, ""
        said = (done.stdout + done.stderr).decode(errors="replace")
        if done.returncode not in (0, 1, 2, 3):
            self.problems.append(f"{verb}: exit code {done.returncode}: {said[-300:]}")
        return done.returncode, said

    def outputs(self):
        """All that a verb has written, folders before what lies in them."""
        for name in OUTPUTS:
            path = self.folder / name
            if path.exists():
                yield from [path, *path.rglob("*")]

    def judged(self, what, verb):
        """What the verb did, its exit code and all that is said. Its outputs, which are none of an earlier one, are
        looked at too."""
        for path in reversed(list(self.outputs())):
            path.rmdir() if path.is_dir() else path.unlink()
        code, said = self.call(verb)
        texts = {path.name: path.read_bytes().decode(errors="replace") for path in self.outputs() if path.is_file()}
        for name, text in {SAID: said, **texts}.items():
            if self.is_harmful(name, text):
                self.problems.append(f"{what!r}: {verb}: {name} holds what the stranger wants there")
        return f"{what}: {verb}", code, said

    def make_result(self):
        (self.folder / "own.toml").write_text(STUDY)
        code, said = self.call("run own.toml -o whole.h5")
        if code != 0:
            sys.exit(f"run fails: {said}")
        return (self.folder / "whole.h5").read_bytes()

    def changed(self, content, change, is_mended=True):
        """The content, changed, with right digests unless that would lead out of the file."""
        path = self.folder / "r.h5"
        path.write_bytes(content)
        with h5py.File(path, "r+") as file:
            change(file)
        if is_mended:
            result_digests.mend(path)
        return path.read_bytes()

    def study(self, text, what):
        (self.folder / "s.toml").write_text(text)
        return [self.judged(what, verb) for verb in STUDY_VERBS]

    def result(self, content, what, verbs=RESULT_VERBS):
        said = []
        for verb in verbs:
            (self.folder / "r.h5").write_bytes(content)
            said.append(self.judged(what, verb))
        return said

    def reads(self):
        """Neither a study nor a result makes a verb read a file that lies elsewhere, or wait for it."""
        (self.outside / "secret.csv").write_text(f"e_m\n{SECRET}\n-{SECRET}\n")
        with h5py.File(self.outside / "secret.h5", "w") as file:
            file["x"] = numpy.full(4, float(SECRET))
            file.create_group("g").attrs["name"] = SECRET
        os.mkfifo(self.outside / "pipe")
        os.symlink(self.outside / "secret.csv", self.folder / "link.csv")
        self.is_harmful = lambda name, text: SECRET in text
        for name in ("../secret.csv", str(self.outside / "secret.csv"), "link.csv", "../pipe", "/dev/stdin"):
            for setting in (f'[noise]\nnoise_model = "empirical"\nnoise_samples = {{ file = "{name}", column = "e_m" }}\n',
                            f'[scene]\nobjects = "given"\nobjects_m = {{ file = "{name}", columns = ["e_m", "e_m"] }}\n'):
                text = STUDY.replace("[sweep]\npoints = [3, 5]\n", setting)
                for what, code, _ in self.study(text, name):
                    if code != 2:
                        self.problems.append(f"{what}: exit code {code}")
        building = 'experiment = "building"\n[building]\nmap = { file = "../secret.csv" }\n[[method]]\nsolver = "ols"\n'
        self.study(building, "a map")

        whole = self.make_result()
        for target in ("../secret.h5", str(self.outside / "pipe")):
            def link(name, place="g"):
                def change(file):
                    del file[name]
                    file[name] = h5py.ExternalLink(target, place)
                return change

            def elsewhere(name, virtual):
                def change(file):
                    shape = file[name].shape
                    del file[name]
                    if virtual:
                        layout = h5py.VirtualLayout(shape=shape, dtype="<f8")
                        layout[...] = h5py.VirtualSource(target, "x", shape=shape)
                        file.create_virtual_dataset(name, layout)
                    else:
                        file.create_dataset(name, shape, "<f8", external=[(target, 0, 8 * int(numpy.prod(shape)))])
                return change

            changes = {f"link {name}": link(name) for name in ("provenance", "ledger", "trials", "cells/hash")}
            changes |= {f"external {name}": elsewhere(name, False) for name in ("ledger/mean", "trials/0/ols/error_m")}
            changes |= {"virtual ledger/mean": elsewhere("ledger/mean", True)}
            for what, change in changes.items():
                content = self.changed(whole, change, is_mended=False)
                self.result(content, f"{what} to {target}")

        def samples(file):
            text = file["provenance"].attrs["study"].replace(
                "noise_samples = []", 'noise_samples = { file = "../secret.csv", column = "e_m" }')
            file["provenance"].attrs.modify("study", text.replace('"normal"', '"empirical"'))
        for what, code, _ in self.result(self.changed(whole, samples), "samples of the study inside"):
            if what.split(": ")[1].split()[0] in ("merge", "audit", "replay") and code != 2:
                self.problems.append(f"{what}: exit code {code}")

    def writes(self):
        """Names inside a study or a result lead to no file outside of the output that was asked for."""
        whole = self.make_result()
        (self.outside / "victim.svg").write_text("mine")
        names = ["../victim", str(self.outside / "victim"), "sub/new", ".hidden", "a\nb", "x" * 300]
        before = sorted(os.listdir(self.outside))
        for name in names:
            text = STUDY.replace('name = "figure"', f"name = {toml_text(name)}").replace('"of a stranger"', toml_text(name))
            self.study(text, f"a figure called {name[:20]!r}")

            def rename(file):
                file["figures/0"].attrs.modify("name", name)
                file.attrs.modify("title", name)
            self.result(self.changed(whole, rename), f"a figure called {name[:20]!r}")
        if sorted(os.listdir(self.outside)) != before or (self.outside / "victim.svg").read_text() != "mine":
            self.problems.append(f"files outside: {sorted(os.listdir(self.outside))}, not {before}")
        known = {"own.toml", "whole.h5", "r.h5", "s.toml", "own.h5", *OUTPUTS}
        new = set(os.listdir(self.folder)) - known
        if new:
            self.problems.append(f"files inside that nobody asked for: {sorted(new)}")

    def starts(self):
        """No text of a study or a result is taken for a command by a terminal, gnuplot, a shell or a browser."""
        whole = self.make_result()
        run = f"touch {self.outside}/started"

        def is_command(name, text):
            if name == SAID:
                return "\x1b" in text or "\x9b" in text
            return name.endswith((".html", ".svg")) and f"<script>{run}" in text
        self.is_harmful = is_command
        texts = [f"`{run}`$({run})", f"'; system('{run}'); '", f"\"; system(\"{run}\"); \"", f"|{run}", f"\n!{run}\n",
                 f"\\write18{{{run}}}<script>{run}</script>%s%n%999999d", "{/:Bold `" + run + "`}",
                 "\x1b]0;of a stranger\x07\x9b31m"]
        for text in texts:
            quoted = toml_text(text)
            plain = toml_text(text.replace("/", "_").replace("\n", " ")[:60])
            study = STUDY.replace('"of a stranger"', quoted).replace('solver = "ols"', f'solver = "ols"\nname = {plain}')
            self.study(study.replace('name = "figure"', f'name = "figure"\ntitle = {quoted}'), text)

            def change(file):
                for name in ("title", "aims", "experiment", "isa"):
                    file.attrs.modify(name, text)
                for name in ("title", "x", "facet"):
                    file["figures/0"].attrs.modify(name, text)
                for group, column in (("methods", "description"), ("metrics", "unit"), ("metrics", "description"),
                                      ("events", "description"), ("metrics", "alarm")):
                    file[group][column][...] = [text] * len(file[group][column])
                file["axes/0"].attrs.modify("description", text)
                file["axes/0"].attrs.modify("unit", text)

            def gentle(file):
                for name in ("title", "aims"):
                    file.attrs.modify(name, text)
                file["figures/0"].attrs.modify("title", text)
                file["methods/description"][...] = [text] * len(file["methods/description"])
                file["metrics/unit"][...] = [text] * len(file["metrics/unit"])
                file["axes/0"].attrs.modify("description", text)
            self.result(self.changed(whole, change), text, SHOWING_VERBS)
            for what, code, output in self.result(self.changed(whole, gentle), text, SHOWING_VERBS):
                is_shown = what.split(": ")[-1].split()[0] in ("plot", "report", "export", "summary")
                if is_shown and text.isprintable() and code != 0:
                    self.problems.append(f"{what}: exit code {code}: {output}")
            if (self.outside / "started").exists():
                sys.exit(f"started by {text!r}")

    def ends(self):
        """Whatever the file, a verb that reads it ends, and takes no more memory than its size accounts for."""
        studies = {
            "brackets": "x = " + "[" * 100000,
            "dotted keys": "a" + ".a" * 100000 + " = 1",
            "parentheses": STUDY + f'[[method]]\nsolver = "rr"\nname = "f"\nk = "expr"\nk_expr = "{"(" * 50000}"\n',
            "powers": STUDY + f'[[method]]\nsolver = "rr"\nname = "f"\nk = "expr"\nk_expr = "{"-" * 100000}n"\n',
            "cells": STUDY.replace("points = [3, 5]", "points = { from = 3, to = 1000, step = 1 }\n"
                                   "range_sigma_m = { from = 0.001, to = 1.5, step = 0.001 }"),
            "steps": STUDY.replace("points = [3, 5]", "range_sigma_m = { from = 0, to = 1e4, step = 1e-300 }"),
            "exclusions": STUDY.replace("points = [3, 5]", "points = { from = 3, to = 1000, step = 1 }\nexclude = ["
                                        + ", ".join(["{ points = 3 }"] * 2000) + "]"),
            "methods": STUDY + "".join(f'[[method]]\nsolver = "lm"\nname = "m{i}"\n' for i in range(5000)),
        }
        for what, text in studies.items():
            for verb, code, said in self.study(text, what):
                if code != 2 or said.count("\n") != 1 or len(said) > 2000:
                    self.problems.append(f"{verb}: exit code {code}, {said[:300]}")
        (self.folder / "s.toml").unlink()
        os.symlink("/dev/zero", self.folder / "s.toml")
        for verb in STUDY_VERBS:
            code, said = self.call(verb)
            if code != 2 or said.count("\n") != 1:
                self.problems.append(f"an endless study: {verb}: exit code {code}, {said[:300]}")
        (self.folder / "s.toml").unlink()
        with open(self.folder / "huge.csv", "wb") as file:
            file.truncate(1 << 40)
        huge = '[noise]\nnoise_model = "empirical"\nnoise_samples = { file = "huge.csv", column = "e" }\n[[method]]'
        for verb, code, said in self.study(STUDY.replace("[[method]]", huge, 1), "a huge file"):
            if code != 2:
                self.problems.append(f"{verb}: exit code {code}, {said[:300]}")

        whole = self.make_result()

        def inflate(name, kind):
            def change(file):
                del file[name]
                file.create_dataset(name, (1 << 31,), kind, chunks=(1 << 24,), compression="gzip", compression_opts=9)
                zeros = numpy.zeros(1 << 24, kind)
                for begin in range(0, 1 << 26, 1 << 24):
                    file[name][begin:begin + (1 << 24)] = zeros
            return change

        def many(file):
            file.attrs.modify("trials", numpy.uint64(2 ** 64 - 1))
            file.attrs.modify("block_trials", numpy.uint64(2 ** 63))

        for what, change in {"zeros": inflate("ledger/mean", "<f8"), "cells": inflate("cells/index", "<u8"),
                             "trials": inflate("trials/0/ols/error_m", "<f8"), "counts": many}.items():
            # Readers have to look at the values before they can know that the digest is wrong.
            self.result(self.changed(whole, change, is_mended=what == "counts"), what)
        used = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss << 10
        if used > MOST_MEMORY:
            self.problems.append(f"a verb took {used >> 20} MiB")


def toml_text(text):
    escaped = "".join(c if c.isprintable() and c not in '"\\' else f"\\u{ord(c):04X}" for c in text)
    return f'"{escaped}"'


def main(program, clause):
    with tempfile.TemporaryDirectory(prefix="ridgeloc-stranger-") as place:
        stranger = Stranger(pathlib.Path(program).resolve(), pathlib.Path(place))
        getattr(stranger, clause)()
    for problem in stranger.problems:
        print(problem)
    return 1 if stranger.problems else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
