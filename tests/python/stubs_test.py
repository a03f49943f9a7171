#!/usr/bin/env python3
"""The module's stubs: mypy --strict takes them and the examples that use them, refuses what is wrong, and stubtest finds nothing in them that the module
has not, and nothing in the module that they have not.

usage: stubs_test.py PACKAGE_FOLDER PROJECT_ROOT        ends with 77 (ctest: skipped) where mypy is missing
"""

import importlib.util
import os
import pathlib
import subprocess
import sys
import tempfile

# pybind11's classes have a metaclass of their own, which no stub can name: of stubtest's errors these alone are none.
METACLASS = "is inconsistent, metaclass differs"

WRONG = """
import palpation as pp
tissue = pp.make_plane().surface()
pp.Surface(tissue.vertices, tissue.faces)  # without a unit
pp.Plan(batches="many")
exploration = pp.Exploration(tissue)
exploration.tell("text", noise="x")
area: str = tissue.area_m2
"""


def run(*command, folder):
    environment = {**os.environ, "MYPYPATH": PACKAGE, "PYTHONPATH": PACKAGE, "MYPY_CACHE_DIR": folder}
    done = subprocess.run([sys.executable, "-m", *command], capture_output=True, text=True, cwd=folder, env=environment)
    return done.returncode, done.stdout + done.stderr


def main():
    global PACKAGE
    if len(sys.argv) != 3:
        sys.exit("usage: stubs_test.py PACKAGE_FOLDER PROJECT_ROOT")
    PACKAGE, root = os.path.abspath(sys.argv[1]), pathlib.Path(sys.argv[2]).resolve()
    for needed in ("mypy", "numpy"):
        if importlib.util.find_spec(needed) is None:
            print(f"skipped: {needed} is not installed")
            sys.exit(77)
    with tempfile.TemporaryDirectory() as folder:
        examples = [str(path) for path in sorted((root / "examples/python").glob("*.py"))]
        code, words = run("mypy", "--strict", "-p", "palpation", folder=folder)
        assert code == 0, words
        code, words = run("mypy", "--strict", *examples, folder=folder)
        assert code == 0 and len(examples) >= 3, words
        wrong = pathlib.Path(folder) / "wrong.py"
        wrong.write_text(WRONG)
        code, words = run("mypy", "--strict", str(wrong), folder=folder)
        lines = sorted({int(line.split(":")[1]) for line in words.splitlines() if "error:" in line})
        assert code == 1 and lines == [4, 5, 7, 8], words

        _, words = run("mypy.stubtest", "palpation", folder=folder)
        errors = [line for line in words.splitlines() if line.startswith("error:")]
        assert "checked 3 modules" in words and not [line for line in errors if not line.endswith(METACLASS)], words
    print(f"{len(examples)} examples, the stubs and the module agree")


if __name__ == "__main__":
    main()
