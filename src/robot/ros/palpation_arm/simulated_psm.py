"""A PSM without hardware: its states, motions and limits as dVRK 2.4 has them, and a force from the tissue under it. It knows no ROS and has no clock.

servo: the newest set point wins, without a check of jumps. move: a bounded queue, in order; joints are clipped silently. A pose that no joints reach
sends goal_reached(false). State commands follow CRTK's table; one that is invalid changes nothing and warns. What happened is in `events`.
"""

import collections
import math
import random

from palpation_arm import wrist
from palpation_arm.poses import norm, plus, rotate

AFTER = {  # (state, command): state; the same as in include/palpation/robot/crtk.h
    ("DISABLED", "enable"): "ENABLED", ("DISABLED", "disable"): "DISABLED", ("DISABLED", "unhome"): "DISABLED",
    ("ENABLED", "enable"): "ENABLED", ("ENABLED", "disable"): "DISABLED", ("ENABLED", "pause"): "PAUSED", ("ENABLED", "home"): "ENABLED",
    ("ENABLED", "unhome"): "ENABLED",
    ("PAUSED", "disable"): "DISABLED", ("PAUSED", "pause"): "PAUSED", ("PAUSED", "resume"): "ENABLED", ("PAUSED", "unhome"): "PAUSED",
    ("FAULT", "disable"): "DISABLED", ("FAULT", "unhome"): "FAULT",
}
FAULTS = ["stale_pose", "stale_force", "silence", "frame_change", "stamp_zero", "not_a_number", "zero_quaternion", "state_fault", "unhomed", "ik_failure",
          "clipped_joints", "stuck_force"]
LONGEST_QUEUE = 10


class SimulatedPsm:
    """`tissue`: of tissue.py, or None. `noise`: of a touch's stiffness, N/mm; that of a force sample is 1 mN."""

    def __init__(self, tissue=None, noise=0.0, seed=1, joints=None, spring_n_per_m=80.0):
        self.tissue, self.noise, self.spring_n_per_m = tissue, noise, spring_n_per_m
        self.dice = random.Random(seed)
        self.joints, self.goal, self.velocity = list(joints or [0.0] * 6), None, None
        self.state, self.is_homed, self.is_busy = ("ENABLED", True, False) if joints else ("DISABLED", False, False)
        self.moves, self.ratio, self.is_homing, self.is_moving = collections.deque(), 1.0, False, False
        self.fault, self.fault_yaw, self.events = "none", None, []
        self.speed, self.force_n, self.touch_noise, self.normal = [0.0] * 6, 0.0, None, [0.0, 0.0, 1.0]
        self.wrench = [0.0] * 3  # the force of the tissue on the tip, as the sensor says, in the tip's frame
        self.feel()

    # Commands

    def is_ready(self):
        if self.state == "ENABLED" and self.is_homed and not self.is_homing:
            return True
        self.events.append(("warning", "a motion is asked for, and the arm is not ready"))
        return False

    def state_command(self, command):
        after = AFTER.get((self.state, command))
        if after is None:
            return self.events.append(("warning", f"{command} is invalid in {self.state}"))
        if after != "ENABLED" or command in ("enable", "resume"):
            self.stop()
        self.state = after
        if command == "home" and not self.is_homed:
            self.moves.append([0.0] * 6)
            self.is_homing = True
        if command == "unhome":
            self.is_homed = False
        self.is_busy = bool(self.moves)
        return self.events.append(("operating_state", self.condition()))

    def set_fault(self, name):
        """Throws ValueError for one that does not exist; "none" ends it, and what it did to the state stays."""
        if name not in [*FAULTS, "none"]:
            raise ValueError(f"fault {name!r}: must be none or one of {', '.join(FAULTS)}")
        self.fault, self.fault_yaw = name, self.joints[0] - 0.06
        if name == "state_fault":
            self.stop()
            self.state = "FAULT"
        if name == "unhomed":
            self.stop()
            self.is_homed = False
        if name in ("state_fault", "unhomed"):
            self.events += [("error", name), ("operating_state", self.condition())]

    def stop(self):
        was_busy, self.is_busy = self.is_busy, False
        self.moves.clear()
        self.goal, self.velocity, self.is_homing, self.is_moving = None, None, False, False
        if was_busy:
            self.events.append(("operating_state", self.condition()))

    def hold(self):
        self.stop()

    def reached(self, joints):
        """None, and said so, where inverse kinematics fail: without any transition of busy."""
        if joints is None or self.fault == "ik_failure":
            self.events += [("error", "inverse kinematics have no answer"), ("goal_reached", False), ("operating_state", self.condition())]
            return None
        return wrist.clipped(joints)

    def servo_cp(self, position, quaternion):
        self.servo_jp(wrist.joints_of(position, quaternion))

    def servo_jp(self, joints):
        if self.is_ready() and (goal := self.reached(joints)) is not None:
            self.stop()
            self.goal = goal

    def servo_cv(self, linear, angular):
        """Of the tip, in the base frame: until the next command."""
        if self.is_ready():
            self.stop()
            self.velocity = (linear, angular)

    def move_cp(self, position, quaternion):
        self.move_jp(wrist.joints_of(position, quaternion))

    def move_jp(self, joints):
        if not self.is_ready() or (goal := self.reached(joints)) is None:
            return
        if len(self.moves) >= LONGEST_QUEUE:
            return self.events.append(("warning", "too many moves are waiting"))
        self.goal = None
        self.moves.append(goal)
        self.is_busy = True
        return self.events.append(("operating_state", self.condition()))

    # Time

    def step(self, seconds):
        before = self.joints
        if self.velocity:
            self.goal = self.carried(seconds)
        if self.state == "ENABLED" and self.moves:
            if self.is_moving and self.joints == self.moves[0]:  # a step later, so that who listens sees that it was busy
                self.arrive()
            self.is_moving = bool(self.moves)
            if self.moves:
                self.joints = wrist.together(self.joints, self.moves[0], seconds, self.ratio)
        elif self.state == "ENABLED" and (self.goal or self.fault == "clipped_joints"):
            goal = list(self.goal or self.joints)
            if self.fault == "clipped_joints":  # somebody else's limit
                goal[0] = self.fault_yaw
            self.joints = wrist.towards(self.joints, goal, seconds)
        self.speed = [(after - now) / seconds for after, now in zip(self.joints, before)]
        self.feel()

    def carried(self, seconds):
        """Joints where the velocity leads to in that time; those that are, where none are."""
        (linear, angular), (position, quaternion) = self.velocity, self.pose()
        rate = norm(angular)
        turn = [math.sin(rate * seconds / 2) / rate * a for a in angular] + [math.cos(rate * seconds / 2)] if rate > 0 else [0.0, 0.0, 0.0, 1.0]
        return wrist.joints_of(plus(position, linear, seconds), wrist.times(turn, quaternion)) or self.joints

    def arrive(self):
        self.moves.popleft()
        self.is_moving = False
        if self.moves:
            return
        self.is_busy = False
        if self.is_homing:
            self.is_homed, self.is_homing = True, False
        self.events += [("goal_reached", True), ("operating_state", self.condition())]

    def feel(self):
        """Elastic: stiffness at the foot times how deep the tip is along the normal."""
        height, stiffness = math.inf, 0.0
        if self.tissue is not None:
            height, self.normal, stiffness = self.tissue.below(self.pose()[0])
        if height >= 0.0:
            self.touch_noise = None
        elif self.touch_noise is None:
            self.touch_noise = self.noise * self.dice.gauss(0.0, 1.0)
        pressed_n = max(0.0, -1000 * height * (stiffness + self.touch_noise)) if height < 0.0 else 0.0
        self.force_n = pressed_n + 0.001 * self.dice.gauss(0.0, 1.0)
        if self.fault != "stuck_force":
            x, y, z, w = self.pose()[1]
            self.wrench = [self.force_n * a for a in rotate([-x, -y, -z, w], list(self.normal))]

    # What it says

    def pose(self):
        return wrist.pose_of(self.joints)

    def setpoint_joints(self):
        return self.moves[0] if self.moves else self.goal or self.joints

    def told(self, now, frame):
        """measured_cp and the force along the probe's axis as they go out at a time, faults and all; None for what does not."""
        position, quaternion = self.pose()
        stamp = 0.0 if self.fault == "stamp_zero" else now
        position = [math.nan, *position[1:]] if self.fault == "not_a_number" else position
        quaternion = [0.0] * 4 if self.fault == "zero_quaternion" else quaternion
        pose = {"what": "pose", "stamp": stamp, "frame": "world" if self.fault == "frame_change" else frame, "position": position, "quaternion": quaternion}
        force = {"what": "force", "stamp": stamp, "force": -self.wrench[2]}
        return (None if self.fault in ("stale_pose", "silence") else pose, None if self.fault in ("stale_force", "silence") else force)

    def condition(self):
        return {"state": self.state, "is_homed": self.is_homed, "is_busy": self.is_busy}

