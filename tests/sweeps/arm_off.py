#!/usr/bin/env python3
"""The driver over a ROS 1 master on tissue that is not where, or not what, it is taken to be: a surface that is smoothly a millimetre off, a registration
2 mm off, the stiffest tissue, all of it together. This process, which is neither arm nor driver, records the force as the arm says it.

For each: stops touched and missed, holds, the most force beside what it may be (warn_n + stiffness x speed x the age that data may have). Ends with 1
where it is more, or a stop is neither touched nor noted as missed: a millimetre into the stiffest tissue is more than the gate allows.

usage: arm_off.py PALPATE PROJECT_ROOT [CASE...]        all; needs ROS 1 and numpy
"""

import os
import pathlib
import subprocess
import sys
import tempfile
import time

PALPATE, ROOT = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
sys.path[:0] = [str(ROOT / "tests" / "robot"), str(ROOT / "src" / "robot" / "ros")]

from arm_programs import PATIENCE_S, Programs  # noqa: E402
from arm_scene import SCENE, rows_of, world_of  # noqa: E402

SPEED, STOPS = 8, SCENE["plan"]["initial"]["count"]
WARN_N, CONTACT_M_PER_S, AGE_S = 2.0, 0.005, 0.050  # as the limits are by default
SOFT, STIFF = {}, {"probe": {"low": 4.0, "high": 5.0}, "field": {"length_mm": 4, "signal_sd": 0.5, "noise": 0.05}}
SHIFT_MM = ["1.155"] * 3  # 2 mm
# What the tissue is; what the arm is told; what the driver is told; the stiffest there is, N/mm.
CASES = {
    "surface 1 mm off": (SOFT, ["--offset-mm", "1"], [], 0.5),
    "registration 2 mm off": (SOFT, ["--shift-mm", *SHIFT_MM], ["robot.uncertainty_mm=2", "robot.place_uncertainty_mm=2", "robot.standoff_mm=5"], 0.5),
    "tissue of 5 N/mm": (STIFF, [], [], 5.0),
    "all of it, pressed in by 0.3 mm": (
        STIFF,
        ["--offset-mm", "1", "--shift-mm", *SHIFT_MM],
        ["robot.uncertainty_mm=3", "robot.place_uncertainty_mm=2", "robot.standoff_mm=6", "robot.indent_mm=0.3"],
        5.0,
    ),
}


def record(name):
    """In a process of its own, since a node outlives no master: the most force, and the holds, when told to end."""
    import rospy
    from std_msgs.msg import Empty, Float64

    most, holds = [0.0], []
    rospy.init_node("recorder", disable_signals=True)
    rospy.Subscriber(f"/{name}/probe/force", Float64, lambda message: most.append(max(most.pop(), message.data)))
    rospy.Subscriber(f"/{name}/hold", Empty, holds.append)
    print("listening", flush=True)
    sys.stdin.readline()
    print(most[0], len(holds), flush=True)
    os._exit(0)


def one(name, folder):
    tissue, arm, driver, stiffest = CASES[name]
    world_of(PALPATE, folder, **tissue)
    programs = Programs(PALPATE, ROOT, folder, SPEED)
    programs.master()
    try:
        programs.arm("--noise", "0.002", *arm)
        recorder = subprocess.Popen([sys.executable, __file__, PALPATE, ROOT, "--record"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        recorder.stdout.readline()
        words = [word for value in driver for word in ("--set", value)]
        said, _ = programs.driver(folder / "session", "--batches", "1", *words).communicate(timeout=5 * PATIENCE_S)
        time.sleep(0.5)
        most_n, holds = recorder.communicate("end\n", timeout=PATIENCE_S)[0].split()
    finally:
        programs.end()
    rows = rows_of(folder / "session")
    missed = (folder / "session" / "journal.jsonl").read_text(encoding="utf-8").count('"kind":"missed"')
    may_n = WARN_N + 1e3 * stiffest * CONTACT_M_PER_S * AGE_S
    is_good = float(most_n) <= may_n and len(rows) + missed == STOPS
    print(f"{name}: {len(rows)} touched, {missed} missed, {holds} holds, {float(most_n):.2f} N at most, which may be {may_n:.2f}: {'good' if is_good else 'NOT SO'}",
          *[line for line in said.splitlines() if line.startswith("HOLD")], *([] if is_good else [said[-600:]]), sep="\n  ", flush=True)
    return is_good


def main():
    good = True
    for name in sys.argv[3:] or CASES:
        with tempfile.TemporaryDirectory() as folder:
            good = bool(one(name, pathlib.Path(folder))) and good
    return 0 if good else 1


if __name__ == "__main__":
    if sys.argv[3:] == ["--record"]:
        record("PSM1")
    sys.exit(main())
