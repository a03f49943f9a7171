#!/usr/bin/env python3
"""Ten to forty readings all over the tissue, few or one of them in the tumour: does `palpate boundary` know how little it knows?

usage: few_readings.py PALPATE [FIRST COUNT]        needs Debian's python3-numpy and python3-shapely
COUNT worlds from number FIRST on (0 20), a line each and a table: disks, hexagons, squares and Ls as corners.py has them, as large as a disk of 4
to 12 mm; readings apart from each other, as a careful hand places them, with 2 % noise.
"""

import math

import numpy as np
import shapely.affinity
from corners import SIZE_MM, VERTICES, depth, outline, share
from felt_plane import judge_worlds

SHAPES, READINGS, NOISE, RISES_MM = ["disk", "hexagon", "square", "ell"], [10, 14, 20, 28, 40], 0.02, [1.0, 2.0, 4.0]
APART, NEARER = 0.7, 0.02  # of what a grid's would be; part of those that may lie nearer


def places(count, dice):
    apart_mm = APART * math.sqrt(np.prod(SIZE_MM) / count)
    at = []
    while len(at) < count:
        place = dice.uniform(0.3, SIZE_MM - 0.3)
        if all(np.linalg.norm(place - other) > apart_mm for other in at) or dice.uniform() < NEARER:
            at.append(place)
    return np.array(at)


def world(number):
    dice = np.random.default_rng([number, 555])
    kind = dice.choice(SHAPES)
    truth = outline(kind, dice)
    truth = shapely.affinity.scale(truth, *[dice.uniform(4, 12) * math.sqrt(math.pi / truth.area)] * 2)
    at = places(dice.choice(READINGS), dice)
    reading = 3 + 2 * (share("sigmoid", dice.choice(RISES_MM), depth(truth, at)) + NOISE * dice.normal(size=len(at)))
    return (f"{len(at)} readings",), f"{kind:8s} {len(at)} readings  area {truth.area:4.0f}", (SIZE_MM, VERTICES, at, reading, truth)


if __name__ == "__main__":
    judge_worlds(__doc__, 20, world)
