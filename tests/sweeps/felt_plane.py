"""A plane of tissue that was felt at some places, concluded by `palpate boundary`."""

import collections
import csv
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np
import shapely.affinity
import shapely.wkt
from shapely.geometry import LineString


def concluded(palpate, folder, size_mm, vertices, at_mm, readings, sessions=None):
    """The summary; the other files lie in folder/out. size_mm, vertices: of the plane, two each; at_mm: a row a place; sessions: of each."""
    (folder / "scene.json").write_text(json.dumps({"surface": {"plane": {"size_mm": list(size_mm), "vertices": list(vertices)}}}))
    sessions = [0] * len(readings) if sessions is None else sessions
    rows = [f"{x / 1e3},{y / 1e3},0,{reading},{session}\n" for (x, y), reading, session in zip(at_mm, readings, sessions)]
    (folder / "felt.csv").write_text("x,y,z,reading,session\n" + "".join(rows))
    subprocess.run([palpate, "boundary", folder / "scene.json", "--measurements", folder / "felt.csv", "--out", folder / "out", "--overwrite", "--quiet"],
                   check=True, capture_output=True)
    return json.loads((folder / "out" / "summary.json").read_text())


def between_vertices(field, size_mm, at_mm):
    """A field on the plane's grid of vertices, rows of x, bilinear."""
    count = np.array(field.shape[::-1])
    cells = at_mm / np.array(size_mm) * (count - 1)
    low = np.minimum(cells.astype(int), count - 2)
    (x, y), (i, j) = (cells - low).T, low.T
    return ((1 - y) * ((1 - x) * field[j, i] + x * field[j, i + 1]) + y * ((1 - x) * field[j + 1, i] + x * field[j + 1, i + 1]))


def judged(palpate, folder, size_mm, vertices, at_mm, readings, truth, sessions=None):
    """Wrong area and the expected one, mm2, and how far the true polygon is off in widths of the band: no numbers where nothing was found."""
    summary = concluded(palpate, folder, size_mm, vertices, at_mm, readings, sessions)
    if summary["band"] is None:
        return truth.area, np.nan, np.nan
    subprocess.run([palpate, "export", folder / "out", "--for", "csv", "--out", folder / "csv", "--overwrite"], check=True, capture_output=True)
    score = np.array([float(row["score"]) for row in csv.DictReader((folder / "csv" / "tissue.csv").open())]).reshape(vertices[::-1])
    found = shapely.affinity.scale(shapely.wkt.loads((folder / "out" / "boundary.wkt").read_text()), 1e3, 1e3, origin=(0, 0))
    line = LineString(truth.exterior)
    along = np.array([line.interpolate(t).coords[0] for t in np.arange(0, line.length, 0.1)] + list(truth.exterior.coords))
    off = np.max(np.abs(between_vertices(score, size_mm, along))) / summary["band"]["score"]
    return found.symmetric_difference(truth).area, summary["expected_error_mm2"], off


def print_table(table):
    """Of each name a row: rows of what `judged` says of each."""
    print("\n              worlds  in the band  wrong, mm2, mean  wrong/expected, median and most")
    for name, rows in table.items():
        wrong, expected, off = map(np.array, zip(*rows))
        print(f"{name:13s} {len(rows):6d} {np.sum(off <= 1):12d} {wrong.mean():17.1f} {np.nanmedian(wrong / expected):23.2f} {np.nanmax(wrong / expected):8.2f}")


def judge_worlds(usage, count, world):
    """What a sweep is called with: PALPATE [FIRST COUNT]. `world`, of a number: the rows that it counts in, what it is in words, and what
    `judged` needs of it but palpate and folder."""
    if len(sys.argv) not in (2, 4):
        sys.exit(usage)
    first, count = map(int, sys.argv[2:] or (0, count))
    table = collections.defaultdict(list)
    with tempfile.TemporaryDirectory() as folder:
        for number in range(first, first + count):
            rows, words, felt = world(number)
            wrong, expected, off = judged(sys.argv[1], pathlib.Path(folder), *felt)
            for row in (*rows, "all"):
                table[row].append((wrong, expected, off))
            print(f"{number:4d} {words}  wrong {wrong:5.1f}  expected {expected:5.1f}  off {off:4.2f} of the band{'' if off <= 1 else '  outside'}",
                  flush=True)
    print_table(table)
