#!/usr/bin/python3
"""Writes shapely_reference.txt: random pairs of polygons with holes, and what shapely (GEOS) says of them.

Usage: /usr/bin/python3 make_shapely_reference.py > shapely_reference.txt      (shapely 1.8, any numpy; the seed is fixed)

A pair is three lines: "A ring|ring...", "B ring|ring...", "= area(A) area(B) area(A & B) area(A | B) area(A ^ B)". A ring is x,y,x,y...;
coordinates are integers, the outer ring comes first. Areas are GEOS's with 17 digits; its rounding of crossing points costs it about 1e-15 of the area.
"""

import math
import random

from shapely.geometry import Polygon

SEED = 20261121
PAIRS = 1000
RADIUS = 20000


def star_ring(rng, centre, radius, corners):
    """A ring that is seen whole from its centre, so never crosses itself."""
    angles = sorted(rng.uniform(0.0, 2.0 * math.pi) for _ in range(corners))
    points = []
    for angle in angles:
        reach = radius * rng.uniform(0.35, 1.0)
        points.append((round(centre[0] + reach * math.cos(angle)), round(centre[1] + reach * math.sin(angle))))
    return points


def random_polygon(rng):
    """An outer star with up to two holes; drawn again until it is valid."""
    while True:
        centre = (rng.randint(-RADIUS // 2, RADIUS // 2), rng.randint(-RADIUS // 2, RADIUS // 2))
        rings = [star_ring(rng, centre, RADIUS, rng.randint(12, 40))]
        for _ in range(rng.randint(0, 2)):
            angle = rng.uniform(0.0, 2.0 * math.pi)
            hole = (centre[0] + 0.2 * RADIUS * math.cos(angle), centre[1] + 0.2 * RADIUS * math.sin(angle))
            rings.append(star_ring(rng, hole, 0.12 * RADIUS, rng.randint(5, 9)))
        polygon = Polygon(rings[0], rings[1:])
        if polygon.is_valid and polygon.area > 0.0:
            return rings, polygon


def text(rings):
    return "|".join(",".join(f"{x},{y}" for x, y in ring) for ring in rings)


def main():
    rng = random.Random(SEED)
    for _ in range(PAIRS):
        rings_a, a = random_polygon(rng)
        rings_b, b = random_polygon(rng)
        areas = [a.area, b.area, a.intersection(b).area, a.union(b).area, a.symmetric_difference(b).area]
        print("A", text(rings_a))
        print("B", text(rings_b))
        print("=", " ".join(f"{area:.17g}" for area in areas))


main()
