#!/usr/bin/env python3
"""Healthy tissue that reads noise alone, touched as `palpate plan` asks, with a goal of the search and without: how often a tumour is claimed.

usage: healthy_noise.py PALPATE [FIRST COUNT]        needs Debian's python3-numpy
COUNT loops of twelve plans from number FIRST on (0 8), every second one with a goal of 6 mm, and as many sets of 120 readings of which two or
three are of one place: a line each.
"""

import csv
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

PLANS, BATCHES = 12, {"initial": {"count": 16}, "batch": 10, "batches": 10}


def planned(palpate, folder, rows, goal_mm):
    """The area that is taken for tumour, mm2, the next waypoints, m, and what could hide, mm."""
    plan = BATCHES | ({"goal": {"max_undetected_diameter_mm": goal_mm}} if goal_mm else {})
    (folder / "scene.json").write_text(json.dumps({"surface": {"plane": {"size_mm": [40, 50], "vertices": [81, 101]}}, "plan": plan}))
    (folder / "felt.csv").write_text("x,y,z,reading,batch\n" + "".join(f"{x},{y},0,{reading},{batch}\n" for x, y, reading, batch in rows))
    felt = ["--measurements", folder / "felt.csv"] if rows else []
    subprocess.run([palpate, "plan", folder / "scene.json", *felt, "--out", folder / "out", "--overwrite", "--quiet"], check=True, capture_output=True)
    summary = json.loads((folder / "out" / "summary.json").read_text())
    stops = [] if summary["stop_reason"] else [(float(row["x"]), float(row["y"])) for row in csv.DictReader((folder / "out" / "waypoints.csv").open())]
    return summary["area_mm2"], stops, summary["nothing_wider_than_mm"]


def loop(palpate, folder, number, dice):
    rows, claimed, goal_mm = [], 0, 6 if number % 2 else 0
    for batch in range(PLANS):
        area_mm2, stops, hidden_mm = planned(palpate, folder, rows, goal_mm)
        claimed += area_mm2 > 0
        rows += [(x, y, 3 + 0.1 * dice.normal(), batch) for x, y in stops]
    return f"goal {goal_mm} mm: a tumour in {claimed} of {PLANS} plans; {len(rows)} touches, at the end {hidden_mm:.1f} mm could hide"


def felt_again(palpate, folder, number, dice):
    times = 2 + number % 2
    places = np.repeat(dice.uniform([0.0005, 0.0005], [0.0395, 0.0495], (120 // times, 2)), times, axis=0)
    area_mm2 = planned(palpate, folder, [(x, y, 3 + 0.1 * dice.normal(), 0) for x, y in places], 0)[0]
    return f"each of {120 // times} places felt {times} times: {area_mm2:.0f} mm2 of tumour"


if __name__ == "__main__":
    if len(sys.argv) not in (2, 4):
        sys.exit(__doc__)
    first, count = map(int, sys.argv[2:] or (0, 8))
    with tempfile.TemporaryDirectory() as folder:
        for number in range(first, first + count):
            for world in (loop, felt_again):
                print(f"{number:3d} {world(sys.argv[1], pathlib.Path(folder), number, np.random.default_rng([number, 79]))}", flush=True)
