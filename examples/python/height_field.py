#!/usr/bin/env python3
"""Tissue from a height field, as a depth camera gives it: where to touch, where the tumour ends, how sure that is.

usage: height_field.py     needs numpy and the module palpation (src/python/README.md)
"""

import numpy as np
import numpy.typing as npt

import palpation as pp


def grid_faces(rows: int, columns: int) -> npt.NDArray[np.int64]:
    """Two triangles a cell, counter-clockwise seen from above."""
    corner = np.arange(rows * columns).reshape(rows, columns)
    a, b, c, d = corner[:-1, :-1].ravel(), corner[:-1, 1:].ravel(), corner[1:, 1:].ravel(), corner[1:, :-1].ravel()
    return np.concatenate([np.column_stack([a, b, c]), np.column_stack([a, c, d])])


def main() -> None:
    x, y = np.meshgrid(np.linspace(0, 30, 61), np.linspace(0, 40, 81))  # mm
    height = 2.0 * np.sin(x / 12.0) * np.cos(y / 15.0)
    vertices = np.column_stack([x.ravel(), y.ravel(), height.ravel()])
    tissue = pp.Surface(vertices, grid_faces(*x.shape), unit="mm")
    print(f"{len(tissue.vertices)} vertices, {tissue.area_m2 * 1e6:.0f} mm2")

    # In place of your robot: a disk of 6 mm radius under the tissue, noise of 5 % of its contrast.
    phantom = pp.Phantom(tissue, [pp.Disk((0.014, 0.022, 0.0), 0.006)], noise=0.05)
    random = pp.Random(1)
    exploration = pp.Exploration(tissue, plan=pp.Plan(batches=6))
    while stops := exploration.ask():
        exploration.tell(phantom.touch(stops.positions, random))

    conclusion = exploration.conclusion
    found, summary = conclusion.region(), conclusion.summary()
    print(f"{summary['readings']} readings, level {summary['level']:.2f}, tumour of {pp.surface_area(tissue, found) * 1e6:.0f} mm2")
    print(f"expected to be wrong: {summary['expected_error_m2'] * 1e6:.1f} mm2")
    error = pp.compare(tissue, found, phantom.true_region())
    print(f"dice against the truth: {error['dice']:.2f}")
    assert conclusion.probability_inside is not None
    likely = conclusion.probability_inside.reshape(x.shape) > 0.5  # an image again
    print(f"{np.count_nonzero(likely)} of {likely.size} pixels are rather tumour than not")


if __name__ == "__main__":
    main()
