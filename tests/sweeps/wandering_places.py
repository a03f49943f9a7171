#!/usr/bin/env python3
"""Tissue that keeps moving while it is touched: how wrong `palpate boundary` is, and whether it knows.

usage: wandering_places.py PALPATE [FIRST COUNT]        needs Debian's python3-numpy and python3-shapely
COUNT worlds from number FIRST on (0 35), a line each and a table: disks, hexagons, squares and crosses as corners.py has them, with edges that rise
over 2 or 4 mm; 200 places at random, or a raster of rows 2.5 mm apart; noise of 2 or 5 % of the contrast. Tissue rests; goes to and fro, once in 50
readings or in 4.3; goes steadily one way; walks at random; or each place is off by itself, as rough poses are: by 1 or 2 mm, root mean square. Or 25
readings in a row are told of where they would be in a mirror. The truth is where the tissue lies on the mean.
"""

import numpy as np
from corners import SIZE_MM, VERTICES, depth, outline, share
from felt_plane import judge_worlds
from late_readings import places

SHAPES, RISES_MM = ["disk", "hexagon", "square", "cross"], [2.0, 4.0]
WANDERS = ["rests", "slow breath", "fast breath", "steadily", "random walk", "each", "mirrored"]
WAYS = ["random", "there and back"]


def off_mm(wanders, count, by_mm, dice):
    """Of the tissue, a row a reading."""
    turn, way = np.arange(count), np.array([np.cos(angle := dice.uniform(0, 2 * np.pi)), np.sin(angle)])
    if wanders == "each":
        return by_mm / np.sqrt(2) * dice.normal(size=(count, 2))
    if wanders == "random walk":
        path = np.cumsum(dice.normal(size=(count, 2)), axis=0)
        path -= path.mean(axis=0)
        return by_mm * path / np.sqrt(np.mean(np.sum(path**2, axis=1)))
    along = {"rests": 0 * turn, "mirrored": 0 * turn, "slow breath": np.sqrt(2) * np.sin(2 * np.pi * (turn / 50 + dice.uniform())),
             "fast breath": np.sqrt(2) * np.sin(2 * np.pi * (turn / 4.3 + dice.uniform())), "steadily": np.sqrt(12) * (turn / (count - 1) - 0.5)}[wanders]
    return by_mm * np.outer(along, way)


def world(number):
    dice = np.random.default_rng([number, 41])
    wanders, way = WANDERS[number % len(WANDERS)], WAYS[number // len(WANDERS) % len(WAYS)]
    noise, rise, by_mm = dice.choice([0.02, 0.05]), dice.choice(RISES_MM), dice.choice([1.0, 2.0])
    truth, at = outline(dice.choice(SHAPES), dice), places(way, dice)
    felt = share("sigmoid", rise, depth(truth, at - off_mm(wanders, len(at), by_mm, dice))) + noise * dice.normal(size=len(at))
    if wanders == "mirrored":
        first = dice.integers(20, 150)
        at[first:first + 25, 0] = SIZE_MM[0] - at[first:first + 25, 0]
    return (wanders, way), f"{wanders} by {by_mm} mm, {way}, rise {rise}, noise {noise:.0%}", (SIZE_MM, VERTICES, at, 3 + 2 * felt, truth)


if __name__ == "__main__":
    judge_worlds(__doc__, 35, world)
