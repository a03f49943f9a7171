#!/usr/bin/env python3
"""What people stumble over who meet the tool for the first time: each has a claim here.

usage: newcomer_test.py PALPATE PROJECT_ROOT [Newcomer.test_...]        needs Python 3 and bash; groff checks the manual page where it is installed
"""

import json
import math
import pathlib
import shutil
import subprocess
import sys
import unittest

from support import PALPATE, InFolder, main_without_pictures, palpate, rows_of

ROOT = pathlib.Path(sys.argv[2]).resolve()
PLANE = {"surface": {"plane": {"size_mm": [20, 30], "vertices": [41, 61]}}}


class Newcomer(InFolder):
    def scene(self, **groups):
        path = self.folder / "scene.json"
        path.write_text(json.dumps({**PLANE, **groups}))
        return path

    def done(self, *arguments):
        run = palpate(*arguments)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        return run

    def table(self, name):
        return rows_of(self.folder / name)

    def test_a_plan_begins_without_measurements(self):
        scene = self.scene(plan={"initial": {"count": 7}})
        self.done("plan", scene, "--out", self.folder / "first")
        header = self.folder / "none.csv"
        header.write_text("x,y,z,reading,batch\n")
        self.done("plan", scene, "--measurements", header, "--out", self.folder / "same")
        stops = (self.folder / "first/waypoints.csv").read_bytes()
        self.assertEqual(len(self.table("first/waypoints.csv")), 7)
        self.assertEqual((self.folder / "same/waypoints.csv").read_bytes(), stops)

    def test_what_info_says_of_a_scene_is_said_once_when_a_run_starts(self):
        scene = self.scene(surface={"plane": {"size_mm": [20, 20], "vertices": [12, 12]}}, field={"length_mm": 60},
                           plan={"initial": {"count": 4}, "batch": 3, "batches": 2, "least_spacing_mm": 40})
        remarks = ("field.length_mm 60.0 is long for tissue that is 28.3 mm across", "plan.least_spacing_mm 40.0 is wider than the tissue",
                   "Coarse: edges up to 2.57 mm exceed what a probe resolves")
        def counts(words):
            return [words.count(remark) for remark in remarks]

        self.assertEqual(counts(self.done("info", scene).stdout), [1, 1, 1])
        out = self.folder / "out"
        self.assertEqual(counts(self.done("simulate", scene, "--out", out).stderr), [1, 1, 1])
        self.assertEqual(counts("".join(json.loads((out / "summary.json").read_text())["warnings"])), [1, 1, 1])
        self.assertEqual(counts(self.done("plan", scene).stderr), [1, 1, 1])
        rows = "".join(f"0.0{x},0.0{x},0,7.{x},{batch}\n" for batch, x in enumerate((11, 12, 14)))
        later = self.folder / "later.csv"
        later.write_text("x,y,z,reading,batch\n" + rows)
        self.assertEqual(counts(self.done("plan", scene, "--measurements", later, "--out", self.folder / "later").stderr), [0, 0, 0])
        self.assertEqual(counts("".join(json.loads((self.folder / "later/summary.json").read_text())["warnings"]))[:2], [1, 1])
        for times in ([1, 1, 1], [0, 0, 0]):
            self.assertEqual(counts(self.done("session", scene, self.folder / "run", "next").stderr), times)
        short = self.done("plan", scene, "--set", "field.length_mm=1").stderr
        self.assertIn("field.length_mm 1 is shorter than the edges of the tissue, 2.07 mm on average", short)

    def test_the_printed_scene_of_one_cell_is_a_scene(self):
        cells = json.loads(self.done("experiment", "table1", "--print-scene").stdout)
        printed = self.done("experiment", "table1", "--only", cells[0]["cell"], "--print-scene").stdout
        self.assertEqual(json.loads(printed), cells[0]["scene"])
        path = self.folder / "cell.json"
        path.write_text(printed)
        run = self.done("simulate", path, "--set", "plan.batches=1", "--set", "surface.plane.vertices=[21,41]", "--quiet")
        self.assertNotIn("unknown", run.stderr)

    def test_experiments_and_their_cells_are_listed(self):
        lines = self.done("experiment", "--list").stdout.splitlines()
        names = [line.split()[0] for line in lines]
        self.assertEqual(names[0], "table1")
        self.assertTrue({"coverage", "study", "merge"} <= set(names) and all(len(line.split()) > 2 for line in lines))
        cells = self.done("experiment", "table1", "--list").stdout.splitlines()
        self.assertEqual(cells, [cell["cell"] for cell in json.loads(self.done("experiment", "table1", "--print-scene").stdout)])
        self.assertIn("shards", self.ends(2, "experiment", "merge", "--list"))
        refused = palpate("experiment")
        self.assertEqual(refused.returncode, 2)
        self.assertIn("experiment --list", refused.stderr)

    def test_every_command_and_every_key_has_help(self):
        self.assertEqual(self.done("help", "plan").stdout, self.done("plan", "--help").stdout.replace(str(PALPATE), "palpate"))
        self.assertIn("--points", self.done("help", "mesh", "surface").stdout)
        self.assertEqual(self.done("help").stdout, self.done("--help").stdout.replace(str(PALPATE), "palpate"))
        for command, words in (("mesh", "plane dome folded"), ("experiment", "table1 coverage merge")):
            for word in words.split():
                self.assertEqual(self.done("help", command, word).stdout, self.done("help", command).stdout)
            self.assertEqual(palpate("help", command, "nothing").returncode, 2)
        metric = self.done("help", "field.metric").stdout
        self.assertTrue(metric.startswith("field.metric\n") and "chart | ambient | intrinsic" in metric, metric)
        robot = self.done("help", "robot").stdout
        self.assertIn("robot.margin_mm [mm]", robot)
        self.assertNotIn("field.", robot)
        self.assertIn('"shape": "horseshoe"', self.done("help", "probe.tumours").stdout)
        keys = [line.split()[0] for line in self.done("help", "scene").stdout.splitlines() if line and line[0].islower() and "." in line.split()[0]]
        self.assertGreater(len(keys), 60)
        for key in keys[::7]:
            self.assertIn(self.done("help", key).stdout.splitlines()[1], self.done("help", "scene").stdout)
        refused = palpate("help", "field.metrik")
        self.assertEqual(refused.returncode, 2)
        self.assertIn("field.metric", refused.stderr)

    def test_the_manual_page_has_every_command_and_key(self):
        page = self.done("help", "man").stdout
        for words in ("palpate plan SCENE", "palpate mesh surface", "robot.margin_mm [mm]", "field.metric", ".SH EXIT STATUS", "--measurements"):
            self.assertIn(words.replace("-", "\\-"), page)
        if shutil.which("groff"):
            formatted = subprocess.run(["groff", "-man", "-ww", "-Tutf8", "-P-cbou"], input=page, capture_output=True, text=True)
            self.assertEqual((formatted.returncode, formatted.stderr), (0, ""))
            self.assertIn("EXIT STATUS", formatted.stdout)

    def completed(self, *words):
        script = self.done("help", "completion").stdout
        line = f'{script}\nCOMP_WORDS=({" ".join(words)})\nCOMP_CWORD={len(words) - 1}\n_palpate\nprintf "%s\\n" "${{COMPREPLY[@]}}"\n'
        run = subprocess.run(["bash", "-c", line], capture_output=True, text=True)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        return run.stdout.split()

    def test_bash_completes_commands_options_and_keys(self):
        self.assertEqual(self.completed("palpate", "sim"), ["simulate"])
        self.assertIn("--measurements", self.completed("palpate", "plan", "scene.json", "--me"))
        self.assertEqual(self.completed("palpate", "mesh", "su"), ["surface"])
        self.assertIn("--jitter", self.completed("palpate", "mesh", "dome", "--ji"))
        self.assertEqual(self.completed("palpate", "simulate", "a.json", "--set", "field.met"), ["field.metric="])
        self.assertEqual(self.completed("palpate", "help", "robot.mar"), ["robot.margin_mm"])
        self.assertEqual(self.completed("palpate", "simulate", "exam"), [])  # files are bash's own

    def test_no_stop_comes_nearer_to_the_border_than_the_margin(self):
        scene = self.scene(plan={"initial": {"count": 12}, "batches": 2}, robot={"margin_mm": 3, "spring_n_per_m": 250, "indent_mm": 4})
        self.done("simulate", scene, "--out", self.folder / "run", "--quiet")
        rows = self.table("run/waypoints.csv")
        self.assertEqual(len(rows), 32)
        for row in rows:
            x, y = 1e3 * float(row["x"]), 1e3 * float(row["y"])
            self.assertGreaterEqual(min(x, 20 - x, y, 30 - y), 3 - 1e-9)
            self.assertTrue(math.isclose(float(row["expected_force_n"]), 1.0))  # 250 N/m over 4 mm
        nearest = min(min(1e3 * float(row["x"]), 20 - 1e3 * float(row["x"])) for row in rows)
        self.assertLess(nearest, 5)  # and not much farther than it must
        refused = palpate("simulate", scene, "--set", "robot.margin_mm=12")
        self.assertEqual(refused.returncode, 3)
        self.assertIn("robot.margin_mm", refused.stderr)

    def test_a_robot_a_hundred_metres_away_is_questioned(self):
        identity = [1, 0, 0, 100, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
        told = self.done("plan", self.scene(robot={"from_tissue": identity}), "--quiet").stderr
        self.assertIn("its translation of 100 m", told)
        self.assertIn("millimetres", told)
        identity[3] = 0.1
        self.assertNotIn("translation", self.done("plan", self.scene(robot={"from_tissue": identity}), "--quiet").stderr)


if __name__ == "__main__":
    main_without_pictures(own_arguments=2)
