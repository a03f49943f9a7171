#!/usr/bin/env python3
"""The pages of the library's headers are made without a warning, hold what the headers begin with, and a wrong word in a header is an error.

usage: docs_test.py DOXYGEN DOXYFILE        ends with 77 (ctest: skipped) where doxygen is missing
"""

import pathlib
import subprocess
import sys
import tempfile


def run(doxygen, settings, folder):
    return subprocess.run([doxygen, "-"], input=settings, capture_output=True, text=True, cwd=folder)


def main():
    if len(sys.argv) != 3:
        sys.exit("usage: docs_test.py DOXYGEN DOXYFILE")
    doxygen = sys.argv[1]
    if not doxygen or doxygen.endswith("NOTFOUND"):
        print("skipped: doxygen is not installed")
        sys.exit(77)
    settings = pathlib.Path(sys.argv[2]).read_text(encoding="utf-8")
    with tempfile.TemporaryDirectory() as holder:
        folder = pathlib.Path(holder)
        made = run(doxygen, f'{settings}\nOUTPUT_DIRECTORY = "{folder}/pages"\n', folder)
        assert made.returncode == 0 and not made.stderr, made.stderr
        pages = {path.name: path.read_text(encoding="utf-8") for path in (folder / "pages/html").glob("*.html")}
        assert "A tissue surface: an oriented, edge-manifold triangle mesh" in pages["surface_8h.html"]
        assert "Ask and tell" in pages["exploration_8h.html"]
        (folder / "wrong.h").write_text("/// Some words.\n#pragma once\n/// Adds.\n/// @param nobody is none\nint add(int one);\n")
        wrong = run(doxygen, f'{settings}\nINPUT = "{folder}/wrong.h"\nOUTPUT_DIRECTORY = "{folder}/wrong"\n', folder)
        assert wrong.returncode != 0 and "nobody" in wrong.stderr, (wrong.returncode, wrong.stderr)
    print(f"{len(pages)} pages without a warning")


if __name__ == "__main__":
    main()
