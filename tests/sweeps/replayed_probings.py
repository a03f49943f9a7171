#!/usr/bin/env python3
"""Recorded probings of curved phantoms and tissue, replayed with no option but the mesh and its unit: what `palpate replay` says ends where.

usage: replayed_probings.py PALPATE FOLDER [SEEDS]        needs Debian's python3-numpy and python3-scipy
FOLDER holds probing_ridge.csv (110 touches), probing_small_balls.csv (50) and probing_pig_liver.csv (110). Of each and of SEEDS seeds (5) a line:
the Dice coefficient of what is found and where the logarithm of the recorded readings, interpolated, lies above the middle of its median and
its greatest; which part of the tissue lies on the other side of that surely, beyond the band; areas; and what may have been left open.
"""

import csv
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np
from scipy.interpolate import LinearNDInterpolator

TOUCHES = {"probing_ridge": 110, "probing_small_balls": 50, "probing_pig_liver": 110}
INITIAL, BATCH = 5, 10


def rows_of(path):
    with path.open() as file:
        return list(csv.DictReader(file))


def columns(rows, names):
    return np.array([[float(row[name]) for name in names] for row in rows])


def replayed(palpate, folder, touches, seed):
    """Summary and the tissue's vertices."""
    scene = {"surface": {"mesh": "tissue.ply", "unit": "mm"}, "plan": {"batches": (touches - INITIAL) // BATCH}, "seed": seed}
    (folder / "scene.json").write_text(json.dumps(scene))
    for command in (["replay", folder / "scene.json", "--recording", folder / "readings.csv", "--out", folder / "out", "--overwrite", "--quiet"],
                    ["export", folder / "out", "--for", "csv", "--out", folder / "csv", "--overwrite"]):
        subprocess.run([palpate, *command], check=True, capture_output=True)
    return json.loads((folder / "out" / "summary.json").read_text()), rows_of(folder / "csv" / "tissue.csv")


def main(palpate, recordings, seeds):
    for name, touches in TOUCHES.items():
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            for command in (["readings", recordings / f"{name}.csv", "--out", folder / "readings.csv"],
                            ["mesh", "surface", "--points", folder / "readings.csv", "--gap", "8", folder / "tissue.ply"]):
                subprocess.run([palpate, *command], check=True, capture_output=True)
            felt = [row for row in rows_of(folder / "readings.csv") if row["reading"]]
            log = np.log(columns(felt, ["reading"])[:, 0])
            between = LinearNDInterpolator(1e3 * columns(felt, ["x", "y"]), log)
            for seed in range(1, seeds + 1):
                summary, tissue = replayed(palpate, folder, touches, seed)
                here = between(columns(tissue, ["x [mm]", "y [mm]"]))
                felt_here = ~np.isnan(here)
                stiff = (here > (np.median(log) + log.max()) / 2)[felt_here]
                score = columns(tissue, ["score"])[felt_here, 0]
                found = score >= 0
                band = summary["band"]["score"] if summary["band"] else np.inf
                surely_wrong = np.mean(np.where(stiff, score < -band, score > band))
                dice = 2 * np.sum(stiff & found) / max(np.sum(stiff) + np.sum(found), 1)
                probability = [f"{part['probability']:.2f}" for part in summary["parts"]]
                print(f"{name:20s} seed {seed}  Dice {dice:.2f}  surely wrong {surely_wrong:6.2%}  found {summary['area_mm2'] or 0:6.1f} mm2, "
                      f"expected wrong {summary['expected_error_mm2'] or 0:6.1f}  parts' probability {', '.join(probability)}  "
                      f"transform {summary['transform']}{' or the other' if summary['transform_is_open'] else ''}", flush=True)


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    main(sys.argv[1], pathlib.Path(sys.argv[2]), int(sys.argv[3]) if len(sys.argv) > 3 else 5)
