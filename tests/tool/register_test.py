#!/usr/bin/env python3
"""palpate register: from touched places to the transform that a scene names, and what cannot be one.

usage: register_test.py PALPATE        needs Python 3 and nothing else
"""

import csv
import json
import math
import subprocess
import sys
import unittest

from support import PALPATE, InFolder, main_without_pictures

TURN = math.radians(30)
SHIFT = (0.10, -0.05, 0.20)
CORNERS = ((0.0, 0.0, 0.0), (0.025, 0.0, 0.0), (0.0, 0.05, 0.0), (0.025, 0.05, 0.0))


def in_robot(place):
    x, y, z = place
    return (math.cos(TURN) * x - math.sin(TURN) * y + SHIFT[0], math.sin(TURN) * x + math.cos(TURN) * y + SHIFT[1], z + SHIFT[2])


class Register(InFolder):
    def setUp(self):
        super().setUp()
        self.mesh = self.folder / "tissue.ply"
        self.done("mesh", "plane", "--size-mm", 25, 50, "--vertices", 14, 26, self.mesh)

    def touched(self, rows, name="touched.csv"):
        path = self.folder / name
        lines = ["x,y,z,tissue_x,tissue_y,tissue_z"] + [",".join(map(str, row)) for row in rows]
        path.write_text("".join(line + "\n" for line in lines), encoding="utf-8")
        return path

    def register(self, rows, *options, code=0):
        return self.ends(code, "register", self.mesh, "--unit", "mm", "--touched", self.touched(rows), "--out", self.folder / "T.json", *options)

    def test_a_scene_that_names_the_file_plans_in_the_robots_frame(self):
        said = self.register([(*in_robot(corner), *corner) for corner in CORNERS])
        self.assertIn("4 places touched, 4 pairs.", said)
        told = json.loads((self.folder / "T.json").read_text())
        expected = [math.cos(TURN), -math.sin(TURN), 0, SHIFT[0], math.sin(TURN), math.cos(TURN), 0, SHIFT[1], 0, 0, 1, SHIFT[2], 0, 0, 0, 1]
        for a, b in zip(told["from_tissue"], expected):
            self.assertAlmostEqual(a, b, places=12)
        self.assertEqual(len(told["covariance"]), 36)
        self.assertRegex(told["touched"], r"^20\d\d-\d\d-\d\dT\d\d:\d\d:\d\dZ$")
        self.assertIn(f"along itself within {told['place_uncertainty_mm']:.2f} mm", said)
        scene = self.folder / "scene.json"
        scene.write_text(json.dumps({"surface": {"mesh": "tissue.ply", "unit": "mm"}, "robot": {"registration": "T.json"}}), encoding="utf-8")
        felt = self.folder / "felt.csv"
        felt.write_text("x,y,z,reading\n", encoding="utf-8")
        self.done("plan", scene, "--measurements", felt, "--out", self.folder / "a", "--quiet")
        self.done("plan", scene, "--measurements", felt, "--out", self.folder / "b", "--quiet", "--set", "robot.registration=null")
        with open(self.folder / "a/waypoints.csv", encoding="utf-8") as a, open(self.folder / "b/waypoints.csv", encoding="utf-8") as b:
            for moved, plain in zip(csv.DictReader(a), csv.DictReader(b)):
                place = in_robot([float(plain[axis]) for axis in "xyz"])
                for axis, value in zip("xyz", place):
                    self.assertAlmostEqual(float(moved[axis]), value, places=12)
        in_force = json.loads((self.folder / "a/summary.json").read_text())["options"]["robot"]["from_tissue"]
        self.assertEqual(in_force, told["from_tissue"])  # by which pictures and exports bring the stops back
        self.assertIn("give one of them", self.ends(3, "plan", scene, "--measurements", felt, "--set", "robot.from_tissue=[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]"))

    def test_pairs_that_do_not_fit_are_told(self):
        places = (*CORNERS, (0.01, 0.02, 0.0), (0.02, 0.03, 0.0), (0.005, 0.04, 0.0), (0.02, 0.045, 0.0))
        rows = [(*in_robot(place), *place) for place in places]
        rows[1], rows[2] = (*rows[1][:3], *rows[2][3:]), (*rows[2][:3], *rows[1][3:])
        self.assertIn("more than 1 mm: is every one of the 8 pairs the same place", self.register(rows))

    def test_what_a_registration_leaves_open_is_in_the_band_and_an_old_one_is_told(self):
        scene = self.folder / "scene.json"
        scene.write_text(json.dumps({"surface": {"mesh": "tissue.ply", "unit": "mm"}, "robot": {"registration": "T.json"}, "plan": {"batches": 3},
                                     "probe": {"noise": 0.02, "tumours": [{"shape": "disk", "centre_mm": [12, 25, 0], "radius_mm": 6}]}}), encoding="utf-8")
        corners = [(*in_robot(corner), *corner) for corner in CORNERS]
        self.register(corners, "--touch-sd-mm", 1)
        told = json.loads((self.folder / "T.json").read_text())
        self.assertGreater(told["place_uncertainty_mm"], 1.0)
        self.done("simulate", scene, "--out", self.folder / "run", "--quiet", "--set", "robot.registration=null")
        widths = {}
        for name, settings in (("sure", ["robot.place_uncertainty_mm=0"]), ("unsure", [])):
            words = [word for setting in settings for word in ("--set", setting)]
            said = self.done("boundary", scene, "--measurements", self.folder / "run" / "measurements.csv", "--out", self.folder / name, "--quiet", *words)
            summary = json.loads((self.folder / name / "summary.json").read_text())
            widths[name] = summary["band"]["half_width_mm"]
            self.assertEqual(any("so well the robot is registered" in warning for warning in summary["warnings"]), name == "unsure", said)
        least = math.hypot(widths["sure"], told["place_uncertainty_mm"])  # the whole outline's band is of more than 1.96 deviations
        self.assertGreater(widths["unsure"], least)
        told["touched"] = "2020-01-01T00:00:00Z"
        (self.folder / "T.json").write_text(json.dumps(told))
        self.assertIn("was anything moved since?", subprocess.run([PALPATE, "session", scene, self.folder / "session", "next"], capture_output=True, text=True).stderr)
        told["touched"] = "yesterday"
        (self.folder / "T.json").write_text(json.dumps(told))
        self.assertIn("touched: must be a time", self.ends(3, "plan", scene, "--measurements", self.folder / "run" / "measurements.csv"))

    def test_what_cannot_be_one_is_refused_in_words(self):
        line = ((0.0, 0.0, 0.0), (0.0, 0.02, 0.0), (0.0, 0.05, 0.0))
        self.assertIn("beside one line", self.register([(*in_robot(place), *place) for place in line], code=3))
        self.assertIn("three at least", self.register([(*in_robot(place), *place) for place in CORNERS[:2]], code=3))
        mm = [(*(1000 * value for value in in_robot(place)), *place) for place in CORNERS]
        self.assertIn("is one of them in millimetres?", self.register(mm, code=3))
        off = [(*in_robot(place), place[0], place[1], 0.05) for place in CORNERS]
        self.assertIn("50.0 mm from the tissue", self.register(off, code=3))
        self.assertIn("touched.csv:2: ", self.register([(0.1, 0.1, 0.1, 0.0, "", "")] * 3, code=3))
        flat = [(*in_robot(place), *place) for place in (*CORNERS, (0.01, 0.01, 0.0), (0.02, 0.03, 0.0))]
        self.assertIn("hold it in place", self.register(flat, "--refine", code=3))
        self.assertFalse((self.folder / "T.json").exists())


if __name__ == "__main__":
    main_without_pictures()
