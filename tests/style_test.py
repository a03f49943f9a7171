#!/usr/bin/env python3
"""The style that a machine can hold: clang-format's layout, a comment at the head of every public header that says what it is, and nothing at the top
level but what belongs there.

usage: style_test.py PROJECT_ROOT [CLANG_FORMAT]        needs Python 3 and nothing else
Ends with 77 (ctest: skipped) where all is well but the layout could not be checked: versions of clang-format disagree, so only 14 counts.
"""

import pathlib
import re
import subprocess
import sys

VERSION = 14
SKIPPED = 77
AT_THE_TOP = {"CMakeLists.txt", "CMakePresets.json", "LICENSE", "README.md", "examples", "include", "meshes", "src", "tests"}


def sources_of(root):
    folders = ["include", "src", "examples", "tests"]
    return sorted(path for folder in folders for path in (root / folder).rglob("*") if path.suffix in {".h", ".cpp"})


def has_leading_comment(text):
    """The first line is a /// comment of at least two words."""
    first = text.split("\n", 1)[0]
    return first.startswith("/// ") and len(first.split()) > 2


def test_itself():
    good = ["/// A place on a surface.\n#pragma once\n"]
    bad = ["", "#pragma once\n/// A place on a surface.\n", "// A place on a surface.\n", "///\n", "/// surface_point.h\n", "\n/// A place on a surface.\n"]
    for text in good + bad:
        if has_leading_comment(text) != (text in good):
            sys.exit(f"this test is broken: it misjudges {text!r}")
    if strangers_at_the_top(["src/a.cpp", ".gitignore", "a.cpp", "notes/b"]) != ["a.cpp", "notes"]:
        sys.exit("this test is broken: it misjudges the top level")


def silent_headers_of(root):
    headers = sorted((root / "include").rglob("*.h"))
    if not headers:
        sys.exit(f"no headers in {root / 'include'}: that is not the project")
    return [path for path in headers if not has_leading_comment(path.read_text(encoding="utf-8"))]


def strangers_at_the_top(paths):
    """Of paths that git follows, the first parts that belong elsewhere; files whose name begins with a dot may lie there."""
    first = {path.split("/", 1)[0] for path in paths}
    return sorted(name for name in first - AT_THE_TOP if not name.startswith("."))


def paths_in_git(root):
    """What git follows; nothing where the project is no clone, or git is not there."""
    try:
        words = subprocess.run(["git", "-C", str(root), "ls-files", "-z"], capture_output=True, text=True, check=True).stdout
    except (OSError, subprocess.CalledProcessError):
        return []
    return [path for path in words.split("\0") if path]


def version_of(clang_format):
    """Major version, or None if it cannot be run."""
    try:
        words = subprocess.run([clang_format, "--version"], capture_output=True, text=True, check=True).stdout
    except (OSError, subprocess.CalledProcessError):
        return None
    match = re.search(r"version (\d+)", words)
    return int(match.group(1)) if match else None


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit("usage: style_test.py PROJECT_ROOT [CLANG_FORMAT]")
    root = pathlib.Path(sys.argv[1])
    clang_format = sys.argv[2] if len(sys.argv) == 3 else "clang-format"

    test_itself()
    silent = silent_headers_of(root)
    for path in silent:
        print(f"{path.relative_to(root)}:1: the first line of a public header is a /// comment that says what it is")

    strangers = strangers_at_the_top(paths_in_git(root))
    for name in strangers:
        print(f"{name}: does not belong at the top level, where only {', '.join(sorted(AT_THE_TOP))} lie")

    version = version_of(clang_format)
    misshapen = False
    if version == VERSION:
        sources = [str(path.relative_to(root)) for path in sources_of(root)]
        misshapen = subprocess.run([clang_format, "--dry-run", "--Werror", "--style=file", *sources], cwd=root).returncode != 0
        if misshapen:
            print(f"clang-format -i (version {VERSION}) puts the layout right")

    if silent or strangers or misshapen:
        sys.exit(1)
    if version != VERSION:
        print(f"layout not checked: {clang_format} is {f'version {version}' if version else 'not installed'}, and only version {VERSION} counts")
        sys.exit(SKIPPED)
    print(f"{len(sources)} files as clang-format wants them, every public header says what it is")


if __name__ == "__main__":
    main()
