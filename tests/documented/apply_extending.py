#!/usr/bin/env python3
"""Usage: apply_extending.py SOURCE_DIR COPY_DIR

Copies core/, sim/, solvers/ and tests/ of the sources, and does to the copy what docs/extending.md says: each example
becomes the file that the text names, or goes to the end of the one that it belongs to, and its name to the end of the
registry. The tests of the document are collected in tests/documented/extending_test.cpp of the copy.
"""

import os
import re
import shutil
import sys

# Where an example of the document goes: the class in it, its file, whether the file is new, and the registry.
EXAMPLES = [
    ("Steepest", "solvers/methods/steepest.hpp", True, "solvers/methods/methods.hpp", "Methods"),
    ("HockingSpeedLynn", "solvers/estimators/k_hocking.hpp", True, "solvers/estimators/k_registry.hpp", "KEstimators"),
    ("LaplaceNoise", "sim/laplace_noise.hpp", True, "sim/range_noise.hpp", "NoiseModels"),
    ("WelschWeight", "solvers/methods/robust_weights.hpp", False, "solvers/methods/robust_weights.hpp", "RobustWeights"),
]

TEST_HEAD = """#include <cmath>
#include <vector>

#include "solvers/methods/robust_weights.hpp"
#include "tests/support/hand_scene.hpp"

using namespace ridgeloc;
using namespace ridgeloc::tests;

"""


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def write(path, text):
    """Leaves a file that is already so alone, so that nothing is compiled again."""
    os.makedirs(os.path.dirname(path), exist_ok=True)
    if os.path.exists(path) and read(path) == text:
        return
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def before(text, mark, inserted, path):
    if text.count(mark) != 1:
        sys.exit(f"apply_extending: {path} has {text.count(mark)} times '{mark}' where one was expected")
    return text.replace(mark, inserted + mark)


def include(text, header):
    """With an include after those that are there."""
    last = list(re.finditer(r'^#include .*\n', text, re.MULTILINE))[-1]
    return text[: last.end()] + f'#include "{header}"\n' + text[last.end() :]


def registered(text, name, registry, path):
    found = re.search(rf"using {registry} = std::tuple<[^;]*(?=>;)", text)
    if found is None:
        sys.exit(f"apply_extending: {path} has no tuple {registry}")
    return text[: found.end()] + ", " + name + text[found.end() :]


def main():
    source, copy = sys.argv[1:]
    document = read(os.path.join(source, "docs/extending.md"))
    blocks = re.findall(r"^```cpp\n(.*?)^```$", document, re.MULTILINE | re.DOTALL)

    texts = {}
    for folder in ("core", "sim", "solvers", "tests"):
        for place, _, names in os.walk(os.path.join(source, folder)):
            for name in names:
                if name.endswith((".hpp", ".cpp")):
                    path = os.path.join(place, name)
                    texts[os.path.relpath(path, source)] = read(path)

    for name, path, is_new, registry_path, registry in EXAMPLES:
        example = [b for b in blocks if re.search(rf"^struct {name}\b", b, re.MULTILINE)]
        if len(example) != 1 or f"`{path}`" not in document:
            sys.exit(f"apply_extending: docs/extending.md has no example {name} for {path}")
        blocks.remove(example[0])
        if is_new:
            texts[path] = example[0]
            texts[registry_path] = include(texts[registry_path], path)
        else:
            texts[path] = include(texts[path], "core/elementary.hpp")
            mark = "/// A new one is a class and a line here.\nusing RobustWeights"
            texts[path] = before(texts[path], mark, example[0] + "\n", path)
        texts[registry_path] = registered(texts[registry_path], name, registry, registry_path)

    statistics = "tests/statistics/noise_statistics_test.cpp"
    tests = [b for b in blocks if b.startswith("TEST_CASE")]
    if len(tests) != len(blocks) or len(tests) != len(EXAMPLES):
        sys.exit("apply_extending: docs/extending.md has an example that no test of it uses")
    of_noise = [b for b in tests if "draw_errors" in b]
    texts[statistics] += "\n" + "\n".join(of_noise)
    others = [b for b in tests if b not in of_noise]
    texts["tests/documented/extending_test.cpp"] = TEST_HEAD + "\n".join(others)

    for path, text in texts.items():
        write(os.path.join(copy, path), text)


if __name__ == "__main__":
    main()
