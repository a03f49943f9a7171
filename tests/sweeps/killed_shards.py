#!/usr/bin/env python3
"""Shards of an experiment that are killed at random and started again give, added up, the bytes of one run in one piece.

usage: killed_shards.py [--shards N] [--kills N] [--seed N] [--threads N] PALPATE EXPERIMENT [OPTION ...]      (Python 3, standard library only)
such as: killed_shards.py --shards 8 --kills 20 build/ci/bin/palpate coverage --trials 4 --set plan.batches=2

Compares rows.csv, every table and what is printed. What is the machine's (times.csv, *_times.csv, tradeoff.csv and what is printed of times) is left out. Then a missing, a
doubled and a foreign shard must be refused by name.
"""

import argparse
import pathlib
import random
import re
import subprocess
import sys
import tempfile
import time

OF_THE_MACHINE = re.compile(r"(times|_times|tradeoff)\.csv$|\.png$")
TELLS_TIMES = {"curved", "tradeoff"}


def run(palpate, *arguments, code=0):
    result = subprocess.run([palpate, *map(str, arguments)], capture_output=True, text=True, stdin=subprocess.DEVNULL)
    if result.returncode != code:
        sys.exit(f"ended with {result.returncode}, not {code}: {arguments}\n{result.stdout}{result.stderr}")
    return result


def killed_run(palpate, arguments, chance, kills, longest_s):
    """Runs to the end, however often it is killed before; returns how often that was."""
    for killed in range(kills + 1):
        with subprocess.Popen([palpate, *map(str, arguments)], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as process:
            try:
                process.wait(chance.uniform(0.0, longest_s) if killed < kills else None)
                if process.returncode != 0:
                    sys.exit(f"ended with {process.returncode}: {arguments}\n{process.stderr.read()}")
                return killed
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
    return kills


def compare(whole, merged):
    names = sorted(path.name for path in whole.iterdir() if path.is_file())
    if names != sorted(path.name for path in merged.iterdir() if path.is_file()):
        sys.exit(f"other files: {names} and {sorted(path.name for path in merged.iterdir())}")
    compared = [name for name in names if not OF_THE_MACHINE.search(name)]
    different = [name for name in compared if (whole / name).read_bytes() != (merged / name).read_bytes()]
    if different or len(compared) < 3:
        sys.exit(f"different: {different}; compared: {compared}")
    return compared


def refuse_bad_shards(palpate, folders, other, merged):
    missing = run(palpate, "experiment", "merge", *folders[1:], "--out", merged, code=3).stderr
    doubled = run(palpate, "experiment", "merge", *folders, folders[0], "--out", merged, code=3).stderr
    foreign = run(palpate, "experiment", "merge", *folders[1:], other, "--out", merged, code=3).stderr
    for words, said in (("are missing", missing), ("is doubled", doubled), ("is not of the same experiment", foreign)):
        if words not in said:
            sys.exit(f"'{words}' is not said: {said}")
    if merged.exists():
        sys.exit("a refused merge left files")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("palpate", type=lambda text: pathlib.Path(text).resolve())
    parser.add_argument("--shards", type=int, default=8)
    parser.add_argument("--kills", type=int, default=16, help="at most, over all shards")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("experiment", nargs=argparse.REMAINDER)
    options = parser.parse_args()
    chance = random.Random(options.seed)
    command = ["experiment", *options.experiment, "--quiet", "--threads", options.threads]
    with tempfile.TemporaryDirectory() as holder:
        folder = pathlib.Path(holder)
        start = time.monotonic()
        words = run(options.palpate, *command, "--out", folder / "whole").stdout
        whole_s = time.monotonic() - start
        folders = [folder / f"shard{number}" for number in range(1, options.shards + 1)]
        killed = 0
        for number, shard in enumerate(folders, start=1):
            share = max(1, options.kills // options.shards)
            killed += killed_run(options.palpate, [*command, "--shard", f"{number}/{options.shards}", "--out", shard], chance, share, 1.2 * whole_s / options.shards)
        run(options.palpate, *command, "--first-seed", 500, "--shard", f"1/{options.shards}", "--out", folder / "other")
        refuse_bad_shards(options.palpate, folders, folder / "other", folder / "merged")
        chance.shuffle(folders)
        merged_words = run(options.palpate, "experiment", "merge", *folders, "--out", folder / "merged").stdout
        if options.experiment[0] not in TELLS_TIMES and words != merged_words:
            sys.exit("other words are printed of the same rows")
        compared = compare(folder / "whole", folder / "merged")
    print(f"{options.experiment[0]}: {options.shards} shards, killed {killed} times, added up: equal in {', '.join(compared)}")


if __name__ == "__main__":
    main()
