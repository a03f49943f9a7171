"""A simulated PSM on ROS 1: its topics, and those that switch its faults."""

import time

import rospy
from geometry_msgs.msg import PoseStamped, TransformStamped, TwistStamped, WrenchStamped
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState
from std_msgs.msg import Bool, Empty, Float64, String

from palpation_arm import wrist
from palpation_arm.crtk_link import pose_message, stamped_pose
from palpation_arm.messages import crtk_message

TICK_S = 0.01
SIMULATED_BEGIN_S = 1000.0
HEARD_WITHIN_S, POLL_S = 1.0, 0.0005  # in the machine's time


class SimulatedNode:
    """`speed`: of simulated time at most, whose /clock it keeps then (use_sim_time must be set); None: the machine's. The clock waits for who says on
    simulation/heard how far it has heard, so that a loaded machine makes nothing late."""

    def __init__(self, psm, name, frame, pose_kind="pose", speed=None):
        self.psm, self.name, self.frame, self.speed = psm, "/" + name.strip("/"), frame, speed
        self.kind = PoseStamped if pose_kind == "pose" else TransformStamped
        self.state, self.text = crtk_message("OperatingState"), crtk_message("StringStamped")
        self.commands, self.seconds, self.before = [], SIMULATED_BEGIN_S, psm.pose()[0]
        self.stamp = self.seconds if speed else time.time()  # of what was measured last
        self.topics = {topic: self.publisher(topic, kind) for topic, kind in {
            "measured_cp": self.kind, "setpoint_cp": self.kind, "measured_js": JointState, "setpoint_js": JointState, "measured_cv": TwistStamped,
            "body/measured_cf": WrenchStamped, "probe/force": Float64, "probe/displacement": Float64, "goal_reached": Bool, "error": self.text,
            "warning": self.text}.items()}
        self.heard_s = None
        self.topics["operating_state"] = self.publisher("operating_state", self.state, latch=True)
        self.clock = rospy.Publisher("/clock", Clock, queue_size=1) if speed else None
        self.subscribe()
        self.tell_state(psm.condition())

    def publisher(self, topic, kind, latch=False):
        return rospy.Publisher(f"{self.name}/{topic}", kind, queue_size=10, latch=latch)

    def subscribe(self):
        """Commands wait for the next step: one thread moves the arm."""
        def on(topic, kind, act):
            rospy.Subscriber(f"{self.name}/{topic}", kind, lambda message: self.commands.append((act, message)), queue_size=10)

        psm = self.psm
        for topic, act in (("servo_cp", psm.servo_cp), ("move_cp", psm.move_cp)):
            on(topic, self.kind, lambda message, act=act: act(*(pose_message(message, 0.0)[key] for key in ("position", "quaternion"))))
        for topic, act in (("servo_jp", psm.servo_jp), ("move_jp", psm.move_jp)):
            on(topic, JointState, lambda message, act=act: act(list(message.position)) if len(message.position) == 6 else None)
        for topic, act in (("servo_jr", psm.servo_jp), ("move_jr", psm.move_jp)):
            on(topic, JointState, lambda message, act=act: act([a + b for a, b in zip(psm.setpoint_joints(), message.position)]))
        on("servo_cv", TwistStamped, lambda message: psm.servo_cv(*([part.x, part.y, part.z] for part in (message.twist.linear, message.twist.angular))))
        on("hold", Empty, lambda message: psm.hold())
        on("state_command", self.text, lambda message: psm.state_command(message.string))
        on("trajectory_j/set_ratio", Float64, lambda message: setattr(psm, "ratio", min(1.0, max(0.01, message.data))))
        rospy.Subscriber(f"{self.name}/simulation/heard", Float64, lambda message: setattr(self, "heard_s", message.data), queue_size=1)
        on("simulation/fault", String, lambda message: self.switch(message.data))

    def switch(self, fault):
        try:
            self.psm.set_fault(fault)
        except ValueError as error:
            rospy.logwarn(str(error))

    def run(self, faults=()):
        """Until ROS shuts down. `faults`: each with the second after the first command from which on it is there."""
        faults, begun, due = sorted(faults, key=lambda fault: fault[1]), None, time.monotonic()
        while not rospy.is_shutdown():
            due = max(due + TICK_S / (self.speed or 1.0), time.monotonic() - TICK_S)
            time.sleep(max(0.0, due - time.monotonic()))
            self.wait_until_heard()
            self.stamp = self.advance()
            begun = begun or (self.stamp if self.commands else None)
            while begun and faults and faults[0][1] <= self.stamp - begun:
                self.switch(faults.pop(0)[0])
            while self.commands:
                act, message = self.commands.pop(0)
                act(message)
            self.psm.step(TICK_S)
            self.tell(self.stamp)

    def wait_until_heard(self):
        until = time.monotonic() + HEARD_WITHIN_S
        while self.clock and self.heard_s is not None and self.heard_s < self.stamp - TICK_S / 2 and time.monotonic() < until:
            time.sleep(POLL_S)

    def advance(self):
        """The seconds of this step. A simulated clock is a step ahead of what was measured, so that no message is of the future."""
        if not self.clock:
            return time.time()
        self.seconds += TICK_S
        self.clock.publish(Clock(rospy.Time.from_sec(self.seconds)))
        return self.seconds - TICK_S

    def tell(self, seconds):
        pose, force = self.psm.told(seconds, self.frame)
        if self.psm.fault != "silence":
            self.tell_joints(seconds)
            self.tell_events()
        if pose is not None:
            self.send("measured_cp", stamped_pose(self.kind, pose["position"], pose["quaternion"]), pose["stamp"], pose["frame"])
        if force is not None:
            wrench = WrenchStamped()
            wrench.wrench.force.x, wrench.wrench.force.y, wrench.wrench.force.z = self.psm.wrench
            self.send("body/measured_cf", wrench, force["stamp"], self.name.strip("/") + "_tip")
            self.topics["probe/force"].publish(force["force"])
            self.topics["probe/displacement"].publish(force["force"] / self.psm.spring_n_per_m)

    def tell_joints(self, seconds):
        for topic, joints, speed in (("measured_js", self.psm.joints, self.psm.speed), ("setpoint_js", self.psm.setpoint_joints(), [0.0] * 6)):
            self.send(topic, JointState(name=wrist.NAMES, position=joints, velocity=speed, effort=[0.0] * 6), seconds)
        self.send("setpoint_cp", stamped_pose(self.kind, *wrist.pose_of(self.psm.setpoint_joints())), seconds, self.frame)
        place, twist = self.psm.pose()[0], TwistStamped()
        twist.twist.linear.x, twist.twist.linear.y, twist.twist.linear.z = [(a - b) / TICK_S for a, b in zip(place, self.before)]
        self.before = place
        self.send("measured_cv", twist, seconds, self.frame)

    def tell_events(self):
        events, self.psm.events = self.psm.events, []
        for name, what in events:
            if name == "operating_state":
                self.tell_state(what)
            elif name == "goal_reached":
                self.topics["goal_reached"].publish(bool(what))
            else:
                self.send(name, self.text(string=what), self.stamp)

    def tell_state(self, condition):
        self.send("operating_state", self.state(**condition), self.stamp)

    def send(self, topic, message, seconds, frame=""):
        message.header.stamp, message.header.frame_id = rospy.Time.from_sec(seconds), frame
        self.topics[topic].publish(message)
