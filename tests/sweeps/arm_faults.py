#!/usr/bin/env python3
"""Each fault of the simulated arm, over a ROS 1 master: how long until `hold` goes out, and what is sent after it.

Both are recorded by this process, which is neither arm nor driver, by the arm's clock, which waits for the driver: what this process is late by on a
loaded machine counts as the driver's. A run whose driver held before its fault is told and counts for nothing.

usage: arm_faults.py PALPATE PROJECT_ROOT [TIMES]        needs ROS 1 and numpy
"""

import os
import pathlib
import random
import socket
import subprocess
import sys
import tempfile
import time

PALPATE, ROOT = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
sys.path[:0] = [str(ROOT / "tests" / "robot"), str(ROOT / "src" / "robot" / "ros")]

from arm_scene import rows_of, world_of  # noqa: E402
from palpation_arm.simulated_psm import FAULTS  # noqa: E402

ROS = ROOT / "src" / "robot" / "ros"
PATIENCE_S = 60


class Recorder:
    """Seconds at which set points and holds went out."""

    def __init__(self):
        import rospy
        from geometry_msgs.msg import PoseStamped
        from std_msgs.msg import Empty, String

        rospy.set_param("/use_sim_time", True)
        rospy.init_node("recorder", disable_signals=True)
        self.now, self.sent, self.held = rospy.get_time, [], []
        rospy.Subscriber("/PSM1/servo_cp", PoseStamped, lambda message: self.sent.append((self.now(), message.pose.position.z)))
        rospy.Subscriber("/PSM1/hold", Empty, lambda message: self.held.append(self.now()))
        self.switch = rospy.Publisher("/PSM1/simulation/fault", String, queue_size=1)

    def wait_until(self, is_so):
        until = time.monotonic() + PATIENCE_S
        while not is_so() and time.monotonic() < until:
            time.sleep(0.002)
        return is_so()


def start(*words, **streams):
    return subprocess.Popen([str(word) for word in words], stdout=streams.get("stdout", subprocess.DEVNULL), stderr=subprocess.STDOUT, text=True)


def one(recorder, fault, folder, dice):
    """(seconds to hold, set points after it, false readings), or the words of a run that is none."""
    arm = start(sys.executable, ROS / "palpate-simulated-arm", "--tissue", folder / "world", "--speed", 1, stdout=subprocess.PIPE)
    arm.stdout.readline()
    session = pathlib.Path(tempfile.mkdtemp(dir=folder)) / "session"
    recorder.sent.clear(), recorder.held.clear()
    driver = start(sys.executable, ROS / "palpate-arm", folder / "scene.json", session, "--palpate", PALPATE, "--yes", stdout=subprocess.PIPE)
    try:
        # In the tissue, or a random while after: a stuck force says nothing in the air.
        recorder.wait_until(lambda: recorder.held or (recorder.sent and recorder.sent[-1][1] < -0.1185))
        time.sleep(0.0 if fault == "stuck_force" else dice.uniform(0, 2.5))
        since = recorder.now()
        recorder.switch.publish(fault)
        early = bool(recorder.held)
        said, _ = driver.communicate(timeout=PATIENCE_S)
        words = [line for line in said.splitlines() if line.startswith("HOLD")]
        if early or not recorder.wait_until(lambda: recorder.held):
            return f"held before: {words}" if early else f"did not hold: {said[-300:]}"
        time.sleep(0.3)
        false = [row["reading"] for row in (rows_of(session) if (session / "journal.jsonl").exists() else []) if not 0.29 < row["reading"] < 0.51]
        return recorder.held[0] - since, sum(sent > recorder.held[0] for sent, _ in recorder.sent), len(false)
    finally:
        for process in (driver, arm):
            process.kill()
            process.wait()


def main():
    times, dice = int(sys.argv[3]) if len(sys.argv) > 3 else 5, random.Random(1)
    with tempfile.TemporaryDirectory() as holder:
        folder = pathlib.Path(holder)
        world_of(PALPATE, folder)
        with socket.socket() as spare:
            spare.bind(("localhost", 0))
            port = spare.getsockname()[1]
        os.environ.update(ROS_MASTER_URI=f"http://localhost:{port}", ROS_HOSTNAME="localhost", ROS_LOG_DIR=holder, ROS_VERSION="1")
        master = start("rosmaster", "--core", "-p", port)
        try:
            time.sleep(2)
            recorder = Recorder()
            for fault in FAULTS:
                runs = [one(recorder, fault, folder, dice) for _ in range(times)]
                good = [run for run in runs if not isinstance(run, str)]
                slowest = f"{1000 * max(run[0] for run in good):.0f} ms" if good else "-"
                print(f"{fault}: {len(good)} of {times}, held within {slowest}, sent after {sum(run[1] for run in good)}, "
                      f"false readings {sum(run[2] for run in good)}", *[run for run in runs if isinstance(run, str)], flush=True)
        finally:
            master.kill()
            master.wait()


if __name__ == "__main__":
    main()
    os._exit(0)
