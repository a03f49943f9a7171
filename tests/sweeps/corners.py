#!/usr/bin/env python3
"""Tumours of straight sides and sharp corners, felt at a few places: how wrong `palpate boundary` is, and whether its band holds the corners.

usage: corners.py PALPATE [FIRST COUNT]        needs Debian's python3-numpy and python3-shapely
COUNT worlds from number FIRST on (0 48), a line each and a table: triangles, squares, hexagons, Ls, crosses and disks, which have no corner,
turned at random on 40 x 50 mm; edges that rise over 1 to 4 mm as a sigmoid, an error function or a ramp does; noise of 0.5 to 5 % of the
contrast; 100 to 200 readings at random places.
"""

import math

import numpy as np
import shapely
import shapely.affinity
from felt_plane import judge_worlds
from shapely.geometry import Point, Polygon, box

SIZE_MM = np.array([40.0, 50.0])
VERTICES = [81, 101]
SHAPES = ["triangle", "square", "hexagon", "ell", "cross", "disk"]
NOISES, RISES_MM, READINGS = [0.005, 0.01, 0.02, 0.05], [1.0, 2.0, 4.0], [100, 150, 200]


def regular(corners):
    return Polygon([(math.cos(2 * math.pi * i / corners), math.sin(2 * math.pi * i / corners)) for i in range(corners)])


def outline(kind, dice):
    unit = {"triangle": regular(3), "square": regular(4), "hexagon": regular(6), "disk": Point(0, 0).buffer(1, 64),
            "ell": box(0, 0, 2, 0.9).union(box(0, 0, 0.9, 1.6)), "cross": box(-1, -0.4, 1, 0.4).union(box(-0.4, -1, 0.4, 1))}[kind]
    area = dice.uniform(130, 330)
    grown = shapely.affinity.scale(unit, *[math.sqrt(area / unit.area)] * 2)
    turned = shapely.affinity.rotate(grown, dice.uniform(0, 360), origin="centroid")
    middle = SIZE_MM / 2 + dice.uniform(-4, 4, 2)
    return shapely.affinity.translate(turned, *(middle - np.array(turned.centroid.coords[0])))


def depth(truth, at):
    """Millimetres, positive inside."""
    points = [Point(place) for place in at]
    return np.array([truth.boundary.distance(point) * (1 if truth.contains(point) else -1) for point in points])


def share(kind, rise_mm, depth_mm):
    """Of the contrast, from a tenth to nine tenths within the rise."""
    if kind == "sigmoid":
        return 1 / (1 + np.exp(-np.clip(2 * math.log(9) / rise_mm * depth_mm, -60, 60)))
    if kind == "error function":
        return 0.5 * (1 + np.vectorize(math.erf)(2.563 / rise_mm * depth_mm / math.sqrt(2)))
    return np.clip(0.5 + 0.8 * depth_mm / rise_mm, 0, 1)


def world(number):
    dice = np.random.default_rng([number, 12])
    kind, noise = SHAPES[number % len(SHAPES)], NOISES[number // len(SHAPES) % len(NOISES)]
    truth = outline(kind, dice)
    at = dice.uniform(0.3, SIZE_MM - 0.3, (dice.choice(READINGS), 2))
    rise = dice.choice(["sigmoid", "error function", "ramp"]), dice.choice(RISES_MM)
    reading = 3 + 2 * (share(*rise, depth(truth, at)) + noise * dice.normal(size=len(at)))
    return (kind, f"noise {noise}"), f"{kind:8s} noise {noise:5.3f}  area {truth.area:4.0f}", (SIZE_MM, VERTICES, at, reading, truth)


if __name__ == "__main__":
    judge_worlds(__doc__, 48, world)
