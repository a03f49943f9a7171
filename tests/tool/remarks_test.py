#!/usr/bin/env python3
"""What may be wrong with an answer is said in words: tissue beside tissue, holes, coarse meshes, readings that come late, another probe.

usage: remarks_test.py PALPATE [Remarks.test_...]        needs Python 3
"""

import json
import math
import random
import unittest

from support import BRIEFLY, SANITIZED, InFolder, main_without_pictures

SIZE_MM = (30, 30)


def step(depth_mm):
    """Of a contrast of one, over an edge of 2 mm."""
    return 1 / (1 + math.exp(-2.2 * depth_mm))


def in_disk(x, y, radius_mm=8):
    return radius_mm - math.hypot(x - 14, y - 15)


class Remarks(InFolder):
    def said(self, reading_of, places, *options, vertices=61, sessions=None):
        """Summary and warnings of readings of so many at these places."""
        scene = self.write("scene.json", json.dumps({"surface": {"plane": {"size_mm": SIZE_MM, "vertices": [vertices, vertices]}}}))
        dice = random.Random(5)
        rows = [f"{x / 1e3},{y / 1e3},0,{3 + reading_of(i, x, y) + dice.gauss(0, 0.02)},{sessions[i] if sessions else 0}\n" for i, (x, y) in enumerate(places)]
        felt = self.write("felt.csv", "x,y,z,reading,session\n" + "".join(rows))
        self.done("boundary", scene, "--measurements", felt, "--out", self.folder / "out", "--overwrite", "--quiet", *options)
        summary = json.loads((self.folder / "out" / "summary.json").read_text())
        return summary, " ".join(summary["warnings"])

    def at_random(self, count=150):
        dice = random.Random(7)
        return [(dice.uniform(0.3, 29.7), dice.uniform(0.3, 29.7)) for _ in range(count)]

    def test_what_takes_much_of_the_border_may_be_another_tissue(self):
        summary, words = self.said(lambda i, x, y: step(x - 17), self.at_random(), *BRIEFLY)
        self.assertRegex(words, r"Part 1 takes 4[0-9] % of the border of the tissue, as another tissue beside it would")
        (part,), (doubtful,) = summary["parts"], summary["doubtful"]
        self.assertAlmostEqual(part["probability"], 0.5, delta=1e-3)
        self.assertAlmostEqual(doubtful["border_share"], (30 + 2 * 13) / 120, delta=0.03)
        self.assertAlmostEqual(summary["expected_extra_mm2"], 0.5 * 30 * 13, delta=30)
        summary, words = self.said(lambda i, x, y: step(in_disk(x, y)), self.at_random(), *BRIEFLY)
        self.assertNotIn("of the border", words)
        self.assertGreater(summary["parts"][0]["probability"], 0.99)

    def test_a_tumour_beside_another_tissue_is_as_sure_as_alone(self):
        summary, _ = self.said(lambda i, x, y: max(step(x - 22), step(6 - math.hypot(x - 11, y - 15))), self.at_random(), *BRIEFLY)
        sure = sorted(part["probability"] for part in summary["parts"])
        self.assertAlmostEqual(sure[0], 0.5, delta=1e-3)
        self.assertGreater(sure[1], 0.99)

    def test_a_hole_may_be_a_soft_core(self):
        _, words = self.said(lambda i, x, y: step(in_disk(x, y, 10)) - step(in_disk(x, y, 4)), self.at_random(250), *BRIEFLY)
        self.assertRegex(words, r"The outline has 1 hole, of [3-7]\d mm2 around \(1[345]\.\d, 1[456]\.\d, 0\.0\) mm: what reads like healthy tissue counts as such")

    def test_a_mesh_that_cuts_corners_off_is_told(self):
        _, coarse = self.said(lambda i, x, y: step(in_disk(x, y)), self.at_random(), *BRIEFLY, vertices=7)
        self.assertRegex(coarse, r"The mesh is coarse where the outline runs, with triangles up to 5\.7 mm wide: they cut some \d+ mm2 off what is round")
        _, fine = self.said(lambda i, x, y: step(in_disk(x, y)), self.at_random(), *BRIEFLY)
        self.assertNotIn("coarse", fine)

    def test_readings_that_come_late_are_taken_back_and_told(self):
        if SANITIZED:
            return
        places, legs = [], []
        for row in range(15):
            along = [1.5 * i + 0.75 for i in range(20)]
            for x in along if row % 2 == 0 else along[::-1]:
                legs.append((x - places[-1][0], 2.0 * row + 1 - places[-1][1]) if places else (0, 0))
                places.append((x, 2.0 * row + 1))

        def trailing(i, x, y):
            length = math.hypot(*legs[i]) or 1
            return step(in_disk(x - 1.2 * legs[i][0] / length, y - 1.2 * legs[i][1] / length))

        summary, words = self.said(trailing, places)
        (late,) = summary["taken_back"]
        self.assertEqual(late["kind"], "late")
        self.assertAlmostEqual(late["lag_mm"], 1.2, delta=0.3)
        self.assertIn("lag that was found", summary["modelled"])
        self.assertIn("mm behind where they were made, along the way on which the probe came there", words)
        self.assertIn(f"the whole outline would lie {late['lag_mm']:.1f} mm to one side", words)

    def test_rows_of_one_way_do_not_tell_whether_they_come_late(self):
        rows = [[(1.5 * i + 0.75, 2.0 * row + 1) for i in range(20)] for row in range(15)]
        _, words = self.said(lambda i, x, y: step(in_disk(x, y)), [place for row in rows for place in row], *BRIEFLY)
        self.assertIn("Nearly all readings were made on the way towards (1.00, ", words)
        there_and_back = [place for number, row in enumerate(rows) for place in (row[::-1] if number % 2 else row)]
        for places in (there_and_back, self.at_random()):
            _, words = self.said(lambda i, x, y: step(in_disk(x, y)), places, *BRIEFLY)
            self.assertNotIn("Nearly all", words)

    def test_sessions_of_a_reading_or_two_tell_nothing(self):
        _, words = self.said(lambda i, x, y: step(in_disk(x, y)), self.at_random(30), *BRIEFLY, sessions=[f"{i // 2}" for i in range(30)])
        self.assertIn("15 sessions of 15 have fewer than 3 readings that count: what they tell goes to the zero of their session", words)

    def test_a_session_with_another_probe_is_told(self):
        if SANITIZED:
            return
        places = self.at_random(200)
        second = [i >= 100 for i in range(200)]
        summary, words = self.said(lambda i, x, y: step(in_disk(x, y) + 1.5 * second[i]), places, sessions=["b" if one else "a" for one in second])
        self.assertIn("Readings of the 2nd session and later put the outline elsewhere than those before, at", words)
        self.assertIn("mm outwards, and neither a zero, a gain nor a shift explains it", words)
        self.assertGreater(summary["expected_error_mm2"], 25)
        summary, words = self.said(lambda i, x, y: 999 * second[i] * (3 + step(in_disk(x, y))) + step(in_disk(x, y)), places,
                                   sessions=["b" if one else "a" for one in second])
        self.assertRegex(words, r"The 2nd session, which begins with reading 101,.* what stands out does so (9\d\d|1\d\d\d)\.\d+ times as much")
        (session,) = [one for one in summary["taken_back"] if one.get("session") == 2]
        self.assertLess(session["factor_interval"][0], 1000)
        self.assertGreater(session["factor_interval"][1], 1000)
        self.assertAlmostEqual(summary["area_mm2"], math.pi * 64, delta=20)


if __name__ == "__main__":
    main_without_pictures()
