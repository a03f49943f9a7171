"""An arm through CRTK, as the driver moves it: what it says as messages for the gate, set points as servo_cp.

Under ROS 1 by rospy or crtk.ral; under ROS 2 by crtk.ral, which is untested.
"""

import collections
import math
import threading
import time

from geometry_msgs.msg import PoseStamped, TransformStamped, WrenchStamped
from std_msgs.msg import Bool, Empty, Float64

from palpation_arm.messages import crtk_message

TICK_S = 0.01
MOST_MESSAGES = 10000  # that wait while a plan is made: the oldest are dropped
CLOCK_STANDS_S = 5.0
MESSAGE_WITHIN_S, POLL_S = 0.05, 0.0005  # under a simulated clock, in the machine's time
MASTER_EVERY_S = 0.02
CONNECTED_WITHIN_S = 10.0
A_DAY_S = 86400.0  # so far from the machine's is a simulated clock


def pose_message(stamped, stamp):
    inner = stamped.pose if hasattr(stamped, "pose") else stamped.transform
    place, turn = (inner.position, inner.orientation) if hasattr(stamped, "pose") else (inner.translation, inner.rotation)
    return {"what": "pose", "stamp": stamp, "frame": stamped.header.frame_id, "position": [place.x, place.y, place.z],
            "quaternion": [turn.x, turn.y, turn.z, turn.w]}


def stamped_pose(kind, position, quaternion):
    stamped = kind()
    inner = stamped.pose if kind is PoseStamped else stamped.transform
    place, turn = (inner.position, inner.orientation) if kind is PoseStamped else (inner.translation, inner.rotation)
    place.x, place.y, place.z = position
    turn.x, turn.y, turn.z, turn.w = quaternion
    return stamped


class CrtkLink:
    """`force`: ("wrench", topic): minus z of a WrenchStamped in the tip's frame; ("newtons", topic): a Float64; ("spring", topic, N/m): a displacement in
    metres as a Float64, by Hooke's law. What has no stamp has that of its arrival. `ping` throws where the ROS master is gone."""

    def __init__(self, ral, pose_kind="pose", force=("wrench", "body/measured_cf"), ping=None):
        self.ral, self.kind = ral, PoseStamped if pose_kind == "pose" else TransformStamped
        self.queue = collections.deque(maxlen=MOST_MESSAGES)
        self.due, self.clock = time.monotonic(), (0.0, time.monotonic())
        self.servo = ral.publisher("servo_cp", self.kind, queue_size=1)
        self.has_heard, self.newest_s = ral.publisher("simulation/heard", Float64, queue_size=1), {"pose": 0.0, "force": 0.0}
        self.holding = ral.publisher("hold", Empty, queue_size=1)
        ral.subscriber("measured_cp", self.kind, lambda message: self.say(pose_message(message, ral.to_sec(message))))
        ral.subscriber("operating_state", crtk_message("OperatingState"), self.hear_state, latch=True)
        ral.subscriber("goal_reached", Bool, lambda message: message.data or self.say({"what": "failure", "words": "goal_reached(false)"}))
        ral.subscriber("error", crtk_message("StringStamped"), lambda message: self.say({"what": "failure", "words": message.string}))
        self.listen_to_force(*force)
        ral.spin()
        self.wait_for_all()
        if ping is not None:
            threading.Thread(target=self.watch_master, args=(ping,), daemon=True).start()

    def wait_for_all(self):
        """Throws ValueError, with what is not there, where the arm does not say all that is needed, or nobody listens."""
        until = time.monotonic() + CONNECTED_WITHIN_S
        while True:
            missing = sorted({"pose", "force", "state"} - {message["what"] for message in list(self.queue)})
            missing += [] if self.is_connected() else ["one who listens to servo_cp"]
            if not missing:
                return
            if time.monotonic() > until:
                raise ValueError(f"the arm in {self.ral.namespace()}: after {CONNECTED_WITHIN_S:g} s there is no {', '.join(missing)}")
            time.sleep(TICK_S)

    def listen_to_force(self, kind, topic, spring_n_per_m=1.0):
        if kind == "wrench":
            self.ral.subscriber(topic, WrenchStamped, lambda message: self.say({"what": "force", "stamp": self.ral.to_sec(message), "force": -message.wrench.force.z}))
        else:
            factor = spring_n_per_m if kind == "spring" else 1.0
            self.ral.subscriber(topic, Float64, lambda message: self.say({"what": "force", "stamp": self.now(), "force": factor * message.data}))

    def hear_state(self, message):
        self.say({"what": "state", "stamp": self.ral.to_sec(message), "state": message.state, "is_homed": message.is_homed, "is_busy": message.is_busy})

    def watch_master(self, ping):
        """Topics outlive their master, and nobody new hears of anything: that is a fault, too."""
        while not self.ral.is_shutdown():
            try:
                ping()
            except Exception as error:
                self.say({"what": "failure", "words": str(error)})
            time.sleep(MASTER_EVERY_S)

    def say(self, message):
        self.queue.append(message)

    def now(self):
        return self.ral.to_sec(self.ral.now())

    def wait(self):
        """By the machine's clock. A simulated one waits for who says how far it has heard, and may stand still, which is a fault."""
        if self.is_simulated():
            self.has_heard.publish(Float64(data=min(self.newest_s.values())))
            until = time.monotonic() + MESSAGE_WITHIN_S
            while time.monotonic() < until and not self.has_news():
                time.sleep(POLL_S)
        else:
            self.due = max(self.due + TICK_S, time.monotonic() - TICK_S)
            time.sleep(max(0.0, self.due - time.monotonic()))
        if self.now() != self.clock[0]:
            self.clock = (self.now(), time.monotonic())
        elif time.monotonic() - self.clock[1] > CLOCK_STANDS_S:
            self.say({"what": "failure", "words": "time stands still"})

    def heard(self):
        """All that came. What is ahead of a simulated clock, which comes by a topic of its own, waits until that has come, too."""
        now, messages = self.now(), []
        while self.queue and not (self.is_simulated() and self.queue[0].get("stamp", now) > now):
            messages.append(self.queue.popleft())
        for message in messages:
            if message["what"] in self.newest_s:
                self.newest_s[message["what"]] = message["stamp"]
        return messages

    def has_news(self):
        """Of pose and force both."""
        now = self.now()
        return {"pose", "force"} <= {message["what"] for message in list(self.queue) if message.get("stamp", math.inf) <= now}

    def is_simulated(self):
        return abs(self.now() - time.time()) > A_DAY_S

    def send(self, set_point):
        stamped = stamped_pose(self.kind, set_point["position"], set_point["quaternion"])
        stamped.header.frame_id = set_point["frame"]
        self.servo.publish(self.ral.set_timestamp(stamped))

    def hold(self):
        self.holding.publish(Empty())

    def is_connected(self):
        return self.servo.get_num_connections() > 0 if hasattr(self.servo, "get_num_connections") else self.servo.get_subscription_count() > 0
