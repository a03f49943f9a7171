#!/usr/bin/env python3
"""The driver on the simulated PSM over a ROS 1 master of its own: programs, topics and messages as a laboratory has them. Time is the arm's,
which keeps /clock and waits for the driver: a loaded machine makes nothing late.

usage: ros_test.py PALPATE PROJECT_ROOT [Ros.test_...]        ends with 77 (ctest: skipped) where ROS 1 is not installed
"""

import contextlib
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest

PALPATE, ROOT = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
ROS = ROOT / "src" / "robot" / "ros"
sys.dont_write_bytecode = True
try:
    import geometry_msgs.msg  # noqa: F401
    import netifaces  # noqa: F401
    import numpy  # noqa: F401
    import rospy  # noqa: F401
    import sensor_msgs.msg  # noqa: F401

    if shutil.which("rosmaster") is None:
        raise ImportError("there is no program rosmaster")
except ImportError as error:
    print(f"skipped: ROS 1 is not installed: {error}")
    sys.exit(77)

from arm_scene import rows_of, world_of  # noqa: E402

PATIENCE_S = 100
SPEED = 8



def free_port():
    with socket.socket() as one:
        one.bind(("localhost", 0))
        return one.getsockname()[1]


def answers(port):
    with socket.socket() as one:
        return one.connect_ex(("localhost", port)) == 0


class Ros(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.stack = contextlib.ExitStack()
        cls.addClassCleanup(cls.stack.close)
        cls.shared = pathlib.Path(cls.stack.enter_context(tempfile.TemporaryDirectory()))
        world_of(PALPATE, cls.shared)

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(dir=self.shared))
        port = free_port()
        self.environment = {**os.environ, "ROS_MASTER_URI": f"http://localhost:{port}", "ROS_HOSTNAME": "localhost", "ROS_LOG_DIR": str(self.folder),
                            "ROS_VERSION": "1", "PYTHONDONTWRITEBYTECODE": "1"}
        self.master = self.start("rosmaster", "--core", "-p", str(port))
        self.wait_until(lambda: answers(port), "the master")

    def start(self, *words, **streams):
        process = subprocess.Popen([str(word) for word in words], env=self.environment, stdout=streams.get("stdout", subprocess.DEVNULL), stderr=subprocess.STDOUT, text=True)
        self.addCleanup(self.end, process)
        return process

    @staticmethod
    def end(process):
        if process.poll() is None:
            process.kill()
        process.wait()
        if process.stdout:
            process.stdout.close()

    def wait_until(self, is_so, what):
        until = time.monotonic() + PATIENCE_S
        while not is_so():
            self.assertLess(time.monotonic(), until, f"waited for {what}")
            time.sleep(0.02)

    def start_arm(self, *words):
        arm = self.start(sys.executable, ROS / "palpate-simulated-arm", "--tissue", self.shared / "world", "--noise", "0.002", "--speed", SPEED, *words,
                         stdout=subprocess.PIPE)
        self.assertEqual(arm.stdout.readline(), "PSM1 is there\n")

    def start_driver(self, *words):
        return self.start(sys.executable, ROS / "palpate-arm", self.shared / "scene.json", self.folder / "session", "--palpate", PALPATE, "--yes", *words,
                          stdout=subprocess.PIPE)

    def rows(self):
        return rows_of(self.folder / "session") if (self.folder / "session" / "journal.jsonl").exists() else []

    def test_a_driver_that_is_killed_once_palpates_a_plan_over_ros(self):
        self.start_arm("--pose", "transform")
        first = self.start_driver("--pose", "transform", "--batches", "1")
        self.wait_until(lambda: len(self.rows()) >= 3 or first.poll() is not None, "three readings")
        first.send_signal(signal.SIGKILL)
        first.wait()
        before = self.rows()
        second = self.start_driver("--pose", "transform", "--batches", "1")
        said, _ = second.communicate(timeout=PATIENCE_S)
        self.assertEqual(second.returncode, 0, first.stdout.read() + said)
        rows = self.rows()
        self.assertEqual(rows[: len(before)], before)
        self.assertEqual(len({tuple(row["place"]) for row in rows}), 9)
        self.assertEqual(len(rows), 9)
        for row in rows:
            self.assertTrue(0.28 < row["reading"] < 0.52, row)

    def test_a_force_that_stops_coming_is_a_hold_and_no_reading(self):
        self.start_arm("--fault", "stale_force@4")
        driver = self.start_driver("--force", "spring:probe/displacement:80")
        said, _ = driver.communicate(timeout=PATIENCE_S)
        self.assertEqual(driver.returncode, 5, said)
        self.assertIn("HOLD: the last force is", said)

    def test_without_a_master_it_holds(self):
        self.start_arm()
        driver = self.start_driver()
        self.wait_until(lambda: self.rows() or driver.poll() is not None, "a reading")
        self.master.kill()
        said, _ = driver.communicate(timeout=PATIENCE_S)
        self.assertEqual(driver.returncode, 5, said)
        self.assertIn("the ROS master does not answer", said)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
