#!/usr/bin/env python3
"""A criterion of one's own beside published ones: a function of two arrays and the level, asked anew for every pick of a batch.

usage: own_acquisition.py     needs numpy and the module palpation (src/python/README.md)
"""

import numpy as np
import numpy.typing as npt

import palpation as pp

Array = npt.NDArray[np.float64]


def near_the_level(mean: Array, stddev: Array, level: float) -> Array:
    """Worth most where the level is near in standard deviations, and the standard deviation is large."""
    z = (mean - level) / stddev
    return np.asarray(stddev * np.exp(-0.5 * z**2))


def wrong_area_mm2(tissue: pp.Surface, phantom: pp.Phantom, plan: pp.Plan) -> float:
    exploration, random = pp.Exploration(tissue, pp.Model(level=8.0), plan), pp.Random(2)
    while stops := exploration.ask():
        exploration.tell(phantom.touch(stops.vertices, random))
    error = pp.compare(tissue, exploration.conclusion.region(), phantom.true_region())
    wrong = error["symmetric_difference_m2"]
    assert wrong is not None
    return 1e6 * wrong


def main() -> None:
    tissue = pp.make_plane(columns=51, rows=101).surface()
    horseshoe = pp.Horseshoe((0.0095, 0.020, 0.0), arc_radius_m=0.007, half_width_m=0.0025)
    phantom = pp.Phantom(tissue, [horseshoe], noise=0.05)
    plans = {
        "evr": pp.Plan(acquisition="evr"),
        "straddle": pp.Plan(acquisition="straddle"),
        "mine": pp.Plan(acquisition=near_the_level),
    }
    for name, plan in plans.items():
        print(f"{name:9}{wrong_area_mm2(tissue, phantom, plan):5.1f} mm2 wrong")


if __name__ == "__main__":
    main()
