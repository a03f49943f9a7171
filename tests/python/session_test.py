#!/usr/bin/env python3
"""Sessions from Python: the bytes of `palpate serve` and `palpate session`, the same next plan after any death, all or nothing of what is recorded.

usage: session_test.py PALPATE PROJECT_ROOT [CLAIM...]     with the package `palpation` on PYTHONPATH
Ends with 77 (ctest: skipped) where numpy is missing.
"""

import csv
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import warnings

try:
    import numpy as np
except ImportError:
    print("skipped: numpy is not installed")
    sys.exit(77)

import palpation as pp

PALPATE = ROOT = None
SCENE = {
    "surface": {"plane": {"size_mm": [20, 20], "vertices": [30, 30]}},
    "plan": {"initial": {"count": 9}, "batch": 4, "batches": 3},
}


def felt_at(positions):
    """9 in a disk, 7 elsewhere, and a little more with each."""
    inside = np.hypot(positions[:, 0] - 0.01, positions[:, 1] - 0.01) < 0.004
    return np.where(inside, 9.0, 7.0) + 0.01 * (7 * np.arange(len(positions)) % 5)


def what_it_says(folder):
    """The lines of a journal but for when they were written, synced, and by which program."""
    lines = pp.Session.read_journal(folder)
    return [{key: value for key, value in line.items() if key not in ("at", "synced", "version")} for line in lines]


class InFolder(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)
        self.run_folder = self.folder / "run"

    def opened(self, folder=None, scene=SCENE, **options):
        session = pp.Session(scene, folder or self.run_folder, **options)
        self.addCleanup(session.close)
        return session

    def refused(self, kind, words, call):
        with self.assertRaises(kind) as caught:
            call()
        self.assertIn(words, str(caught.exception))


class ToTheByte(InFolder):
    def palpate(self, *words):
        done = subprocess.run([PALPATE, *map(str, words)], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def serve(self, folder, batches):
        """A session by `palpate serve`: asked for the next plan, told its readings, as Python is below."""
        requests = [{"do": "open", "scene": str(ROOT / "examples/planar.json"), "folder": str(folder)}]
        for rows in batches:
            requests.append({"do": "next"})
            for index, row in enumerate(rows):
                place = [float(row[axis]) for axis in "xyz"]
                requests.append({"do": "record", "place": place, "reading": float(row["reading"]), "stop": index, "t": 0.5 * index})
        requests += [{"do": "next"}, {"do": "close"}]
        lines = "".join(json.dumps(request) + "\n" for request in requests)
        done = subprocess.run([PALPATE, "serve"], input=lines, capture_output=True, text=True)
        answers = [json.loads(line) for line in done.stdout.splitlines()]
        self.assertTrue(all(answer["ok"] for answer in answers) and len(answers) == len(requests), done.stdout[-500:])
        return [answer for answer in answers if "plan" in answer]

    def test_it_is_the_session_of_the_tool_on_the_planar_scene(self):
        scene = ROOT / "examples/planar.json"
        self.palpate("simulate", scene, "--out", self.folder / "simulated", "--quiet")
        with open(self.folder / "simulated/measurements.csv", encoding="utf-8", newline="") as table:
            made = list(csv.DictReader(table))
        batches = [[row for row in made if row["batch"] == str(batch)] for batch in range(10)]
        answers = self.serve(self.folder / "served", batches)

        with pp.Session(scene, self.run_folder) as session:
            for rows in batches:
                plan = session.next()
                self.assertEqual(plan.positions.tolist(), [[float(row[axis]) for axis in "xyz"] for row in rows])
                self.assertEqual(plan.poses["qw"].tolist(), [stop["qw"] for stop in answers[plan.number]["stops"]])
                told = session.record([float(row["reading"]) for row in rows], t=0.5 * np.arange(len(rows)))
                self.assertEqual([one["stop"] for one in told], list(range(len(rows))))
            self.assertEqual((len(session.next()), session.next().stop_reason), (0, answers[-1]["finished"]))
            conclusion, measurements = session.conclude(), session.measurements_csv()
        self.assertEqual(what_it_says(self.run_folder), what_it_says(self.folder / "served"))

        out = self.folder / "exported"
        self.palpate("session", scene, self.folder / "served", "export", "--out", out)
        self.assertEqual(measurements.encode(), (out / "measurements.csv").read_bytes())
        self.palpate("boundary", out / "scene.json", "--measurements", out / "measurements.csv", "--out", out / "boundary", "--quiet")
        self.assertEqual(conclusion.region().wkt, (out / "boundary/boundary.wkt").read_text().strip())

    def test_a_folder_that_python_began_goes_on_in_the_tool_and_back(self):
        scene = self.folder / "scene.json"
        scene.write_text(json.dumps(SCENE), encoding="utf-8")
        with pp.Session(scene, self.run_folder) as session:
            first = session.next()
            session.record(felt_at(first.positions))
            second = session.next()
        self.palpate("session", scene, self.run_folder, "next")
        for name, text in (("waypoints", second.waypoints_csv), ("path", second.path_csv)):
            self.assertEqual((self.run_folder / f"plan_001_{name}.csv").read_bytes(), text.encode())
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            session = self.opened(scene=scene)
        self.assertIn("the version", str(told[0].message))
        self.assertIn("the plan does not", session.remarks[0])
        self.assertEqual(session.next().waypoints_csv, second.waypoints_csv)


KILLED = """
import json, os, signal, sys
import palpation as pp
session = pp.Session(json.loads(sys.argv[1]), sys.argv[2])
plan = session.next()
session.record(json.loads(sys.argv[3]), stop=list(range(5)))
print(plan.waypoints_csv, end="", flush=True)
os.kill(os.getpid(), signal.SIGKILL)
"""


class Deaths(InFolder):
    def test_a_session_that_was_killed_goes_on_with_the_same_plan_and_the_same_next_one(self):
        other = self.opened(self.folder / "unharmed")
        felt = felt_at(other.next().positions)
        done = subprocess.run([sys.executable, "-c", KILLED, json.dumps(SCENE), self.run_folder, json.dumps(felt[:5].tolist())], capture_output=True, text=True)
        self.assertEqual(done.returncode, -signal.SIGKILL, done.stderr)
        session = self.opened()
        plan = session.next()
        self.assertEqual(plan.waypoints_csv, done.stdout)
        self.assertEqual((plan.states, plan.open.tolist()), (["touched"] * 5 + ["open"] * 4, [5, 6, 7, 8]))
        session.record(felt[5:])
        other.record(felt)
        for _ in range(3):
            mine, its = session.next(), other.next()
            self.assertEqual((mine.waypoints_csv, mine.path_csv, mine.used), (its.waypoints_csv, its.path_csv, its.used))
            for one in (session, other):
                one.record(felt_at(mine.positions))
        self.assertEqual(session.next().stop_reason, "budget")

    def test_a_journal_that_was_changed_is_refused_by_its_line(self):
        with pp.Session(SCENE, self.run_folder) as session:
            session.record(felt_at(session.next().positions))
        journal = self.run_folder / "journal.jsonl"
        lines = journal.read_bytes().splitlines(keepends=True)
        lines[4] = lines[4].replace(b'"off_tissue"', b'"off_tissuf"')
        journal.write_bytes(b"".join(lines))
        self.refused(pp.IoError, "journal.jsonl:5: this line is corrupted", lambda: pp.Session(SCENE, self.run_folder))
        self.refused(pp.IoError, "journal.jsonl:5: this line is corrupted", lambda: pp.Session.read_journal(self.run_folder))

    def test_another_plan_is_refused_unless_it_is_wanted(self):
        with pp.Session(SCENE, self.run_folder) as session:
            session.record(felt_at(session.next().positions))
            session.next()
        self.refused(pp.IoError, "--anyway", lambda: pp.Session(SCENE, self.run_folder, overrides=["plan.batch=3"]))
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            session = self.opened(overrides=["plan.batch=3"], anyway=True)
        self.assertEqual((len(session.next()), session.next().number), (3, 2))


class Told(InFolder):
    def test_nothing_of_what_is_refused_is_taken(self):
        session = self.opened()
        self.refused(pp.InvalidInput, "come when no stop is open", lambda: session.record([1.0]))
        positions = session.next().positions
        before = (self.run_folder / "journal.jsonl").read_bytes()
        good = felt_at(positions)
        late = good.copy()
        late[7] = 1e31
        for words, call in (
            ("has 2 numbers, must have 9", lambda: session.record([1.0, 2.0])),
            ("row 7: reading 1e+31 must be finite and at most 1e30", lambda: session.record(late)),
            ("readings: row 3 is inf", lambda: session.record(np.where(np.arange(9) == 3, np.inf, good))),
            ("noise_variance -1 must be", lambda: session.record(good, noise_variance=-1.0)),
            ("stop: entry 0 is 9, must be from 0", lambda: session.record([1.0], stop=9)),
            ("stop 2 was touched", lambda: session.record([1.0, np.nan], stop=[2, 2])),
            ("name it by `stop`", lambda: session.record([np.nan], positions[:1])),
            ("must have one for each of 2 places", lambda: session.record([1.0, 2.0], positions[:2], stop=[1])),
            ("kind 'slide' must be", lambda: session.record(good, kind="slide")),
            ("Session.miss: stop: entry 0 is 12", lambda: session.miss(12)),
            ("row 1 must be one of the session's 0", lambda: session.withdraw(1)),
            ("off the tissue", lambda: session.touch_first((0.01, 0.01, 0.09))),
            ("positive radius", lambda: session.keep_out((0.01, 0.01, 0.0), -1.0)),
        ):
            with self.subTest(words):
                self.refused(pp.InvalidInput, words, call)
                self.assertEqual((self.run_folder / "journal.jsonl").read_bytes(), before)
        self.refused(TypeError, "", lambda: session.record("abc"))
        self.refused(TypeError, "", lambda: pp.Session(3, self.folder / "x"))
        self.refused(pp.IoError, "plan.bach", lambda: pp.Session({**SCENE, "plan": {"bach": 3}}, self.folder / "x"))

    def test_readings_come_with_time_and_place_in_any_order_and_once(self):
        session = self.opened()
        positions = session.next().positions
        told = session.record([7.1, 8.2], positions[[3, 1]] + [0.0003, 0.0, 0.0001], t=[1.5, np.nan], travel=[[2, 0, 0], [0, 0, 0]], noise_variance=0.01)
        self.assertEqual([(one["number"], one["new"], one["stop"]) for one in told], [(1, True, 3), (2, True, 1)])
        self.assertEqual(session.open_stops.tolist(), [0, 2, 4, 5, 6, 7, 8])
        again = session.record([7.1], positions[[3]] + [0.0003, 0.0, 0.0001], t=1.5, travel=[[1, 0, 0]], noise_variance=0.01)
        self.assertEqual(again, [{"number": 1, "new": False, "stop": 3, "off_tissue": ""}])
        off = session.record([7.0], [[0.01, 0.01, 0.09]])
        self.assertIn("from the surface", off[0]["off_tissue"])
        on_the_way = pp.Readings(session.surface, [[0.0101, 0.0102, 0.0]], [7.3], kind="way")
        self.assertEqual(session.record(on_the_way, t=2.0)[0]["stop"], None)
        readings = [line for line in session.journal if line["kind"] == "reading"]
        self.assertEqual([line["t"] for line in readings], [1.5, None, None, 2.0])
        self.assertEqual(readings[0]["travel"], [1, 0, 0])
        session.record([np.nan], stop=0, why="behind a vessel")
        session.miss([2, 4])
        session.miss()
        self.assertEqual(len(session.open_stops), 0)
        rows = list(csv.DictReader(session.measurements_csv().splitlines()))
        self.assertEqual([row["kind"] for row in rows].count("missed"), 7)
        self.assertEqual([line["why"] for line in session.journal if line["kind"] == "missed"][0], "behind a vessel")

    def test_a_persons_hand_is_in_the_next_plan(self):
        session = self.opened()
        session.record(felt_at(session.next().positions))
        session.withdraw(2, "slipped")
        session.touch_first((0.010, 0.010, 0.0))
        session.keep_out((0.016, 0.016, 0.0), 0.004)
        session.note_refusal("too fast")
        plan = session.next()
        self.assertEqual(plan.used, "1,3-9")
        self.assertLess(np.hypot(*(plan.positions[0, :2] - 0.010)), 0.0011)  # half the diagonal of a cell
        self.assertGreater(np.hypot(plan.positions[:, 0] - 0.016, plan.positions[:, 1] - 0.016).min(), 0.004)
        self.assertIn("refused", [line["kind"] for line in session.journal])
        self.assertEqual(len(session.conclude().readings), 9)

    def test_one_writes_at_a_time_and_who_closed_it_is_told(self):
        session = self.opened()
        self.refused(pp.WriteError, "", lambda: pp.Session(SCENE, self.run_folder))
        session.next()
        session.close()
        session.close()
        self.assertTrue(session.closed)
        for call in (session.next, session.conclude, lambda: session.record([1.0]), session.__enter__().miss):
            self.refused(pp.InvalidInput, "is closed", call)
        self.assertEqual([line["kind"] for line in session.journal], ["session", "plan"])
        with self.assertRaises(ZeroDivisionError), self.opened() as again:
            self.assertEqual(len(again.next()), 9)
            raise ZeroDivisionError
        self.assertTrue(again.closed)

    def test_other_threads_run_while_it_plans_and_must_wait_their_turn(self):
        session = self.opened(scene={**SCENE, "surface": {"plane": {"size_mm": [20, 20], "vertices": [150, 150]}}})
        session.record(felt_at(session.next().positions))
        refusals, done = [], threading.Event()

        def conclude():
            while not done.is_set():
                try:
                    session.conclude()
                except RuntimeError:  # the other thread's turn
                    pass

        thread = threading.Thread(target=conclude)
        thread.start()
        give_up = time.monotonic() + 120
        while not refusals and time.monotonic() < give_up:  # this thread runs, and is refused, while the other concludes
            try:
                session.open_stops
            except RuntimeError as error:
                refusals.append(str(error))
        done.set()
        thread.join()
        self.assertIn("take turns", refusals[0])


def main():
    global PALPATE, ROOT
    if len(sys.argv) < 3:
        sys.exit("usage: session_test.py PALPATE PROJECT_ROOT [CLAIM...]")
    PALPATE, ROOT = os.path.abspath(sys.argv[1]), pathlib.Path(sys.argv[2]).resolve()
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=1)


if __name__ == "__main__":
    main()
