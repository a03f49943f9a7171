#!/usr/bin/env python3
"""Two sessions whose zeros, gains and sensors differ: how wrong `palpate boundary` is, and whether it knows.

usage: two_sessions.py PALPATE [FIRST COUNT]        needs Debian's python3-numpy and python3-shapely
COUNT worlds from number FIRST on (0 24), a line each and a table: disks, hexagons and squares as corners.py has them, edges that rise over 1 to
4 mm, noise of 1 to 5 %; 60 readings in either session, the second with another zero, another gain, both or neither, and a range that ends at 60 or
80 % of the contrast in neither, in the second or in both.
"""

import numpy as np
from corners import SIZE_MM, VERTICES, depth, outline, share
from felt_plane import judge_worlds

SHAPES, NOISES, RISES_MM, PER_SESSION = ["disk", "hexagon", "square"], [0.01, 0.02, 0.05], [1.0, 2.0, 4.0], 60
CHANGES = {"alike": (1, 0), "gain": (None, 0), "zero": (1, None), "gain and zero": (None, None)}
CAPPED = {"whole": (), "second": (1,), "both": (0, 1)}


def world(number):
    dice = np.random.default_rng([number, 99])
    change, capped = list(CHANGES)[number % 4], list(CAPPED)[number // 4 % 3]
    truth = outline(dice.choice(SHAPES), dice)
    at = dice.uniform(0.3, SIZE_MM - 0.3, (2 * PER_SESSION, 2))
    session = np.repeat([0, 1], PER_SESSION)
    noise, rise = dice.choice(NOISES), (dice.choice(["sigmoid", "error function"]), dice.choice(RISES_MM))
    gain, zero = dice.choice([0.6, 0.8, 1.25, 1.6]), dice.choice([-0.6, -0.2, 0.2, 0.6])
    gain, zero = (value if fixed is None else fixed for fixed, value in zip(CHANGES[change], (gain, zero)))
    end = dice.choice([0.6, 0.8])
    reading = 3 + 2 * (share(*rise, depth(truth, at)) + noise * dice.normal(size=len(at)))
    for one in CAPPED[capped]:
        reading[session == one] = np.minimum(reading[session == one], 3 + 2 * end)
    reading = np.where(session == 1, gain * reading + zero, reading)
    words = f"gain {gain:4.2f} zero {zero:4.1f} end {end:.0%} of {capped:6s} noise {noise:.0%} {rise[0]} {rise[1]:.0f} mm"
    return (change, f"ends: {capped}"), words, (SIZE_MM, VERTICES, at, reading, truth, session)


if __name__ == "__main__":
    judge_worlds(__doc__, 24, world)
