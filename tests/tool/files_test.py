#!/usr/bin/env python3
"""Nothing is destroyed: whatever lies in a folder, whoever writes there, and however a run ends, a person's files stay as they are,
and a folder holds one run.

usage: files_test.py PALPATE [Files.test_...]        needs Python 3 and nothing else
"""

import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import time

from support import main_without_pictures, PALPATE, PATIENCE_S, rows_of, SMALL, WithSmallScene

LONG = ("--set", "surface.plane.vertices=[60,60]", "--set", "plan.batches=10000", "--set", "plan.acquisition=random")
SIMULATED = {"run.json", "summary.json", "report.html", "timings.json", "trace.csv", "measurements.csv", "waypoints.csv", "path.csv", "boundary.wkt", "boundary.vtp",
             "surface.vtp", "steps.pvd", "steps", "steps/step_000.vtp", "steps/step_001.vtp", "steps/step_002.vtp"}
PLANNED = {"run.json", "summary.json", "timings.json", "trace.csv", "readings_used.csv", "waypoints.csv", "path.csv", "boundary.wkt", "boundary.vtp", "surface.vtp"}
BOUNDED = PLANNED - {"waypoints.csv", "path.csv"} | {"report.html"}
MINE = "what a person wrote\n"


def names_in(folder):
    return {str(path.relative_to(folder)) for path in folder.rglob("*")}


def tree(folder):
    """Everything below, by its bytes; of links, where they lead."""
    return {str(path.relative_to(folder)): os.readlink(path) if path.is_symlink() else path.read_bytes() if path.is_file() else None
            for path in sorted(folder.rglob("*"))}


def state_of(folder):
    return json.loads((folder / "run.json").read_text())["state"]


class Files(WithSmallScene):
    readings = "x,y,z,reading,operator\n0.01,0.01,0,9,anna\n0.002,0.003,0,7,\n0.016,0.004,0,7.1,\"B, C\"\n"

    def setUp(self):
        super().setUp()
        self.out = self.folder / "out"

    def refused(self, code, *arguments, says):
        """And nothing is other than before."""
        before = tree(self.folder)
        self.ends(code, *arguments, says=says)
        after = tree(self.folder)
        self.assertEqual(after, before, arguments)

    def started(self, *arguments, program=None, until="steps/step_002.vtp", **options):
        """A run that goes on, when it has come so far."""
        options = {"stdin": subprocess.DEVNULL, "stdout": subprocess.DEVNULL, "stderr": subprocess.PIPE} | options
        run = subprocess.Popen([program or PALPATE, *map(str, arguments)], **options)
        self.addCleanup(run.stderr.close)
        self.addCleanup(run.wait)
        self.addCleanup(run.kill)
        self.wait_for(lambda: (self.out / until).exists() or run.poll() is not None)
        self.assertIsNone(run.poll(), "it has ended already")
        return run

    def wait_for(self, what):
        deadline = time.monotonic() + PATIENCE_S
        while not what() and time.monotonic() < deadline:
            time.sleep(0.01)
        self.assertTrue(what(), "waited in vain")

    def plan(self, *more):
        return ("plan", self.scene, "--measurements", self.measured, "--out", self.out, *more)

    # No input is an output

    def test_no_input_is_ever_an_output(self):
        self.out.mkdir()
        simulated = ("simulate", self.scene, "--out", self.out)
        for name in ("summary.json", "timings.json"):
            scene = self.write(f"out/{name}", json.dumps(SMALL))
            self.refused(3, "simulate", scene, "--out", self.out, says=(name, "was read in this run"))
            scene.unlink()
        mesh = self.out / "surface.vtp"
        self.ends(0, "mesh", "plane", "--size-mm", 20, 20, "--vertices", 12, 12, self.folder / "plane.ply")
        shutil.copy(self.folder / "plane.ply", mesh)
        scene = self.write("on_mesh.json", json.dumps(SMALL | {"surface": {"mesh": "out/surface.vtp", "unit": "mm"}}))
        self.refused(3, "simulate", scene, "--out", self.out, says=("surface.vtp", "was read in this run"))
        mesh.unlink()
        for name in ("readings_used.csv", "waypoints.csv", "trace.csv"):
            measured = self.write(f"out/{name}", self.readings)
            for command in ("plan", "boundary"):
                self.refused(3, command, self.scene, "--measurements", measured, "--out", self.out, says=(name, "was read in this run"))
            measured.unlink()
        rows = "".join(f"{0.001 * i},{0.001 * j},{i}\n" for i in range(0, 21, 2) for j in range(0, 21, 2))
        recording = self.write("out/measurements.csv", "x,y,reading\n" + rows)
        self.refused(3, "replay", self.scene, "--recording", recording, "--out", self.out, says=("measurements.csv", "was read in this run"))
        recording.unlink()
        boundary = self.write("out/boundary.wkt", self.square.read_text())
        self.refused(3, "compare", self.scene, boundary, self.square, "--out", self.out, says=("boundary.wkt", "was read in this run"))
        boundary.unlink()
        self.ends(0, *simulated)

    def test_an_input_of_another_name_is_known_by_its_inode(self):
        self.out.mkdir()
        os.link(self.measured, self.out / "readings_used.csv")
        self.refused(3, *self.plan(), says=("readings_used.csv", "was read in this run"))
        (self.out / "readings_used.csv").unlink()
        (self.out / "trace.csv").write_text(self.readings)
        through = self.folder / "through.csv"
        through.symlink_to(self.out / "trace.csv")
        self.refused(3, "plan", self.scene, "--measurements", through, "--out", self.out, says=("trace.csv", "was read in this run"))

    def test_meshes_and_tables_replace_nothing_unasked(self):
        mesh = self.folder / "plane.ply"
        small, large = (("mesh", "plane", "--size-mm", 20, 20, "--vertices", n, n, mesh) for n in (5, 6))
        self.ends(0, *small)
        self.ends(0, *small)  # the same again is no loss
        self.refused(3, *large, says=("plane.ply", "is there already", "--overwrite"))
        self.ends(0, *large, "--overwrite")
        recording = self.write("r.ply", "x,y,reading\n0,0,1\n0.01,0,2\n0,0.01,3\n")
        self.refused(3, "mesh", "plane", "--around", recording, recording, "--overwrite", says="was read in this run")
        log = self.write("log.csv", "probe,t_s,x_mm,y_mm,z_mm,force_N\n" + "".join(f"{p},{p + 0.1 * i},{3 * p},0,{-0.25 * i},{0.1 * i + 0.001 * (i % 3)}\n" for p in range(3) for i in range(12)))
        readings = ("readings", log, "--out", self.measured)
        self.refused(3, *readings, says=("measured.csv", "is there already", "--overwrite"))
        for _ in range(2):
            self.ends(0, *readings, "--overwrite")
        self.ends(0, *readings)
        link = self.folder / "link.ply"
        link.symlink_to(mesh)
        self.refused(4, "mesh", "plane", link, "--overwrite", says=("link.ply", "is a link"))
        table = self.write("tables/table1.csv", MINE)
        experiment = ("experiment", "table1", "--only", "noise 5 %", "--only", "disk", "--only", "evr", "--trials", 1, "--set", "surface.plane.vertices=[13,25]",
                      "--set", "plan.batches=1", "--quiet", "--out", table.parent)
        self.refused(3, *experiment, says=("table1.csv", "is there already", "--overwrite"))
        self.ends(0, *experiment, "--overwrite")
        self.assertIn("evr", table.read_text())

    # What lies in the folder already

    def test_a_persons_file_of_an_outputs_name_is_refused_and_stays(self):
        for name in sorted(SIMULATED - {"steps"}):
            self.write(f"out/{name}", MINE)
            for more in ((), ("--overwrite",)):
                self.refused(3, "simulate", self.scene, "--out", self.out, *more, says=(name.split("/")[-1], "would be replaced"))
            shutil.rmtree(self.out)
        self.write("out/measurements.csv", MINE)
        self.write("out/steps/step_000.vtp", MINE)
        self.write("out/notes.txt", MINE)
        self.ends(0, *self.plan())
        self.assertEqual(names_in(self.out), PLANNED | {"measurements.csv", "notes.txt", "steps", "steps/step_000.vtp"})
        for name in ("measurements.csv", "notes.txt", "steps/step_000.vtp"):
            self.assertEqual((self.out / name).read_text(), MINE)

    def test_a_file_that_was_changed_is_a_persons(self):
        run = ("simulate", self.scene, "--out", self.out)
        self.ends(0, *run)
        for name in sorted(SIMULATED - {"steps", "run.json"}):
            whole = (self.out / name).read_bytes()
            (self.out / name).write_bytes(whole + b"mine\n")
            self.refused(3, *run, "--overwrite", says=(name, "is not as palpate wrote it"))
            (self.out / name).write_bytes(whole)
        self.ends(0, *run)

    def test_what_a_first_version_left_is_not_known_to_be_ours(self):
        self.ends(0, "simulate", self.scene, "--out", self.out)
        (self.out / "run.json").unlink()  # which first versions did not write
        self.refused(3, "simulate", self.scene, "--out", self.out, "--overwrite", says="is not as palpate wrote it")

    def test_another_files_in_steps_stay(self):
        self.write("out/steps/step_notes.txt", MINE)
        self.write("out/steps/step_mine.vtp", MINE)
        for seed in (1, 2):
            self.ends(0, "simulate", self.scene, "--out", self.out, "--overwrite", "--seed", seed)
        self.assertEqual(names_in(self.out), SIMULATED | {"steps/step_notes.txt", "steps/step_mine.vtp"})
        self.ends(0, *self.plan("--overwrite"))
        for name in ("steps/step_notes.txt", "steps/step_mine.vtp"):
            self.assertEqual((self.out / name).read_text(), MINE)

    def test_plan_and_boundary_leave_measurements_alone_where_they_lie_in_the_folder(self):
        measured = self.write("out/measurements.csv", self.readings)
        for command, names in (("plan", PLANNED), ("boundary", BOUNDED)):
            self.ends(0, command, self.scene, "--measurements", measured, "--out", self.out, "--overwrite")
            self.assertEqual(measured.read_text(), self.readings)
            self.assertEqual(names_in(self.out), names | {"measurements.csv"})
            used = (self.out / "readings_used.csv").read_text().splitlines()
            self.assertEqual(used[0], "x,y,z,reading,noise_variance,batch,kind,tx,ty,tz,set_aside,operator")
            self.assertEqual([row.split(",", 11)[-1] for row in used[1:]], ["anna", "", '"B, C"'])
            self.ends(0, "boundary", self.scene, "--measurements", self.out / "readings_used.csv")

    def test_rows_that_are_appended_while_a_plan_is_made_stay(self):
        measured = self.write("out/measurements.csv", self.readings)
        for row in range(8):
            run = subprocess.Popen([PALPATE, "plan", self.scene, "--measurements", measured, "--out", self.out, "--quiet"], stdin=subprocess.DEVNULL, stderr=subprocess.PIPE)
            for step in range(5):
                with open(measured, "a") as file:
                    file.write(f"0.00{row + 1},0.0{step + 1}2,0,7.{row}{step},\n"[:80] if step < 1 else f"0.00{row + 1},0.00{step + 2},0,7.{row}{step},\n")
                time.sleep(0.01)
            words = run.communicate(timeout=PATIENCE_S)[1].decode()
            self.assertEqual(run.returncode, 0, words)  # a growing file is the same run: --overwrite is not asked for
        self.assertEqual(len(measured.read_text().splitlines()), 1 + 3 + 40)

    # Another run, and the same again

    def test_the_same_run_again_needs_no_leave_and_another_does(self):
        run = ("simulate", self.scene, "--out", self.out)
        self.ends(0, *run)
        first = tree(self.out)
        self.ends(0, *run)
        again = tree(self.out)
        again["timings.json"] = first["timings.json"]
        self.assertEqual(again, first)
        for other in ((*run, "--seed", 2), (*run, "--set", "plan.batches=1"), self.plan(), ("compare", self.scene, self.square, self.square, "--out", self.out)):
            self.refused(3, *other, says=("holds a run of palpate simulate (complete)", "--overwrite"))
        self.ends(0, *run, "--seed", 2, "--overwrite")
        self.assertEqual(json.loads((self.out / "summary.json").read_text())["seed"], 2)
        self.assertEqual(names_in(self.out), SIMULATED)

    def test_what_is_overwritten_leaves_nothing_but_what_was_measured(self):
        self.ends(0, "simulate", self.scene, "--out", self.out)
        measured = (self.out / "measurements.csv").read_bytes()
        self.ends(0, *self.plan("--overwrite"))
        self.assertEqual(names_in(self.out), PLANNED | {"measurements.csv"})
        self.ends(0, "boundary", self.scene, "--measurements", self.out / "measurements.csv", "--out", self.out, "--overwrite")
        self.assertEqual(names_in(self.out), BOUNDED | {"measurements.csv"})
        self.assertEqual((self.out / "measurements.csv").read_bytes(), measured)
        self.ends(0, "simulate", self.scene, "--out", self.out, "--overwrite")
        self.assertEqual(names_in(self.out), SIMULATED)

    def test_a_record_that_was_tampered_with_gives_away_no_file(self):
        victim = self.write("victim.txt", MINE)
        self.ends(0, "simulate", self.scene, "--out", self.out)
        record = json.loads((self.out / "run.json").read_text())
        print_of_mine = 0xcbf29ce484222325
        for byte in MINE.encode():
            print_of_mine = ((print_of_mine ^ byte) * 0x100000001b3) & 0xffffffffffffffff
        for name in ("../victim.txt", "steps/../../victim.txt", "notes.txt", "steps/notes.txt"):
            record["files"][name] = f"{print_of_mine:016x}"
        self.write("out/notes.txt", MINE)
        self.write("out/steps/notes.txt", MINE)
        (self.out / "run.json").write_text(json.dumps(record))
        self.ends(0, *self.plan("--overwrite"))
        for path in (victim, self.out / "notes.txt", self.out / "steps" / "notes.txt"):
            self.assertEqual(path.read_text(), MINE)

    # Links

    def test_nothing_is_written_or_deleted_through_a_link(self):
        elsewhere = self.folder / "elsewhere"
        elsewhere.mkdir()
        self.write("elsewhere/step_000.vtp", MINE)
        target = self.write("elsewhere/target", MINE)
        self.out.mkdir()
        for name in sorted(SIMULATED - {name for name in SIMULATED if "/" in name}) + [".palpate-lock", ".palpate-partial"]:
            link = self.out / name
            link.symlink_to(elsewhere if name in ("steps", ".palpate-partial") else target)
            self.refused(4 if name.startswith(".") else 3, "simulate", self.scene, "--out", self.out, "--overwrite", says=str(link))
            link.unlink()
            link.symlink_to(elsewhere / "gone")
            self.refused(4 if name.startswith(".") else 3, "simulate", self.scene, "--out", self.out, says=str(link))
            link.unlink()
        self.ends(0, "simulate", self.scene, "--out", self.out)
        steps = self.out / "steps"
        steps.rename(elsewhere / "kept")  # with ours in it
        steps.symlink_to(elsewhere / "kept")
        kept = tree(elsewhere)
        self.ends(3, "simulate", self.scene, "--out", self.out, "--overwrite", says="steps: is a link")
        self.ends(0, *self.plan("--overwrite"))
        self.assertEqual(tree(elsewhere), kept)

    def test_a_folder_may_be_named_through_a_link(self):
        self.out.mkdir()
        link = self.folder / "link"
        link.symlink_to(self.out)
        for _ in range(2):
            self.ends(0, "simulate", self.scene, "--out", link)
        self.assertEqual(names_in(self.out), SIMULATED)
        self.assertTrue(link.is_symlink())

    # One writer

    def test_a_second_writer_is_told_who_is_the_first(self):
        run = self.started("simulate", self.scene, "--out", self.out, *LONG)
        for command in (("simulate", self.scene), ("plan", self.scene, "--measurements", self.measured), ("experiment", "figure4", "--trials", 1)):
            self.ends(4, *command, "--out", self.out, says=(f"palpate simulate (process {run.pid} on {os.uname().nodename}, since 2", "is writing there"))
        self.assertIn(f"process {run.pid} ", (self.out / ".palpate-lock").read_text())
        run.send_signal(signal.SIGTERM)
        self.assertEqual(run.wait(PATIENCE_S), 130)
        self.assertFalse((self.out / ".palpate-lock").exists())
        self.write("out/.palpate-lock", MINE)
        self.refused(4, "simulate", self.scene, "--out", self.out, says="is no lock of palpate's")

    # However it ends

    def test_a_run_that_is_killed_leaves_nothing_to_the_next_one(self):
        run = self.started("simulate", self.scene, "--out", self.out, *LONG)
        run.kill()
        run.wait()
        self.assertEqual(state_of(self.out), "in progress")
        self.write("out/.palpate-partial/steps/step_009.partial-1-1.vtp", "half")  # as a write that was cut off leaves
        self.write("out/.palpate-partial/surface.vtp", "whole, but not landed")
        self.ends(3, *self.plan(), says="holds a run of palpate simulate (in progress)")
        self.ends(0, "simulate", self.scene, "--out", self.out, "--overwrite")
        self.assertEqual(names_in(self.out), SIMULATED)
        self.write("out/.palpate-partial/thesis.txt", MINE)
        self.ends(4, "simulate", self.scene, "--out", self.out, says=("thesis.txt", "is none of palpate's"))
        self.assertEqual((self.out / ".palpate-partial" / "thesis.txt").read_text(), MINE)

    def test_what_was_measured_lands_with_each_step_and_is_replaced_by_the_next_run(self):
        for _ in range(2):  # the second one over what the first one left: its steps land one by one as well
            run = self.started("simulate", self.scene, "--out", self.out, "--overwrite", *LONG)
            steps = len(list((self.out / "steps").iterdir()))
            batches = {row["batch"] for row in rows_of(self.out / "measurements.csv")}
            run.kill()
            run.wait()
            self.assertGreaterEqual(steps, 3)
            self.assertGreaterEqual(len(batches), 2, batches)
            record = json.loads((self.out / "run.json").read_text())
            self.assertEqual(record["begun"]["scene"], str(self.scene))
            self.assertEqual(record["begun"]["options"]["plan"]["batches"], 10000)
        self.ends(0, "simulate", self.scene, "--out", self.out, "--overwrite")
        self.assertEqual(names_in(self.out), SIMULATED)
        self.assertNotIn("begun", json.loads((self.out / "run.json").read_text()))  # the summary says it

    def test_what_a_run_that_ended_measured_is_kept_until_the_next_one_is_whole(self):
        self.ends(0, "simulate", self.scene, "--out", self.out)
        for path in list(self.out.iterdir()):
            if path.name not in ("run.json", "measurements.csv"):
                shutil.rmtree(path) if path.is_dir() else path.unlink()
        felt = (self.out / "measurements.csv").read_bytes()
        run = self.started("simulate", self.scene, "--out", self.out, "--overwrite", *LONG, until=".palpate-partial/steps/step_001.vtp")
        run.kill()
        run.wait()
        self.assertEqual((self.out / "measurements.csv").read_bytes(), felt)

    def test_what_is_refused_or_fails_before_there_is_anything_leaves_an_empty_folder(self):
        self.ends(3, "simulate", self.scene, "--out", self.out, "--set", "plan.explore_mm=3", "--set", "plan.batch=500")
        self.assertEqual(names_in(self.out), set())
        self.ends(0, *self.plan())
        before = tree(self.out)
        self.ends(3, "simulate", self.scene, "--out", self.out, "--overwrite", "--set", "plan.explore_mm=3", "--set", "plan.batch=500")
        self.assertEqual(tree(self.out), before)

    def test_signals_end_a_run_alike_with_words_and_its_folder_says_so(self):
        for number, name in ((signal.SIGINT, "SIGINT (Ctrl-C)"), (signal.SIGTERM, "SIGTERM"), (signal.SIGHUP, "SIGHUP")):
            run = self.started("simulate", self.scene, "--out", self.out, *LONG)
            run.send_signal(number)
            sent = time.monotonic()
            words = run.communicate(timeout=PATIENCE_S)[1].decode()
            self.assertEqual(run.returncode, 130, words)
            self.assertIn(f"palpate: interrupted by {name}", words)
            self.assertEqual(state_of(self.out), "interrupted")
            # A run that is deaf for two seconds is ended as it stands, with what it had begun.
            begun = {".palpate-partial", ".palpate-lock"} if time.monotonic() - sent >= 2 else set()
            self.assertEqual({name for name in names_in(self.out) if "step" not in name} - begun, {"run.json", "measurements.csv"})
            for path in (self.out / "steps").iterdir():
                self.assertRegex(path.name, r"^step_\d{3}\.vtp$")
            listed = re.findall(r'file="steps/(.*?)"', (self.out / "steps.pvd").read_text())
            there = sorted(path.name for path in (self.out / "steps").iterdir())
            self.assertIn(listed, (there, there[:-1]), "the list grows as the run goes")
            felt = (self.out / "measurements.csv").read_bytes()
            self.ends(0, *self.plan(), "--overwrite")  # what an interrupted run left is replaced, but what was measured
            self.assertEqual(names_in(self.out), PLANNED | {"measurements.csv"})
            self.assertEqual((self.out / "measurements.csv").read_bytes(), felt)
            shutil.rmtree(self.out)

    def test_long_arithmetic_is_ended_too(self):
        # Learning on many places does not look up for minutes.
        rows = "".join(f"{0.0001 * i},{0.0001 * j},0,{7 + 0.001 * ((i * 7 + j * 13) % 100)}\n" for i in range(1, 199, 3) for j in range(1, 199, 3))
        measured = self.write("many.csv", "x,y,z,reading\n" + rows)
        run = self.started("boundary", self.scene, "--measurements", measured, "--out", self.out, "--threads", "1", until="run.json")
        run.send_signal(signal.SIGTERM)
        words = run.communicate(timeout=PATIENCE_S)[1].decode()
        self.assertEqual((run.returncode, "interrupted by SIGTERM" in words), (130, True), words)
        self.assertEqual(state_of(self.out), "interrupted")
        self.ends(0, *self.plan())  # there was nothing there to be lost
        self.assertEqual(names_in(self.out), PLANNED)

    def test_a_hang_up_that_is_ignored_stays_so(self):
        run = self.started("simulate", self.scene, "--out", self.out, *LONG, preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
        run.send_signal(signal.SIGHUP)
        time.sleep(0.3)
        self.assertIsNone(run.poll())

    def test_until_a_new_run_is_whole_the_earlier_one_stays(self):
        self.ends(0, "simulate", self.scene, "--out", self.out)
        before = tree(self.out)
        for end in (signal.SIGTERM, signal.SIGKILL):
            run = self.started("simulate", self.scene, "--out", self.out, "--overwrite", *LONG, until=".palpate-partial/steps/step_001.vtp")
            run.send_signal(end)
            run.wait(PATIENCE_S)
            now = {name: content for name, content in tree(self.out).items() if not name.startswith(".palpate")}
            self.assertEqual(now, before)
        self.ends(0, "simulate", self.scene, "--out", self.out)
        self.assertEqual(names_in(self.out), SIMULATED)

    def test_what_a_person_puts_there_in_the_meantime_stays_and_so_does_the_result(self):
        # A quiet moment: the program that draws, which comes before the landing.
        program = self.with_drawing("sleep 1")
        run = self.started("simulate", self.scene, "--out", self.out, program=program, until=".palpate-partial/summary.json")
        self.write("out/waypoints.csv", MINE)
        words = run.communicate(timeout=PATIENCE_S)[1].decode()
        self.assertEqual(run.returncode, 4, words)
        self.assertIn("waypoints.csv: is not as palpate wrote it", words)
        self.assertIn(f"what was computed is in {self.out}/.palpate-partial", words)
        self.assertEqual((self.out / "waypoints.csv").read_text(), MINE)
        self.assertTrue((self.out / ".palpate-partial" / "summary.json").exists())

    def test_a_step_that_a_person_puts_there_in_the_meantime_stays(self):
        run = self.started("simulate", self.scene, "--out", self.out, *LONG)
        self.write("out/steps/step_5000.vtp", MINE)
        (self.out / "steps").rename(self.folder / "moved")
        (self.out / "steps").symlink_to(self.folder / "moved")
        words = run.communicate(timeout=PATIENCE_S)[1].decode()
        self.assertEqual((run.returncode, "steps: is a link" in words), (3, True), words)
        self.assertEqual((self.folder / "moved" / "step_5000.vtp").read_text(), MINE)
        self.assertEqual(state_of(self.out), "failed")

    # The program that draws

    def with_drawing(self, body):
        """A copy of the tool, with a program beside it that does this in place of drawing."""
        program = shutil.copy(PALPATE, self.folder)
        drawing = self.write("palpate-draw", f"#!/bin/sh\necho $$ > {self.folder}/drawing.pid\n{body}\n")
        drawing.chmod(0o755)
        return program

    def drawing(self):
        return int((self.folder / "drawing.pid").read_text())

    def is_running(self, process):
        try:
            return pathlib.Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()[0] != "Z"
        except FileNotFoundError:
            return False

    def test_the_drawing_dies_with_its_parent(self):
        program = self.with_drawing("exec sleep 100")
        run = self.started("simulate", self.scene, "--out", self.out, program=program, until="../drawing.pid")
        self.wait_for(lambda: (self.folder / "drawing.pid").read_text().endswith("\n"))
        run.kill()
        run.wait()
        self.wait_for(lambda: not self.is_running(self.drawing()))
        self.ends(0, "simulate", self.scene, "--out", self.out)
        self.assertEqual(names_in(self.out), SIMULATED)

    def test_an_interrupt_while_it_is_drawn_keeps_what_was_computed(self):
        program = self.with_drawing("exec sleep 100")
        run = self.started("simulate", self.scene, "--out", self.out, program=program, until="../drawing.pid")
        run.send_signal(signal.SIGTERM)
        words = run.communicate(timeout=PATIENCE_S)[1].decode()
        self.assertEqual(run.returncode, 130, words)
        self.assertIn("no picture: interrupted", words)
        self.assertFalse(self.is_running(self.drawing()))
        self.assertEqual((names_in(self.out), state_of(self.out)), (SIMULATED, "complete"))

    def test_a_picture_that_fails_leaves_the_rest(self):
        for body, words in (("exit 1", "palpate-draw failed"), ("echo no light >&2; exit 4", "no light"), ("kill -SEGV $$", "signal 11")):
            program = self.with_drawing(body)
            self.ends(0, "simulate", self.scene, "--out", self.out, program=program, says=("no picture", words))
            self.assertEqual(names_in(self.out), SIMULATED)

    def test_a_picture_lands_with_the_rest(self):
        program = self.with_drawing('echo pixels > "$1/picture.png"')
        self.ends(0, "simulate", self.scene, "--out", self.out, program=program)
        self.assertEqual(names_in(self.out), SIMULATED | {"picture.png"})
        self.ends(0, "simulate", self.scene, "--out", self.out)  # a picture of another run would not do
        self.assertEqual(names_in(self.out), SIMULATED)

    # What is given

    def test_what_can_be_no_folder_is_said_to_be_none(self):
        (self.folder / "nowhere").symlink_to(self.folder / "gone")
        for out, words in ((self.scene, "scene.json: cannot make this folder"), (self.measured, "cannot make this folder"), (self.measured / "below", "cannot make this folder"),
                           ("/dev/null", "/dev/null: cannot make this folder"), (self.folder / "nowhere", "a link of that name, which leads nowhere")):
            self.refused(4, "plan", self.scene, "--measurements", self.measured, "--out", out, says=words)

    def test_a_persons_other_name_for_a_result_keeps_its_bytes(self):
        self.ends(0, "simulate", self.scene, "--out", self.out)
        kept = {}
        for name in ("summary.json", "measurements.csv", "steps/step_000.vtp"):
            other = self.folder / f"kept_{pathlib.PurePath(name).name}"
            os.link(self.out / name, other)
            kept[other] = other.read_bytes()
        self.ends(0, "simulate", self.scene, "--out", self.out, "--seed", 5, "--overwrite")
        for other, content in kept.items():
            self.assertEqual(other.read_bytes(), content)
        self.assertNotEqual((self.out / "measurements.csv").read_bytes(), kept[self.folder / "kept_measurements.csv"])

    def test_an_empty_name_is_no_folder(self):
        for command in (("simulate", self.scene), ("experiment", "figure4")):
            self.refused(2, *command, "--out", "", says="--out: is empty, but must name a folder")

    def test_what_was_cut_off_is_refused_by_name(self):
        torn = self.write("torn.csv", "x,y,z,reading\n0.01,0.01,0,9\n0.002,0.003,0,8")
        for command in (("plan", self.scene, "--measurements", torn), ("boundary", self.scene, "--measurements", torn), ("replay", self.scene, "--recording", torn),
                        ("mesh", "plane", "--around", torn, self.folder / "x.ply")):
            self.refused(3, *command, says="torn.csv:3: the last line has no line end")
        with open(torn, "a") as file:
            file.write("\n")  # as the words advise
        self.ends(0, "boundary", self.scene, "--measurements", torn)

    def test_a_nul_ends_no_scene(self):
        text = json.dumps(SMALL)
        (self.folder / "nul.json").write_bytes(text.encode() + b"\n\0{}")
        self.refused(3, "simulate", self.folder / "nul.json", says="nul.json:2:1: not JSON: a NUL byte")
        self.write("nul.json", '{ "surface": { "mesh": "scene.json\\u0000.ply", "unit": "mm" } }')
        self.refused(3, "simulate", self.folder / "nul.json", says="must be a text without control characters")
        self.refused(3, "simulate", self.scene, "--set", 'surface.mesh="a\\u0000b"', says="must be a text without control characters")

    def test_a_mesh_that_calls_another_file_is_refused(self):
        mesh = self.write("a.obj", "v 0 0 0\nv 10 0 0\nv 0 10 0\nf 1 2 3\ncall more.obj\n")
        self.refused(3, "info", mesh, "--unit", "mm", says=("a.obj:5", "runs another file"))


if __name__ == "__main__":
    main_without_pictures()
