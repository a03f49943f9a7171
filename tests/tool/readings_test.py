#!/usr/bin/env python3
"""From a robot's log to readings: clean logs against closed forms, dirty ones read right or refused by name, real ones against a plain script.

Usage: readings_test.py PALPATE PROJECT_ROOT (Python 3; the plain script needs numpy and the recordings, and skips where either is absent)."""

import json
import math
import pathlib
import random
import sys
import unittest

from support import BRIEFLY, PATIENCE_S, SANITIZED, InFolder, main_without_pictures, palpate, rows_of

ROOT = pathlib.Path(sys.argv[2]).resolve()
REAL = ROOT.parent.parent / "shared" / "data" / "vu-arma"
if not REAL.is_dir():
    REAL = ROOT.parent / "shared" / "data" / "vu-arma"

HEADER = "probe,sample,t_s,x_mm,y_mm,z_mm,force_N"
STIFFNESS = 0.4  # N/mm


def probing(number, samples=12, stiffness=STIFFNESS, air=0, noise=0.004, step=0.25, start=0.0):
    """Rows of one press straight down, the tissue's surface at z = 0."""
    rows, dice = [], random.Random(number)
    for i in range(samples):
        past = (i - air) * step
        force = stiffness * max(0.0, past) + dice.gauss(0, noise)
        t = start + number * 5.0 + i * 0.1
        rows.append([number, i, f"{t:.3f}", 3 * (number % 3), 3 * (number // 3), f"{-past:.4f}", f"{force:.5f}"])
    return rows


def log(count=6, **shape):
    return [row for number in range(count) for row in probing(number, **shape)]


def text(rows, header=HEADER, separator=","):
    return header + "\n" + "".join(separator.join(map(str, row)) + "\n" for row in rows)


def slide(seconds=40.0, hz=2.0, rate=60.0, stiffness=STIFFNESS):
    dice, rows = random.Random(1), []
    for i in range(int(seconds * rate)):
        t = i / rate
        z = -1.0 * math.cos(2 * math.pi * hz * t)
        rows.append([f"{t:.4f}", f"{2 * t:.4f}", "0", f"{z:.5f}", f"{1.0 - stiffness * z + dice.gauss(0, 0.01):.5f}"])
    return rows


SLIDE = "t_s,x_mm,y_mm,z_mm,force_N"


def changed(rows, index, column, value):
    rows = [list(row) for row in rows]
    rows[index][column] = value
    return rows


class Readings(InFolder):
    def run_on(self, content, *options):
        path = self.folder / "log.csv"
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        out = self.folder / "readings.csv"
        out.unlink(missing_ok=True)
        result = palpate("readings", path, "--out", out, *options)
        rows = rows_of(out) if out.exists() else []
        return result, rows

    def good(self, content, count, *options, says="", near=STIFFNESS, within=0.03):
        result, rows = self.run_on(content, *options)
        self.assertEqual(result.returncode, 0, result.stderr)
        used = [row for row in rows if row["kind"] != "missed"]
        self.assertEqual(len(used), count, result.stdout)
        for row in used:
            self.assertAlmostEqual(float(row["reading"]), near, delta=within, msg=result.stdout)
        for word in [says] if isinstance(says, str) else says:
            self.assertIn(word, result.stdout)
        return rows

    def refused(self, content, says, *options, code=3):
        result, rows = self.run_on(content, *options)
        self.assertEqual(result.returncode, code, result.stdout + result.stderr)
        self.assertEqual(rows, [])
        for word in [says] if isinstance(says, str) else says:
            self.assertIn(word, result.stderr)

    # Clean logs.

    def test_columns_of_measurements_come_out(self):
        rows = self.good(text(log()), 6, "--session", "left lobe")
        self.assertEqual(
            list(rows[0])[:15], "x,y,z,reading,noise_variance,batch,kind,tx,ty,tz,set_aside,t,session,withdrawn,reading_unit".split(",")
        )
        first = rows[1]
        self.assertEqual((first["reading_unit"], first["session"], first["kind"]), ("N/mm", "left lobe", "stop"))
        self.assertAlmostEqual(float(first["x"]), 0.003)
        self.assertAlmostEqual(float(first["z"]), 0.0)
        self.assertAlmostEqual(float(first["t"]), 5.55, delta=0.01)
        self.assertEqual(float(first["nz"]), 1.0)

    def test_a_contact_point_in_the_air_is_found(self):
        rows = self.good(text(log(air=7, samples=20)), 6, says="begin in the air")
        for row in rows:
            self.assertAlmostEqual(float(row["z"]), 0.0, delta=1e-4)

    def test_probings_without_names_are_found_by_contact(self):
        rows = []
        for row in log(air=8, samples=20, noise=0.002):
            rows.append(row[2:])
            if row[1] == 19:  # out again
                z, t = float(row[5]), float(row[2])
                rows += [[f"{t + 0.1 * i:.3f}", row[3], row[4], f"{z + 0.5 * i:.3f}", f"{STIFFNESS * max(0.0, -(z + 0.5 * i)):.4f}"] for i in range(1, 12)]
        self.good(text(rows, "t_s,x_mm,y_mm,z_mm,force_N"), 6, says="found by contact")

    def test_a_probing_without_contact_is_a_row_of_kind_missed(self):
        rows = [row[:6] + [f"{random.Random(i).gauss(0, 0.004):.5f}"] if row[0] == 4 else row for i, row in enumerate(log(9))]
        rows = self.good(text(rows), 8, "--left-out", self.folder / "left.csv", says="1 of them is a row of kind missed")
        (missed,) = [row for row in rows if row["kind"] == "missed"]
        self.assertEqual((missed["reading"], missed["noise_variance"], missed["contact"], missed["probing"]), ("", "", "none", "4"))
        self.assertIn(",missed,no contact", (self.folder / "left.csv").read_text())
        # As any measurements: the plane spans it, the boundary counts the others, and no stop is planned there again.
        mesh, scene, readings = self.folder / "plane.ply", self.folder / "scene.json", self.folder / "readings.csv"
        scene.write_text('{"surface": {"mesh": "plane.ply", "unit": "mm"}, "plan": {"batch": 20}}')
        for command in (["mesh", "plane", "--around", readings, "--edge-mm", 1, mesh], ["boundary", scene, "--measurements", readings], ["plan", scene, "--measurements", readings, "--out", self.folder / "plan"]):
            self.done(*command)
        stops = rows_of(self.folder / "plan" / "waypoints.csv")
        self.assertGreater(len(stops), 10)
        self.assertTrue(all(math.dist((float(stop["x"]), float(stop["y"])), (0.003, 0.003)) > 1e-4 for stop in stops))

    def test_a_slide_gives_its_spring(self):
        rows = self.good(text(slide(), SLIDE), 20, says="Hz, found in the log", within=0.01)
        self.assertEqual(rows[3]["kind"], "way")
        self.assertAlmostEqual(float(rows[3]["tx"]), 1.0, delta=0.02)

    def test_hertz_and_force_at_a_depth(self):
        rows = []
        for number in range(5):
            for i in range(13):
                depth = 0.2 * i
                force = 4 / 3 * 0.02 * math.sqrt(3.0) * depth**1.5  # 20 kPa are 0.02 N/mm2
                rows.append([number, f"{depth}", 2 * number, 0, force])
        header = "probe,depth [mm],x(mm),y(mm),force (N)"
        self.good(text(rows, header), 5, "--model", "hertz", "--radius-mm", 3, near=20.0, within=0.01, says="kPa")
        at = 4 / 3 * 0.02 * math.sqrt(3.0) * 1.5**1.5
        self.good(text(rows, header), 5, "--model", "force", "--at-mm", 1.5, near=at, within=0.005)

    def test_counts_with_and_without_a_gain(self):
        rows = [[row[0], row[3], row[4], row[5], round(1000 + 500 * float(row[6]))] for row in log()]
        header = "probe,x_mm,y_mm,z_mm,adc"
        self.good(text(rows, header), 6, "--kind", "probings", near=200.0, within=10, says="counts/mm")
        self.good(text(rows, header), 6, "--gain", 0.002, "--offset", 1000, says="N/mm")

    # Dirty logs: one list, read right or refused by name.

    def test_dirty_logs(self):
        base = log()
        stuck = [row[:6] + ["0.5"] if row[0] == 2 else row for row in base]
        in_air = [row[:6] + [f"{random.Random(i).gauss(0, 0.004):.5f}"] if row[0] == 2 else row for i, row in enumerate(base)]
        clipped = [row[:6] + ["0.7"] if float(row[6]) > 0.7 else row for row in base]
        spread = lambda pick: [row for row in base if row[0] != 2 or pick(row)]
        nan = "nan"
        good = [
            # name, text, readings, words, options
            ("a hole in the force", text(changed(base, 5, 6, nan)), 6, "1 samples were left out", []),
            ("an empty cell", text(changed(base, 5, 6, "")), 6, "left out", []),
            ("NA for nothing", text(changed(base, 5, 6, "NA")), 6, "left out", []),
            ("infinite force", text(changed(base, 5, 6, "inf")), 6, "left out", []),
            ("nan in z", text(changed(base, 5, 5, nan)), 6, "left out", []),
            ("a word for a number", text(changed(base, 5, 6, "ERR")), 6, 'line 7: column force_N: "ERR" is not a number', []),
            ("a cell with its unit", text(changed(base, 5, 6, "1.2 N")), 6, '"1.2 N" is not a number', []),
            ("an overflow", text(changed(base, 5, 6, "1e999")), 6, "line 7", []),
            ("a wild force", text(changed(base, 5, 6, "1e30")), 6, "is no force", []),
            ("a spike", text(changed(base, 5, 6, "9.0")), 6, "1 samples were left out", []),
            ("a probing all nan", text([row[:6] + [nan] if row[0] == 2 else row for row in base]), 5, "too few samples: 0", []),
            ("a probing of two samples", text(spread(lambda row: row[1] < 2)), 5, "too few samples: 2", []),
            ("a probing without contact", text(in_air), 5, "no contact", []),
            ("a stuck force", text(stuck), 5, "stuck at 0.5", []),
            ("a saturated force", text(clipped), 6, "left out", []),
            ("a spike at the deepest sample", text(changed(base, 11, 6, "9.0")), 6, "1 samples were left out", []),
            ("a comment between rows", text(base).replace("\n2,0,", "\n# a pause\n2,0,"), 6, "begins with #", []),
            ("a depth that stands still", text([row[:5] + ["0"] + row[6:] if row[0] == 2 else row for row in base]), 5, "depth", []),
            ("to and fro", text([row[:5] + [f"{-math.sin(row[1])}"] + row[6:] if row[0] == 2 else row for row in base]), 5, "to and fro", []),
            ("a probing in metres", text([row[:5] + [float(row[5]) / 1000] + row[6:] if row[0] == 2 else row for row in base]), 5, "another unit", []),
            ("a probing far away", text([row[:3] + [row[3] * 1000 + 5000] + row[4:] if row[0] == 2 else row for row in base]), 5, "another unit", []),
            ("two rows swapped", text(base[:5] + [base[6], base[5]] + base[7:]), 6, "first at line 7", []),
            ("rows of two probings swapped", text(base[:11] + [base[12], base[11]] + base[13:]), 6, "out of order", []),
            ("rows backwards", text(base[::-1]), 6, "", []),
            ("swapped, without times", text([r[:2] + r[3:] for r in base[:5] + [base[6], base[5]] + base[7:]], "probe,sample,x_mm,y_mm,z_mm,force_N"), 6, "sorted by sample", []),
            ("repeated rows", text(base[:6] + [base[5]] + base[6:]), 6, "repeats the one before", []),
            ("repeated stamps", text(changed(base, 5, 2, base[4][2])), 6, "1 stamp repeats", []),
            ("a clock set back", text([row[:2] + [f"{float(row[2]) - 14:.3f}"] + row[3:] if row[0] > 2 else row for row in base]), 6, "clock goes back 1 time", []),
            ("a missing stamp", text(changed(base, 5, 2, "")), 6, "line 7: no stamp", []),
            ("a stamp of 0 among epochs", text(changed([r[:2] + [f"{float(r[2]) + 1.7e9:.3f}"] + r[3:] for r in base], 5, 2, "0")), 6, "a stamp of 0", []),
            ("a first stamp of 0 among epochs", text(changed([r[:2] + [f"{float(r[2]) + 1.7e9:.3f}"] + r[3:] for r in base], 0, 2, "0")), 6, "a stamp of 0", []),
            ("a torn last line", text(base)[:-9], 6, "", []),
            ("a torn row", text(base) + "5,12,3", 6, "the last line has no line end", []),
            ("a row too long", text(changed(base, 5, 6, "0,5")), 6, "decimals take a point", []),
            ("CRLF and a mark", b"\xef\xbb\xbf" + text(base).replace("\n", "\r\n").encode(), 6, "", []),
            ("quoted cells", text([[f'"{cell}"' for cell in row] for row in base]), 6, "", []),
            ("pressing is negative", text([row[:6] + [-float(row[6])] for row in base]), 6, "pressing as negative", []),
            ("z down", text([row[:5] + [-float(row[5])] + row[6:] for row in base]), 6, "", []),
            ("an offset of the sensor", text([row[:6] + [float(row[6]) + 3.0] for row in base]), 6, "", []),
            ("milliseconds and metres", text([[r[0], r[1], float(r[2]) * 1e3, r[3] / 1e3, r[4] / 1e3, float(r[5]) / 1e3, float(r[6]) * 1e3] for r in base], "probe,sample,t_ms,x_m,y_m,z_m,force_mN"), 6, "x_m [m]", []),
            ("units by option", text(base, "probe,sample,t,x,y,z,force"), 6, "", ["--unit", "time=s", "--unit", "position=mm", "--unit", "force=N"]),
            ("names by option", text(base, "wo,nr,wann,a,b,c,druck"), 6, "", ["--unit", "time=s", "--unit", "position=mm", "--unit", "force=N", *sum((["--column", pair] for pair in ["probe=wo", "sample=nr", "time=wann", "x=a", "y=b", "z=c", "force=druck"]), [])]),
            ("a probing in millinewtons", text([row[:6] + [float(row[6]) * 1000] if row[0] == 2 else row for row in base]), 5, "in another unit?", []),
            ("three samples each", text([row for row in base if row[1] in (0, 6, 11) or row[0] != 2]), 6, "do not tell their noise", []),
            ("no name in two rows", text(changed(changed(base, 20, 0, ""), 21, 0, "")), 6, "too few samples: 2", []),
            ("a header in the middle", text(base[:20] + [HEADER.split(",")] + base[20:]), 6, "is not a number", []),
            ("normals of zero", text([row + [0, 0, 0] for row in base], HEADER + ",nx,ny,nz"), 6, "", []),
            ("two sessions", text([["a"] + row for row in base] + [["b"] + row for row in base], "session," + HEADER), 12, "", []),
            ("named twice in two visits", text(base + [r[:2] + [float(r[2]) + 100] + r[3:] for r in base]), 12, "", []),
        ]
        bad = [
            ("an empty file", "", "the file is empty", []),
            ("a header alone", HEADER + "\n", "no row is left", []),
            ("no header", text(base)[len(HEADER) + 1 :], "header line", []),
            ("semicolons", text(base, HEADER.replace(",", ";"), ";"), "semicolons", []),
            ("no force", text([row[:6] for row in base], "probe,sample,t_s,x_mm,y_mm,z_mm"), "no column for the force", []),
            ("no position", text([[row[0], row[5], row[6]] for row in base], "probe,depth_mm,force_N"), "no column for the position x", []),
            ("no unit", text(base, "probe,sample,t_s,x_mm,y_mm,z_mm,force"), "--unit force=N", []),
            ("two forces", text([row + [row[6]] for row in base], HEADER + ",load_N"), ['"force_N", "load_N"', "--column force=NAME"], []),
            ("force and components", text([row + [0, 0, row[6]] for row in base], HEADER + ",fx_N,fy_N,fz_N"), "more than one column could be the force", []),
            ("half a vector", text([row[:6] + [0, row[6]] for row in base], "probe,sample,t_s,x_mm,y_mm,z_mm,fx_N,fz_N"), "component fy", []),
            ("a unit of something else", text(base, HEADER), "is in n by its name", ["--unit", "force=mN"]),
            ("a column that is not there", text(base), 'no column "fz"', ["--column", "force=fz"]),
            ("the same column twice", text(base, HEADER.replace("y_mm", "x_mm")), "appears twice", []),
            ("all stuck", text([row[:6] + ["0.5"] for row in base]), ["no reading came of it", "stuck"], []),
            ("all nan", text([row[:6] + ["nan"] for row in base]), "no reading came of it", []),
            ("a slide without oscillation", text([row[:4] + ["1.0"] for row in slide()], SLIDE), "--kind", []),
            ("metres that are millimetres", text(base, HEADER.replace("_mm", "_m")), "is its unit right?", []),
            ("a comment on top", "# mine\n" + text(base), ":1: begins with #, but a table has no lines of comment", []),
            ("a comment with commas on top", "# mine, of arm 7\n" + text(base), "the line that begins with # a comment? Take it away", []),
            ("commas at all lines' ends", text(base).replace("\n", ",\n"), ":1: a column has no name: take the comma at the line's end away", []),
            ("commas at the rows' ends", text([row + [""] for row in base]), "no row is left that could be read: line 2: 8 cells, but the header names 7 columns (a comma at the line's end", []),
            ("a row of units", text([["-", "-", "s", "mm", "mm", "mm", "N"]] + base, "probe,sample,t,x,y,z,force"), "--unit", []),
            ("two topics", text([row[:3] + row[3:6] + row[3:] for row in base], "probe,sample,t_s,m.position.x [mm],m.position.y [mm],m.position.z [mm],s.position.x [mm],s.position.y [mm],s.position.z [mm],force_N"), "--column x=NAME", []),
            ("positions and forces in turns", text([r for row in base for r in (row[:6] + [""], row[:3] + ["", "", "", row[6]])]), "too few samples", []),
            ("a slide without times", text([row[1:] for row in slide()], SLIDE[4:]), "a slide needs times", []),
            ("bytes", b"\x00\x01\x02", "NUL", []),
        ]
        for name, content, count, says, options in good:
            with self.subTest(name):
                self.good(content, count, *options, says=says)
        for name, content, says, options in bad:
            with self.subTest(name):
                self.refused(content, says, *options)
        self.assertGreaterEqual(len(good) + len(bad), 40)

    def test_dirty_slides(self):
        base = slide()
        half = len(base) // 2
        later = [[f"{float(row[0]) + 7.3:.4f}"] + row[1:] for row in base[half:]]
        for name, rows, least, says in [
            ("a gap in time", base[:half] + later, 18, "1 gap in time"),
            ("swapped rows", base[:100] + [base[101], base[100]] + base[102:], 20, "out of order"),
            ("holes", [row if i % 50 else row[:4] + ["nan"] for i, row in enumerate(base)], 20, ""),
            ("a stretch in the air", [row if i < half else row[:4] + [f"{random.Random(i).gauss(0, 0.01):.4f}"] for i, row in enumerate(base)], 9, "no contact"),
            ("repeated stamps", [row if i % 40 else [base[i - 1][0]] + row[1:] for i, row in enumerate(base) if i], 19, "stamps repeat"),
        ]:
            with self.subTest(name):
                result, rows = self.run_on(text(rows, SLIDE))
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertGreaterEqual(len(rows), least)
                self.assertIn(says, result.stdout)
                for row in rows:
                    self.assertAlmostEqual(float(row["reading"]), STIFFNESS, delta=0.02)

    def test_usage_is_refused_with_its_words(self):
        content = text(log())
        self.refused(content, "needs --radius-mm", "--model", "hertz", code=2)
        self.refused(content, "is of a slide", "--frequency-hz", 2, code=2)
        self.refused(content, "is no role", "--column", "druck=force_N", code=2)
        self.refused(content, "no unit that is known", "--unit", "force=stone", code=2)
        self.refused(content, "ROLE=NAME", "--column", "force", code=2)
        path = self.folder / "log.csv"
        result = palpate("readings", path, "--out", path)
        self.assertEqual((result.returncode, path.read_text()), (2, content))

    # Real logs against a plain script.

    def plain(self, name):
        try:
            import numpy
        except ImportError:
            self.skip("numpy is not installed")
        path = REAL / name
        if not path.exists():
            self.skip(f"{path} is absent")
        return numpy, numpy.genfromtxt(path, delimiter=",", names=True), path

    def test_real_probings_have_the_slopes_of_a_plain_script(self):
        for name in ["probing_ridge.csv", "probing_small_balls.csv", "probing_pig_liver.csv"]:
            np, d, path = self.plain(name)
            force = np.c_[d["fx_n"], d["fy_n"], d["fz_n"]]
            place = np.c_[d["x_mm"], d["y_mm"], d["z_mm"]]
            normal = np.c_[d["normal_x"], d["normal_y"], d["normal_z"]]
            rows = {row["probing"]: row for row in self.run_on(path.read_text())[1]}
            used = 0
            for probe in np.unique(d["probe"]):
                row = rows.get(str(int(probe)))
                if row is None or row["kind"] == "missed":
                    continue
                at = d["probe"] == probe
                along, depth = np.sum(force[at] * normal[at], 1), -np.sum(place[at] * normal[at], 1)
                slope = np.polyfit(depth, along, 1)[0]
                self.assertAlmostEqual(float(row["reading"]) / slope, 1.0, delta=0.02, msg=f"{name}, {probe}")
                used += 1
            self.assertGreaterEqual(used, 0.98 * len(np.unique(d["probe"])))

    def test_real_logs_become_a_boundary_in_three_commands(self):
        scene = self.write("tissue.json", '{"surface": {"mesh": "tissue.ply", "unit": "mm"}, "field": {"metric": "ambient"}}')
        readings, mesh = self.folder / "readings.csv", self.folder / "tissue.ply"
        for name in ["probing_ridge.csv", "probing_small_balls.csv", "probing_pig_liver.csv", "continuous_ridge.csv"]:
            if SANITIZED and name == "probing_ridge.csv":
                continue  # the same code as of the others, for 872 readings
            if not (REAL / name).exists():
                self.skip(f"{REAL / name} is absent")
            with self.subTest(name):
                self.done("readings", REAL / name, "--out", readings, "--overwrite")
                told = self.done("mesh", "surface", "--points", readings, "--gap", 8, mesh, "--overwrite")
                self.assertIn("No holes", told)
                self.assertIn("of these readings", told)
                # Outlines of 872 readings take two minutes, and so do those of four parts on liver.
                briefly = BRIEFLY if SANITIZED or name in ("probing_ridge.csv", "probing_pig_liver.csv") else []
                self.done("boundary", scene, "--measurements", readings, "--out", self.folder / name, *briefly, timeout=3 * PATIENCE_S)
                summary = json.loads((self.folder / name / "summary.json").read_text())
                # The ridge is 59 x 15 mm and both ways of touching it find it; the ball of 5 mm and the liver are only to be answered.
                if "ridge" in name:
                    (part,) = summary["parts"]
                    self.assertAlmostEqual(max(part["extent_mm"]), 59, delta=8)

    def test_a_slide_as_points_is_told_to_be_no_tissue(self):
        points = "x_mm,y_mm,z_mm,fx_n,fy_n,fz_n\n" + "".join(
            f"{x},{y},{math.sin(3 * x + y) * 0.01},0,0,1\n" for x in range(0, 40, 2) for y in range(0, 40, 2) if (x - 20) ** 2 + (y - 20) ** 2 > 100)
        told = self.done("mesh", "surface", "--points", self.write("ring.csv", points), self.folder / "ring.ply")
        self.assertIn("no boundary can be drawn on all of it", told)

    def test_a_real_slide_has_the_slope_of_a_plain_script(self):
        np, d, path = self.plain("continuous_ridge.csv")
        t, force, place = d["t_s"], np.c_[d["fx_n"], d["fy_n"], d["fz_n"]], np.c_[d["x_mm"], d["y_mm"], d["z_mm"]]
        rows = self.run_on(path.read_text())[1]
        self.assertGreaterEqual(len(rows), 190)
        ratios = []
        for row in rows:
            at = np.abs(t - float(row["t"])) <= 1.0
            when = t[at] - float(row["t"])
            band = np.c_[np.cos(4 * np.pi * when), np.sin(4 * np.pi * when)]
            basis = np.c_[np.vander(when, 4), band]
            waves = [band @ np.linalg.lstsq(basis, values[at], rcond=None)[0][4:] for values in (force, place)]
            axis = np.array([float(row["nx"]), float(row["ny"]), float(row["nz"])])
            f, x = waves[0] @ axis, waves[1] @ axis
            ratios.append(float(row["reading"]) / abs(f @ x / (x @ x)))
        ratios = np.array(ratios)
        self.assertLess(abs(np.median(ratios) - 1.0), 0.002)
        self.assertGreater(np.mean(np.abs(ratios - 1.0) < 0.02), 0.95)


if __name__ == "__main__":
    main_without_pictures(own_arguments=2)
