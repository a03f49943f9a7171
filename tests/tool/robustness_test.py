#!/usr/bin/env python3
"""The tool where things go wrong: arguments, files that are none, full disks, closed pipes. Exit codes, words, and nothing half-written.

usage: robustness_test.py PALPATE        needs Python 3 and nothing else
"""

import json
import os
import pathlib
import re
import resource
import signal
import subprocess
import time

from support import PALPATE, PATIENCE_S, SANITIZED, SMALL, WithSmallScene, main_without_pictures, palpate


class Robustness(WithSmallScene):
    # Arguments

    def test_wrong_usage_is_told_with_value_and_range(self):
        scene = ("simulate", self.scene)
        cases = [
            ((), "subcommand"),
            (("simulat",), ""),
            (("simulate",), "SCENE is required"),
            ((*scene, self.scene), "not expected"),
            (("boundary", self.scene), "--measurements is required"),
            (("replay", self.scene), "--recording is required"),
            (("compare", self.scene, self.square), "B is required"),
            (("info",), "FILE is required"),
            (("info", self.square), "a mesh needs --unit"),
            (("info", self.square, "--unit", "mm", "--set", "seed=2"), "--set is for a scene"),
            (("info", self.scene, "--unit", "mm"), "a scene has surface.unit"),
            (("info", self.square, "--unit", "km"), "km"),
            (("experiment", "table3"), "table3"),
            (("experiment", "table1", "--only", "disk", "--only", "cube"), "no cell has 'disk' and 'cube' in its name"),
            (("experiment", "coverage", "--only", "noise 25 %"), "table1, table2, curved and study, not of this one"),
            (("help", "cats"), "cats"),
            (("mesh", "sphere", "x.ply"), "sphere"),
            ((*scene, "--treads", 2), "--treads"),
            ((*scene, "--out"), "--out"),
            ((*scene, "--out", "a", "--out", "b"), "--out"),
            ((*scene, "--set"), "--set"),
            (("plan", self.scene, "--measurements", self.measured, "--measurements", self.measured), "--measurements"),
        ]
        for threads in ("0", "-1", "1e9", "1000000000", "1.5", "many", ""):
            cases.append(((*scene, "--threads", threads), "--threads"))
        for seed in ("-1", "1.5", "9007199254740993", "18446744073709551616", "1" * 400, "nan"):
            cases.append(((*scene, "--seed", seed), "--seed: is " + seed))
        for option, values in {"--size-mm": ["-1", "nan", "inf", "1e300", "0"], "--vertices": ["1", "-5", "1000000000", "3.5"]}.items():
            cases += [(("mesh", "plane", option, value, value, "x.ply"), f"{option}: is {value}, but must be a") for value in values]
        for option, values in {"--jitter": ["0.5", "-0.1", "nan"], "--margin-mm": ["-1", "inf"], "--edge-mm": ["0", "nan", "-1"], "--seed": ["-1"]}.items():
            cases += [(("mesh", "plane", option, value, "x.ply"), f"{option}: is {value}, but must be a") for value in values]
        cases.append((("mesh", "plane", "--around", self.measured, "--size-mm", "5", "5", "x.ply"), "excludes"))
        for trials in ("0", "-1", "1e7", "2.5"):
            cases.append((("experiment", "table1", "--trials", trials), "--trials: is " + trials))
        cases.append((("experiment", "table1", "--first-seed", "-1"), "--first-seed: is -1"))
        for arguments, part in cases:
            self.ends(2, *arguments, says=part, cwd=self.folder)

    def test_overrides_are_checked_in_experiments_too(self):
        self.ends(3, "experiment", "table1", "--print-scene", "--set", "plan.bach=1", says="the nearest is plan.batch")
        self.ends(3, "experiment", "table1", "--print-scene", "--set", "plan.batch", says="must have the form KEY=VALUE")
        self.ends(3, "experiment", "table1", "--print-scene", "--set", "plan.batch=many", says='plan.batch: is "many", but must be a number')

    # Files that are none

    def test_what_is_no_file_is_refused_at_once(self):
        fifo = self.folder / "fifo.wkt"
        os.mkfifo(fifo)
        link = self.folder / "loop.csv"
        link.symlink_to(link)
        for bad, words in ((fifo, "is no regular file"), (self.folder, "is a folder"), ("/dev/zero", "is no regular file"), (link, "symbolic links"), (self.folder / "gone", "No such file"), ("x" * 5000, "too long")):
            self.ends(3, "simulate", bad, says=words)
            self.ends(3, "boundary", self.scene, "--measurements", bad, says=words)
            self.ends(3, "plan", self.scene, "--measurements", bad, says=words)
            self.ends(3, "replay", self.scene, "--recording", bad, says=words)
            self.ends(3, "info", bad, "--unit", "mm", says=words)
            self.ends(3, "mesh", "plane", "--around", bad, "x.ply", says=words, cwd=self.folder)
            self.ends(3, "experiment", "figure4", bad, says=words)
        self.ends(3, "compare", self.scene, fifo, self.square, says="is no regular file")
        self.ends(3, "compare", self.scene, self.square, self.folder / "gone.vtp", says="No such file")
        self.ends(3, "compare", self.scene, self.scene, self.square, says="a boundary is a .wkt or a .vtp file")

    def test_boundaries_that_are_none_are_refused_with_their_place(self):
        cases = {
            "": "byte 0: POLYGON or MULTIPOLYGON is expected, not the end of the file",
            "POINT (0 0)": 'not "POINT"',
            "POLYGON ((0 0, nan 0, 0.01 0.01, 0 0))": 'byte 15: "nan" is not finite',
            "POLYGON ((5 5, 15 5, 15 15, 5 5))": "lies more than 5 mm off the tissue: coordinates are metres",
            "POLYGON ((0 0, 0.01 0.01, 0.01 0, 0 0.01, 0 0))": "byte 8: the outer ring must not cross itself",
            "POLYGON " + "(" * 1000000: "byte 10: a number is expected",
        }
        for text, words in cases.items():
            bad = self.write("bad.wkt", text)
            self.ends(3, "compare", self.scene, bad, self.square, says=("bad.wkt", words))
            self.ends(3, "compare", self.scene, self.square, bad, says=("bad.wkt", words))
        broken = self.write("broken.vtp", "<VTKFile type=\"PolyData\">")
        self.ends(3, "compare", self.scene, broken, self.square, says="broken.vtp")

    def test_what_lies_beside_the_tissue_does_not_count_and_is_told(self):
        beside = self.write("beside.wkt", "POLYGON ((-0.004 -0.004, 0.024 -0.004, 0.024 0.024, -0.004 0.024, -0.004 -0.004))")
        out = self.folder / "out"
        self.ends(0, "compare", self.scene, beside, self.square, "--out", out, says="384.00 mm2 of it lie beside the tissue")
        summary = json.loads((out / "summary.json").read_text())
        self.assertAlmostEqual(summary["error"]["extra_mm2"], 300.0, delta=1e-9)  # 20 x 20 - 10 x 10
        self.assertIn("384.00 mm2", summary["warnings"][0])
        self.assertEqual(palpate("compare", self.scene, self.square, self.square).stderr, "")

    def test_recordings_that_are_none_are_named(self):
        line = "".join(f"{0.001 * i},0.01,{i}\n" for i in range(20))
        there = "".join(f"{0.001 * i},{0.001 * j},{i}\n" for i in range(0, 21, 2) for j in range(0, 21, 2))
        far = "".join(f"{1 + 0.001 * i},{0.001 * j},{i}\n" for i in range(5) for j in range(5))
        cases = {
            "": "the file is empty",
            "x,y,reading\n": "no row holds a reading",
            "x,y,reading\n0,0,1\n": "only 1 row holds a reading; a recording has at least three",
            "x,y,reading\n0,0,1\n0.01,0,2\n": "only 2 rows hold a reading",
            "x,y,reading\n" + "0.01,0.01,7\n" * 9: "not all on one line",
            "x,y,reading\n" + line: "not all on one line",
            "x,y,reading\n" + far: "no vertex of the tissue lies within 2 mm of its readings",
            "x,y,reading\n0,0,1\n0,0.01,inf\n": ":3: column reading: \"inf\" must be at most 1e30 in size, or nan where nothing was recorded",
        }
        good = self.write("good.csv", "x,y,reading\n" + there)
        for text, words in cases.items():
            bad = self.write("bad.csv", text)
            self.ends(3, "replay", self.scene, "--recording", bad, says=("bad.csv", words))
            if "no vertex" not in words:
                self.ends(3, "replay", self.scene, "--recording", good, "--recording", bad, says=("bad.csv", words))
        self.ends(0, "replay", self.scene, "--recording", good)
        alike = self.write("alike.csv", "x,y,reading\n" + "".join(row.rsplit(",", 1)[0] + ",7\n" for row in there.splitlines()))
        out = self.folder / "alike"
        self.ends(0, "replay", self.scene, "--recording", alike, "--out", out, says="all its readings are equal")
        summary = json.loads((out / "summary.json").read_text())
        self.assertEqual((summary["parts"], summary["error"]["dice"]), ([], 1.0))

    # Machines at fault

    def test_an_out_that_cannot_be_a_folder_ends_with_4(self):
        for out in (self.scene, self.scene / "below", "/proc/nothing", "/dev/full"):
            for command in (("simulate", self.scene), ("boundary", self.scene, "--measurements", self.measured), ("plan", self.scene, "--measurements", self.measured), ("compare", self.scene, self.square, self.square), ("experiment", "figure4", self.scene, "--trials", 1)):
                self.ends(4, *command, "--out", out, "--quiet", says=(str(out), "cannot make this folder"))
        self.ends(4, "mesh", "plane", self.folder / "gone" / "x.ply", says="cannot write")

    def test_steps_that_cannot_be_a_folder_end_with_4(self):
        out = self.folder / "out"
        out.mkdir()
        (out / "steps").write_text("a file")
        self.ends(4, "simulate", self.scene, "--out", out, says="steps: cannot make this folder")
        self.assertEqual(sorted(path.name for path in out.iterdir()), ["steps"])

    def test_a_disk_that_is_full_ends_with_4_and_leaves_whole_files_only(self):
        good = self.folder / "good"
        self.ends(0, "simulate", self.scene, "--out", good)
        sizes = sorted({path.stat().st_size for path in good.rglob("*") if path.is_file() and path.suffix not in (".png", ".html")})
        out = self.folder / "out"
        for limit in [0, 1] + [size - 1 for size in sizes]:
            def full():
                resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))

            words = self.ends(4, "simulate", self.scene, "--out", out, "--quiet", says=str(out), preexec_fn=full)
            self.assertRegex(words, "(cannot write|not written): ")
            self.assertFalse((out / "summary.json").exists(), "a run that failed has no summary")
            for path in out.rglob("*"):
                if path.name == "steps.pvd":  # as far as the run came
                    listed = re.findall(r'file="(.*?)"', path.read_text())
                    self.assertTrue(listed and all((out / step).exists() for step in listed), listed)
                elif path.name == "measurements.csv":  # as far as the run came, in whole lines
                    measured, all_of_it = path.read_text(), (good / path.name).read_text()
                    self.assertTrue(measured.endswith("\n") and all_of_it.startswith(measured), measured)
                elif path.is_file() and path.name != "run.json":
                    self.assertEqual(path.read_bytes(), (good / path.relative_to(out)).read_bytes(), path)

    def test_too_little_memory_ends_with_4(self):
        if SANITIZED:
            self.skip("AddressSanitizer itself wants more than there is")

        def little():
            resource.setrlimit(resource.RLIMIT_AS, (400 << 20, 400 << 20))

        self.ends(4, "simulate", self.scene, "--set", "surface.plane.vertices=[2000,2000]", "--threads", 1, says="not enough memory", preexec_fn=little)

    def test_words_that_cannot_be_told_end_with_4(self):
        for arguments in (("help", "scene"), ("--version",), ("--help",), ("simulate", self.scene), ("boundary", self.scene, "--measurements", self.measured), ("experiment", "table1", "--print-scene")):
            with open("/dev/full", "w") as full:
                self.ends(4, *arguments, stdout=full, says="cannot write to standard output")
        reader, writer = os.pipe()
        os.close(reader)
        self.ends(4, "help", "scene", stdout=writer, says="cannot write to standard output")
        os.close(writer)
        out = self.folder / "out"
        self.ends(4, "simulate", self.scene, "--out", out, stdout=None, preexec_fn=lambda: os.close(1), says="cannot write to standard output")
        self.assertTrue((out / "summary.json").exists(), "the files are there all the same")
        self.ends(0, "simulate", self.scene, "--out", out, "--quiet", stdout=None, preexec_fn=lambda: (os.close(0), os.close(1), os.close(2)))
        json.loads((out / "summary.json").read_text())

    def test_an_interrupt_ends_with_130_and_leaves_whole_files_only(self):
        out = self.folder / "out"
        long = ("--set", "surface.plane.vertices=[60,60]", "--set", "plan.batches=10000", "--set", "plan.acquisition=random")
        run = subprocess.Popen([PALPATE, "simulate", self.scene, "--out", out, *long], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        deadline = time.monotonic() + PATIENCE_S
        while not (out / "steps" / "step_002.vtp").exists() and time.monotonic() < deadline:
            time.sleep(0.01)
        run.send_signal(signal.SIGINT)
        run.communicate(timeout=PATIENCE_S)
        self.assertEqual(run.returncode, 130)
        self.assertEqual([path.name for path in out.rglob("*") if "partial" in path.name], [])
        self.assertFalse((out / "summary.json").exists())

    # What is odd but sound

    def test_names_may_be_any_bytes(self):
        odd = pathlib.Path(os.fsdecode(os.fsencode(self.folder) + b"/odd \xff\xfe.json"))
        odd.write_text(json.dumps(SMALL))
        out = pathlib.Path(os.fsdecode(os.fsencode(self.folder) + b"/out \xff"))
        self.ends(0, "simulate", odd, "--out", out)
        self.assertIn("odd", json.loads((out / "summary.json").read_text())["scene"])

    def test_warnings_are_in_the_summary_as_on_standard_error(self):
        rows = "".join(f"{0.002 * (i % 8) + 0.001},{0.002 * (i // 8) + 0.001},{0.001 if i == 3 else 0},{7 + 0.01 * (i % 5) if i < 40 else 1e6}\n" for i in range(41))
        measured = self.write("m.csv", "x,y,z,reading\n" + rows)
        out = self.folder / "out"
        for command in ("boundary", "plan"):
            result = palpate(command, self.scene, "--set", "level.value=8", "--measurements", measured, "--out", out, "--overwrite", "--quiet")
            self.assertEqual(result.returncode, 0, result.stderr)
            words = result.stderr
            told = json.loads((out / "summary.json").read_text())["warnings"]
            self.assertEqual([warning for warning in told if warning.startswith("Coarse: ")], ["Coarse: edges up to 2.57 mm exceed what a probe resolves (about 0.5 mm); set surface.refine_mm."] if command == "plan" else [])
            told = [warning for warning in told if not warning.startswith("Coarse: ")]
            about_certainty = ("1 reading set aside (outlier: contradicts the readings around it): 1000000 at (1.0, 11.0, 0.0) mm.", "Nothing found", "Part ", "No place is tumour", "The area expected", "13 % of the tissue lies 8 mm or more from any reading")
            self.assertEqual([warning for warning in told[3:] if not warning.startswith(about_certainty) and "there is no column batch" not in warning], [], told)
            for part, warning in zip(("level.value: has no effect", "1 of 41 positions lay off the surface", "1 reading stands more than 1000 times"), told):
                self.assertIn(part, warning)
                self.assertIn(warning, words)

    def test_a_budget_of_nothing_is_an_empty_plan(self):
        out = self.folder / "out"
        self.ends(0, "simulate", self.scene, "--set", "plan.initial.count=0", "--set", "plan.batches=0", "--out", out)
        summary = json.loads((out / "summary.json").read_text())
        self.assertEqual((summary["measurements"], summary["stop_reason"], summary["parts"]), (0, "budget", []))
        self.assertEqual(len((out / "waypoints.csv").read_text().splitlines()), 1)


if __name__ == "__main__":
    main_without_pictures()
