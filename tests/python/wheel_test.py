#!/usr/bin/env python3
"""The wheel: made by one command, it installs into an empty folder and works there, away from the tree; and nothing is left beside the sources.

usage: wheel_test.py BUILD_TREE PROJECT_ROOT        ends with 77 (ctest: skipped) where pip, setuptools or wheel are missing
"""

import importlib.util
import os
import pathlib
import subprocess
import sys
import tempfile
import zipfile

PROGRAM = """
import palpation as pp
assert pp.__file__.startswith({folder!r}), pp.__file__
exploration = pp.Exploration(pp.make_plane(columns=11, rows=21).surface(), plan=pp.Plan(initial_count=5, batch=2, batches=1))
while stops := exploration.ask():
    exploration.tell([1.0 + i for i in range(len(stops))])
print(len(exploration.readings), exploration.stop_reason)
"""


def everything_in(folder):
    return sorted(str(path) for path in folder.rglob("*") if "__pycache__" not in path.parts)


def main():
    if len(sys.argv) != 3:
        sys.exit("usage: wheel_test.py BUILD_TREE PROJECT_ROOT")
    tree, root = os.path.abspath(sys.argv[1]), pathlib.Path(sys.argv[2]).resolve()
    for needed in ("pip", "setuptools", "wheel", "numpy"):
        if importlib.util.find_spec(needed) is None:
            print(f"skipped: {needed} is not installed")
            sys.exit(77)
    before = everything_in(root / "src")
    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check", "-q"]
    with tempfile.TemporaryDirectory() as folder:
        environment = {**os.environ, "PALPATION_BUILD_TREE": tree, "PYTHONDONTWRITEBYTECODE": "1"}
        environment.pop("PYTHONPATH", None)
        made = [*pip, "wheel", str(root / "src/python"), "--no-build-isolation", "--no-deps", "--no-index", "-w", folder]
        subprocess.run(made, check=True, env=environment, cwd=folder)
        (wheel,) = pathlib.Path(folder).glob("palpation-*.whl")
        assert "cp3" in wheel.name and "linux" in wheel.name, wheel.name
        names = zipfile.ZipFile(wheel).namelist()
        for name in ("__init__.py", "__init__.pyi", "_vtk.py", "_vtk.pyi", "py.typed"):
            assert f"palpation/{name}" in names, names
        place = os.path.join(folder, "installed")
        subprocess.run([*pip, "install", "--no-deps", "--no-index", "--target", place, str(wheel)], check=True, env=environment, cwd=folder)
        environment["PYTHONPATH"] = place
        said = subprocess.run([sys.executable, "-c", PROGRAM.format(folder=place)], check=True, env=environment, cwd=folder, capture_output=True, text=True)
        assert said.stdout == "7 budget\n", said.stdout
    assert everything_in(root / "src") == before, "files are left beside the sources"
    print(f"{wheel.name}: {len(names)} files")


if __name__ == "__main__":
    main()
