#!/usr/bin/env python3
"""Runs that are killed, interrupted, two at once, or on a full disk, at random moments, over a folder that holds a person's files and
an earlier run. After each: 0 files of the person changed, 0 folders that mix two runs, and after the next run 0 leftovers.

usage: sweep_files.py PALPATE [KILLS [SIGNALS [PAIRS [DISKS [SEED]]]]]        300 100 100 100 1 unless told; needs Python 3 and nothing else
Full disks are small tmpfs, which only root can mount: else they are left out, and that is said.
"""

import json
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

PATIENCE_S = 120
SCENE = {
    "surface": {"plane": {"size_mm": [20, 20], "vertices": [14, 14]}},
    "plan": {"initial": {"count": 9}, "batch": 4, "batches": 4},
    "probe": {"noise": 0.05, "tumours": [{"shape": "disk", "centre_mm": [10, 10, 0], "radius_mm": 4}]},
}
MINE = {"notes.txt": b"notes\n", "steps/step_mine.vtp": b"mine\n", "steps/readme": b"", "measurements.mine.csv": b"1\n", "log.json": b"{}\n"}
NOT_COMPARED = {"timings.json"}  # seconds
STAYS = "measurements.csv"  # until it is replaced
LEFT_OUT = "report.html"  # where the disk is full: said, and no reason to lose the run


class Sweep:
    def __init__(self, palpate, folder, dice):
        self.palpate, self.folder, self.dice = palpate, folder, dice
        self.scene = folder / "scene.json"
        self.scene.write_text(json.dumps(SCENE))
        self.measured = folder / "measured.csv"
        rows = [f"{0.001 * x},{0.001 * y},0,{9 if (x - 10) ** 2 + (y - 10) ** 2 < 16 else 7}.{(x * 7 + y * 3) % 10}" for x in range(2, 19, 4) for y in range(2, 19, 4)]
        self.measured.write_text("\n".join(["x,y,z,reading", *rows]) + "\n")
        given = ("--measurements", self.measured)
        self.runs = [("simulate", self.scene, "--seed", 1), ("simulate", self.scene, "--seed", 2, "--set", "plan.batches=2"), ("plan", self.scene, *given),
                     ("plan", self.scene, *given, "--seed", 3), ("boundary", self.scene, *given)]
        self.clean, self.seconds = [], 0.0
        for number, run in enumerate(self.runs):
            out = folder / f"clean{number}"
            start = time.monotonic()
            ended = subprocess.run(self.command(run, out), stdin=subprocess.DEVNULL, capture_output=True, timeout=PATIENCE_S)
            assert ended.returncode == 0, ended.stderr
            self.seconds = max(self.seconds, time.monotonic() - start)
            self.clean.append(self.files_of(out))
        self.counts = {"changed": 0, "mixed": 0, "leftovers": 0, "refused": 0}
        self.examples = []

    def command(self, run, out):
        return [str(word) for word in (self.palpate, *run, "--out", out, "--quiet", "--overwrite")]

    @staticmethod
    def files_of(folder):
        return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}

    def fault(self, kind, words):
        self.counts[kind] += 1
        self.examples.append(f"{kind}: {words}")

    def prepare(self, out):
        """A person's files, and mostly an earlier run."""
        for name, content in MINE.items():
            path = out / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)
        if self.dice.random() < 0.7:
            self.finish(self.dice.choice(self.runs), out)

    def start(self, run, out):
        return subprocess.Popen(self.command(run, out), stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)

    def finish(self, run, out):
        return subprocess.run(self.command(run, out), stdin=subprocess.DEVNULL, capture_output=True, timeout=PATIENCE_S)

    def is_of(self, name, content, number):
        return name in NOT_COMPARED or self.clean[number].get(name) == content

    def check(self, out, what):
        """The person's files, and that a folder with a summary holds one whole run."""
        there = self.files_of(out)
        for name, content in MINE.items():
            if there.get(name) != content:
                self.fault("changed", f"{what}: {name}")
        if "summary.json" not in there:
            return
        # A plan and a boundary on the same readings have the same summary.
        faults = [self.faults_against(number, there) for number, files in enumerate(self.clean) if files["summary.json"] == there["summary.json"]]
        if not faults or all(faults):
            self.fault("mixed", f"{what}: {faults[0] if faults else 'a summary of no run'}")

    def faults_against(self, number, there):
        """What is not as this run alone would have left it."""
        clean = self.clean[number]
        wrong = [f"{name} is of another run" for name, content in there.items() if name in clean and name != "run.json" and not self.is_of(name, content, number)]
        wrong += [f"{name} is missing" for name in clean if name not in there and name != LEFT_OUT]
        wrong += [f"{name} is another's" for name in there if name not in clean and name != STAYS and any(name in files for files in self.clean)]
        return wrong

    def test_itself(self):
        """A sweep that cannot accuse is worse than none."""
        there = self.clean[0] | MINE
        assert not self.faults_against(0, there)
        assert self.faults_against(0, there | {"waypoints.csv": self.clean[1]["waypoints.csv"]})
        assert self.faults_against(0, {name: content for name, content in there.items() if name != "trace.csv"})
        assert self.faults_against(0, there | {LEFT_OUT: b"of another run"})
        assert self.faults_against(0, there | {"readings_used.csv": self.clean[2]["readings_used.csv"]})

    def check_next(self, out, what):
        number = self.dice.randrange(len(self.runs))
        ended = self.finish(self.runs[number], out)
        if ended.returncode != 0:
            self.fault("refused", f"{what}: {ended.stderr.decode()}")
            return
        there = self.files_of(out)
        self.check(out, what + ", next run")
        left = set(there) - set(self.clean[number]) - set(MINE) - {STAYS}
        folders = {str(path.relative_to(out)) for path in out.rglob("*") if path.is_dir()} - {"steps"}
        if left or folders:
            self.fault("leftovers", f"{what}: {left} {folders}")

    def end_by(self, number, out, what):
        self.prepare(out)
        run = self.start(self.dice.choice(self.runs), out)
        time.sleep(self.dice.uniform(0.0, 1.2 * self.seconds))
        run.send_signal(number)
        run.communicate(timeout=PATIENCE_S)
        # A signal that comes before the program looks for it ends it as it ends any program.
        if run.returncode not in (0, 130, -number):
            self.fault("refused", f"{what}: ended with {run.returncode}")
        self.check(out, what)
        self.check_next(out, what)

    def pair(self, out, what):
        self.prepare(out)
        runs = []
        for _ in range(2):
            runs.append(self.start(self.dice.choice(self.runs), out))
            time.sleep(self.dice.uniform(0.0, 0.5 * self.seconds))
        words = [run.communicate(timeout=PATIENCE_S)[1].decode() for run in runs]
        for run, said in zip(runs, words):
            if run.returncode not in (0, 4) or (run.returncode == 4 and "is writing there" not in said):
                self.fault("refused", f"{what}: {run.returncode} {said}")
        if all(run.returncode == 4 for run in runs):
            self.fault("refused", f"{what}: both")
        self.check(out, what)
        self.check_next(out, what)

    def full_disk(self, disk, what):
        size_kb = self.dice.choice([0, 4, 8, 16]) + int(2 ** self.dice.uniform(3, 9))
        subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size_kb}k", "tmpfs", disk], check=True)
        try:
            out = disk / "out"
            for name, content in MINE.items():
                (out / name).parent.mkdir(parents=True, exist_ok=True)
                (out / name).write_bytes(content)
            for _ in range(3):
                ended = self.finish(self.dice.choice(self.runs), out)
                said = ended.stderr.decode()
                if ended.returncode not in (0, 4) or (ended.returncode == 4 and not any(words in said for words in ("No space left", "not written", "cannot write", "cannot make"))):
                    self.fault("refused", f"{what}: {ended.returncode} {said}")
                self.check(out, what)
            subprocess.run(["mount", "-o", "remount,size=64m", disk], check=True)
            self.check_next(out, what)
        except OSError:
            pass  # too small for the person's own files
        finally:
            subprocess.run(["umount", disk], check=True)

    def times(self, count, name, trial):
        start = time.monotonic()
        for number in range(count):
            out = self.folder / "out"
            trial(out, f"{name} {number}")
            shutil.rmtree(out, ignore_errors=True)
        if count:
            print(f"{name}: {count} times, {time.monotonic() - start:.0f} s", flush=True)


def can_mount(folder):
    disk = folder / "disk"
    disk.mkdir()
    try:
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=64k", "tmpfs", disk], capture_output=True).returncode == 0
    except FileNotFoundError:
        return None
    if not mounted:
        return None
    subprocess.run(["umount", disk], check=True)
    return disk


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    kills, signals, pairs, disks, seed = [int(word) for word in sys.argv[2:]] + [300, 100, 100, 100, 1][len(sys.argv) - 2:]
    with tempfile.TemporaryDirectory() as holder:
        folder = pathlib.Path(holder).resolve()
        program = pathlib.Path(shutil.copy(sys.argv[1], folder))  # away from palpate-draw: pictures take their time
        sweep = Sweep(program, folder, random.Random(seed))
        sweep.test_itself()
        print(f"a run takes up to {sweep.seconds:.2f} s", flush=True)
        sweep.times(kills, "killed", lambda out, what: sweep.end_by(signal.SIGKILL, out, what))
        sweep.times(signals, "terminated", lambda out, what: sweep.end_by(sweep.dice.choice([signal.SIGTERM, signal.SIGTERM, signal.SIGHUP, signal.SIGINT]), out, what))
        sweep.times(pairs, "two at once", sweep.pair)
        disk = can_mount(folder) if disks else None
        if disk:
            sweep.times(disks, "full disk", lambda out, what: sweep.full_disk(disk, what))
        elif disks:
            print("full disk: left out, no tmpfs can be mounted here")
    print("; ".join(f"{count} {kind}" for kind, count in sweep.counts.items()))
    print("\n".join(sweep.examples[:20]))
    sys.exit(1 if any(sweep.counts.values()) else 0)


if __name__ == "__main__":
    main()
