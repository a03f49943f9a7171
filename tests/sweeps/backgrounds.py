#!/usr/bin/env python3
"""Tissue that is not level: how wrong `palpate boundary` is, and how wrong it expects to be, on slopes, bowls, saddles and slow waves.

usage: backgrounds.py PALPATE [FIRST COUNT]        needs Debian's python3-numpy and python3-shapely
COUNT worlds from number FIRST on (0 72), a line each and a table: on each background healthy tissue, disks, a large one, two, a corner
and half of the tissue that are stiff; noise of 2 to 10 % of the contrast, which the background reaches a quarter to 2.5 times; 60 to 200
readings at random places. A world is called sure and wrong where more than three times the expected area is wrong, and 4 mm2.
"""

import collections
import pathlib
import sys
import tempfile

import numpy as np
import shapely.affinity
import shapely.wkt
from felt_plane import concluded
from shapely import vectorized

SIZE_MM = np.array([40.0, 50.0])
CELL_MM = 0.2
CONTRAST, STEEPNESS_PER_MM = 2.0, 1.4
REGIONS = ["half", "corner", "disk", "large", "two", "healthy"]
BACKGROUNDS = ["level", "plane", "bowl", "saddle", "wave"]
HEIGHTS = [0.5, 1.0, 0.25, 1.6, 2.5]  # of the contrast
NOISES, READINGS = [0.02, 0.05, 0.1], [60, 120, 200]


def disk(centre, radius):
    return lambda at: radius - np.linalg.norm(at - centre, axis=1)


def region(kind, dice):
    """How deep places lie inside, millimetres."""
    angle, middle, shift = dice.uniform(0, 2 * np.pi), dice.uniform(0.25, 0.75, 2) * SIZE_MM, dice.uniform(-6, 6)
    if kind == "half":
        return lambda at: (at - SIZE_MM / 2) @ [np.cos(angle), np.sin(angle)] - shift
    if kind == "corner":
        return disk(SIZE_MM * dice.integers(0, 2, 2), dice.uniform(16, 26))
    if kind == "disk":
        return disk(middle, dice.uniform(5, 9))
    if kind == "large":
        return disk(middle, dice.uniform(11, 15))
    if kind == "two":
        one, other = disk(middle * [1, 0.5], 5), disk(middle * [1, 0.5] + [0, 24], 6)
        return lambda at: np.maximum(one(at), other(at))
    return lambda at: np.full(len(at), -100.0)


def background(kind, dice):
    """Over the tissue, from its least to its greatest: one."""
    angle, length = dice.uniform(0, 2 * np.pi), dice.uniform(45, 90)
    middle, phase = SIZE_MM * dice.uniform(0.35, 0.65, 2), dice.uniform(0, 2 * np.pi)

    def raw(at):
        off = (at - middle) / SIZE_MM * 2
        along, across = off @ [np.cos(angle), np.sin(angle)], off @ [-np.sin(angle), np.cos(angle)]
        way = (at - middle) @ [np.cos(angle), np.sin(angle)]
        return {"level": 0 * way, "plane": way, "bowl": along**2 + 0.5 * across**2, "saddle": along**2 - across**2,
                "wave": np.sin(2 * np.pi * way / length + phase)}[kind]

    span = np.ptp(raw(GRID)) or 1.0
    sign = dice.choice([-1, 1])
    return lambda at: sign * raw(at) / span


GRID = np.stack(np.meshgrid(*(np.arange(CELL_MM / 2, size, CELL_MM) for size in SIZE_MM)), -1).reshape(-1, 2)


def found(wkt):
    inside = np.zeros(len(GRID), bool)
    for line in filter(None, map(str.strip, wkt.splitlines())):
        if "EMPTY" not in line:
            inside |= vectorized.contains(shapely.affinity.scale(shapely.wkt.loads(line), 1e3, 1e3, origin=(0, 0)), *GRID.T)
    return inside


def answered(palpate, folder, number):
    """Kinds of background and region, true area, area found, wrong area and expected one, mm2."""
    dice = np.random.default_rng([number, 11])
    ground, kind = BACKGROUNDS[number % len(BACKGROUNDS)], REGIONS[number % len(REGIONS)]
    depth, rise = region(kind, dice), background(ground, dice)
    noise, count = dice.choice(NOISES), dice.choice(READINGS)
    height = dice.choice(HEIGHTS)
    at = dice.uniform(0.3, SIZE_MM - 0.3, (count, 2))
    reading = 7 + CONTRAST * (1 / (1 + np.exp(-STEEPNESS_PER_MM * depth(at))) + height * rise(at) + noise * dice.normal(size=count))
    summary = concluded(palpate, folder, SIZE_MM, [65, 81], at, reading)
    outline = folder / "out" / "boundary.wkt"
    inside = found(outline.read_text()) if outline.exists() else np.zeros(len(GRID), bool)
    truth = depth(GRID) > 0
    return ground, kind, height, *(CELL_MM**2 * np.sum(one) for one in (truth, inside, truth != inside)), summary["expected_error_mm2"] or 0.0


def main():
    if len(sys.argv) not in (2, 4):
        sys.exit(__doc__)
    first, count = map(int, sys.argv[2:] or (0, 72))
    table = collections.defaultdict(list)
    with tempfile.TemporaryDirectory() as folder:
        for number in range(first, first + count):
            ground, kind, height, true, area, wrong, expected = answered(sys.argv[1], pathlib.Path(folder), number)
            is_sure = wrong > 3 * expected + 4
            table[ground, kind == "healthy"].append((wrong, expected, is_sure, true > 0 and area == 0))
            print(f"{number:4d} {ground:6s} {height:4.2f} {kind:7s} true {true:6.0f}  found {area:6.0f}  wrong {wrong:6.1f}  "
                  f"expected {expected:6.1f}{'  sure and wrong' if is_sure else ''}", flush=True)
    print("\nbackground          worlds  wrong/expected, median  sure and wrong  lost")
    for (ground, is_healthy), rows in sorted(table.items()):
        ratio = [wrong / expected for wrong, expected, *_ in rows if expected > 0]
        print(f"{ground:6s} {'healthy' if is_healthy else 'tumour':9s} {len(rows):9d} {np.median(ratio) if ratio else np.nan:24.2f} "
              f"{sum(row[2] for row in rows):15d} {sum(row[3] for row in rows):5d}")


if __name__ == "__main__":
    main()
