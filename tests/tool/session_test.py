#!/usr/bin/env python3
"""A session, as a person and a robot use it: the loop is that of simulate, its export answers alike, kill -9 loses nothing, mistakes are told.

usage: session_test.py PALPATE [Session.test_...]        needs Python 3 and nothing else
"""

import json
import random
import signal
import subprocess
import sys
import time
import unittest

from support import PALPATE, PATIENCE_S, InFolder, main_without_pictures, palpate, rows_of

SCENE = {
    "surface": {"plane": {"size_mm": [20, 20], "vertices": [14, 14]}},
    "certainty": "laplace",
    "plan": {"initial": {"count": 9}, "batch": 4, "batches": 3},
    "probe": {"noise": 0.05, "tumours": [{"shape": "disk", "centre_mm": [10, 10, 0], "radius_mm": 4}]},
}


class Session(InFolder):
    def setUp(self):
        super().setUp()
        self.scene = self.write("scene.json", json.dumps(SCENE))
        self.run_folder = self.folder / "run"

    def session(self, *words, code=0):
        return self.ends(code, "session", self.scene, self.run_folder, *words)

    def record(self, rows, columns=("x", "y", "z", "reading")):
        felt = self.folder / "felt.csv"
        lines = [",".join(columns)] + [",".join(str(row[column]) for column in columns) for row in rows]
        felt.write_text("".join(line + "\n" for line in lines), encoding="utf-8")
        return self.session("record", felt)

    def touch(self, plan):
        """A plan's stops, felt in order: 9 in a disk, 7 elsewhere, and a little more with each."""
        rows = rows_of(self.run_folder / f"plan_{plan:03}_waypoints.csv")
        for row in rows:
            inside = (float(row["x"]) - 0.01) ** 2 + (float(row["y"]) - 0.01) ** 2 < 0.004 ** 2
            row["reading"] = (9 if inside else 7) + 0.01 * ((7 * int(row["index"])) % 5)
        return rows

    def test_its_loop_is_that_of_simulate_and_its_export_is_answered_alike(self):
        simulated = self.folder / "simulated"
        self.done("simulate", self.scene, "--out", simulated, "--quiet")
        made = rows_of(simulated / "measurements.csv")
        for batch in range(4):
            self.session("next")
            waypoints = rows_of(self.run_folder / f"plan_{batch:03}_waypoints.csv")
            of_batch = [row for row in made if row["batch"] == str(batch)]
            self.assertEqual([[row[axis] for axis in "xyz"] for row in waypoints], [[row[axis] for axis in "xyz"] for row in of_batch])
            self.assertIn("Nothing is open", self.record(of_batch))
        self.assertIn("nothing more to touch: budget", self.session("next"))

        for plan in range(4):
            self.session("export", "--out", self.folder / f"export{plan}", "--plan", plan)
            exported = self.folder / f"export{plan}"
            self.done("plan", exported / "scene.json", "--measurements", exported / "measurements.csv", "--out", exported / "plan", "--quiet")
            for name in ("waypoints", "path"):
                self.assertEqual((exported / "plan" / f"{name}.csv").read_bytes(), (self.run_folder / f"plan_{plan:03}_{name}.csv").read_bytes(), name)
        self.session("export", "--out", self.folder / "all")
        for name, measurements in (("a", self.folder / "all" / "measurements.csv"), ("b", simulated / "measurements.csv")):
            self.done("boundary", self.folder / "all" / "scene.json", "--measurements", measurements, "--out", self.folder / name, "--quiet")
        for name in ("boundary.wkt", "boundary.vtp", "surface.vtp"):
            self.assertEqual((self.folder / "a" / name).read_bytes(), (self.folder / "b" / name).read_bytes(), name)

    def test_a_persons_hand_is_in_the_next_plan_and_in_the_export(self):
        self.session("next")
        rows = self.touch(0)
        self.assertIn("1 stop is open: 8.", self.record(rows[:-1]))
        self.assertIn("Nothing is open", self.session("skip", "--why", "behind a vessel"))
        self.session("withdraw", 2, 3, "--why", "slipped")
        self.session("touch", "--at-mm", 10, 10, 0)
        self.session("keep-out", "--at-mm", 16, 16, 0, "--radius-mm", 4)
        self.assertIn("from the rows 1,4-9:", self.session("next"))
        stops = rows_of(self.run_folder / "plan_001_waypoints.csv")
        self.assertEqual(len(stops), 5)
        self.assertLess(abs(float(stops[0]["x"]) - 0.010), 0.001)
        for stop in stops:
            self.assertGreater((float(stop["x"]) - 0.016) ** 2 + (float(stop["y"]) - 0.016) ** 2, 0.004 ** 2)
        exported = self.folder / "export"
        self.session("export", "--out", exported, "--plan", 1)
        self.done("plan", exported / "scene.json", "--measurements", exported / "measurements.csv", "--out", exported / "plan", "--quiet")
        self.assertEqual((exported / "plan/waypoints.csv").read_bytes(), (self.run_folder / "plan_001_waypoints.csv").read_bytes())
        shown = self.session("show")
        for words in ("2 withdrawn (2 and 3)", "1 not to be touched (9)", "Keep out: 4.00 mm around (16.00, 16.00, 0.00) mm"):
            self.assertIn(words, shown)

    def test_rows_told_again_are_taken_once(self):
        self.session("next")
        rows = self.touch(0)
        self.assertIn("5 readings taken", self.record(rows[:5]))
        self.assertIn("4 readings taken, 5 known before", self.record(rows))
        self.assertIn("0 readings taken, 9 known before", self.record(rows))

    def test_what_a_file_sets_aside_is_not_taken(self):
        self.session("next")
        rows = [{**row, "set_aside": "", "withdrawn": ""} for row in self.touch(0)]
        rows[1]["set_aside"], rows[4]["withdrawn"], rows[5]["withdrawn"] = "slipped", "yes", "no"
        said = self.record(rows, ("x", "y", "z", "reading", "set_aside", "withdrawn"))
        self.assertIn("7 readings taken, 2 set aside by the file", said)
        self.assertIn("2 stops are open", said)

    def test_readings_in_another_unit_than_the_scenes_are_refused(self):
        self.session("--set", "reading_unit=N/mm", "next")
        felt = self.write("felt.csv", "x,y,z,reading,reading_unit\n0.005,0.005,0,7,kPa\n")
        said = self.session("--set", "reading_unit=N/mm", "record", felt, code=3)
        self.assertIn("is another unit than \"N/mm\", the scene's reading_unit", said)

    def test_a_mistake_is_told_with_its_line_and_nothing_of_its_file_is_taken(self):
        self.session("next")
        rows = self.touch(0)
        journal = self.run_folder / "journal.jsonl"
        before = journal.read_bytes()
        for reading, words in (("nan", "felt.csv:4: column reading"), ("2e30", "felt.csv:4: ")):
            rows[2]["reading"] = reading
            felt = self.folder / "felt.csv"
            felt.write_text("x,y,z,reading\n" + "".join(f"{row['x']},{row['y']},{row['z']},{row['reading']}\n" for row in rows), encoding="utf-8")
            self.assertIn(words, self.session("record", felt, code=3))
            self.assertEqual(journal.read_bytes(), before)
        self.assertIn("stop 99 must be one of the plan's 9", self.session("skip", 99, code=3))
        self.assertIn("row 1 must be one of the session's 0", self.session("withdraw", 1, code=3))
        self.assertIn("off the tissue", self.session("touch", "--at-mm", 10, 10, 90, code=3))
        self.assertIn("has no plan 7", self.session("export", "--out", self.folder / "e", "--plan", 7, code=3))

    def test_what_changed_is_told_and_refused_where_the_plan_would_be_another(self):
        self.session("next")
        self.record(self.touch(0))
        self.session("next")
        told = palpate("session", self.scene, self.run_folder, "next", "--set", "probe.noise=0.1")
        self.assertEqual(told.returncode, 0, told.stderr)
        self.assertIn("probe/noise: 0.05 then, 0.1 now", told.stderr)
        self.assertIn("the plan does not", told.stderr)
        refused = palpate("session", self.scene, self.run_folder, "next", "--set", "plan.batch=3")
        self.assertEqual(refused.returncode, 3)
        self.assertIn("--anyway", refused.stderr)
        anyway = palpate("session", self.scene, self.run_folder, "next", "--set", "plan.batch=3", "--anyway")
        self.assertEqual(anyway.returncode, 0, anyway.stderr)
        self.assertIn("Plan 2, from the rows 1-9", anyway.stdout)

    def test_a_corrupted_journal_is_refused_by_its_line(self):
        self.session("next")
        self.record(self.touch(0))
        journal = self.run_folder / "journal.jsonl"
        lines = journal.read_bytes().splitlines(keepends=True)
        lines[4] = lines[4].replace(b'"off_tissue"', b'"off_tissuf"')
        journal.write_bytes(b"".join(lines))
        for words in (("next",), ("show",)):
            self.assertIn("journal.jsonl:5: this line is corrupted", self.session(*words, code=3))

    def test_kill_9_loses_nothing_that_was_acknowledged(self):
        dice = random.Random(1)
        plans, acknowledged, plan, kills = {}, 0, -1, 0
        while kills < 20:
            if plan < 0:
                words = ("next",)
            else:
                rows = self.touch(plan)
                felt = self.folder / "felt.csv"
                felt.write_text("x,y,z,reading\n" + "".join(f"{row['x']},{row['y']},{row['z']},{row['reading']}\n" for row in rows), encoding="utf-8")
                words = ("record", felt)
            process = subprocess.Popen([PALPATE, "session", self.scene, self.run_folder, *words], stdin=subprocess.DEVNULL,
                                       stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            time.sleep(dice.uniform(0.0, 0.3))
            process.send_signal(signal.SIGKILL)
            said, _ = process.communicate(timeout=PATIENCE_S)
            kills += process.returncode == -signal.SIGKILL
            if words[0] == "record" and "taken" in said:
                acknowledged = sum(len(stops) for stops in plans.values())
            self.session("next")  # whatever became of it, this hands out the plan that is due
            shown = self.session("show")
            plan = int(shown.split("\nPlan ")[1].split(":")[0].split(",")[0])
            taken = int(shown.split(" taken")[0].split(", ")[-1].split()[0])
            self.assertGreaterEqual(taken, acknowledged)
            if "The session is finished" in shown:
                break
            waypoints = (self.run_folder / f"plan_{plan:03}_waypoints.csv").read_text()
            self.assertEqual(plans.setdefault(plan, waypoints.splitlines()[1:]), waypoints.splitlines()[1:])
        self.session("export", "--out", self.folder / "export")
        made = [tuple(row[column] for column in ("x", "y", "z", "reading", "batch")) for row in rows_of(self.folder / "export/measurements.csv")]
        self.assertEqual(len(made), len(set(made)), "a reading was taken twice")


if __name__ == "__main__":
    main_without_pictures()
