"""A simulated arm without ROS, under simulated time: what the driver moves in tests, and where ROS is not installed."""

TICK_S = 0.01


class InProcess:
    def __init__(self, psm, frame):
        self.psm, self.frame, self.seconds = psm, frame, 1.0
        self.messages = []
        self.held_s, self.sent = None, []  # when it was told to hold; when set points came
        self.most_n = 0.0

    def now(self):
        return self.seconds

    def wait(self):
        self.psm.step(TICK_S)
        self.seconds += TICK_S
        self.most_n = max(self.most_n, abs(self.psm.force_n))
        pose, force = self.psm.told(self.seconds, self.frame)
        self.messages += [message for message in (pose, force) if message]
        if self.psm.fault != "silence":
            self.messages.append({"what": "state", "stamp": self.seconds, **self.psm.condition()})
            self.messages += [{"what": "failure", "words": f"goal_reached({reached})"} for name, reached in self.psm.events if name == "goal_reached" and not reached]
        self.psm.events.clear()

    def heard(self):
        messages, self.messages = self.messages, []
        return messages

    def send(self, set_point):
        self.sent.append(self.seconds)
        self.psm.servo_cp(set_point["position"], set_point["quaternion"])

    def hold(self):
        self.held_s = self.held_s or self.seconds
        self.psm.hold()
