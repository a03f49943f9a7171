"""What the tests of the tool share: the program, run without a terminal, and a folder of each test's own.

The program is the first word of a test's command line.
"""

import csv
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

PALPATE = pathlib.Path(sys.argv[1]).resolve()
SANITIZED = b"__asan_init" in PALPATE.read_bytes()  # what takes minutes under the sanitizers asks less of them
PATIENCE_S = 1200 if SANITIZED else 300
BRIEFLY = ["--set", "certainty=laplace"]  # where no outline is asked for: drawing them takes longer than all else


def palpate(*arguments, program=None, **options):
    """The finished process, its output as text; arguments may be bytes."""
    options = {"stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True, "errors": "replace", "timeout": PATIENCE_S} | options
    return subprocess.run([program or PALPATE, *(word if isinstance(word, bytes) else str(word) for word in arguments)], **options)


def rows_of(path):
    with open(path, encoding="utf-8", newline="") as table:
        return list(csv.DictReader(table))


def skip(test, reason):
    print(f"skipped: {reason}", file=sys.stderr)
    test.skipTest(reason)


class InFolder(unittest.TestCase):
    skip = skip

    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)

    def write(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        return path

    def ends(self, code, *arguments, says=(), **options):
        """Runs the tool; checks its exit code, and for parts of what it says on standard error. Returns what it says: there unless it is done."""
        result = palpate(*arguments, **options)
        self.assertEqual(result.returncode, code, f"{arguments}: {result.stdout}{result.stderr}")
        for part in [says] if isinstance(says, str) else says:
            self.assertIn(part, result.stderr, arguments)
        return result.stdout if code == 0 else result.stderr

    def done(self, *arguments, **options):
        return self.ends(0, *arguments, **options)


SMALL = {
    "surface": {"plane": {"size_mm": [20, 20], "vertices": [12, 12]}},
    "certainty": "laplace",
    "plan": {"initial": {"count": 9}, "batch": 4, "batches": 2},
    "probe": {"noise": 0.05, "tumours": [{"shape": "disk", "centre_mm": [10, 10, 0], "radius_mm": 4}]},
}


class WithSmallScene(InFolder):
    """A scene that takes no time, readings of its tissue, and an outline on it."""

    readings = "x,y,z,reading\n0.01,0.01,0,9\n0.002,0.003,0,7\n0.016,0.004,0,7.1\n"

    def setUp(self):
        super().setUp()
        self.scene = self.write("scene.json", json.dumps(SMALL))
        self.measured = self.write("measured.csv", self.readings)
        self.square = self.write("square.wkt", "POLYGON ((0.005 0.005, 0.015 0.005, 0.015 0.015, 0.005 0.015, 0.005 0.005))")


def main_without_pictures(own_arguments=1):
    """Runs the tests of the file that was started, on a copy of the program away from palpate-draw: pictures take their time, and are tested elsewhere.

    own_arguments: how many words of the command line are the file's, the program among them; what follows is unittest's.
    """
    global PALPATE
    with tempfile.TemporaryDirectory() as alone:
        PALPATE = pathlib.Path(shutil.copy(PALPATE, alone))
        sys.modules["__main__"].PALPATE = PALPATE
        tests = unittest.main(argv=sys.argv[:1] + sys.argv[1 + own_arguments:], exit=False)
    sys.exit(0 if tests.result.wasSuccessful() else 1)
