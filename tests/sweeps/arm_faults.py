#!/usr/bin/env python3
"""Each fault of the simulated arm, over a ROS 1 master, and the master's own end: how long until `hold` goes out, what is sent after it, whether a false
reading was taken, and whether the session goes on once the fault is over and the arm is back over the tissue.

Recorded by this process, which is neither arm nor driver, by the arm's clock, which waits for the driver: what this process is late by on a loaded
machine counts as the driver's. A run whose driver held before its fault is told and counts for nothing.

usage: arm_faults.py PALPATE PROJECT_ROOT [TIMES [FAULT...]]        5 and all; needs ROS 1 and numpy
"""

import os
import pathlib
import random
import subprocess
import sys
import tempfile
import time

PALPATE, ROOT = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
sys.path[:0] = [str(ROOT / "tests" / "robot"), str(ROOT / "src" / "robot" / "ros")]

from arm_programs import PATIENCE_S, Programs, wait_until  # noqa: E402
from arm_scene import rows_of, world_of  # noqa: E402
from palpation_arm import wrist  # noqa: E402
from palpation_arm.messages import crtk_message  # noqa: E402
from palpation_arm.simulated_psm import FAULTS  # noqa: E402
from palpation_arm.world import World  # noqa: E402

MASTER = "killed_master"
STOPS, SPEED = 2, 2
FEW = ["--set", f"plan.initial.count={STOPS}", "--batches", "1"]


class Recorder:
    """Seconds at which set points and holds went out; and a person's hand on the arm."""

    def __init__(self):
        import rospy
        from geometry_msgs.msg import PoseStamped
        from sensor_msgs.msg import JointState
        from std_msgs.msg import Empty, String

        rospy.set_param("/use_sim_time", True)
        rospy.init_node("recorder", disable_signals=True)
        self.now, self.sent, self.held, self.state = rospy.get_time, [], [], None
        rospy.Subscriber("/PSM1/servo_cp", PoseStamped, lambda message: self.sent.append((self.now(), message.pose.position.z)))
        rospy.Subscriber("/PSM1/hold", Empty, lambda message: self.held.append(self.now()))
        rospy.Subscriber("/PSM1/operating_state", crtk_message("OperatingState"), lambda message: setattr(self, "state", message))
        self.switch = rospy.Publisher("/PSM1/simulation/fault", String, queue_size=1)
        self.command = rospy.Publisher("/PSM1/state_command", crtk_message("StringStamped"), queue_size=5)
        self.move = rospy.Publisher("/PSM1/move_jp", JointState, queue_size=1)
        self.joints = JointState

    def recover(self, start):
        """As after any fault: off and on, homed, and over the tissue."""
        self.switch.publish("none")
        for word in ("disable", "enable", "home"):
            self.command.publish(crtk_message("StringStamped")(string=word))
            time.sleep(0.1)
        assert wait_until(lambda: self.state.state == "ENABLED" and self.state.is_homed and not self.state.is_busy), self.state
        self.move.publish(self.joints(name=wrist.NAMES, position=start))
        assert wait_until(lambda: self.state.is_busy) and wait_until(lambda: not self.state.is_busy)


def goes_on(programs, session, before):
    """Whether something becomes of every stop, and what was taken stays."""
    said, _ = programs.driver(session, *FEW).communicate(timeout=PATIENCE_S)
    rows, missed = rows_of(session), (session / "journal.jsonl").read_text(encoding="utf-8").count('"kind":"missed"')
    places = {tuple(row["place"]) for row in rows}
    return len(places) == len(rows) and len(rows) + missed == STOPS and rows[: len(before)] == before, said


def taken(session):
    return rows_of(session) if (session / "journal.jsonl").exists() else []


def one(recorder, fault, programs, dice, start):
    """(seconds to hold, set points after it, false readings, whether it went on), or the words of a run that is none."""
    master, arm = programs.started[0], programs.arm("--noise", 0.002)
    session = pathlib.Path(tempfile.mkdtemp(dir=programs.folder)) / "session"
    recorder.sent.clear(), recorder.held.clear()
    driver = programs.driver(session, *FEW)
    try:
        # In the tissue, or a random while after: a stuck force says nothing in the air.
        wait_until(lambda: recorder.held or (recorder.sent and recorder.sent[-1][1] < -0.1185))
        time.sleep(0.0 if fault == "stuck_force" else dice.uniform(0, 2.5) / SPEED)
        since = recorder.now()
        master.kill() if fault == MASTER else recorder.switch.publish(fault)
        early = bool(recorder.held)
        said, _ = driver.communicate(timeout=PATIENCE_S)
        words = [line for line in said.splitlines() if line.startswith("HOLD")]
        if early or not wait_until(lambda: recorder.held):
            return f"held before: {words}" if early else f"did not hold: {said[-300:]}"
        time.sleep(0.3)
        rows, after = taken(session), sum(sent > recorder.held[0] for sent, _ in recorder.sent)
        false = sum(not 0.28 < row["reading"] < 0.52 for row in rows)
        if fault == MASTER:
            programs.end(arm)
            programs.master(), programs.arm("--noise", 0.002)
        else:
            recorder.recover(start)
        went_on, told = goes_on(programs, session, rows)
        if not went_on:
            print(f"{fault} did not go on, from {rows} to {taken(session)}: {told[-400:]}", flush=True)
        return recorder.held[0] - since, after, false, went_on
    finally:
        programs.end(*[process for process in programs.started if process is not master])


def tell(fault, runs, times):
    good = [run for run in runs if not isinstance(run, str)]
    slowest = f"{1000 * max(run[0] for run in good):.0f} ms" if good else "-"
    print(f"{fault}: {len(good)} of {times}, held within {slowest}, sent after {sum(run[1] for run in good)}, false readings {sum(run[2] for run in good)}, "
          f"went on {sum(run[3] for run in good)}", *[run for run in runs if isinstance(run, str)], flush=True)


def main():
    times = int(sys.argv[3]) if len(sys.argv) > 3 else 5
    faults, dice = sys.argv[4:] or [*FAULTS, MASTER], random.Random(1)
    if MASTER in faults and (len(faults) > 1 or times > 1):  # a recorder outlives no master
        for _ in range(times):
            subprocess.run([sys.executable, __file__, PALPATE, ROOT, "1", MASTER], check=True)
        faults = [fault for fault in faults if fault != MASTER]
    with tempfile.TemporaryDirectory() as holder:
        programs = Programs(PALPATE, ROOT, holder, SPEED)
        start = World(world_of(PALPATE, programs.folder)).start()
        programs.master()
        try:
            recorder = Recorder()
            for fault in faults:
                tell(fault, [one(recorder, fault, programs, dice, start) for _ in range(times)], times)
        finally:
            programs.end()


if __name__ == "__main__":
    main()
    sys.stdout.flush()
    os._exit(0)
