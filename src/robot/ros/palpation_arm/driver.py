"""The paper's loop on an arm: in air to the approach pose, down along the normal until it touches, deeper by a constant indentation, a reading, back out.

Every set point is asked of the gate first, and all that the arm says is told to it. `arm` is what the loop moves (crtk_link.CrtkLink, in_process.InProcess):
wait() until the next hundredth of a second, now() in seconds, heard() since the last call (messages as the gate takes them), send(set_point), hold().
"""

import math

from palpation_arm.poses import dot, minus, norm, on_the_way, plus, turn_between
from palpation_arm.reading import Felt
from palpation_arm.serve import Gone, Refused
from palpation_arm.way import approach, rotation, stop_below, triple, way_to

SHARE = 0.9  # of the speeds that the gate permits
LONGEST_TICK_S = 0.02  # what was late is not made up for
LATE_S, TIMES_AS_LONG = 5.0, 4  # seconds and so many times the shortest time: then a motion is a failure
PHASES = {"air": "in the air", "search": "to the tissue", "press": "into the tissue", "retract": "out of the tissue"}
LISTEN_TICKS = 100
REST_S = 0.15  # at the indentation, while the reading is taken


class Held(Exception):
    """The gate holds, in words; nothing is sent until a person acknowledges."""


def sayable(message):
    """JSON has no word for a number that is none: the gate hears of it as a failure."""
    numbers = [number for value in message.values() for number in (value if isinstance(value, (list, tuple)) else [value]) if isinstance(number, float)]
    return message if all(map(math.isfinite, numbers)) else {"what": "failure", "words": f"a {message['what']} that is no number"}


class Driver:
    def __init__(self, serve, arm, kind="stiffness", say=print):
        self.serve, self.arm, self.kind, self.say = serve, arm, kind, say
        self.limits = serve.ask(do="gate", what="limits")
        self.plan, self.pose, self.sent, self.sent_s = None, None, None, 0.0
        self.contact, self.felt, self.is_at_rest, self.only_back = None, None, False, ""
        self.normal, self.has_force = None, False

    # The gate

    def gate(self, requests):
        """The last answer. Throws Held, and Gone, where the arm holds too, if there is none in time."""
        now = self.arm.now()
        try:
            answers = self.serve.ask_all([{"do": "gate", "now": now, **request} for request in requests])
        except Refused as refused:
            answers = self.serve.ask_all([{"do": "gate", "now": now, "what": "failure", "words": str(refused)}])
        except Gone:
            self.arm.hold()
            raise
        for request, answer in zip(requests, answers):
            self.learn(request, answer)
        return answers[-1]

    def learn(self, request, answer):
        if answer["answer"] == "hold":
            self.arm.hold()
            self.serve.ask(do="note", words=answer["words"])
            raise Held(answer["words"])
        if answer["answer"] == "retract":
            self.only_back = answer["words"]
        if request["what"] == "pose":
            self.pose = (request["position"], request["quaternion"])
        if request["what"] == "force":
            self.has_force = True
            if answer["touches"]:
                self.touches(request["force"])

    def touches(self, force_n):
        if self.contact is None:
            self.contact, self.felt = self.pose[0], Felt(self.kind)
        if self.felt is not None:
            self.felt.hear(dot(minus(self.contact, self.pose[0]), self.normal), force_n, self.is_at_rest)

    def tick(self):
        """The next hundredth of a second."""
        self.arm.wait()
        self.gate([*map(sayable, self.arm.heard()), {"what": "watch"}])

    def send(self, phase, pose):
        """What the gate answers; it is sent if that is go."""
        set_point = {"frame": self.limits["frame"], "position": pose[0], "quaternion": pose[1]}
        answer = self.gate([{"what": "permit", "phase": phase, **set_point}])["answer"]
        if answer == "go":
            self.arm.send(set_point)
            self.sent, self.sent_s = pose, self.arm.now()
        return answer

    # A touch

    def go(self, phase, goal):
        """Set points to a pose; True there, False where the gate permits no more of them (it touches, or the tip only goes back)."""
        speed = SHARE * self.limits["air_m_per_s" if phase == "air" else "contact_m_per_s"]
        turn = SHARE * self.limits["turn_rad_per_s"]
        begun = self.sent or self.pose
        least_s = norm(minus(goal[0], begun[0])) / speed + turn_between(begun[1], goal[1]) / turn
        until = self.arm.now() + LATE_S + TIMES_AS_LONG * least_s
        while True:
            self.tick()
            if self.arm.now() > until:
                self.gate([{"what": "failure", "words": f"the way {PHASES[phase]} takes more than {TIMES_AS_LONG} times as long as it may"}])
            elapsed = min(self.arm.now() - self.sent_s, LONGEST_TICK_S)
            step = min(speed * elapsed, SHARE * self.limits["step_m"])
            pose = on_the_way(self.sent or self.pose, goal, step, turn * elapsed)
            if self.send(phase, pose) != "go":
                return False
            if pose == (list(goal[0]), list(goal[1])):
                return True

    def begin(self, stop):
        self.tick()
        self.normal = triple(stop, "normal_")
        self.contact, self.felt, self.is_at_rest, self.only_back = None, None, False, ""
        self.gate([{"what": "begin", "stop": stop["index"]}])
        self.sent, self.sent_s = None, self.arm.now()

    def touch(self, stop):
        """A stop from the air to the air. What was felt is on the disk before the tip goes back."""
        self.begin(stop)
        if all(self.go("air", pose) for pose in way_to(self.plan, stop["index"], self.pose[0])):
            self.feel(stop)
        if self.only_back:
            self.say(f"stop {stop['index']}: {self.only_back}")
            self.serve.ask(do="miss", stop=stop["index"], why=self.only_back)
        self.back_out(stop)

    def feel(self, stop):
        far = 0.1  # metres: the gate ends a search
        if self.go("search", (plus(triple(stop), self.normal, -far), rotation(stop))) or self.only_back or self.contact is None:
            return
        indent = norm(minus(triple(stop), triple(stop, "indented_")))
        if not self.go("press", (plus(self.contact, self.normal, -indent), rotation(stop))):
            return
        reading = self.read()
        self.felt = None
        if reading is None:
            self.only_back = self.only_back or "what was felt is no reading"
            return
        answer = self.serve.ask(do="record", place=stop["place"], reading=reading, stop=stop["index"], t=self.arm.now())
        self.say(f"stop {stop['index']}: {reading:.4g} {Felt.KINDS[self.kind]}, {answer['open']} open")

    def read(self):
        """Waits for the gate to say that the tip has arrived (or to hold), then listens while it says so."""
        arrived_s = None
        while arrived_s is None or self.arm.now() - arrived_s < REST_S:
            self.tick()
            answer = self.gate([{"what": "reading"}])
            is_there = answer["answer"] == "go"
            if arrived_s is not None and not is_there:
                return None
            if is_there and arrived_s is None:
                arrived_s = self.arm.now()
                self.only_back = ""
                self.is_at_rest = True
            elif not is_there and self.arm.now() - self.sent_s > self.limits["settle_s"]:
                return None
        return self.felt.reading()

    def back_out(self, stop):
        """Along the normal until it is surely in the air, then up to the approach point."""
        above = approach(stop)
        height = min(self.limits["uncertainty_m"] + 0.0005, norm(minus(above[0], triple(stop))))
        if dot(minus((self.sent or self.pose)[0], triple(stop)), self.normal) < height:
            self.go("retract", (plus(triple(stop), self.normal, height), above[1]))
        if not self.only_back:
            self.go("air", above)
        else:
            self.go("retract", above)
        self.tick()
        self.gate([{"what": "finish"}])

    # A session

    def run(self, batches=None):
        """Plan after plan, until the session is finished; why. Throws Held; called again after an acknowledgement it goes on."""
        while batches is None or batches > 0:
            self.plan = self.serve.ask(do="next")
            if not self.plan["stops"]:
                return self.plan["finished"]
            self.listen()
            self.climb_out()
            for stop in self.plan["stops"]:
                if stop["state"] == "open":
                    self.touch(stop)
            batches = None if batches is None else batches - 1
        return "batches"

    def listen(self):
        """Until pose and force were heard, if they are: the gate says what is missing."""
        for _ in range(LISTEN_TICKS):
            self.tick()
            if self.pose is not None and self.has_force:
                return

    def climb_out(self):
        """Where a death or a hold left the tip in the tissue."""
        stop = stop_below(self.plan, self.pose[0]) if self.pose is not None else None
        if stop is not None:
            self.say(f"the tip is at stop {stop['index']}: back along its normal first")
            self.begin(stop)
            self.back_out(stop)

    def acknowledge(self):
        """A person has looked. Words where that is no reason to go on, else nothing."""
        self.arm.heard()  # what was said while the person looked
        for _ in range(20):
            self.arm.wait()
            now = self.arm.now()
            self.serve.ask_all([{"do": "gate", "now": now, **sayable(message)} for message in self.arm.heard()] or [{"do": "show"}])
        answer = self.serve.ask(do="acknowledge", now=self.arm.now())
        return "" if answer["answer"] == "go" else answer["words"]
