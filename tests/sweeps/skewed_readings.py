#!/usr/bin/env python3
"""Readings that are many times as high on the tumour: does `palpate boundary` find on which scale they are level, and how wrong is it?

usage: skewed_readings.py PALPATE [FIRST COUNT]        needs Debian's python3-numpy and python3-shapely
COUNT worlds from number FIRST on (0 24), a line each and a table: disks, hexagons and squares as corners.py has them, 3, 6 or 15 times as stiff
as what lies beside them, where either the readings' logarithms rise by a sigmoid, with even noise (factors), or the readings do, with noise that
is even (sums) or grows with what is read (growing); the tumour ends half of the way up on that scale; 100 to 200 readings.
"""

import numpy as np
from corners import READINGS, SIZE_MM, VERTICES, depth, outline, share
from felt_plane import judge_worlds

SHAPES, RATIOS, RISES_MM = ["disk", "hexagon", "square"], [3, 6, 15], [1.0, 2.0, 4.0]
KINDS = {"factors": [0.02, 0.05, 0.12], "sums": [0.005, 0.01, 0.02], "growing": [0.02, 0.05, 0.1]}


def world(number):
    dice = np.random.default_rng([number, 91])
    kind = list(KINDS)[number % 3]
    ratio, noise = RATIOS[number // 3 % 3], dice.choice(KINDS[kind])
    truth = outline(dice.choice(SHAPES), dice)
    at = dice.uniform(0.3, SIZE_MM - 0.3, (dice.choice(READINGS), 2))
    rise, scatter = share("sigmoid", dice.choice(RISES_MM), depth(truth, at)), noise * dice.normal(size=len(at))
    if kind == "factors":
        reading = 0.2 * ratio ** (rise + scatter)
    elif kind == "sums":
        reading = 0.2 * (1 + (ratio - 1) * (rise + scatter))
    else:
        reading = 0.2 * (1 + (ratio - 1) * rise) * (1 + scatter)
    return (kind, f"{ratio} times"), f"{kind:8s} {ratio:2d} times, noise {noise:.1%}", (SIZE_MM, VERTICES, at, reading, truth)


if __name__ == "__main__":
    judge_worlds(__doc__, 24, world)
