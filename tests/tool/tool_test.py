#!/usr/bin/env python3
"""The tool as a person meets it: exit codes, messages, files. Usage: tool_test.py PALPATE PROJECT_ROOT [Tool.test_...] (Python 3, standard library only)."""

import csv
import json
import math
import os
import pathlib
import random
import re
import sys
import unittest

from support import BRIEFLY, SANITIZED, InFolder, main_without_pictures, palpate

ROOT = pathlib.Path(sys.argv[2]).resolve()
RECORDINGS = ROOT.parent / "shared" / "data" / "dvrk-palp"
LIVER = ROOT.parent / "shared" / "data" / "meshes" / "liver-smooth.obj"

SCENE = {
    "version": 1,
    "surface": {"plane": {"size_mm": [25, 50], "vertices": [51, 101]}},
    "certainty": "laplace",
    "plan": {"acquisition": "straddle", "batches": 4},
    "probe": {"noise": 0.05, "tumours": [{"shape": "disk", "centre_mm": [11.5, 30, 0], "radius_mm": 6.25}]},
}
FILES = {"summary.json", "timings.json", "trace.csv", "measurements.csv", "waypoints.csv", "path.csv", "boundary.wkt", "boundary.vtp", "surface.vtp", "steps.pvd", "steps"}


class Tool(InFolder):
    def setUp(self):
        super().setUp()
        self.scene = self.write("scene.json", json.dumps(SCENE))

    def refused(self, code, *arguments):
        result = palpate(*arguments)
        self.assertEqual(result.returncode, code, result.stdout + result.stderr)
        self.assertTrue(result.stderr.strip() or code == 2)
        return result.stderr

    def test_a_boundary_finer_than_the_mesh_is_told(self):
        scene = self.write("coarse.json", json.dumps({
            "version": 1, "surface": {"plane": {"size_mm": [20, 20], "vertices": [5, 5]}},
            "field": {"length_mm": 1, "signal_sd": 1, "noise": 0.001}, "level": {"estimate": "known", "value": 8.7}}))
        rows = ["0.01,0.01,0,9"] + [f"{x},{y},0,7" for x in (0.005, 0.015) for y in (0.005, 0.015)]
        measured = self.write("m.csv", "\n".join(["x,y,z,reading", *rows]) + "\n")
        result = palpate("boundary", scene, "--measurements", measured, "--out", self.folder / "out")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("smaller than a triangle", result.stderr)
        self.assertIn("smaller than a triangle", " ".join(json.loads((self.folder / "out" / "summary.json").read_text())["warnings"]))

    def test_readings_that_look_wrong_are_told(self):
        dice = random.Random(1)
        healthy = [f"{x / 1000},{y / 1000},0,{dice.gauss(7, 0.1)}" for x in range(2, 20, 3) for y in range(2, 20, 3)]
        scene = self.write("flat.json", json.dumps({"version": 1, "surface": {"plane": {"size_mm": [20, 20], "vertices": [21, 21]}}}))
        tilted = [f"{x / 1000},{y / 1000},0,{7 + 0.1 * x + dice.gauss(0, 0.1)}" for x in range(2, 20, 2) for y in range(2, 20, 2)]
        for rows, words in ((healthy[:-1] + ["0.017,0.017,0,9"], "One reading, 9.000 at (17.0, 17.0, 0.0) mm"),
                            ([row.rsplit(",", 1)[0] + ",7" for row in healthy], "all 36 readings are equal, 7.000, to the last digit"),
                            (tilted, "Readings slope all over the tissue: they rise by 0.99"),
                            (healthy + healthy[:5], "5 rows repeat earlier ones, place and reading alike to every digit, and are set aside: line 38 repeats line 2")):
            measured = self.write("odd.csv", "\n".join(["x,y,z,reading", *rows]) + "\n")
            result = palpate("boundary", scene, "--measurements", measured)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertIn(words, result.stderr + result.stdout)
            self.assertIn("Nothing found", result.stdout)
        stuck = self.write("stuck.csv", "x,y,z,reading\n" + "".join(f"0.00{x},0.00{y},0,7\n" for y in range(2, 9) for x in range(2, 9)))
        result = palpate("boundary", scene, "--measurements", stuck, "--set", "field.screening=true")
        self.assertIn("49 readings (49 set aside).\nAll readings are set aside, so nothing is known.", result.stdout)
        self.assertIn("49 readings set aside (frozen", result.stderr)

    def test_one_reading_tells_of_no_contrast(self):
        measured = self.write("one.csv", "x,y,z,reading\n0.01,0.02,0,7\n")
        self.assertIn("Nothing found: one reading tells of no contrast.", self.done("boundary", self.scene, "--measurements", measured))

    def test_touches_that_would_help_are_asked_for_at_the_boundary(self):
        dice = random.Random(14)
        places = [(dice.uniform(2, 22), dice.uniform(2, 22)) for _ in range(14)]  # of 40 x 40 mm
        rows = [f"{x / 1000},{y / 1000},0,{7 + 2 / (1 + math.exp(-1.4 * (6 - math.hypot(x - 12, y - 12)))) + dice.gauss(0, 0.2)}" for x, y in places]
        scene = self.write("corner.json", json.dumps({"surface": {"plane": {"size_mm": [40, 40], "vertices": [41, 41]}}}))
        measured = self.write("corner.csv", "\n".join(["x,y,z,reading", *rows]) + "\n")
        result = palpate("boundary", scene, "--measurements", measured)
        right, up = map(float, re.search(r"above all around \(([-0-9.]+), ([-0-9.]+), ", result.stderr).groups())
        self.assertLess(abs(math.hypot(right - 12, up - 12) - 6), 4)

    def test_what_lies_beyond_the_sensors_range_is_told_to_be_open(self):
        dice = random.Random(15)
        places = [(dice.uniform(1, 29), dice.uniform(1, 29)) for _ in range(60)]
        felt = [(x, y, 7 + 2 / (1 + math.exp(-0.9 * (8 - math.hypot(x - 14, y - 15)))) + dice.gauss(0, 0.04)) for x, y in places]
        ended = sum(reading > 8.2 for _, _, reading in felt)
        scene = self.write("ended.json", json.dumps({"surface": {"plane": {"size_mm": [30, 30], "vertices": [31, 31]}}}))
        measured = self.write("ended.csv", "x,y,z,reading\n" + "".join(f"{x / 1000},{y / 1000},0,{min(reading, 8.2)}\n" for x, y, reading in felt))
        end = f"{ended} readings are exactly 8.200, the greatest of all: the sensor's range may end there, and what lies beyond is not known"
        self.done("boundary", scene, "--measurements", measured, "--out", self.folder / "brief", *BRIEFLY)
        self.assertIn(end + ".", json.loads((self.folder / "brief" / "summary.json").read_text())["warnings"])
        if SANITIZED:
            return
        self.done("boundary", scene, "--measurements", measured, "--out", self.folder / "ended")
        drawn = json.loads((self.folder / "ended" / "summary.json").read_text())
        self.assertIn(end + ": outlines are drawn for tissue that reads as much or more.", drawn["warnings"])
        self.assertLess(drawn["area_interval_mm2"][0], math.pi * 64)
        self.assertGreater(drawn["area_interval_mm2"][1], math.pi * 64)

    def test_slow_waves_under_a_tumour_are_taken_back_and_told(self):
        dice = random.Random(3)
        places = [(dice.uniform(0, 40), dice.uniform(0, 50)) for _ in range(90)]
        waving = [(x, y, 7 + 0.004 * ((x - 20) ** 2 - (y - 25) ** 2) + 2 * (math.hypot(x - 18, y - 22) < 9) + dice.gauss(0, 0.05)) for x, y in places]
        scene = self.write("waves.json", json.dumps({"surface": {"plane": {"size_mm": [40, 50], "vertices": [41, 51]}}}))
        measured = self.write("waves.csv", "x,y,z,reading\n" + "".join(f"{x / 1000},{y / 1000},0,{reading}\n" for x, y, reading in waving))
        self.done("boundary", scene, "--measurements", measured, "--out", self.folder / "waves", *BRIEFLY)
        summary = json.loads((self.folder / "waves" / "summary.json").read_text())
        (waves,) = summary["taken_back"]
        self.assertEqual(waves["kind"], "waves")
        self.assertAlmostEqual(waves["rise"], 4.1, delta=1.0)
        self.assertIn("slow waves that were found", summary["modelled"])
        self.assertIn("Readings rise and fall slowly all over the tissue", " ".join(summary["warnings"]))
        self.assertAlmostEqual(summary["area_mm2"], math.pi * 81, delta=50)
        self.assertIn(b'"waves"', (self.folder / "waves" / "surface.vtp").read_bytes())

    def test_a_known_level_that_nothing_comes_near_is_told(self):
        for level, words in (("20", "above every reading"), ("0", "below every reading")):
            out = self.folder / level
            self.done("simulate", self.scene, "--set", "level.estimate=known", "--set", f"level.value={level}", "--out", out)
            self.assertIn(words, " ".join(json.loads((out / "summary.json").read_text())["warnings"]))
        summary = json.loads(self.summary_of("simulate", "--set", "level.estimate=known", "--set", "level.value=8", "--set", "probe.tumours=[]"))
        self.assertTrue(3.0 < summary["nothing_wider_than_mm"] < 30.0)

    def test_a_patch_far_from_the_tissue_is_refused(self):
        words = self.refused(3, "simulate", self.scene, "--set", "surface.patch.centre_mm=[500,0,0]", "--set", "surface.patch.radius_mm=8")
        self.assertIn("is surface.unit right?", words)

    def test_the_edge_tells_the_level_and_how_well_it_is_known(self):
        self.done("simulate", self.scene, "--out", self.folder / "out", "--set", "level.estimate=edge")
        summary = json.loads((self.folder / "out" / "summary.json").read_text())
        self.assertGreater(summary["level_sd"], 0.0)
        self.assertLess(abs(summary["level"] - 8.0), 3.0 * summary["level_sd"])

    def test_simulate_writes_every_file_and_tells_the_result(self):
        out = self.folder / "out"
        words = self.done("simulate", self.scene, "--out", out)
        self.assertIn("Found 1 stiff region", words)
        self.assertIn("Against the truth", words)
        self.assertLessEqual(FILES, {path.name for path in out.iterdir()})
        summary = json.loads((out / "summary.json").read_text())
        self.assertEqual(summary["computed"], [], "a planar scene needs no chart solve, search tree, geodesics or spectrum")
        self.assertEqual(summary["vertices"], 51 * 101)
        self.assertEqual(summary["measurements"], 16 + 4 * 10)
        self.assertAlmostEqual(summary["search_area_mm2"], 1250.0, delta=1e-9)
        self.assertEqual(summary["stop_reason"], "budget")
        self.assertEqual(len(summary["parts"]), 1)
        self.assertLess(summary["error"]["percent_of_search_area"], 2.0)
        self.assertAlmostEqual(summary["error"]["missed_mm2"] + summary["error"]["extra_mm2"], summary["error"]["symmetric_difference_mm2"], delta=1e-9)
        self.assertEqual(len((out / "trace.csv").read_text().splitlines()), 1 + 5)
        stops = (out / "waypoints.csv").read_text().splitlines()
        self.assertEqual(len(stops), 1 + 56)
        way = (out / "path.csv").read_text().splitlines()
        self.assertEqual(way[0], stops[0] + ",leg", "places on the way tell which stop they lead to")
        legs = [int(line.rsplit(",", 1)[1]) for line in way[1:]]
        self.assertEqual(legs, sorted(legs))
        self.assertTrue(0 < legs[0] and legs[-1] == 55, "no way leads to the first stop")

    def summary_of(self, command, *arguments):
        out = self.folder / "other"
        self.done(command, self.scene, "--out", out, "--quiet", *arguments)
        return (out / "summary.json").read_text()

    def test_the_band_lies_around_the_boundary(self):
        out = self.folder / "out"
        words = self.done("simulate", self.scene, "--out", out)
        self.assertIn("95 % confidence band: ", words)
        summary = json.loads((out / "summary.json").read_text())
        band, cut = summary["band"], summary["cut"]
        self.assertEqual((band["probability"], cut["risk"]), (0.95, 0.05))
        self.assertLess(band["inner_area_mm2"], summary["area_mm2"])
        self.assertLess(summary["area_mm2"], cut["area_mm2"])
        self.assertLess(cut["area_mm2"], band["outer_area_mm2"])
        self.assertGreater(band["half_width_mm"], 0.0)
        self.assertIn("No other tumour", words)
        self.assertIsNone(summary["nothing_wider_than_mm"])
        self.assertTrue(3.0 < summary["no_other_wider_than_mm"] < 30.0)
        self.assertAlmostEqual(summary["expected_missed_mm2"] + summary["expected_extra_mm2"], summary["expected_error_mm2"], delta=1e-9)
        self.assertGreaterEqual(summary["expected_untouched_mm2"], 0.0)
        (part,) = summary["parts"]
        self.assertGreater(part["probability"], 0.99)
        self.assertEqual((part["holes"], part["touches_border"]), ([], False))
        narrow = json.loads(self.summary_of("simulate", "--set", "band.probability=0.5", "--set", "band.cut_risk=0.4"))
        self.assertLess(narrow["band"]["half_width_mm"], band["half_width_mm"])
        self.assertLess(narrow["cut"]["area_mm2"], cut["area_mm2"])

    def test_what_is_sampled_is_said_and_is_the_same_again(self):
        sampled = self.summary_of("simulate", "--set", "certainty=sampled")
        self.assertEqual(sampled, self.summary_of("simulate", "--set", "certainty=sampled"))
        summary, laplace = json.loads(sampled), json.loads(self.summary_of("simulate", "--overwrite"))
        self.assertEqual((summary["certainty"], laplace["certainty"]), ("sampled", "laplace"))
        least, most = summary["area_interval_mm2"]
        self.assertTrue(least < summary["area_mm2"] < most, summary["area_interval_mm2"])
        self.assertIsNone(laplace["area_interval_mm2"])
        # The same touches: plans go by Laplace's approximation in both.
        self.assertEqual(summary["path_mm"], laplace["path_mm"])
        self.assertNotEqual(summary["expected_missed_mm2"], summary["expected_extra_mm2"])

    def test_certainty_that_is_off_is_asked_nowhere_and_changes_no_boundary(self):
        off, laplace = (json.loads(self.summary_of("simulate", "--overwrite", "--set", f"certainty={kind}")) for kind in ("off", "laplace"))
        self.assertEqual(off["certainty"], "off")
        for key in ("band", "cut", "expected_error_mm2", "expected_missed_mm2", "expected_untouched_mm2", "area_interval_mm2"):
            self.assertIsNone(off[key], key)
        self.assertIsNone(off["parts"][0]["probability"])
        self.assertEqual((off["modelled"], laplace["modelled"]), (["level at the edge"], ["level at the edge", "Laplace's certainty"]))
        for key in ("area_mm2", "level", "path_mm", "no_other_wider_than_mm"):
            self.assertEqual(off[key], laplace[key], key)
        curves = (self.folder / "other" / "boundary.wkt").read_text()
        words = self.done("simulate", self.scene, "--set", "certainty=off", "--out", self.folder / "off")
        self.assertIn("How sure that is was not asked", words)
        self.assertNotIn("band", words)
        self.assertEqual((self.folder / "off" / "boundary.wkt").read_text(), curves)
        self.assertNotIn(b"probability_inside", (self.folder / "off" / "surface.vtp").read_bytes())
        self.assertIn("plan.stop.band_mm: is 1", self.refused(3, "simulate", self.scene, "--set", "certainty=off", "--set", "plan.stop.band_mm=1"))
        self.assertIn('certainty: is "off"', self.refused(3, "experiment", "coverage", "--set", "certainty=off", "--trials", 1))

    def test_a_tumour_at_the_border_is_found_scored_and_told(self):
        out = self.folder / "out"
        disk = '[{"shape": "disk", "centre_mm": [25, 25, 0], "radius_mm": 6}]'
        words = self.done("simulate", self.scene, "--set", f"probe.tumours={disk}", "--out", out)
        self.assertIn("reaching the border", words)
        summary = json.loads((out / "summary.json").read_text())
        self.assertTrue(summary["parts"][0]["touches_border"])
        self.assertGreater(summary["error"]["dice"], 0.8)
        self.assertTrue(any("reaches the border" in warning for warning in summary["warnings"]))

    def test_experiments_run_the_cells_that_are_asked_for(self):
        coarse = ["--trials", 1, "--set", "surface.plane.vertices=[13,25]", "--set", "plan.batches=1", "--quiet", *BRIEFLY, "--out", self.folder]
        self.done("experiment", "table1", "--only", "noise 5 %", "--only", "disk", *coarse)
        rows = [row.split(",")[:4] for row in (self.folder / "table1.csv").read_text().splitlines()[1:]]
        self.assertEqual(rows, [[level, "noise 5 %", "disk", algorithm] for level in ("known", "range") for algorithm in ("evr", "ucb", "ils-ucb")])
        self.assertEqual(len((self.folder / "table1_defaults.csv").read_text().splitlines()), 2)
        coarse[3], coarse[-1] = "surface.plane.vertices=[19,17]", self.folder / "table2"
        self.done("experiment", "table2", "--only", "way, lag learned, horseshoe, noise 10 %", *coarse)
        (row,) = (self.folder / "table2" / "table2.csv").read_text().splitlines()[1:]
        self.assertTrue(row.startswith("way,learned,horseshoe,10,1,"), row)

    def test_coverage_and_detection_count_runs_over_random_tumours(self):
        if SANITIZED:
            self.skip("two dozen runs take minutes there, and are those of other tests")
        coarse = ["--trials", 1, "--set", "surface.plane.vertices=[37,33]", "--set", "plan.batches=2", "--quiet", *BRIEFLY, "--out", self.folder]
        words = self.done("experiment", "coverage", *coarse)
        self.assertIn("noise 25 %", words)
        header, *rows = (self.folder / "rows.csv").read_text().splitlines()
        self.assertEqual(len(rows), 4)
        names = header.split(",")
        for row in rows:
            run = dict(zip(names, row.split(",")))
            self.assertEqual((run["seed"], run["parts"]), ("0", "1"))
            self.assertTrue(50.0 <= float(run["area_mm2"]) <= 400.0 and 500.0 <= float(run["slope_per_m"]) <= 2000.0)
            self.assertGreater(float(run["bound_mm2"]), 0.0)
        (total,) = [row for row in (self.folder / "coverage.csv").read_text().splitlines() if row.startswith("all,")]
        self.assertTrue(total.startswith("all,4,"), total)
        coarse[-1] = self.folder / "detection"
        words = self.done("experiment", "detection", *coarse, "--set", "plan.min_contrast=2")
        self.assertIn("Healthy tissue: nothing found", words)
        kinds = [row.split(",")[0] for row in (self.folder / "detection" / "detection.csv").read_text().splitlines()[1:]]
        self.assertEqual((kinds.count("healthy"), kinds.count("two")), (4, 3))

    def test_a_study_varies_values_and_meshes(self):
        (self.folder / "meshes").mkdir()
        for name in ("a.ply", "b.ply"):
            self.done("mesh", "plane", "--vertices", 13, 25, self.folder / "meshes" / name)
        scene = dict(SCENE, surface={"mesh": "none.ply", "unit": "mm"})
        self.write("meshed.json", json.dumps(scene))
        study = self.write("study.json", json.dumps({"scene": "meshed.json", "meshes": "meshes", "vary": {"plan.batch": [5, 10], "plan.batches": [1]}, "trials": 2}))
        self.done("experiment", "study", study, "--quiet", "--out", self.folder / "out")
        cells = [f"surface.mesh {mesh}, plan.batch {batch}, plan.batches 1" for mesh in ("a.ply", "b.ply") for batch in (5, 10)]
        self.assertEqual(self.done("experiment", "study", study, "--list").splitlines(), cells)
        self.assertEqual(self.done("experiment", "study", study, "--list", "--only", "b.ply").splitlines(), cells[2:])
        _, *rows = (self.folder / "out" / "study.csv").read_text().splitlines()
        self.assertEqual([row.split('"')[1] for row in rows], cells)
        self.assertTrue(all(row.split('"')[2].startswith(",2,") for row in rows))
        self.assertIn("no key of a study", self.refused(3, "experiment", "study", self.write("bad.json", '{"scene": "meshed.json", "varry": {}}')))
        self.assertIn("must be a list", self.refused(3, "experiment", "study", self.write("bad.json", '{"scene": "meshed.json", "vary": {"seed": 1}}')))
        self.assertIn("needs a study", self.refused(3, "experiment", "study"))

    def test_a_study_names_the_cell_that_is_at_fault(self):
        (self.folder / "meshes").mkdir()
        self.done("mesh", "plane", "--vertices", 13, 25, self.folder / "meshes" / "a.ply")
        (self.folder / "meshes" / "b.ply").write_text("ply\n")
        self.write("meshed.json", json.dumps(dict(SCENE, surface={"mesh": "none.ply", "unit": "mm"})))
        study = lambda vary, **more: self.write("study.json", json.dumps({"scene": "meshed.json", "vary": vary, "trials": 1, **more}))
        self.assertIn("cell 'plan.batch 5, plan.batches -1': ", self.refused(3, "experiment", "study", study({"plan.batch": [5], "plan.batches": [1, -1]})))
        words = self.refused(3, "experiment", "study", study({"plan.batch": [5]}, meshes="meshes"), "--quiet")
        self.assertIn("cell 'surface.mesh b.ply, plan.batch 5': ", words)

    def test_the_values_of_a_study_are_cells_of_its_table(self):
        disks = [[{"shape": "disk", "centre_mm": [x, 25, 0], "radius_mm": 6}] for x in (10, 15)]
        self.write("scene.json", json.dumps(SCENE))
        study = self.write("study.json", json.dumps({"scene": "scene.json", "vary": {"probe.tumours": disks}, "trials": 1}))
        self.done("experiment", "study", study, "--quiet", "--set", "plan.batches=1", "--out", self.folder / "out")
        rows = list(csv.DictReader((self.folder / "out" / "study.csv").open()))
        self.assertEqual([json.loads(row["cell"].removeprefix("probe.tumours ")) for row in rows], disks)
        self.assertEqual([row["trials"] for row in rows], ["1", "1"])

    def test_shards_are_asked_for_in_words_that_make_sense(self):
        self.assertIn("--shard needs --out", self.refused(2, "experiment", "coverage", "--shard", "1/2"))
        self.assertIn("must be I/N", self.refused(2, "experiment", "coverage", "--shard", "3/2", "--out", self.folder / "x"))
        self.assertIn("needs the folders", self.refused(2, "experiment", "merge"))
        self.assertIn("experiment.json: cannot read", self.refused(3, "experiment", "merge", self.folder))

    def test_tradeoff_advises_what_its_table_supports(self):
        if SANITIZED:
            self.skip("two dozen runs that draw outlines take minutes there, and are those of other tests")
        words = self.done("experiment", "tradeoff", self.scene, "--trials", 1, "--set", "plan.batches=2", "--quiet", "--out", self.folder)
        table = {}
        for name in ("tradeoff_areas.csv", "tradeoff_times.csv"):
            header, *rows = (self.folder / name).read_text().splitlines()
            for row in (dict(zip(header.split(","), row.split(","))) for row in rows):
                table.setdefault(row["choice"], {}).update(row)
        self.assertTrue({"exact", "fast", "draft", "plan on 1.0 mm", "plain arithmetic"} <= set(table))
        self.assertEqual(float(table["exact"]["from_exact_mm2"]), 0.0)
        self.assertEqual(float(table["plain arithmetic"]["from_exact_mm2"]), 0.0, "the boundary is the same, only its error is summed otherwise")
        self.assertAlmostEqual(float(table["plain arithmetic"]["error_mm2"]), float(table["exact"]["error_mm2"]), delta=1e-6)
        self.assertLess(float(table["draft"]["run_s"]), float(table["exact"]["run_s"]))
        advised = words.strip().splitlines()[-1]
        if advised.startswith("Take "):
            self.assertLess(float(table[advised[5:advised.index(" (")]]["of_exact"]), 1.0)
        self.assertIn("needs a scene", self.refused(3, "experiment", "tradeoff"))

    def test_speed_leaves_the_conclusion_on_the_whole_mesh(self):
        summary = json.loads(self.summary_of("simulate", "--set", "speed=draft"))
        self.assertEqual(summary["options"]["plan"]["explore_mm"], 1.0)
        self.assertIsNotNone(summary["stop_reason"])
        self.assertIsNone(summary["error"]["mean_distance_mm"])
        self.assertLess(summary["error"]["symmetric_difference_mm2"], 15.0)
        self.refused(3, "simulate", self.scene, "--set", "plan.explore_mm=3", "--set", "plan.batch=500")

    def test_a_hole_is_listed_with_its_part(self):
        ring = '[{"shape": "horseshoe", "centre_mm": [12, 25, 0], "arc_radius_mm": 8, "half_width_mm": 2.5, "arc_deg": 360}]'
        summary = json.loads(self.summary_of("simulate", "--set", f"probe.tumours={ring}", "--set", "probe.noise=0.01", "--set", "plan.batches=9"))
        holes = [hole for part in summary["parts"] for hole in part["holes"]]
        self.assertEqual(len(holes), 1)
        self.assertAlmostEqual(holes[0]["area_mm2"], 95.0, delta=15.0)  # pi 5.5^2
        self.assertAlmostEqual(holes[0]["centroid_mm"][1], 25.0, delta=0.5)

    def test_a_stop_has_its_reason_in_words(self):
        words = self.done("simulate", self.scene, "--set", "plan.stop.band_mm=3", "--set", "plan.batches=12", "--set", "level.estimate=edge")
        self.assertIn("Stopped because the band is narrow enough.", words)

    def test_healthy_tissue_holds_nothing(self):
        out = self.folder / "healthy"
        words = self.done("simulate", self.scene, "--set", "probe.tumours=[]", "--out", out)
        self.assertIn("Nothing found", words)
        self.assertIn("wider than", words)
        summary = json.loads((out / "summary.json").read_text())
        self.assertEqual(summary["parts"], [])
        self.assertIsNone(summary["band"])
        stiffer = json.loads(self.summary_of("simulate", "--set", "probe.tumours=[]", "--set", "plan.min_contrast=2"))
        self.assertGreater(summary["nothing_wider_than_mm"], stiffer["nothing_wider_than_mm"])
        self.assertGreater(stiffer["nothing_wider_than_mm"], 2.0)
        self.assertIsNone(summary["level"])
        self.assertEqual(summary["error"]["dice"], 1.0)
        self.assertIsNone(summary["error"]["hausdorff_mm"])
        self.assertEqual((out / "boundary.wkt").read_text(), "MULTIPOLYGON EMPTY\n")

    def test_the_files_are_the_same_bytes_at_one_and_two_threads(self):
        for threads in (1, 2):
            self.done("simulate", self.scene, "--out", self.folder / str(threads), "--threads", threads, "--quiet")
        for path in sorted((self.folder / "1").rglob("*")):
            if path.is_file() and path.name != "timings.json":
                twin = self.folder / "2" / path.relative_to(self.folder / "1")
                self.assertEqual(path.read_bytes(), twin.read_bytes(), path.name)

    def test_boundary_and_plan_follow_from_the_measurements_alone(self):
        run, bounded, planned = (self.folder / name for name in ("run", "bounded", "planned"))
        self.done("simulate", self.scene, "--out", run)
        self.done("boundary", self.scene, "--measurements", run / "measurements.csv", "--out", bounded)
        first, second = (json.loads((folder / "summary.json").read_text()) for folder in (run, bounded))
        # The hyperparameters are learned to 1e-5 from another start, so the areas agree to about that.
        self.assertAlmostEqual(first["area_mm2"], second["area_mm2"], delta=1e-2)
        words = self.done("plan", self.scene, "--set", "plan.batches=9", "--measurements", run / "measurements.csv", "--out", planned)
        self.assertIn("Touch next", words)
        self.assertEqual(len((planned / "waypoints.csv").read_text().splitlines()), 1 + 10)
        self.assertIn("all planned batches", self.done("plan", self.scene, "--measurements", run / "measurements.csv"))

    def test_a_second_run_leaves_nothing_of_the_first(self):
        out = self.folder / "out"
        self.done("simulate", self.scene, "--out", out)
        measured = self.write("measured.csv", (out / "measurements.csv").read_text())
        self.done("boundary", self.scene, "--measurements", measured, "--out", out, "--overwrite")
        names = {path.name for path in out.iterdir()}
        self.assertNotIn("waypoints.csv", names, "a robot must not follow the waypoints of another plan")
        self.assertNotIn("steps.pvd", names)

    def test_a_field_of_zero_mean_is_about_the_readings_mean(self):
        self.done("simulate", self.scene, "--set", "field.trend=zero", "--out", self.folder / "zero")
        summary = json.loads((self.folder / "zero" / "summary.json").read_text())
        self.assertLess(summary["error"]["percent_of_search_area"], 3.0)

    def test_values_without_effect_are_refused(self):
        for value in ("surface.patch.radius_mm=5", "surface.plane.vertices=[2.5,3]"):
            self.refused(3, "simulate", self.scene, "--set", value)
        nothing = self.write("nothing.csv", "x,y,z,reading\n")
        self.assertIn("raster", self.refused(3, "plan", self.scene, "--set", "plan.acquisition=raster", "--measurements", nothing))

    def test_plan_without_measurements_asks_for_the_first_touches(self):
        nothing = self.write("nothing.csv", "x,y,z,reading\n")
        self.assertIn("Touch next", self.done("plan", self.scene, "--measurements", nothing))

    def test_compare_tells_the_difference_of_two_boundaries(self):
        a = self.write("a.wkt", "MULTIPOLYGON (((0.005 0.01, 0.015 0.01, 0.015 0.02, 0.005 0.02, 0.005 0.01)))")
        b = self.write("b.wkt", "POLYGON ((0.005 0.01, 0.015 0.01, 0.015 0.03, 0.005 0.03, 0.005 0.01))")
        self.assertIn("100.00 mm2 wrong", self.done("compare", self.scene, a, b))
        self.assertIn(f"With {b.name} taken for the truth", self.done("compare", self.scene, a, b))
        self.assertIn(" 0.00 mm2 wrong", self.done("compare", self.scene, a, a))
        millimetres = self.write("mm.wkt", "POLYGON ((10 10, 20 10, 20 20, 10 10))")
        self.assertIn("off the tissue", self.refused(3, "compare", self.scene, a, millimetres))
        run = self.folder / "run"
        self.done("simulate", self.scene, "--out", run, *BRIEFLY)
        self.assertIn("no boundary", self.refused(3, "compare", self.scene, run / "surface.vtp", a))
        self.assertIn(" 0.00 mm2 wrong", self.done("compare", self.scene, run / "boundary.wkt", run / "boundary.vtp"))
        self.assertIn("holds a run", self.refused(3, "compare", self.scene, a, b, "--out", run))
        curved, bent = "examples/dome.json", self.folder / "bent"
        self.done("simulate", ROOT / curved, "--set", "plan.batches=1", "--out", bent, *BRIEFLY)
        finer = ["--set", "surface.refine_mm=0.4"]
        self.assertIn("the chart of another mesh", self.refused(3, "compare", ROOT / curved, bent / "boundary.wkt", bent / "boundary.vtp", *finer))
        self.assertIn(" 0.00 mm2 wrong", self.done("compare", ROOT / curved, bent / "boundary.vtp", bent / "boundary.vtp", *finer))

    def test_mesh_makes_what_info_describes(self):
        plane = self.folder / "plane.ply"
        self.done("mesh", "plane", "--size-mm", 25, 50, "--vertices", 26, 51, "--jitter", 0.3, plane)
        words = self.done("info", plane, "--unit", "mm")
        self.assertIn("1326 vertices", words)
        self.assertIn("Flat", words)
        self.assertIn("12.500 cm2", words)

    def test_a_plane_takes_the_length_of_its_cells(self):
        plane = self.folder / "plane.ply"
        made = self.done("mesh", "plane", "--size-mm", 20, 30, "--edge-mm", 0.1, plane)
        self.assertIn("60501 vertices", made)  # 201 x 301: 20 / 0.1 is 200 cells, whatever its last bit
        self.assertIn("364 vertices", self.done("mesh", "plane", "--edge-mm", 2, "--overwrite", plane))  # 25 x 50 mm: 13 by 25 cells, as 2 does not divide 25
        self.assertIn("edge-mm", self.refused(2, "mesh", "plane", "--edge-mm", 2, "--vertices", 5, 5, self.folder / "x.ply"))
        self.assertIn("--around", self.refused(2, "mesh", "plane", "--margin-mm", 2, self.folder / "x.ply"))
        self.assertIn("--edge-mm 0.001", self.refused(2, "mesh", "plane", "--edge-mm", 0.001, self.folder / "x.ply"))

    def test_mesh_makes_curved_phantoms_too(self):
        for kind, area in (("cylinder", 12.5), ("dome", 12.48), ("saddle", 14.8), ("wave", 13.7), ("folded", 16.2)):
            made = self.folder / f"{kind}.ply"
            self.done("mesh", kind, "--edge-mm", 0.8, "--jitter", 0.3, made)
            words = self.done("info", made, "--unit", "mm")
            self.assertIn("Curved", words)
            self.assertAlmostEqual(float(words.split("Area: ")[1].split()[0]), area, delta=0.15, msg=kind)
        self.assertIn("--reach-mm", self.refused(2, "mesh", "wave", "--reach-mm", 3, self.folder / "x.ply"))
        self.assertIn("--vertices", self.refused(2, "mesh", "dome", "--vertices", 30, 30, self.folder / "x.ply"))
        for kind, option, value in [("dome", "--edge-mm", 0.001), ("dome", "--edge-mm", 1000), ("dome", "--reach-mm", 90), ("wave", "--amplitude-mm", 400)]:
            words = self.refused(2, "mesh", kind, option, value, self.folder / "x.ply")
            self.assertIn(option, words)
            self.assertNotIn("_m ", words, "an option is named, not what the library calls it")
        self.assertIn("--size-mm", self.refused(2, "mesh", "cylinder", "--size-mm", 200, 20, self.folder / "x.ply"))

    def test_the_robot_touches_only_what_it_reaches(self):
        reached = ["--set", "robot.shaft_direction=[0,0,1]", "--set", "robot.clearance_mm=3"]
        self.done("simulate", self.scene, *reached, "--set", "plan.batches=0")
        self.assertIn("reaches no tissue", self.refused(3, "simulate", self.scene, "--set", "robot.shaft_direction=[0,0,-1]"))
        self.assertIn("takes no account", self.refused(3, "simulate", self.scene, *reached, "--set", "plan.acquisition=raster"))

    def test_the_classical_scans_run_too(self):
        for strategy in ("raster", "refinement"):
            words = self.done("simulate", self.scene, "--set", f"plan.acquisition={strategy}", "--set", "field.length_mm=3.3", "--quiet", "--out", self.folder / strategy)
            summary = json.loads((self.folder / strategy / "summary.json").read_text())
            self.assertLess(summary["error"]["percent_of_search_area"], 3.0, words)

    def test_readings_along_the_path_are_taken_where_the_scene_wants_them(self):
        self.done("simulate", self.scene, "--set", "plan.readings_along_path=true", "--set", "plan.batches=1", "--out", self.folder / "way")
        rows = (self.folder / "way" / "measurements.csv").read_text().splitlines()[1:]
        self.assertGreater(sum(",way," in row for row in rows), 50)

    def test_experiment_prints_scenes_that_run(self):
        cells = json.loads(self.done("experiment", "table1", "--print-scene"))
        self.assertEqual(len(cells), 2 * 8 + 2 * 2 * 3 * 8)
        scene = self.write("cell.json", json.dumps(cells[21]["scene"]))
        self.assertIn("Found", self.done("simulate", scene, "--set", "surface.plane.vertices=[26,51]", "--set", "plan.batches=2"))

    def test_wrong_usage_ends_with_2(self):
        self.refused(2)
        misspelt = self.refused(2, "simulat", self.scene)
        self.assertIn("palpate: there is no command simulat; the nearest is simulate\n", misspelt)
        self.assertNotIn("required", misspelt)
        self.refused(2, "simulate")
        self.assertIn("palpate simulate: there is no option --treads; the nearest is --threads\n", self.refused(2, "simulate", self.scene, "--treads", 2))
        self.assertIn("palpate: there is no command qqq\n", self.refused(2, "qqq"))
        self.assertEqual(palpate("--help").returncode, 0)
        self.assertIn("plan.gamma", self.done("help", "scene"))

    def test_an_input_at_fault_ends_with_3(self):
        self.assertIn("missing.json", self.refused(3, "simulate", self.folder / "missing.json"))
        self.assertIn("plan.gamma", self.refused(3, "simulate", self.scene, "--set", "plan.gama=1"))
        no_mesh = self.write("no_mesh.json", '{"surface": {"mesh": "gone.ply", "unit": "mm"}}')
        self.assertIn("gone.ply", self.refused(3, "simulate", no_mesh))
        wrong = self.write("wrong.csv", "x,y,z,reading\n0.01,0.01,0,nan\n")
        self.assertIn("wrong.csv:2", self.refused(3, "boundary", self.scene, "--measurements", wrong))
        far = self.write("far.csv", "x,y,z,reading\n1,1,1,7\n")
        self.assertIn("far.csv:2", self.refused(3, "boundary", self.scene, "--measurements", far))

    def test_a_machine_at_fault_ends_with_4(self):
        occupied = self.write("occupied", "a file, not a folder")
        self.assertIn("occupied", self.refused(4, "simulate", self.scene, "--out", occupied))

    def test_replays_a_recording(self):
        recording = RECORDINGS / "fig_circle_forward.csv"
        if not recording.exists():
            self.skip(f"{recording.name} is not here")
        out = self.folder / "replay"
        words = self.done("replay", ROOT / "examples" / "replay_circle.json", "--recording", recording, "--out", out, *BRIEFLY)
        summary = json.loads((out / "summary.json").read_text())
        self.assertEqual(summary["measurements"], 200, words)
        self.assertLess(summary["error"]["symmetric_difference_mm2"], 60.0)

    def test_info_looks_at_the_tissue_that_a_scene_makes_of_a_mesh(self):
        scene = ROOT / "examples" / "dome.json"
        words = self.done("info", scene, "--set", "surface.patch.centre_mm=[0,0,0]", "--set", "surface.patch.radius_mm=8")
        self.assertIn("The tissue of", words)
        self.assertIn("Recommended: field.metric chart", words)
        self.assertIn("on this scene", words)
        area_cm2 = float(re.search(r"Area: ([0-9.]+) cm2", words).group(1))
        # A cap of a sphere of 25 mm, 8 mm from its middle along the surface, less what its triangles jut out.
        self.assertAlmostEqual(area_cm2, 2 * math.pi * 6.25 * (1 - math.cos(8 / 25)), delta=0.1)

    def test_says_what_to_do_with_a_closed_organ(self):
        if not LIVER.exists():
            self.skip(f"{LIVER.name} is not here")
        self.assertIn("surface.patch", self.done("info", LIVER, "--unit", "cm"))
        scene = self.write("liver.json", json.dumps({"surface": {"mesh": str(LIVER), "unit": "cm"}}))
        self.assertIn("surface.patch", self.refused(3, "simulate", scene))

    def test_works_on_a_curved_disk_in_its_chart(self):
        # 24 x 24 mm of a sphere of 20 mm, its grid sheared so that nothing is regular.
        side, radius, rows, faces = 33, 20.0, [], []
        for i in range(side * side):
            x, y = (i % side + 0.2 * math.sin(i)) * 24 / (side - 1) - 12, (i // side + 0.2 * math.cos(3 * i)) * 24 / (side - 1) - 12
            angle = math.hypot(x, y) / radius
            share = math.sin(angle) / angle
            rows.append(f"{x * share} {y * share} {radius * math.cos(angle)}")
        for i in range((side - 1) ** 2):
            a = i // (side - 1) * side + i % (side - 1)
            faces += [f"3 {a} {a + 1} {a + side + 1}", f"3 {a} {a + side + 1} {a + side}"]
        mesh = self.write("dome.off", f"OFF\n{len(rows)} {len(faces)} 0\n" + "\n".join(rows + faces) + "\n")
        self.assertIn("Curved: flattened, it is stretched to between", self.done("info", mesh, "--unit", "mm"))
        scene = self.write("dome.json", json.dumps({"version": 1,
            "surface": {"mesh": str(mesh), "unit": "mm"}, "field": {"metric": "chart"}, "plan": {"batches": 5},
            "probe": {"low": 7, "high": 9, "slope_per_m": 1400, "noise": 0.01,
                      "tumours": [{"shape": "disk", "centre_mm": [0, 0, radius], "radius_mm": 5}]}}))
        out = self.folder / "dome"
        words = self.done("simulate", scene, "--out", out)
        summary = json.loads((out / "summary.json").read_text())
        self.assertIn("chart", summary["computed"], words)
        # A cap of 5 mm along the surface: 2 pi R^2 (1 - cos(5 / R)).
        self.assertLess(abs(summary["area_mm2"] - 2 * math.pi * radius ** 2 * (1 - math.cos(5 / radius))), 8.0, words)
        self.assertLess(summary["error"]["symmetric_difference_mm2"], 12.0, words)
        self.assertAlmostEqual(sum(part["area_mm2"] for part in summary["parts"]), summary["area_mm2"], 6)
        self.assertLess(math.dist(summary["parts"][0]["position_mm"], [0, 0, radius]), 1.0)


if __name__ == "__main__":
    os.environ.pop("DISPLAY", None)
    main_without_pictures(own_arguments=2)
