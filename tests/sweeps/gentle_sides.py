#!/usr/bin/env python3
"""Tumours that end sharply on one side and gently on the other: how wrong `palpate boundary` is, and whether it knows.

usage: gentle_sides.py PALPATE [FIRST COUNT]        needs Debian's python3-numpy and python3-shapely
COUNT worlds from number FIRST on (0 24), a line each and a table: disks, hexagons and squares as corners.py has them, whose edge rises over
1.5 mm on one side, turned at random, and over 3, 6, 10 or 15 mm on the other; noise of 1 to 5 % of the contrast; 100 to 200 readings.
"""

import numpy as np
from corners import READINGS, SIZE_MM, VERTICES, depth, outline
from felt_plane import judge_worlds

SHAPES, GENTLE_MM, NOISES, SHARP_MM = ["disk", "hexagon", "square"], [3.0, 6.0, 10.0, 15.0], [0.01, 0.02, 0.05], 1.5


def sigmoid(steps):
    return 1 / (1 + np.exp(-np.clip(steps, -60, 60)))


def world(number):
    dice = np.random.default_rng([number, 78])
    gentle, noise = GENTLE_MM[number % len(GENTLE_MM)], NOISES[number // len(GENTLE_MM) % len(NOISES)]
    truth = outline(SHAPES[number % len(SHAPES)], dice)
    at = dice.uniform(0.3, SIZE_MM - 0.3, (dice.choice(READINGS), 2))
    turn = dice.uniform(0, 2 * np.pi)
    across = (at - np.array(truth.centroid.coords[0])) @ np.array([np.cos(turn), np.sin(turn)])
    rise = SHARP_MM + (gentle - SHARP_MM) * sigmoid(across / 2)
    reading = 3 + 2 * (sigmoid(2 * np.log(9) / rise * depth(truth, at)) + noise * dice.normal(size=len(at)))
    return (f"{gentle:.0f} mm",), f"{gentle:4.0f} mm, noise {noise:.0%}", (SIZE_MM, VERTICES, at, reading, truth)


if __name__ == "__main__":
    judge_worlds(__doc__, 24, world)
