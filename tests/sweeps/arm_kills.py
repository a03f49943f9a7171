#!/usr/bin/env python3
"""kill -9 of driver, arm, ROS master and `palpate serve` in turn, at random moments of sessions over ROS 1, each started again where it died.

After each: what the driver said that it took is in the journal, with its value; nothing was taken twice; every plan that was handed out is still the
same. At a session's end: each of its plans is what `palpate plan` makes of the journal before it. Ends with 1 where any of it is not so.

usage: arm_kills.py PALPATE PROJECT_ROOT [KILLS [SEED]]        30 and 1; needs ROS 1 and numpy
"""

import json
import pathlib
import random
import re
import subprocess
import sys
import tempfile
import threading
import time

PALPATE, ROOT = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
sys.path.insert(0, str(ROOT / "tests" / "robot"))

from arm_programs import PATIENCE_S, Programs, wait_until  # noqa: E402
from arm_scene import STOPS, world_of  # noqa: E402

SPEED = 8
VICTIMS = ["driver", "arm", "master", "serve"]
SAID = re.compile(r"stop \d+: ([-+.e\d]+) N/mm")


def entries(session, kind):
    journal = session / "journal.jsonl"
    lines = journal.read_text(encoding="utf-8").splitlines() if journal.exists() else []
    return [entry for entry in (json.loads(line[17:]) for line in lines if line.endswith("}")) if entry["kind"] == kind]


class Run:
    """A session, from its first start to its end, whoever dies on the way."""

    def __init__(self, programs, session, dice):
        self.programs, self.session, self.dice = programs, session, dice
        self.said, self.plans, self.faults, self.held = [], {}, [], 0
        self.master, self.arm = programs.master(), programs.arm("--noise", 0.002)

    def start_driver(self):
        driver, lines = self.programs.driver(self.session), []
        listening = threading.Thread(target=lambda: lines.extend(driver.stdout), daemon=True)
        listening.start()
        return driver, lines, listening

    def victim_of(self, name, driver):
        if name == "serve":
            found = subprocess.run(["ps", "--ppid", str(driver.pid), "-o", "pid=,comm="], capture_output=True, text=True).stdout.split("\n")
            return next((int(line.split()[0]) for line in found if "palpate" in line), None)
        return {"driver": driver, "arm": self.arm, "master": self.master}[name].pid

    def go(self, victim):
        """Until the victim is dead, or the session at its end; whether it died."""
        driver, lines, listening = self.start_driver()
        # Before the first motion, in the middle of a touch, between two: wherever that is.
        wait_until(lambda: driver.poll() is not None or any(line.startswith("Plan ") for line in lines))
        begun = time.monotonic() + self.dice.uniform(0.0, 12.0)
        wait_until(lambda: driver.poll() is not None or time.monotonic() > begun)
        pid = self.victim_of(victim, driver) if driver.poll() is None else None
        if pid is not None:
            subprocess.run(["kill", "-9", str(pid)], check=False)
        try:
            code = driver.wait(timeout=PATIENCE_S)
        except subprocess.TimeoutExpired:
            self.faults.append(f"{victim} died, and the driver went on for {PATIENCE_S} s")
            driver.kill()
            code = driver.wait()
        listening.join(timeout=5)
        self.look(victim if pid else "nobody", code, lines)
        driver.stdout.close()
        return pid is not None, code == 0

    def look(self, victim, code, lines):
        self.held += any(line.startswith("HOLD") for line in lines)
        self.said += [float(word) for word in SAID.findall("".join(lines))]
        taken = entries(self.session, "reading")
        values = [float(f"{row['reading']:.4g}") for row in taken]
        lost = [value for value in set(self.said) if self.said.count(value) > values.count(value)]
        if lost:
            self.faults.append(f"{victim} died: lost {lost}")
        places = [tuple(row["place"]) for row in taken if row["stop"] is not None]
        stops = [(plan["plan"], *place) for plan in entries(self.session, "plan") for place in plan["stops"]]
        if len(places) != len(set(places)) or len(places) > len(stops):
            self.faults.append(f"{victim} died: taken twice")
        for plan in entries(self.session, "plan"):
            if self.plans.setdefault(plan["plan"], plan) != plan:
                self.faults.append(f"{victim} died: plan {plan['plan']} is another")
        if victim in ("arm", "master", "serve") and code == 0:
            self.faults.append(f"{victim} died, and the driver says that it is done")

    def revive(self, victim):
        if victim == "master":
            self.programs.end(self.master, self.arm)  # who was known to it is known to nobody
            self.master = self.programs.master()
        if victim in ("master", "arm"):
            self.programs.end(self.arm)
            self.arm = self.programs.arm("--noise", 0.002)

    def check_plans(self):
        for plan in [plan for plan in entries(self.session, "plan") if plan["stops"]]:
            export, out = (self.session.parent / f"{what}{plan['plan']}" for what in ("export", "plan"))
            words = ["session", self.programs.folder / "scene.json", self.session, "export", "--out", export, "--plan", plan["plan"]]
            for command in (words, ["plan", export / "scene.json", "--measurements", export / "measurements.csv", "--out", out]):
                subprocess.run([PALPATE, *map(str, command)], check=True, capture_output=True)
            if (out / "waypoints.csv").read_text(encoding="utf-8") != plan["waypoints"]:
                self.faults.append(f"plan {plan['plan']} is not what palpate plan makes of the journal before it")


def main():
    kills = int(sys.argv[3]) if len(sys.argv) > 3 else 30
    dice, killed, sessions, held, faults = random.Random(int(sys.argv[4]) if len(sys.argv) > 4 else 1), 0, 0, 0, []
    with tempfile.TemporaryDirectory() as holder:
        world_of(PALPATE, pathlib.Path(holder))
        while killed < kills:
            programs = Programs(PALPATE, ROOT, holder, SPEED)
            run, is_done = Run(programs, pathlib.Path(tempfile.mkdtemp(dir=holder)) / "session", dice), False
            try:
                while not is_done:
                    victim = VICTIMS[killed % len(VICTIMS)] if killed < kills else "nobody"
                    if victim == "nobody":
                        code = run.start_driver()[0].wait(timeout=PATIENCE_S)
                        run.look(victim, code, [])
                        is_done = True
                        continue
                    died, is_done = run.go(victim)
                    killed += died
                    run.revive(victim)
                if len(entries(run.session, "reading")) != STOPS:
                    run.faults.append(f"{len(entries(run.session, 'reading'))} of {STOPS} readings")
                run.check_plans()
            finally:
                programs.end()
            sessions, held, faults = sessions + 1, held + run.held, faults + run.faults
            print(f"{killed} killed, {sessions} sessions", *run.faults, sep="\n  ", flush=True)
    print(f"{killed} killed in {sessions} sessions, {held} holds: {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
