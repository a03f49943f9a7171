#!/usr/bin/python3
"""Areas of random polygon pairs: this library against shapely (GEOS), with rational arithmetic as the referee where they differ.

Usage: /usr/bin/python3 compare_with_shapely.py SWEEP_BOOLEANS COUNT SEED        (shapely 1.8, Debian's python3-shapely; nothing of the build needs it)
SWEEP_BOOLEANS is the program of that name in the build's bin folder. 100,000 pairs take about an hour of one core.

For each pair of valid polygons A, B: |A|, |B|, |A & B|, |A | B|, |A ^ B|, |A - B|, |B - A|. Where the two differ by more than 1e-12 of |A | B|, and for one
pair in a hundred anyway, the areas are computed again with fractions: cut the plane at the x of every corner and crossing; between two cuts no edges
cross, so the even-odd rule along the middle gives trapezoids. The table that is printed at the end counts, for every family of pairs, who was wrong by more
than 1e-12 of |A | B|; it ends with 1 if this library was, or if it refused what is valid.
"""

import collections
import fractions
import math
import os
import random
import subprocess
import sys
import tempfile

from shapely.geometry import MultiPolygon, Polygon
from shapely.ops import unary_union

TOLERANCE = 1e-12
BATCH = 1000
ALWAYS_ONE_IN = 100
NAMES = ["A", "B", "and", "or", "xor", "A-B", "B-A"]


# Families of pairs. A polygon is a list of rings, the outer one first; an operand is a list of polygons.


def star(rng, centre, radius, corners):
    points = []
    for i in range(corners):
        angle = 2.0 * math.pi * (i + 0.8 * rng.random()) / corners
        reach = radius * rng.uniform(0.35, 1.0)
        points.append((centre[0] + reach * math.cos(angle), centre[1] + reach * math.sin(angle)))
    return points


def star_with_holes(rng, centre=(0.0, 0.0), radius=1.0, most=30):
    rings = [star(rng, centre, radius, rng.randint(5, most))]
    for _ in range(rng.randint(0, 2)):
        angle = rng.uniform(0.0, 2.0 * math.pi)
        hole = (centre[0] + 0.2 * radius * math.cos(angle), centre[1] + 0.2 * radius * math.sin(angle))
        rings.append(star(rng, hole, 0.12 * radius, rng.randint(3, 7)))
    return rings


def mapped(rings, function):
    return [[function(x, y) for x, y in ring] for ring in rings]


def on_lattice(rings, side):
    return [[p for i, p in enumerate(ring) if p != ring[i - 1]] for ring in mapped(rings, lambda x, y: (float(round(side * x)), float(round(side * y))))]


def disturbed(rng, rings, noise):
    return mapped(rings, lambda x, y: (x + noise * rng.gauss(0.0, 1.0), y + noise * rng.gauss(0.0, 1.0)))


def next_to_nothing(rng):
    return 10.0 ** rng.uniform(-16.0, -9.0)


def stars(rng):
    return [star_with_holes(rng)], [star_with_holes(rng, (rng.uniform(-1, 1), rng.uniform(-1, 1)))]


def lattice(rng):
    side = rng.randint(3, 9)
    return [on_lattice(star_with_holes(rng, most=16), side)], [on_lattice(star_with_holes(rng, (rng.uniform(-1, 1), rng.uniform(-1, 1)), most=16), side)]


def lattice_and_noise(rng):
    a, b = lattice(rng)
    noise = next_to_nothing(rng)
    return [disturbed(rng, a[0], noise)], [disturbed(rng, rng.choice([a, b])[0], noise)]


def with_spike(rng, ring):
    """A needle on one edge, some 1e-10 wide, outwards or inwards."""
    i = rng.randrange(len(ring))
    (x0, y0), (x1, y1) = ring[i - 1], ring[i]
    t, width, height = rng.uniform(0.2, 0.8), 10.0 ** rng.uniform(-12.0, -9.0), rng.uniform(-0.3, 1.0)
    at = lambda s: (x0 + s * (x1 - x0), y0 + s * (y1 - y0))
    tip = (at(t)[0] + height * (y1 - y0), at(t)[1] - height * (x1 - x0))
    return ring[:i] + [at(t - width), tip, at(t + width)] + ring[i:]


def spikes(rng):
    a, b = stars(rng)
    for polygon in (a[0], b[0]):
        for _ in range(rng.randint(1, 3)):
            polygon[0] = with_spike(rng, polygon[0])
    return a, b


def shared_edges(rng):
    """Two sides of one line from left to right; sometimes with other corners on it, or moved by next to nothing."""
    xs = sorted(rng.uniform(0.05, 0.95) for _ in range(rng.randint(1, 20)))
    line = [(0.0, 0.5)] + [(x, rng.uniform(0.2, 0.8)) for x in xs] + [(1.0, 0.5)]
    other = list(line)
    kind = rng.randrange(3)
    if kind == 1:
        other = [p for i, q in enumerate(line[:-1]) for p in (q, (0.5 * (q[0] + line[i + 1][0]), 0.5 * (q[1] + line[i + 1][1])))] + [line[-1]]
    if kind == 2:
        other = [line[0]] + disturbed(rng, [line[1:-1]], next_to_nothing(rng))[0] + [line[-1]]
    return [[[(0.0, 0.0), (1.0, 0.0)] + line[::-1]]], [[[(1.0, 1.0), (0.0, 1.0)] + other]]


def touching_holes(rng):
    """Holes that touch at corners, each other and the outer ring; the second operand the same, shifted along the lattice or put into the holes."""

    def diamonds(count):
        holes = []
        for i in range(count):
            holes.append([(2.0 * i + 0.0, 4.0), (2.0 * i + 1.0, 3.0), (2.0 * i + 2.0, 4.0), (2.0 * i + 1.0, 5.0)])
        return holes

    count = rng.randint(1, 4)
    outer = [(0.0, 0.0), (2.0 * count + 2.0, 0.0), (2.0 * count + 2.0, 8.0), (0.0, 8.0)]
    a = [[outer] + diamonds(count)]
    kind = rng.randrange(3)
    if kind == 0:
        right, up = rng.randint(-3, 3), rng.randint(-3, 3)
        return a, [mapped(a[0], lambda x, y: (x + right, y + up))]
    if kind == 1:
        return a, [[hole] for hole in diamonds(count)]
    turn = rng.uniform(0.0, math.pi)
    return a, [mapped(a[0], lambda x, y: (x * math.cos(turn) - y * math.sin(turn), x * math.sin(turn) + y * math.cos(turn)))]


def turned_a_little(rng):
    a, _ = stars(rng)
    angle = next_to_nothing(rng) * rng.choice([1.0, 1e3])
    return a, [mapped(a[0], lambda x, y: (x - angle * y, y + angle * x))]


def scaled_and_far_off(rng):
    a, b = rng.choice([stars, lattice])(rng)
    scale = 10.0 ** rng.uniform(-12.0, 7.5)
    offset = scale * 10.0 ** rng.uniform(0.0, 7.0)
    if offset + 20.0 * scale > 1e9:  # as far as a region may reach
        offset = 0.0
    x0, y0 = offset * rng.uniform(-1, 1), offset * rng.uniform(-1, 1)
    move = lambda x, y: (x0 + scale * x, y0 + scale * y)
    return [mapped(a[0], move)], [mapped(b[0], move)]


def many_boxes(rng):
    def boxes():
        union = unary_union([Polygon([(x, y), (x + w, y), (x + w, y + h), (x, y + h)])
                             for x, y, w, h in ((rng.randrange(9), rng.randrange(9), rng.randint(1, 4), rng.randint(1, 4)) for _ in range(rng.randint(1, 7)))])
        parts = union.geoms if isinstance(union, MultiPolygon) else [union]
        return [[list(ring.coords)[:-1] for ring in (part.exterior, *part.interiors)] for part in parts]

    return boxes(), boxes()


FAMILIES = [stars, lattice, lattice_and_noise, spikes, shared_edges, touching_holes, turned_a_little, scaled_and_far_off, many_boxes]


def as_shapely(polygons):
    return MultiPolygon([(rings[0], rings[1:]) for rings in polygons]) if len(polygons) > 1 else Polygon(polygons[0][0], polygons[0][1:])


def is_usable(polygons):
    if any(len(set(ring)) < 3 for rings in polygons for ring in rings):
        return False
    shape = as_shapely(polygons)
    return shape.is_valid and shape.area > 0.0


def random_pair(rng):
    family = rng.choice(FAMILIES)
    while True:
        a, b = family(rng)
        if is_usable(a) and is_usable(b):
            return family.__name__, a, b


# What shapely says.


def areas_of_shapely(a, b):
    try:
        a, b = as_shapely(a), as_shapely(b)
        return [a.area, b.area, a.intersection(b).area, a.union(b).area, a.symmetric_difference(b).area, a.difference(b).area, b.difference(a).area]
    except Exception as error:  # GEOS gives up on some valid pairs
        return type(error).__name__


# The referee.


def edges_of(polygons):
    edges = []
    for rings in polygons:
        for ring in rings:
            points = [(fractions.Fraction(x), fractions.Fraction(y)) for x, y in ring]
            edges += [tuple(sorted((points[i - 1], points[i]))) for i in range(len(points)) if points[i - 1][0] != points[i][0]]
    return edges


def crossing_x(e, f):
    """The x at which two edges cross, if they do at one point."""
    (ax, ay), (bx, by) = e
    (cx, cy), (dx, dy) = f
    slant = (bx - ax) * (dy - cy) - (by - ay) * (dx - cx)
    if slant == 0:
        return None
    t = ((cx - ax) * (dy - cy) - (cy - ay) * (dx - cx)) / slant
    x = ax + t * (bx - ax)
    return x if max(ax, cx) < x < min(bx, dx) else None


def exact_areas(a, b):
    edges = [(edge, 0) for edge in edges_of(a)] + [(edge, 1) for edge in edges_of(b)]
    cuts = {x for (p, q), _ in edges for x in (p[0], q[0])}
    for i, (e, _) in enumerate(edges):
        for f, _ in edges[:i]:
            if e[0][0] < f[1][0] and f[0][0] < e[1][0]:
                x = crossing_x(e, f)
                if x is not None:
                    cuts.add(x)
    cuts = sorted(cuts)
    area = collections.Counter()
    for left, right in zip(cuts, cuts[1:]):
        middle = (left + right) / 2
        heights = sorted((p[1] + (middle - p[0]) * (q[1] - p[1]) / (q[0] - p[0]), layer) for (p, q), layer in edges if p[0] <= left and right <= q[0])
        inside = [False, False]
        for (low, layer), above in zip(heights, heights[1:]):
            inside[layer] = not inside[layer]
            area[tuple(inside)] += (right - left) * (above[0] - low)
    both, only_a, only_b = area[(True, True)], area[(True, False)], area[(False, True)]
    return [both + only_a, both + only_b, both, both + only_a + only_b, only_a + only_b, only_a, only_b]


def is_simple(polygons):
    """Whether no two edges of one operand cross inside both, in exact arithmetic: what shapely's own test may get wrong by a rounding."""
    edges = []
    for rings in polygons:
        for ring in rings:
            points = [(fractions.Fraction(x), fractions.Fraction(y)) for x, y in ring]
            edges += [(points[i - 1], points[i]) for i in range(len(points))]
    side = lambda p, q, r: (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
    sign = lambda value: (value > 0) - (value < 0)
    for i, (p, q) in enumerate(edges):
        for r, s in edges[:i]:
            if sign(side(p, q, r)) * sign(side(p, q, s)) < 0 and sign(side(r, s, p)) * sign(side(r, s, q)) < 0:
                return False
    return True


# The comparison.


def text(polygons):
    return ";".join("|".join(",".join(f"{x!r},{y!r}" for x, y in ring) for ring in rings) for rings in polygons)


def areas_of_library(program, pairs):
    with tempfile.NamedTemporaryFile("w", suffix=".txt", delete=False) as file:
        for _, a, b in pairs:
            file.write(text(a) + "\n" + text(b) + "\n")
    lines = subprocess.run([program, "--areas", file.name], capture_output=True, text=True, check=True).stdout.splitlines()
    os.unlink(file.name)
    if len(lines) != len(pairs):
        sys.exit(f"{program} answered {len(lines)} of {len(pairs)} pairs")
    return lines


def worst_error(areas, exact):
    union = exact[3]
    return float(max(abs(fractions.Fraction(area) - right) for area, right in zip(areas, exact)) / union)


class Tally:
    def __init__(self):
        self.pairs = collections.Counter()
        self.counts = collections.defaultdict(collections.Counter)
        self.worst_ours = collections.defaultdict(float)
        self.worst_theirs = collections.defaultdict(float)
        self.faults = []

    def judge(self, family, a, b, line, rng):
        self.pairs[family] += 1
        count = self.counts[family]
        theirs = areas_of_shapely(a, b)
        if line.startswith("!"):
            simple = is_simple(a) and is_simple(b)
            count["refused, valid" if simple else "refused, rightly"] += 1
            if simple:
                self.faults.append((family, line, text(a), text(b)))
            return
        ours = [float(word) for word in line.split()[1:]]
        if [ours[2], ours[5], ours[6]] != ours[7:]:
            self.faults.append((family, "areas of the overlay differ from those of its parts: " + line, text(a), text(b)))
        differ = isinstance(theirs, str) or max(abs(x - y) for x, y in zip(ours, theirs)) > TOLERANCE * ours[3]
        count["differ"] += differ
        if not differ and rng.randrange(ALWAYS_ONE_IN) > 0:
            return
        exact = exact_areas(a, b)
        count["refereed"] += 1
        error = worst_error(ours, exact)
        self.worst_ours[family] = max(self.worst_ours[family], error)
        if error > TOLERANCE:
            count["library wrong"] += 1
            self.faults.append((family, f"off by {error:.3g}: {line}", text(a), text(b)))
        if isinstance(theirs, str):
            count["shapely gave up"] += 1
        else:
            error = worst_error(theirs, exact)
            self.worst_theirs[family] = max(self.worst_theirs[family], error)
            count["shapely wrong"] += error > TOLERANCE

    def print(self):
        columns = ["differ", "refereed", "library wrong", "shapely wrong", "shapely gave up", "refused, rightly", "refused, valid"]
        print(f"{'family':20} {'pairs':>8} " + " ".join(f"{column:>16}" for column in columns) + f" {'worst, library':>15} {'worst, shapely':>15}")
        for family in sorted(self.pairs):
            numbers = " ".join(f"{self.counts[family][column]:16}" for column in columns)
            print(f"{family:20} {self.pairs[family]:8} {numbers} {self.worst_ours[family]:15.2g} {self.worst_theirs[family]:15.2g}")
        print(f"{sum(self.pairs.values())} pairs, {len(self.faults)} faults of the library")
        for fault in self.faults[:10]:
            print("\n".join(fault))


def main():
    if len(sys.argv) != 4:
        sys.exit("usage: compare_with_shapely.py SWEEP_BOOLEANS COUNT SEED")
    program, count, rng = sys.argv[1], int(sys.argv[2]), random.Random(int(sys.argv[3]))
    tally = Tally()
    for start in range(0, count, BATCH):
        pairs = [random_pair(rng) for _ in range(min(BATCH, count - start))]
        for (family, a, b), line in zip(pairs, areas_of_library(program, pairs)):
            tally.judge(family, a, b, line, rng)
        print(f"{start + len(pairs)} pairs, {len(tally.faults)} faults", file=sys.stderr, flush=True)
    tally.print()
    sys.exit(1 if tally.faults else 0)


main()
