#!/usr/bin/env python3
"""Tumours that read more than the sensor can say: how wrong `palpate boundary` is, and whether it knows.

usage: ended_range.py PALPATE [FIRST COUNT]        needs Debian's python3-numpy and python3-shapely
COUNT worlds from number FIRST on (0 24), a line each and a table: disks, hexagons and squares as corners.py has them, edges that rise over 1 to
6 mm, noise of 0.5 to 5 %, 100 to 200 readings; the sensor's range ends at 90, 75 or 60 % of the contrast, or beyond it.
"""

import collections
import pathlib
import sys
import tempfile

import numpy as np
from corners import READINGS, SIZE_MM, VERTICES, depth, outline, share
from felt_plane import judged, print_table

SHAPES, ENDS, NOISES, RISES_MM = ["disk", "hexagon", "square"], [1.2, 0.9, 0.75, 0.6], [0.005, 0.02, 0.05], [1.0, 2.0, 4.0, 6.0]


def answered(palpate, folder, number):
    """Where the range ends, how many readings do, wrong area and the expected one, mm2, and how far the truth is off in widths of the band."""
    dice = np.random.default_rng([number, 77])
    end, noise = ENDS[number % len(ENDS)], NOISES[number // len(ENDS) % len(NOISES)]
    truth = outline(SHAPES[number % len(SHAPES)], dice)
    at = dice.uniform(0.3, SIZE_MM - 0.3, (dice.choice(READINGS), 2))
    rise = dice.choice(["sigmoid", "error function", "ramp"]), dice.choice(RISES_MM)
    reading = np.minimum(3 + 2 * (share(*rise, depth(truth, at)) + noise * dice.normal(size=len(at))), 3 + 2 * end)
    return end, np.sum(reading == reading.max()), *judged(palpate, folder, SIZE_MM, VERTICES, at, reading, truth)


def main():
    if len(sys.argv) not in (2, 4):
        sys.exit(__doc__)
    first, count = map(int, sys.argv[2:] or (0, 24))
    table = collections.defaultdict(list)
    with tempfile.TemporaryDirectory() as folder:
        for number in range(first, first + count):
            end, ended, wrong, expected, off = answered(sys.argv[1], pathlib.Path(folder), number)
            for row in f"ends at {end:.0%}", "all":
                table[row].append((wrong, expected, off))
            print(f"{number:4d} ends at {end:4.0%}, {ended:2d} readings  wrong {wrong:5.1f}  expected {expected:5.1f}  "
                  f"off {off:4.2f} of the band{'' if off <= 1 else '  outside'}", flush=True)
    print_table(table)


if __name__ == "__main__":
    main()
