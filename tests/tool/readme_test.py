#!/usr/bin/env python3
"""README.md is run: its shell by bash, its C++ held against the example that is compiled, its links and names against what is there.

usage: readme_test.py PALPATE PROJECT_ROOT [Readme.test_...]        needs Python 3 and bash
The two install commands alone are not run here: they are how one comes to be here.
"""

import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

from support import PALPATE, palpate

ROOT = pathlib.Path(sys.argv[2]).resolve()
README = (ROOT / "README.md").read_text(encoding="utf-8")
ALL = sorted([ROOT / "README.md", *(path for folder in ("examples", "meshes", "src", "tests") for path in (ROOT / folder).rglob("README.md"))])

MOST_LINES = 120
MOST_COLUMNS = 122
INSTALL_COMMANDS = ["examples/run", "tests/run"]


def blocks(text, language):
    """The fenced blocks of a language, without their fences."""
    return re.findall(rf"^```{language}\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)


def prose(text):
    """All but the fenced blocks."""
    return re.sub(r"^```.*?^```$", "", text, flags=re.MULTILINE | re.DOTALL)


def indented(text):
    """What stands four columns in, as commands that are shown and not run in one go."""
    return [line.strip() for line in prose(text).splitlines() if line.startswith("    ")]


def words_of(code):
    return re.sub(r"\s+", " ", code).strip()


def sections(text):
    """How GitHub names the headings of a page."""
    headings = re.findall(r"^#+ +(.*)$", prose(text), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


class Readme(unittest.TestCase):
    def test_it_is_one_screen(self):
        lines = README.splitlines()
        self.assertLessEqual(len(lines), MOST_LINES)
        for path in ALL:
            for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
                if not line.startswith("|"):
                    self.assertLessEqual(len(line), MOST_COLUMNS, f"{path.relative_to(ROOT)}:{number}")

    def test_its_shell_runs_from_the_clone_to_the_boundary(self):
        script = "\n".join(blocks(README, "sh"))
        self.assertIn("palpate boundary", script)
        with tempfile.TemporaryDirectory() as holder:
            clone = pathlib.Path(holder)
            for folder in ("examples", "meshes"):
                (clone / folder).symlink_to(ROOT / folder)
            (clone / "build" / "ci").mkdir(parents=True)
            (clone / "build" / "ci" / "bin").symlink_to(PALPATE.parent)
            result = subprocess.run(["bash", "-euo", "pipefail", "-c", script], cwd=clone, capture_output=True, text=True, timeout=500, stdin=subprocess.DEVNULL)
            self.assertEqual(result.returncode, 0, result.stderr)
            summary = json.loads((clone / "found" / "summary.json").read_text())
            self.assertEqual(len(summary["parts"]), 1, "the simulated robot felt one tumour")
            x_mm, y_mm, _ = summary["parts"][0]["position_mm"]
            self.assertLess(abs(x_mm - 4.0) + abs(y_mm - 3.0), 1.5, "which lies at (4, 3) mm")
            self.assertEqual(len((clone / "felt.csv").read_text().splitlines()) - 1, summary["measurements"])
            drawn = (PALPATE.parent / "palpate-draw").exists()
            for picture in re.findall(r"`(out/[\w/]+\.png)`", README):
                self.assertEqual((clone / picture).exists(), drawn, picture)

    def test_the_tutorial_runs_from_a_mesh_and_from_a_log_to_their_boundaries(self):
        script = "\n".join(blocks((ROOT / "examples" / "README.md").read_text(encoding="utf-8"), "sh"))
        with tempfile.TemporaryDirectory() as holder:
            clone = pathlib.Path(holder)
            for folder in ("examples", "meshes"):
                (clone / folder).symlink_to(ROOT / folder)
            (clone / "build" / "ci").mkdir(parents=True)
            (clone / "build" / "ci" / "bin").symlink_to(PALPATE.parent)
            if not (PALPATE.parent / "palpate-draw").exists():
                script = script.replace("palpate draw", ": draw")
            result = subprocess.run(["bash", "-euo", "pipefail", "-c", script], cwd=clone, capture_output=True, text=True, timeout=900, stdin=subprocess.DEVNULL)
            self.assertEqual(result.returncode, 0, result.stderr)
            for run, place_mm in (("rehearsal", (-3, 2)), ("found", (4, 3)), ("tissue", (4, 3))):
                (part,) = json.loads((clone / "out/tutorial" / run / "summary.json").read_text())["parts"]
                self.assertLess(abs(part["position_mm"][0] - place_mm[0]) + abs(part["position_mm"][1] - place_mm[1]), 1.5, run)
            for name in ("rehearsal/report.html", "found/report.html", "found/slicer/palpation.mrml", "tissue/report.html"):
                self.assertTrue((clone / "out/tutorial" / name).exists(), name)

    def test_the_simulated_robots_tumour_can_be_put_on_tissue_of_ones_own(self):
        with tempfile.TemporaryDirectory() as holder:
            stops = pathlib.Path(holder) / "waypoints.csv"
            stops.write_text("index,x,y,z\n0,0.004,0.003,0\n1,-0.017,0.029,0.027\n")
            for place, hard in (((), 0), (("-17", "29", "27"), 1)):
                robot = [ROOT / "examples" / "simulated_robot", stops, "2", *place]
                rows = [line.split(",") for line in subprocess.run(robot, capture_output=True, text=True, check=True).stdout.splitlines()]
                self.assertEqual([[row[:3], row[4]] for row in rows], [[["0.004", "0.003", "0"], "2"], [["-0.017", "0.029", "0.027"], "2"]])
                self.assertEqual([float(row[3]) > 8.0 for row in rows], [hard == 0, hard == 1])

    def test_its_install_commands_are_there_and_can_be_run(self):
        shown = [line.split("#")[0].strip() for line in indented(README)]
        self.assertEqual(shown, INSTALL_COMMANDS)
        for command in INSTALL_COMMANDS:
            self.assertTrue(os.access(ROOT / command, os.X_OK), command)

    def test_its_cpp_is_the_example_that_is_compiled(self):
        example = words_of((ROOT / "examples" / "01_find_a_tumour.cpp").read_text())
        (shown,) = blocks(README, "cpp")
        self.assertIn(words_of(shown), example)
        self.assertLessEqual(shown.count(";\n"), 12, "ten statements or so")

    def test_links_lead_somewhere(self):
        for path in ALL:
            text = prose(path.read_text(encoding="utf-8"))
            for target, section in re.findall(r"\]\(([^)#:]*)(?:#([^)]*))?\)", text):
                there = (path.parent / target).resolve() if target else path
                where = f"{path.relative_to(ROOT)}: {target}#{section}"
                self.assertTrue(there.exists(), where)
                if section:
                    page = there / "README.md" if there.is_dir() else there
                    self.assertIn(section, sections(page.read_text(encoding="utf-8")), where)

    def test_commands_and_options_that_pages_name_are_there(self):
        help_of = {}
        for path in ALL:
            text = path.read_text(encoding="utf-8")
            shown = "\n".join([*indented(text), *re.findall(r"`([^`\n]*)`", prose(text)), *blocks(text, "sh")])
            for line in re.findall(r"^(?:\w+=\S+ )?palpate [a-z][^\n]*|(?<=do )palpate [^\n]*", shown, re.MULTILINE):
                words = line.split()
                command = tuple(words[1:3]) if words[1:3] in (["mesh", "surface"], ["mesh", "repair"]) else (words[1],)
                if command not in help_of:
                    result = palpate(*command, "--help")
                    self.assertEqual(result.returncode, 0, f"{path.relative_to(ROOT)}: {line}")
                    help_of[command] = result.stdout
                for option in re.findall(r"(?<=\s)--[a-z-]+", line.split("#")[0]):
                    self.assertIn(option, help_of[command] + "--help", f"{path.relative_to(ROOT)}: {line}")

    def test_keys_of_a_scene_that_pages_name_are_there(self):
        known = palpate("help", "scene").stdout
        groups = "surface|field|level|plan|probe|robot|error"
        for path in ALL:
            for key in re.findall(rf"`((?:{groups})\.[a-z0-9_]+(?:\.[a-z0-9_]+)*)", path.read_text(encoding="utf-8")):
                if key.endswith((".vtp", ".png")):
                    continue  # a file
                self.assertTrue(re.search(rf"^ *{re.escape(key)}\b", known, re.MULTILINE) or f"{key}." in known, f"{path.relative_to(ROOT)}: {key}")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
