#!/usr/bin/env python3
"""A second half of the readings, made by another probe or another registration: how wrong `palpate boundary` is, and whether it knows.

usage: another_probe.py PALPATE [FIRST COUNT]        needs Debian's python3-numpy and python3-shapely
COUNT worlds from number FIRST on (0 20), a line each and a table: disks, hexagons and squares as corners.py has them, with edges that rise over 2 or
4 mm; 180 places at random, noise of 2 or 5 % of the contrast. The second half is felt as the first; with a registration that is 5 % too long about the
tissue's middle or turned by 6 degrees; by a probe whose tip feels all 1.5 mm early; or in another unit, 20 or 1,000 times as much and some more. It is
said to be a session of its own, or not.
"""

import numpy as np
from corners import SIZE_MM, VERTICES, depth, outline, share
from felt_plane import judge_worlds

SHAPES, RISES_MM = ["disk", "hexagon", "square"], [2.0, 4.0]
PROBES = ["the same", "5 % longer", "turned by 6 degrees", "a tip of 1.5 mm", "20 times", "1000 times"]
READINGS = 180


def turned(at, degrees):
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return at @ np.array([[c, s], [-s, c]])


def world(number):
    dice = np.random.default_rng([number, 41])
    probe, is_told = PROBES[number % len(PROBES)], number // len(PROBES) % 2 == 0
    noise, rise = dice.choice([0.02, 0.05]), dice.choice(RISES_MM)
    truth, at, middle = outline(dice.choice(SHAPES), dice), dice.uniform(0.3, np.array(SIZE_MM) - 0.3, (READINGS, 2)), np.array(SIZE_MM) / 2
    second = np.arange(READINGS) >= READINGS // 2
    felt_at, early = at.copy(), np.zeros(READINGS)
    if probe == "5 % longer":
        felt_at[second] = middle + 1.05 * (at[second] - middle)
    if probe == "turned by 6 degrees":
        felt_at[second] = middle + turned(at[second] - middle, 6)
    if probe == "a tip of 1.5 mm":
        early[second] = 1.5
    reading = 3 + 2 * (share("sigmoid", rise, depth(truth, felt_at) + early) + noise * dice.normal(size=READINGS))
    if probe.endswith("times"):
        reading[second] = float(probe.split()[0]) * reading[second] + 7
        is_told = True
    told = "told" if is_told else "not told"
    return (probe, told), f"{probe}, {told}, noise {noise:.0%}", (SIZE_MM, VERTICES, at, reading, truth, second.astype(int) if is_told else None)


if __name__ == "__main__":
    judge_worlds(__doc__, 20, world)
