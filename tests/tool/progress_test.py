#!/usr/bin/env python3
"""What long work says of itself: on a terminal a line that goes away, in a pipe nothing but what is counted.

usage: progress_test.py PALPATE [Progress.test_...]        needs Python 3 and nothing else
"""

import json
import os
import pty
import re
import subprocess
import sys
import unittest

from support import PALPATE, PATIENCE_S, InFolder, main_without_pictures

SCENE = {
    "surface": {"plane": {"size_mm": [20, 20], "vertices": [150, 150]}},
    "certainty": "laplace",
    "plan": {"batches": 8},
    "probe": {"noise": 0.05, "tumours": [{"shape": "disk", "centre_mm": [10, 10, 0], "radius_mm": 4}]},
}
WIPE = "\r\x1b[K"


class Progress(InFolder):
    def setUp(self):
        super().setUp()
        self.scene = self.write("scene.json", json.dumps(SCENE))

    def on_terminal(self, *words):
        """What comes to a terminal that is standard error."""
        ours, its = pty.openpty()
        process = subprocess.Popen([PALPATE, *map(str, words)], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=its)
        os.close(its)
        told = b""
        while True:
            try:
                more = os.read(ours, 4096)
            except OSError:  # Linux's way to say that the other end is closed
                break
            if not more:
                break
            told += more
        os.close(ours)
        self.assertEqual(process.wait(timeout=PATIENCE_S), 0, told)
        return told.decode()

    def left_on(self, told):
        """The lines that stay on a terminal which was told that."""
        return [line.split(WIPE)[-1] for line in told.replace("\r\n", "\n").split("\n")]

    def test_on_a_terminal_batches_fill_a_bar_that_is_gone_at_the_end(self):
        told = self.on_terminal("simulate", self.scene, "--out", self.folder / "run")
        self.assertIn("Batch [####################] 9/9 ", told)
        self.assertFalse([line for line in self.left_on(told) if "Batch [" in line or "Drawing" in line], told)
        for line in re.split(r"\r\x1b\[K|\r\n", told):
            if not line.startswith("palpate: "):  # warnings are no line of this kind
                self.assertLess(len(line), 80, "what wraps is not wiped")

    def test_in_a_pipe_a_plan_says_nothing_of_its_stages_and_quiet_is_quiet_on_a_terminal(self):
        result = subprocess.run([PALPATE, "plan", self.scene, "--out", self.folder / "plan"], capture_output=True, text=True, timeout=PATIENCE_S)
        self.assertEqual(result.returncode, 0, result.stderr)
        for words in ("Preparing", "Choosing", "Drawing", "\x1b"):
            self.assertNotIn(words, result.stdout + result.stderr)
        self.assertNotIn("\x1b", self.on_terminal("simulate", self.scene, "--quiet", "--set", "plan.batches=1"))


if __name__ == "__main__":
    main_without_pictures()
