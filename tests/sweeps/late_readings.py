#!/usr/bin/env python3
"""Readings that are of where the probe was a little before: how wrong `palpate boundary` is, and whether it knows.

usage: late_readings.py PALPATE [FIRST COUNT]        needs Debian's python3-numpy and python3-shapely
COUNT worlds from number FIRST on (0 20), a line each and a table: disks, hexagons and squares as corners.py has them, with edges that rise over 2 or
4 mm. A raster of rows 2.5 mm apart, there and back or always one way, or places at random, felt with play of 0 to 2 mm between the probe and where it is
said to be (backlash: it trails along each leg), or through a filter that keeps a half of the reading before; noise of 2 or 5 % of the contrast.
"""

import numpy as np
from corners import SIZE_MM, VERTICES, depth, outline, share
from felt_plane import judge_worlds

SHAPES, RISES_MM = ["disk", "hexagon", "square"], [2.0, 4.0]
WAYS, PLAY_MM = ["there and back", "one way", "random"], [0.0, 0.5, 1.0, 2.0, "filter"]
ALONG_MM, ROWS_MM, AT_RANDOM = 2.0, 2.5, 200
KEPT = 0.5  # of the reading before


def places(way, dice):
    if way == "random":
        return dice.uniform(0.3, np.array(SIZE_MM) - 0.3, (AT_RANDOM, 2))
    along = np.arange(ALONG_MM / 2, SIZE_MM[0], ALONG_MM)
    rows = np.arange(ROWS_MM / 2, SIZE_MM[1], ROWS_MM)
    turns = way == "there and back"
    return np.array([(x, y) for row, y in enumerate(rows) for x in (along[::-1] if turns and row % 2 else along)])


def travel(at):
    """Unit vectors from each place's forerunner, a row each; of the first none."""
    legs = np.diff(at, axis=0, prepend=at[:1])
    return legs / np.maximum(np.linalg.norm(legs, axis=1), 1e-9)[:, None]


def world(number):
    dice = np.random.default_rng([number, 37])
    way, play = WAYS[number % len(WAYS)], PLAY_MM[number // len(WAYS) % len(PLAY_MM)]
    noise, rise = dice.choice([0.02, 0.05]), dice.choice(RISES_MM)
    truth, at = outline(dice.choice(SHAPES), dice), places(way, dice)
    behind = 0.0 if play == "filter" else play
    felt = share("sigmoid", rise, depth(truth, at - behind * travel(at))) + noise * dice.normal(size=len(at))
    if play == "filter":
        for i in range(1, len(at)):
            felt[i] = KEPT * felt[i - 1] + (1 - KEPT) * felt[i]
    name = "filter" if play == "filter" else f"{play} mm"
    return (way, name), f"{way}, {name}, noise {noise:.0%}", (SIZE_MM, VERTICES, at, 3 + 2 * felt, truth)


if __name__ == "__main__":
    judge_worlds(__doc__, 20, world)
