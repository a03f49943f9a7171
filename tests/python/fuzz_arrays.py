#!/usr/bin/env python3
"""Array arguments of every kind, right, nearly right and absurd, to everything of the module that takes them: each call answers, or raises an exception
of the module's own, a TypeError or a ValueError, with words. It never crashes, hangs or raises anything else.

usage: fuzz_arrays.py COUNT [FIRST_SEED]     with the package `palpation` on PYTHONPATH; each seed is a case, told before it is tried (--trace)
"""

import sys
import tempfile

try:
    import numpy as np
except ImportError:
    print("skipped: numpy is not installed")
    sys.exit(77)

import palpation as pp

WELCOME = (pp.Error, TypeError, ValueError, OverflowError, UserWarning)
DTYPES = ["f8", "f4", "f2", "g", ">f8", "i4", "i8", "u8", "u1", "i2", ">i4", "?", "c16", "O", "U3", "S2", "M8[s]", "m8[s]", "V4"]
SPECIALS = [0.0, -0.0, 1.0, -1.0, np.nan, np.inf, -np.inf, 1e-300, 5e-324, 1e300, 1.7e308, 1e30, -1e30, 1e18, 2.0**31, 2.0**63, 0.01, 1e-9]


def shape(random, rows, columns):
    if random.random() < 0.7:
        return (rows, columns) if columns else (rows,)
    return tuple(int(n) for n in random.integers(0, 5, size=random.integers(0, 4)))


def numbers(random, size, scale):
    values = random.standard_normal(size) * scale
    kind = random.random()
    if kind < 0.3:
        values = np.where(random.random(size) < 0.2, random.choice(SPECIALS, size=size), values)
    elif kind < 0.4:
        values = np.full(size, random.choice(SPECIALS))
    elif kind < 0.6:
        values = np.abs(values)
    return values


def laid_out(random, array):
    """The same numbers, otherwise in memory, or as something that is no array."""
    kind = random.integers(0, 14)
    if kind == 0:
        return np.asfortranarray(array)
    if kind == 1 and array.ndim:
        return array[::-1]
    if kind == 2 and array.ndim:
        return np.repeat(array, 2, axis=0)[::2]
    if kind == 3:
        return array.tolist()
    if kind == 4:
        return np.ma.masked_invalid(array) if array.dtype.kind == "f" else array
    if kind == 5:
        array.setflags(write=False)
        return array
    if kind == 6:
        return np.broadcast_to(array[:1], array.shape) if array.ndim and len(array) else array
    if kind == 7 and array.nbytes:
        packed = np.zeros(array.nbytes + 1, dtype="u1")
        moved = packed[1:].view(array.dtype).reshape(array.shape)  # out of line with its size
        moved[...] = array
        return moved
    if kind == 8:
        return memoryview(np.ascontiguousarray(array)) if array.dtype.kind in "fiu" else array
    return array


class Hostile:
    """Says that it is an array, and is none."""

    def __init__(self, random):
        self.kind = random.integers(0, 5)

    def __array__(self, dtype=None):
        if self.kind == 0:
            raise ValueError("no array today")
        if self.kind == 1:
            return np.empty((0, 3))
        if self.kind == 2:
            return np.arange(6, dtype=object).reshape(2, 3)
        return np.eye(3)

    def __len__(self):
        return -1 if self.kind == 3 else 3

    def __getitem__(self, index):
        raise IndexError(index)


def argument(random, rows, columns, scale=0.01):
    kind = random.random()
    if kind < 0.06:
        return random.choice(np.array([None, "", "x", b"xy", 3, -1.5, True, {}, {1: 2}, [], [[]], [[1], [2, 3]], (), set(), object, np.nan], dtype=object))
    if kind < 0.09:
        return Hostile(random)
    size = shape(random, rows, columns)
    values = numbers(random, size, scale)
    dtype = "f8" if random.random() < 0.6 else str(random.choice(DTYPES))
    with np.errstate(all="ignore"):
        try:
            array = np.asarray(values).astype(dtype)
        except (TypeError, ValueError, OverflowError):
            array = np.asarray(values)
    return laid_out(random, array)


def whole(random, count, columns, below):
    """Indices, mostly good ones."""
    if random.random() < 0.35:
        return argument(random, count, columns, scale=below)
    size = (count, columns) if columns else (count,)
    indices = random.integers(-1 if random.random() < 0.2 else 0, below + (random.random() < 0.2), size=size)
    return laid_out(random, indices.astype(random.choice(["i4", "i8", "u2", "i1", ">i8"])))


TISSUE = pp.make_plane(size_m=(0.02, 0.02), columns=9, rows=9).surface()
PHANTOM = pp.Phantom(TISSUE, [pp.Disk((0.01, 0.01, 0.0), 0.004)])
GRID = TISSUE.vertices


def where(random, count):
    if random.random() < 0.5:
        return whole(random, count, 0, len(GRID))
    if random.random() < 0.5:
        return GRID[random.integers(0, len(GRID), size=count)] + random.standard_normal((count, 3)) * random.choice([0.0, 1e-4, 1e-2])
    return argument(random, count, 3)


def explore(random):
    exploration = pp.Exploration(TISSUE, plan=pp.Plan(initial_count=4, batch=2, batches=1), reach=None if random.random() < 0.7 else whole(random, 6, 0, 81))
    count = len(exploration.ask())
    try:
        exploration.tell(argument(random, count, 0, 1.0), noise_variance=None if random.random() < 0.5 else argument(random, count, 0, 1.0))
    except WELCOME:
        assert exploration.batch == 0 and len(exploration.readings) == 0, "half told"
        raise


def own_scores(random):
    plan = pp.Plan(acquisition=lambda mean, stddev, level: argument(random, 81, 0), initial_count=2, batch=1, batches=1)
    pp.Exploration(TISSUE, pp.Model(level=0.5, safe_start=False), plan).tell([0.0, 1.0])


def conclude(random):
    count = int(random.integers(0, 8))
    readings = pp.Readings(TISSUE, where(random, count), argument(random, count, 0, 1.0), noise_variance=None if random.random() < 0.6 else argument(random, count, 0))
    conclusion = pp.conclude(readings)
    assert conclusion.mean.shape == (81,) and not np.isnan(conclusion.mean).any() and (conclusion.stddev >= 0).all()
    conclusion.summary(), readings.to_csv(), readings.as_dict()


def readings(random):
    count = int(random.integers(0, 6))
    made = pp.Readings(TISSUE, where(random, count), argument(random, count, 0, 1.0), travel=argument(random, count, 3, 1.0), batch=int(random.integers(-1, 3)))
    assert len(made + made) == 2 * len(made)


def surface(random):
    count = int(random.integers(1, 7))
    made = pp.Surface(argument(random, count, 3), whole(random, int(random.integers(1, 5)), 3, count), unit=str(random.choice(["mm", "cm", "m", "in"])))
    made.normals, made.vertex_areas_m2, made.topology, made.border_loops
    if made.has_chart:
        made.chart


def region(random):
    rings = [argument(random, int(random.integers(0, 6)), 2, 1.0) for _ in range(int(random.integers(1, 4)))]
    a = pp.Region([(rings[0], rings[1:])])
    b = pp.Region([(np.array([(0.0, 0.0), (1.0, 0.0), (0.5, 1.0)]), [])])
    total = (a | b).area_m2 + (a & b).area_m2
    assert abs(total - a.area_m2 - b.area_m2) <= 1e-9 * max(1.0, total), "areas do not add up"
    pp.Region.from_shape(a), pp.Region.from_wkt(a.wkt), a.contains(argument(random, 3, 2, 1.0))


SCENE = {"surface": {"plane": {"size_mm": [6, 6], "vertices": [9, 9]}}, "plan": {"initial": {"count": 4}, "batch": 2, "batches": 1}}


def session(random):
    def perhaps(made):
        return made if random.random() < 0.4 else None

    with tempfile.TemporaryDirectory() as folder, pp.Session(SCENE, folder) as run:
        count = len(run.next())
        lines = len(run.journal)
        try:
            run.record(
                argument(random, count, 0, 1.0),
                perhaps(where(random, count)),
                stop=perhaps(whole(random, count, 0, count)),
                noise_variance=perhaps(argument(random, count, 0)),
                travel=perhaps(argument(random, count, 3)),
                t=perhaps(argument(random, count, 0)),
            )
        except WELCOME:
            assert len(run.journal) == lines, "half told"
            raise
        run.touch_first(argument(random, 3, 0))
        run.keep_out(argument(random, 3, 0), float(random.choice(SPECIALS)))
        run.miss(whole(random, 2, 0, count))
        run.next()


CASES = [
    surface,
    region,
    readings,
    conclude,
    explore,
    own_scores,
    session,
    lambda random: TISSUE.project(argument(random, 4, 3)),
    lambda random: TISSUE.to_chart(where(random, 3)),
    lambda random: TISSUE.distance_from(where(random, 2)),
    lambda random: PHANTOM.touch(where(random, 3), pp.Random(1), travel=argument(random, 3, 3)),
    lambda random: pp.superlevel_region(TISSUE, argument(random, 81, 0), float(random.choice(SPECIALS))),
    lambda random: pp.waypoints(TISSUE, where(random, 3), from_tissue=None if random.random() < 0.5 else argument(random, 4, 4)),
    lambda random: pp.reachable_vertices(TISSUE, shaft_direction=argument(random, 3, 0)),
    lambda random: pp.Phantom(TISSUE, [pp.Outline(where(random, 4)), pp.Disk(argument(random, 3, 0), float(random.choice(SPECIALS)))]),
    lambda random: pp.make_plane(size_m=argument(random, 2, 0), columns=3, rows=3, corner_m=argument(random, 2, 0)),
]


def main():
    arguments = [word for word in sys.argv[1:] if word != "--trace"]
    if len(arguments) not in (1, 2):
        sys.exit("usage: fuzz_arrays.py COUNT [FIRST_SEED] [--trace]")
    count, first = int(arguments[0]), int(arguments[1]) if len(arguments) == 2 else 0
    import warnings

    warnings.simplefilter("ignore")
    answered, refused = 0, {}
    for seed in range(first, first + count):
        if "--trace" in sys.argv:
            print(seed, flush=True)
        try:
            CASES[seed % len(CASES)](np.random.default_rng(seed))
            answered += 1
        except WELCOME as error:
            name = type(error).__name__
            assert str(error) or name != "InvalidInput", f"seed {seed}: an error without words"
            refused[name] = refused.get(name, 0) + 1
        except BaseException:
            print(f"seed {seed}:", file=sys.stderr)
            raise
    print(f"{count} cases: {answered} answered, refused: {dict(sorted(refused.items()))}")
    if count >= 1000 and (answered < count / 20 or sum(refused.values()) < count / 20):
        sys.exit("this test is broken: it tries too little of one kind")


if __name__ == "__main__":
    main()
