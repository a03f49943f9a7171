#!/usr/bin/env python3
"""The driver on a simulated PSM, in one process and under simulated time, through the gate and the session of `palpate serve`. No ROS.

usage: arm_test.py PALPATE PROJECT_ROOT [Arm.test_...]        needs numpy; ends with 77 (ctest: skipped) without
"""

import pathlib
import random
import re
import signal
import subprocess
import sys
import tempfile
import unittest

PALPATE, ROOT = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
sys.path.insert(0, str(ROOT / "src" / "robot" / "ros"))
sys.dont_write_bytecode = True
try:
    import numpy  # noqa: F401
except ImportError:
    print("skipped: the simulated arm needs numpy: apt-get install python3-numpy")
    sys.exit(77)

from arm_scene import STOPS, rows_of, world_of  # noqa: E402
from palpation_arm import wrist  # noqa: E402
from palpation_arm.driver import Driver, Held  # noqa: E402
from palpation_arm.in_process import InProcess  # noqa: E402
from palpation_arm.poses import on_the_way, unit  # noqa: E402
from palpation_arm.serve import Gone, Serve  # noqa: E402
from palpation_arm.simulated_psm import AFTER, FAULTS, SimulatedPsm  # noqa: E402
from palpation_arm.world import World  # noqa: E402

HOLD_WITHIN_S = 0.1
# A fault comes with so many set points of a phase.
MOMENTS = {"air": 30, "search": 20, "press": 5}


class Psm(unittest.TestCase):
    def test_its_states_follow_the_table_of_the_library(self):
        rows = re.findall(r"\{(\w+), (\w+), (\w+)\},", (ROOT / "src" / "robot" / "crtk.cpp").read_text(encoding="utf-8"))
        self.assertEqual({(a.upper(), b.lower()): c.upper() for a, b, c in rows}, AFTER)

    def test_joints_and_poses_are_each_others_inverse(self):
        dice = random.Random(1)
        for _ in range(1000):
            joints = [dice.uniform(max(a, -1.3), min(b, 1.3)) for a, b in zip(wrist.LEAST, wrist.MOST)]
            joints[2] = max(joints[2], 0.01)
            for a, b in zip(wrist.joints_of(*wrist.pose_of(joints)), joints):
                self.assertAlmostEqual(a, b, delta=1e-12)

    def test_a_way_ends_at_its_goal_also_where_the_quaternion_is_the_other_of_two(self):
        start, goal = ([0.0, 0.0, 0.0], [0.6, 0.0, 0.0, -0.8]), ([0.01, 0.0, 0.0], [-0.6, 0.02, 0.0, 0.8])
        goal = (goal[0], unit(goal[1]))
        steps = 0
        while start != goal:
            start = on_the_way(start, goal, 0.003, 0.02)
            steps += 1
            self.assertLess(steps, 10)

    def test_a_move_that_joints_do_not_reach_says_so_and_one_that_they_do_is_busy_until_it_arrives(self):
        psm = SimulatedPsm(joints=[0.0, 0.0, 0.1, 0.0, 0.0, 0.0])
        psm.move_cp([0.0, 0.0, -0.5], psm.pose()[1])
        self.assertIn(("goal_reached", False), psm.events)
        self.assertFalse(psm.is_busy)
        psm.events.clear()
        psm.move_cp([0.0, 0.0, -0.12], psm.pose()[1])
        steps = 0
        while psm.is_busy:
            psm.step(0.01)
            steps += 1
        self.assertIn(("goal_reached", True), psm.events)
        self.assertEqual(steps, 11)  # 20 mm at 0.2 m/s, and one to say so
        psm.state_command("pause")
        psm.servo_cp([0.0, 0.0, -0.13], psm.pose()[1])
        psm.step(0.01)
        self.assertAlmostEqual(psm.pose()[0][2], -0.12)


class Killed(Exception):
    """Stands in for a death: nothing after it is done."""


class Arm(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.holder = tempfile.TemporaryDirectory()
        cls.shared = pathlib.Path(cls.holder.name)
        world_of(PALPATE, cls.shared)

    @classmethod
    def tearDownClass(cls):
        cls.holder.cleanup()

    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.session = pathlib.Path(holder.name) / "session"
        self.said = []

    def arm(self, **tissue):
        self.world = World(self.shared / "world", **tissue)
        psm = SimulatedPsm(self.world.tissue, noise=0.002, joints=self.world.start())
        return InProcess(psm, "PSM1_base")

    def driver(self, arm, *settings):
        serve = Serve(PALPATE, self.shared / "scene.json", self.session, settings)
        self.addCleanup(lambda: serve.process.poll() is None and serve.close())
        self.assertEqual([remark for remark in serve.opened["remarks"] if not remark.startswith("Coarse: ")], [])
        return Driver(serve, arm, say=self.said.append)

    def truth(self, row):
        """Stiffness where the mesh's place lies for the robot."""
        x, y, z = row["place"]
        return self.world.tissue.below([x - 0.01, y - 0.01, z - 0.12])[2]

    def assert_readings_are_true(self):
        """Within five standard deviations of a touch, and what a slope over a tilted millimetre differs."""
        for row in rows_of(self.session):
            self.assertAlmostEqual(row["reading"], self.truth(row), delta=0.012, msg=row)

    def recover(self, arm):
        """What a person does after a hold."""
        if arm.psm.fault == "clipped_joints":  # it is beside every stop
            arm.psm.joints[2] -= 0.01
        arm.psm.set_fault("none")
        if arm.psm.state == "FAULT":
            arm.psm.state_command("disable")
            arm.psm.state_command("enable")
        arm.psm.is_homed = True

    def test_it_palpates_until_the_session_is_finished(self):
        arm = self.arm()
        driver = self.driver(arm)
        self.assertEqual(driver.run(), "budget")
        self.assertEqual(len(rows_of(self.session)), STOPS)
        self.assert_readings_are_true()
        self.assertIsNone(arm.held_s)
        self.assertLess(arm.most_n, 0.65)  # 0.1 N until it is felt, and a millimetre into the stiffest
        self.assertEqual(len(driver.serve.ask(do="conclude")["summary"]["parts"]), 1)
        print(f"{STOPS} stops in {arm.now():.0f} s")

    def fault_at(self, driver, arm, fault, phase):
        """It comes in the middle of the first touch; the list will hold when."""
        send, counted, since = driver.send, {}, []

        def counting(asked, pose):
            counted[asked] = counted.get(asked, 0) + 1
            if asked == phase and counted[asked] == MOMENTS[phase] and not since:
                since.append(arm.now())
                arm.psm.set_fault(fault)
            return send(asked, pose)

        driver.send = counting
        return since

    def hold_within(self, fault, phase):
        """Seconds from the fault to the hold; all that holds after each."""
        self.session = self.session.parent / f"{fault}_{phase}"
        arm = self.arm()
        driver = self.driver(arm, "plan.initial.count=2")
        since = self.fault_at(driver, arm, fault, phase)
        for _ in range(2):  # the second time nobody has looked
            with self.assertRaises(Held):
                driver.run()
            self.assertLessEqual(arm.sent[-1], arm.held_s)
        self.assertEqual(rows_of(self.session), [])
        self.recover(arm)
        self.assertEqual(driver.acknowledge(), "")
        self.assertEqual(driver.run(batches=1), "batches")
        self.assertEqual(len(rows_of(self.session)), 2)
        self.assert_readings_are_true()
        return arm.held_s - since[0]

    def test_after_each_fault_it_holds_sends_nothing_and_goes_on_when_a_person_has_looked(self):
        slowest = 0.0
        for fault in FAULTS:
            # A force that stands still says nothing in the air.
            for phase in ("search", "press") if fault == "stuck_force" else MOMENTS:
                with self.subTest(fault=fault, phase=phase):
                    seconds = self.hold_within(fault, phase)
                    self.assertLessEqual(seconds, HOLD_WITHIN_S + 1e-9)
                    slowest = max(slowest, seconds)
        print(f"held at most {1000 * slowest:.0f} ms after a fault")

    def test_whoever_dies_in_the_middle_of_a_touch_the_next_one_goes_back_first_and_on(self):
        arm, wishes = self.arm(), []
        driver = self.driver(arm)

        def die(set_point):
            wishes.append(set_point)
            if driver.contact is not None and len(rows_of(self.session)) == 4:
                raise Killed
            InProcess.send(arm, set_point)

        arm.send = die
        with self.assertRaises(Killed):
            driver.run()
        driver.serve.process.kill()
        driver.serve.close()
        arm.send = lambda set_point: InProcess.send(arm, set_point)
        self.assertEqual(self.driver(arm).run(), "budget")
        self.assertIn("back along its normal first", " ".join(map(str, self.said)))
        rows = rows_of(self.session)
        self.assertEqual(len(rows), STOPS)
        self.assertEqual(len({tuple(row["place"]) for row in rows}), STOPS)
        self.assert_readings_are_true()

    def test_tissue_that_is_off_within_the_uncertainty_is_felt_alike_and_what_is_farther_is_missed(self):
        arm = self.arm(offset_mm=0.9)
        self.assertEqual(self.driver(arm).run(batches=1), "batches")
        self.assertEqual(len(rows_of(self.session)), 9)
        self.assert_readings_are_true()
        self.session = self.session.parent / "farther"
        arm = self.arm(shift_mm=[0, 0, -2.5])
        self.assertEqual(self.driver(arm).run(batches=1), "batches")
        self.assertEqual(rows_of(self.session), [])
        self.assertIn("no contact down to 2 mm", self.said[-1])

    def test_what_lies_higher_than_it_may_is_a_hold_and_no_reading(self):
        arm = self.arm(shift_mm=[0, 0, 3.5])
        with self.assertRaisesRegex(Held, "touches something in the air"):
            self.driver(arm).run()
        self.assertEqual(rows_of(self.session), [])

    def test_what_came_while_a_plan_was_made_is_told_whole(self):
        arm = self.arm()
        driver = self.driver(arm)
        for _ in range(3000):  # half a minute
            arm.wait()
        self.assertGreater(len(arm.messages), 8000)
        driver.tick()
        self.assertEqual(arm.messages, [])
        self.assertIsNone(arm.held_s)

    def test_a_gate_that_does_not_answer_in_time_is_a_hold(self):
        arm = self.arm()
        driver = self.driver(arm)
        self.addCleanup(driver.serve.process.kill)

        def send(set_point):
            InProcess.send(arm, set_point)
            if len(arm.sent) == 50:
                driver.serve.process.send_signal(signal.SIGSTOP)

        arm.send = send
        with self.assertRaisesRegex(Gone, "does not answer within 2 s"):
            driver.run()
        self.assertEqual(len(arm.sent), 50)
        self.assertEqual(arm.held_s, arm.now())

    def program(self, *words, answers=""):
        return subprocess.run([sys.executable, ROOT / "src" / "robot" / "ros" / "palpate-arm", self.shared / "scene.json", self.session, "--palpate", PALPATE, *words],
                              input=answers, capture_output=True, text=True)

    def test_before_anything_moves_a_person_reads_what_will_and_says_so(self):
        shown = self.program("--dry-run")
        self.assertEqual(shown.returncode, 0, shown.stderr)
        self.assertIn("box (-34.0, -34.0, -144.0) to (34.0, 34.0, -96.0)", shown.stdout)
        self.assertIn("9 of 9 stops are open", shown.stdout)
        simulated = ["--simulated", self.shared / "world", "--batches", "1"]
        refused = self.program(*simulated, answers="no\n")
        self.assertIn("Type move to begin", refused.stdout)
        self.assertEqual(rows_of(self.session), [])
        done = self.program(*simulated, answers="move\n")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual(len(rows_of(self.session)), 9)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
