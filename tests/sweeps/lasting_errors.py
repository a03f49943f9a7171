#!/usr/bin/env python3
"""Rasters by a sensor whose errors last from reading to reading: how wrong `palpate boundary` is, and whether it knows.

usage: lasting_errors.py PALPATE [FIRST COUNT]        needs Debian's python3-numpy and python3-shapely
COUNT worlds from number FIRST on (0 20), a line each and a table: disks, hexagons and squares as corners.py has them, with edges that rise over 2 or
4 mm; rows 4 mm apart, there and back, a reading each 2 mm; errors of 12 or 25 % of the contrast, of which a half to nine tenths are the last one's.
"""

import numpy as np
from corners import SIZE_MM, VERTICES, depth, outline, share
from felt_plane import judge_worlds

SHAPES, ERRORS, LASTING, RISES_MM = ["disk", "hexagon", "square"], [0.12, 0.25], [0.5, 0.8, 0.9], [2.0, 4.0]
ALONG_MM, ROWS_MM = 2.0, 4.0


def raster():
    along = np.arange(ALONG_MM / 2, SIZE_MM[0], ALONG_MM)
    rows = np.arange(ROWS_MM / 2, SIZE_MM[1], ROWS_MM)
    return np.array([(x, y) for row, y in enumerate(rows) for x in (along if row % 2 == 0 else along[::-1])])


def world(number):
    dice = np.random.default_rng([number, 31])
    lasting, height = LASTING[number % len(LASTING)], ERRORS[number // len(LASTING) % len(ERRORS)]
    truth, at = outline(dice.choice(SHAPES), dice), raster()
    fresh, error = dice.normal(size=len(at)), np.zeros(len(at))
    for i in range(len(at)):
        error[i] = lasting * error[i - 1] + np.sqrt(1 - lasting**2) * fresh[i] if i else fresh[i]
    reading = 3 + 2 * (share("sigmoid", dice.choice(RISES_MM), depth(truth, at)) + height * error)
    return (f"{lasting:.0%} last", f"errors {height:.0%}"), f"errors {height:.0%}, {lasting:.0%} last", (SIZE_MM, VERTICES, at, reading, truth)


if __name__ == "__main__":
    judge_worlds(__doc__, 20, world)
