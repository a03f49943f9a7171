#!/usr/bin/env python3
"""Tumours that read more than the sensor can say: how wrong `palpate boundary` is, and whether it knows.

usage: ended_range.py PALPATE [FIRST COUNT]        needs Debian's python3-numpy and python3-shapely
COUNT worlds from number FIRST on (0 24), a line each and a table: disks, hexagons and squares as corners.py has them, edges that rise over 1 to
6 mm, noise of 0.5 to 5 %, 100 to 200 readings; the sensor's range ends at 90, 75 or 60 % of the contrast, or beyond it.
"""

import numpy as np
from corners import READINGS, SIZE_MM, VERTICES, depth, outline, share
from felt_plane import judge_worlds

SHAPES, ENDS, NOISES, RISES_MM = ["disk", "hexagon", "square"], [1.2, 0.9, 0.75, 0.6], [0.005, 0.02, 0.05], [1.0, 2.0, 4.0, 6.0]


def world(number):
    dice = np.random.default_rng([number, 77])
    end, noise = ENDS[number % len(ENDS)], NOISES[number // len(ENDS) % len(NOISES)]
    truth = outline(SHAPES[number % len(SHAPES)], dice)
    at = dice.uniform(0.3, SIZE_MM - 0.3, (dice.choice(READINGS), 2))
    rise = dice.choice(["sigmoid", "error function", "ramp"]), dice.choice(RISES_MM)
    reading = np.minimum(3 + 2 * (share(*rise, depth(truth, at)) + noise * dice.normal(size=len(at))), 3 + 2 * end)
    words = f"ends at {end:4.0%}, {np.sum(reading == reading.max()):2d} readings"
    return (f"ends at {end:.0%}",), words, (SIZE_MM, VERTICES, at, reading, truth)


if __name__ == "__main__":
    judge_worlds(__doc__, 24, world)
