#!/usr/bin/env python3
"""The catalogue of worlds, contrasts that do not matter, logarithms and the goal of a search, as the tool has them.

usage: worlds_test.py PALPATE [Worlds.test_...]        needs Python 3
"""

import json
import math
import random
import sys
import unittest

from support import BRIEFLY, InFolder, main_without_pictures, palpate, rows_of

TISSUE = {"surface": {"plane": {"size_mm": [25, 50], "vertices": [26, 51]}}}


def disk(x, y, middle, radius, contrast):
    """Stiffness at a place, mm, of one on the tissue's middle line."""
    return contrast / (1 + math.exp(-1.4 * (radius - math.hypot(x - 12.5, y - middle))))


class Worlds(InFolder):
    def scene(self, **groups):
        path = self.folder / "scene.json"
        path.write_text(json.dumps({**TISSUE, **groups}))
        return path

    def summary(self, command, scene, *arguments):
        briefly = () if any(str(one).startswith("certainty=") for one in arguments) else BRIEFLY
        run = palpate(command, scene, "--out", self.folder / "out", "--overwrite", "--quiet", *briefly, *arguments)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        return json.loads((self.folder / "out" / "summary.json").read_text())

    def felt(self, touches, column, row_of):
        """A file of touches anywhere on the tissue: row_of their number and the stiffness of a disk around a centre has the reading and the last column."""
        path = self.folder / "felt.csv"
        with open(path, "w") as file:
            file.write(f"x,y,z,reading,{column}\n")
            for touch in range(touches):
                x, y = random.uniform(0, 25), random.uniform(0, 50)
                reading, last = row_of(touch, lambda right, up: 1 + 2 / (1 + math.exp(-1.2 * (6 - math.hypot(x - right, y - up)))))
                file.write(f"{x / 1e3},{y / 1e3},0,{reading},{last}\n")
        return path

    def raster(self, rows, reading_of):
        """A file of readings every 2 mm, of what is felt at a place in mm."""
        path = self.folder / "raster.csv"
        with open(path, "w") as file:
            file.write("x,y,z,reading\n")
            for x in range(12):
                for y in range(rows):
                    file.write(f"{(1.5 + 2 * x) / 1e3},{(1.5 + 2 * y) / 1e3},0,{reading_of(1.5 + 2 * x, 1.5 + 2 * y)}\n")
        return path

    def refused(self, scene, says):
        run = palpate("simulate", scene)
        self.assertEqual(run.returncode, 3, run.stdout + run.stderr)
        self.assertIn(says, run.stderr)

    def test_a_world_is_drawn_by_the_seed(self):
        scene = self.scene(probe={"world": "two", "noise": 0.02}, plan={"batches": 4})
        one, again, other = (self.summary("simulate", scene, "--seed", seed)["error"] for seed in (3, 3, 4))
        self.assertEqual(one, again)
        self.assertNotEqual(one, other)

    def test_without_a_goal_a_search_looks_for_another_tumour_like_it(self):
        plane = {"plane": {"size_mm": [54, 49], "vertices": [75, 68]}}
        scene = self.scene(surface=plane, probe={"world": "two", "noise": 0.01})
        summary = self.summary("simulate", scene, "--seed", 45010)
        self.assertEqual(len(summary["parts"]), 2)
        self.assertLess(summary["error"]["symmetric_difference_mm2"], 10)

    def test_a_world_stands_in_place_of_tumours(self):
        disk = {"shape": "disk", "centre_mm": [12, 25, 0], "radius_mm": 5}
        self.refused(self.scene(probe={"world": "two", "tumours": [disk]}), "stands in place of probe.tumours")
        self.refused(self.scene(probe={"world": "cube"}), "probe.world")
        small = {"plane": {"size_mm": [8, 8], "vertices": [9, 9]}}
        self.refused(self.scene(surface=small, probe={"world": "two"}, plan={"initial": {"count": 4}}), "cannot be drawn on this tissue")

    def test_coverage_runs_over_worlds(self):
        out = self.folder / "coverage"
        coarse = ("--trials", 2, "--set", "plan.batches=2", "--quiet", *BRIEFLY, "--out", out)
        run = palpate("experiment", "coverage", self.scene(probe={"noise": 0.05}), "--world", "profile", *coarse)
        self.assertEqual(run.returncode, 0, run.stderr)
        for family in ("dome", "cone", "gauss", "hill", "unequal-slopes", "all of profile"):
            self.assertIn(family, run.stdout)
        rows = rows_of(out / "rows.csv")
        self.assertEqual(len(rows), 10)
        for row in rows:
            self.assertEqual((row["kind"], row["true_parts"]), ("profile", "1"))
            self.assertGreater(float(row["bound_mm2"]), 0.0)
            if row["outline_by_p"]:
                self.assertAlmostEqual(sum(map(float, row["outline_by_p"].split())), 1.0, 9)
            if row["area_by_p"]:
                self.assertAlmostEqual(sum(map(float, row["area_by_p"].split())), 1250.0, 6)
        self.assertTrue((out / "coverage_tenths.csv").exists())
        wrong = palpate("experiment", "coverage", "--world", "cube", "--quiet")
        self.assertEqual(wrong.returncode, 2)
        self.assertIn("crescent", wrong.stderr)
        self.assertEqual(palpate("experiment", "table1", "--world", "all").returncode, 2)

    def test_what_is_weaker_than_matters_is_named_and_no_tumour(self):
        probe = {"world": "vessel", "noise": 0.02}
        weak = self.summary("simulate", self.scene(probe=probe, plan={"min_contrast": 1.4}), "--seed", 2)
        self.assertEqual(weak["parts"], [])
        self.assertTrue(any("plan.min_contrast" in words for words in weak["warnings"]), weak["warnings"])
        self.assertNotEqual(self.summary("simulate", self.scene(probe=probe), "--seed", 2)["parts"], [])

    def test_logarithms_are_written_as_readings(self):
        random.seed(4)
        skewed = self.raster(24, lambda x, y: 0.2 * math.exp(disk(x, y, 30, 6, 2) + random.gauss(0, 0.04)))
        arguments = ("--measurements", skewed)
        log = self.summary("boundary", self.scene(field={"transform": "log"}), *arguments)
        raw = self.summary("boundary", self.scene(field={"transform": "none"}), *arguments)
        self.assertEqual((log["transform"], raw["transform"]), ("log", "none"))
        self.assertAlmostEqual(log["level"], 0.2 * math.e, delta=0.05)  # half way between logarithms
        self.assertGreater(raw["level"], log["level"] + 0.1)
        by_itself = self.summary("boundary", self.scene(), *arguments)
        self.assertTrue(by_itself["transform"] == "log" or by_itself["transform_is_open"])
        self.assertTrue(any("logarithms" in words for words in by_itself["warnings"]), by_itself["warnings"])
        self.refused(self.scene(field={"transform": "log", "noise": 0.1}), "field.noise")
        self.refused(self.scene(field={"transform": "log"}, plan={"min_contrast": 1.0}), "plan.min_contrast")

    def test_what_may_be_tumour_or_not_lies_in_the_band(self):
        random.seed(5)
        measured = self.raster(25, lambda x, y: 7 + disk(x, y, 34, 6, 2) + disk(x, y, 14, 5, 0.66) + random.gauss(0, 0.06))
        summary = self.summary("boundary", self.scene(), "--measurements", measured)
        (part,) = summary["doubtful"]
        self.assertLess(math.dist(part["position_mm"], (12.5, 14.0, 0.0)), 4.0)
        self.assertAlmostEqual(part["area_mm2"], 25 * math.pi, delta=25)
        self.assertGreater(summary["expected_missed_mm2"], 0.5 * part["area_mm2"])
        self.assertLess(summary["area_mm2"], 36 * math.pi + 10)
        said = f"It may be tumour or not: its {part['area_mm2']:.0f} mm2 lie in the band, and half of them count as missed."
        self.assertTrue(any(said in words for words in summary["warnings"]), summary["warnings"])

    def test_a_part_that_was_felt_once_is_told(self):
        random.seed(6)
        glitch = lambda x, y: 2 if x == 5.5 and 31 < y < 42 else 0  # readings 66 to 71
        measured = self.raster(25, lambda x, y: 7 + disk(x, y, 14, 6, 2) + glitch(x, y) + random.gauss(0, 0.06))
        warnings = self.summary("boundary", self.scene(), "--measurements", measured)["warnings"]
        said = "Part 2 of 2 was felt once, by readings 66 to 71, made one after the other: what a sensor does wrong for as long looks alike. Touch there again."
        self.assertIn(said, warnings)

    def test_a_zero_that_moves_is_taken_back_and_said(self):
        scene = self.scene(probe={"world": "sensor-shift", "noise": 0.05}, plan={"batches": 9})
        summary = self.summary("simulate", scene, "--seed", 11)
        (change,) = summary["taken_back"]
        self.assertAlmostEqual(change["reading"], 41, delta=3)  # the catalogue's, after 40 stops
        said = f"Since reading {change['reading']}, of batch {change['batch']}, readings lie {change['amount']:.3f} higher than before"
        self.assertTrue(any(words.startswith(said) for words in summary["warnings"]), summary["warnings"])
        self.assertLess(summary["error"]["symmetric_difference_mm2"], 20)

    def test_tissue_that_moves_is_taken_back_and_said(self):
        random.seed(3)

        def moved(touch, stiffness):
            return stiffness(*((12, 25) if touch < 60 else (15, 27))) + random.gauss(0, 0.06), touch // 10

        felt = self.felt(120, "batch", moved)
        summary = self.summary("boundary", self.scene(), "--measurements", felt, "--set", "certainty=sampled")
        (change,) = summary["taken_back"]
        self.assertEqual(change["kind"], "moved")
        self.assertAlmostEqual(change["reading"], 61, delta=6)
        right, up, out = change["moved_mm"]
        self.assertLess(math.hypot(right - 3, up - 2, out), 1.5)
        said = f"Since reading {change['reading']}, of batch {change['batch']}, the tissue lies {math.hypot(right, up, out):.1f} mm from where it lay"
        self.assertTrue(any(words.startswith(said) for words in summary["warnings"]), summary["warnings"])
        self.assertLess(abs(summary["area_mm2"] - math.pi * 36), 3 * summary["expected_error_mm2"])

    def test_sessions_have_zeros_and_gains_of_their_own(self):
        random.seed(5)

        def fastened_anew(touch, stiffness):
            reading, day = (stiffness(12, 25), "monday") if touch < 60 else (5 + 1.1 * stiffness(12, 25), "tuesday")
            return reading + random.gauss(0, 0.06), day

        felt = self.felt(120, "session", fastened_anew)
        summary = self.summary("boundary", self.scene(), "--measurements", felt, "--set", "certainty=sampled")
        (change,) = summary["taken_back"]
        self.assertEqual((change["session"], change["reading"]), (2, 61))
        self.assertEqual(summary["modelled"][:2], ["level at the edge", "sessions"])
        self.assertEqual(summary["modelled"][-1], "sampled certainty")
        # Healthy tissue reads 1, and 5 + 1.1 on Tuesday.
        self.assertAlmostEqual(change["amount"], 5.1, delta=3 * change["amount_sd"])
        self.assertLess(change["amount_sd"], 0.1)
        low, high = change["factor_interval"]
        self.assertTrue(low < 1.1 < high and high - low < 0.2, change)
        self.assertTrue(any(words.startswith("The 2nd session, which begins with reading 61, has a zero of its own") for words in summary["warnings"]), summary["warnings"])
        least, most = summary["area_interval_mm2"]
        self.assertTrue(least < math.pi * 36 < most, summary["area_interval_mm2"])

    def test_of_logarithms_a_zero_that_moves_is_a_factor(self):
        random.seed(1)

        def raised(touch, stiffness):
            return stiffness(12, 25) * (1.8 if touch >= 50 else 1) * math.exp(random.gauss(0, 0.03)), touch // 10

        felt = self.felt(100, "batch", raised)
        summary = self.summary("boundary", self.scene(field={"transform": "log"}), "--measurements", felt)
        (change,) = summary["taken_back"]
        self.assertAlmostEqual(change["amount"], math.log(1.8), delta=0.05)
        said = f"{math.exp(change['amount']):.2f} times as high as before"
        self.assertIn(said, " ".join(summary["warnings"]))

    def test_a_search_with_a_goal_says_how_far_it_is(self):
        short = self.scene(plan={"goal": {"max_undetected_diameter_mm": 6}, "batches": 1}, probe={"noise": 0.05})
        summary = self.summary("simulate", short)
        goal = summary["goal"]
        self.assertFalse(goal["reached"])
        self.assertGreater(goal["touches_needed"], 10)
        self.assertIn("The search is not done", " ".join(summary["warnings"]))
        self.assertIn(b'"undetected_mm"', (self.folder / "out" / "surface.vtp").read_bytes())
        planned = palpate("plan", short)
        self.assertIn("touches rule out one of 6.0 mm", planned.stdout)
        self.assertIsNone(self.summary("simulate", self.scene(plan={"batches": 1}))["goal"])


if __name__ == "__main__":
    main_without_pictures()
