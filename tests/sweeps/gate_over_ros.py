#!/usr/bin/env python3
"""COUNT set points, a thousand a second, of a driver that knows how to touch and every now and then does not, through the gate of `palpate serve` and
over a ROS 1 master, to an arm that says nonsense at times and falls silent. The arm, a process of its own, records what arrives and judges it by figures
of its own: frame, numbers, box, cone, step, speed, indentation, the age of what it had said, and nothing after a hold. Ends with 1 where one is wrong.

usage: gate_over_ros.py PALPATE PROJECT_ROOT [COUNT [SEED]]        20000 and 1; needs ROS 1 and numpy
"""

import json
import math
import os
import pathlib
import random
import subprocess
import sys
import tempfile
import threading
import time

PALPATE, ROOT = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
COUNT, SEED = (int(sys.argv[3 + i]) if len(sys.argv) > 3 + i else default for i, default in enumerate((20000, 1)))
sys.path[:0] = [str(ROOT / "tests" / "robot"), str(ROOT / "src" / "robot" / "ros")]

from arm_programs import Programs, wait_until  # noqa: E402
from arm_scene import world_of  # noqa: E402

TICK_S, AGE_S = 0.001, 0.050
FRAME, DOWN = "PSM1_base", (1.0, 0.0, 0.0, 0.0)
TISSUE_Z, STIFFNESS_N_PER_M = -0.12, 500.0
INDENT_M, EXTRA_M, UNCERTAINTY_M, STANDOFF_M = 0.001, 0.001, 0.001, 0.003
NONSENSE = [math.nan, math.inf, 0.0, 1e300, -0.02, 0.3]


def topics():
    from geometry_msgs.msg import PoseStamped
    from std_msgs.msg import Float64, String

    return PoseStamped, Float64, String


class Arm:
    """Follows each set point at once, and keeps all that it said and heard."""

    def __init__(self, dice):
        import rospy
        from palpation_arm.messages import crtk_message

        self.rospy, self.dice, self.tip, self.said, self.heard, self.events = rospy, dice, [0.0, 0.0, TISSUE_Z + 0.01], [], [], []
        self.pose_kind, number, text = topics()
        rospy.init_node("arm", disable_signals=True)
        self.poses = rospy.Publisher("/PSM1/measured_cp", self.pose_kind, queue_size=10)
        self.forces = rospy.Publisher("/PSM1/probe/force", number, queue_size=10)
        self.states = rospy.Publisher("/PSM1/operating_state", crtk_message("OperatingState"), queue_size=1, latch=True)
        self.state = crtk_message("OperatingState")(state="ENABLED", is_homed=True)
        self.state.header.stamp = rospy.Time.from_sec(time.time())
        self.states.publish(self.state)
        rospy.Subscriber("/PSM1/all", self.pose_kind, self.hear, queue_size=1000, tcp_nodelay=True)
        rospy.Subscriber("/PSM1/servo_cp", self.pose_kind, lambda message: None)  # the link waits for one who listens
        rospy.Subscriber("/player", text, lambda message: self.events.append(json.loads(message.data)), queue_size=1000)

    def hear(self, message):
        place, turn = message.pose.position, message.pose.orientation
        self.heard.append((message.header.stamp.to_sec(), message.header.frame_id, (place.x, place.y, place.z), (turn.x, turn.y, turn.z, turn.w)))
        self.tip = [place.x, place.y, place.z]

    def say(self):
        message, now = self.pose_kind(), time.time()
        message.header.stamp, message.header.frame_id = self.rospy.Time.from_sec(now), FRAME
        place = list(self.tip)
        turn, is_sound = DOWN, True
        if self.dice.random() < 0.0003:
            is_sound = False
            kind = self.dice.randrange(4)
            message.header.frame_id = "world" if kind == 0 else FRAME
            turn = (0.0, 0.0, 0.0, 0.0) if kind == 1 else DOWN
            place[0] = math.nan if kind == 2 else place[0]
            message.header.stamp = self.rospy.Time(0) if kind == 3 else message.header.stamp
        message.pose.position.x, message.pose.position.y, message.pose.position.z = place
        message.pose.orientation.x, message.pose.orientation.y, message.pose.orientation.z, message.pose.orientation.w = turn
        force = max(0.0, STIFFNESS_N_PER_M * (TISSUE_Z - self.tip[2])) + 1e-5 * self.dice.gauss(0, 1)
        self.poses.publish(message)
        self.forces.publish(math.nan if self.dice.random() < 0.0001 else force)
        if is_sound:
            self.said.append(now)

    def run(self, player):
        while player.poll() is None:
            due = time.time() + TICK_S
            self.say()
            if self.dice.random() < 0.0003:
                time.sleep(self.dice.uniform(0.04, 0.15))
            time.sleep(max(0.0, due - time.time()))


def faults_of(arm):
    """Words for each set point that must not have come."""
    events = sorted(arm.events, key=lambda event: event["at"])
    before, stop, held, faults, next_event, said = None, None, False, [], 0, 0
    for at, frame, place, turn in arm.heard:
        while next_event < len(events) and events[next_event]["at"] <= at:
            event, next_event = events[next_event], next_event + 1
            held = event["what"] == "hold" or (held and event["what"] != "acknowledged")
            if event["what"] == "begin":
                stop, before = event, None
        while said + 1 < len(arm.said) and arm.said[said + 1] <= at:
            said += 1
        wrong = [] if stop else ["no touch has begun"]
        wrong += ["after a hold"] * held + ["frame " + frame] * (frame != FRAME) + [f"not finite: {place}"] * (not all(map(math.isfinite, (*place, *turn))))
        wrong += [f"the last pose was {at - arm.said[said]:.3f} s old"] * (at - arm.said[said] > AGE_S)
        wrong += [f"box: {place}"] * (abs(place[0]) > 0.034 or abs(place[1]) > 0.034 or not -0.144 <= place[2] <= -0.096)
        if stop and not wrong:
            height, beside = place[2] - TISSUE_Z, math.dist(place[:2], stop["place"][:2])
            phase = stop["phases"].get(f"{at:.6f}", "?")
            wrong += [f"cone: {beside}"] * (phase != "air" and beside > 0.001 + max(0.0, height) * math.tan(0.26) + 1e-9)
            wrong += [f"low in the air: {height}"] * (phase == "air" and height < UNCERTAINTY_M - 1e-9)
            # What is felt may be as late as data may be.
            deepest = 0.1 / STIFFNESS_N_PER_M + INDENT_M + EXTRA_M + 0.005 * 2 * AGE_S
            wrong += [f"deep: {height}"] * (-height > deepest)
            if before:
                step, since = math.dist(place, before[1]), min(AGE_S, at - before[0])
                speed = 0.030 if phase == "air" else 0.005
                wrong += [f"step {step} in {since} {phase}"] * (step > 0.001 + 1e-9 or step > speed * since * 1.000001 + 1e-9)
        before = (at, place)
        faults += [f"{at:.6f}: " + ", ".join(wrong)] if wrong else []
    return faults


class Player:
    """The other process."""

    def __init__(self, dice, folder):
        import rospy
        from palpation_arm.crtk_link import CrtkLink, stamped_pose
        from palpation_arm.ral import RospyRal
        from palpation_arm.serve import Serve

        self.rospy, self.dice, self.stamped = rospy, dice, stamped_pose
        self.serve = Serve(PALPATE, folder / "scene.json", folder / "session")
        self.stops = self.serve.ask(do="next")["stops"]
        ral = RospyRal("player", "PSM1")
        self.servo = rospy.Publisher("/PSM1/all", topics()[0], queue_size=1000, tcp_nodelay=True)  # of servo_cp the newest wins: here all are to be seen
        self.link = CrtkLink(ral, "pose", ("newtons", "probe/force"))
        self.events = rospy.Publisher("/player", topics()[2], queue_size=1000)
        self.counts, self.due, self.pose, self.phases, self.sent_s = {"asked": 0, "go": 0, "hold": 0, "retract": 0, "touches": 0}, time.time(), None, {}, 0.0
        self.mischief, self.stop, self.begun = 0.0, None, None

    def tell(self, what, **more):
        self.events.publish(json.dumps({"what": what, "at": time.time(), **more}))

    def gate(self, **request):
        from palpation_arm.driver import sayable

        now, messages = time.time(), [sayable(message) for message in self.link.heard()]
        answers = self.serve.ask_all([{"do": "gate", "now": now, **one} for one in [*messages, request]])
        poses = [message for message in messages if message["what"] == "pose"]
        self.pose = poses[-1]["position"] if poses else self.pose
        if any(answer["answer"] == "hold" for answer in answers):
            self.tell("hold")
        return now, answers[-1]

    def ask(self, phase, place, turn=DOWN, frame=FRAME):
        """Whether it was sent."""
        if not all(map(math.isfinite, (*place, *turn))):  # JSON has no word for it
            place, turn = [1e300 if not math.isfinite(a) else a for a in place], DOWN
        now, answer = self.gate(what="permit", phase=phase, frame=frame, position=list(place), quaternion=list(turn))
        self.counts["asked"] += 1
        self.counts[answer["answer"]] += 1
        if answer["answer"] == "go":
            message = self.stamped(self.link.kind, place, turn)
            message.header.stamp, message.header.frame_id = self.rospy.Time.from_sec(now), frame
            self.phases[f"{message.header.stamp.to_sec():.6f}"] = phase
            self.servo.publish(message)
            self.sent, self.sent_s = list(place), now
        return answer["answer"] == "go"

    def step(self, phase, goal):
        speed = 0.030 if phase == "air" else 0.005
        if self.dice.random() < self.mischief / 4:
            time.sleep(self.dice.uniform(0.0, 0.2))
        self.due = max(self.due + TICK_S, time.time() - 0.02)
        time.sleep(max(0.0, self.due - time.time()))
        greed = self.dice.uniform(0.5, 1.5) if self.dice.random() < self.mischief else 0.9
        away = [a - b for a, b in zip(goal, self.sent)]
        far = math.hypot(*away)
        share = min(1.0, greed * speed * min(AGE_S if greed < 1 else 1.0, time.time() - self.sent_s) / far) if far > 0 else 1.0
        place, turn, frame = [a + share * b for a, b in zip(self.sent, away)], DOWN, FRAME
        if self.dice.random() < self.mischief:
            kind = self.dice.randrange(5)
            if kind == 0:
                place[self.dice.randrange(3)] += self.dice.choice(NONSENSE)
            elif kind == 1:
                turn = [self.dice.gauss(0, 1) for _ in range(4)]
                turn = [a / math.hypot(*turn) for a in turn]
            elif kind == 2:
                turn = (0.0, 0.0, 0.0, 0.0)
            elif kind == 3:
                frame = self.dice.choice(["", "world", "PSM2_base"])
            else:
                phase = self.dice.choice(["air", "search", "press", "retract"])
        return self.ask(phase, place, turn, frame)

    def go(self, phase, goal):
        while self.counts["asked"] < COUNT and math.dist(self.sent, goal) > 1e-9:
            if not self.step(phase, goal):
                return False
        return True

    def touch(self):
        self.mischief = self.dice.choice([0.0, 0.0, 0.0003, 0.003, 0.05, 0.5])
        stop = self.dice.choice(self.stops)
        x, y = stop["x"], stop["y"]
        now, answer = self.gate(what="begin", stop=stop["index"])
        if answer["answer"] == "go":
            self.sent, self.sent_s = list(self.pose), now
            self.phases = {}
            self.begun = {"place": [x, y, TISSUE_Z]}
            began = time.time()
            high = [[self.sent[0], self.sent[1], TISSUE_Z + 0.01], [x, y, TISSUE_Z + 0.01], [x, y, TISSUE_Z + STANDOFF_M]]
            is_low = self.sent[2] < TISSUE_Z + UNCERTAINTY_M
            if is_low:
                self.go("retract", [self.sent[0], self.sent[1], TISSUE_Z + 0.002])
            elif all(self.go("air", goal) for goal in high):
                self.go("search", [x, y, TISSUE_Z - 0.01])
                self.go("press", [x, y, self.sent[2] - INDENT_M - self.dice.choice([0.0, 0.0, 0.0015])])
                self.go("retract", [x, y, TISSUE_Z + STANDOFF_M])
            self.events.publish(json.dumps({"what": "begin", "at": began - 1e-4, "place": self.begun["place"], "phases": self.phases}))
            answer = self.gate(what="finish")[1]
        for _ in range(3 if answer["answer"] == "hold" else 0):  # nobody has looked
            self.ask(self.dice.choice(["air", "retract"]), self.pose or [0, 0, TISSUE_Z + 0.01])
        if answer["answer"] == "hold":
            while True:
                self.gate(what="watch")
                if self.serve.ask(do="acknowledge", now=time.time())["answer"] == "go":
                    break
                time.sleep(0.005)
            self.tell("acknowledged")

    def run(self):
        began = time.time()
        while self.counts["asked"] < COUNT:
            self.touch()
        time.sleep(0.5)
        return {**self.counts, "seconds": time.time() - began}


def player(folder):
    print(json.dumps(Player(random.Random(SEED), pathlib.Path(folder)).run()), flush=True)
    os._exit(0)


def main():
    with tempfile.TemporaryDirectory() as holder:
        world_of(PALPATE, pathlib.Path(holder))
        programs = Programs(PALPATE, ROOT, holder, 1)
        programs.master()
        try:
            arm = Arm(random.Random(SEED + 1))
            other = programs.start(sys.executable, __file__, PALPATE, ROOT, COUNT, SEED, holder, stdout=subprocess.PIPE)
            arm.run(other)
            said = other.stdout.read()
            time.sleep(0.5)
            counts = json.loads(said.splitlines()[-1])
            faults = faults_of(arm)
            print(f"{counts['asked']} asked in {counts['seconds']:.1f} s: {counts['go']} sent, {len(arm.heard)} recorded, {counts['hold']} answers hold, "
                  f"{len(arm.said)} poses said, {len(faults)} wrong", *faults[:10], sep="\n", flush=True)
            return 1 if faults or len(arm.heard) < 0.2 * COUNT or counts["hold"] == 0 else 0
        finally:
            programs.end()


if __name__ == "__main__":
    if len(sys.argv) > 5:
        player(sys.argv[5])
    code = main()
    sys.stdout.flush()
    os._exit(code)
