"""What the tests of the tool share: the program, run without a terminal, and a folder of each test's own.

The program is the first word of a test's command line.
"""

import csv
import pathlib
import subprocess
import sys
import tempfile
import unittest

PALPATE = pathlib.Path(sys.argv[1]).resolve()
PATIENCE_S = 300


def palpate(*arguments, **options):
    """The finished process, its output as text."""
    options = {"stdin": subprocess.DEVNULL, "capture_output": True, "text": True, "timeout": PATIENCE_S} | options
    return subprocess.run([PALPATE, *map(str, arguments)], **options)


def rows_of(path):
    with open(path, encoding="utf-8", newline="") as table:
        return list(csv.DictReader(table))


class InFolder(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)

    def write(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        return path

    def skip(self, reason):
        print(f"skipped: {reason}", file=sys.stderr)
        self.skipTest(reason)

    def ends(self, code, *arguments, **options):
        """Runs the tool; checks its exit code. Returns what it says: on standard error unless it is done."""
        result = palpate(*arguments, **options)
        self.assertEqual(result.returncode, code, f"{arguments}: {result.stdout}{result.stderr}")
        return result.stdout if code == 0 else result.stderr

    def done(self, *arguments, **options):
        return self.ends(0, *arguments, **options)
