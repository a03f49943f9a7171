"""The tissue under a simulated arm, from tissue.csv of `palpate export RUN --for csv`: its shape, and as stiffness, N/mm, the truth that a simulated run knew.

Its shape is the plane through the vertices around, weighted by their distance: within some hundredths of a millimetre of the mesh. It must face up.
"""

import csv
import math

import numpy

AROUND = 10  # vertices
SAME_PLACE_M = 1e-6


class Tissue:
    """In the robot's frame, metres. `offset_mm`: it lies that far at most, smoothly, from where the mesh says; `seed` draws how. Throws ValueError for a
    file without vertices or truth."""

    def __init__(self, path, from_tissue, shift_mm=(0.0, 0.0, 0.0), offset_mm=0.0, seed=1):
        with open(path, newline="", encoding="utf-8") as lines:
            rows = list(csv.DictReader(lines))
        truths = [name for name in (rows or [{}])[0] if name.split(" [")[0] == "truth"]
        if not truths:
            raise ValueError(f"{path}: has no column truth: it must be of a simulated run")
        local = numpy.array([[float(row[f"{axis} [mm]"]) for axis in "xyz"] for row in rows]) / 1000
        self.stiffness = numpy.array([float(row[truths[0]]) for row in rows])
        transform = numpy.array(from_tissue, dtype=float).reshape(4, 4)
        self.up = transform[:3, :3] @ [0.0, 0.0, 1.0]
        dice = numpy.random.default_rng(seed)
        waves, phases = dice.normal(size=(3, 3)) * 2 * math.pi / 0.06, dice.uniform(0, 2 * math.pi, 3)
        bumps = numpy.cos(local @ waves.T + phases).mean(axis=1) * offset_mm / 1000
        self.vertices = local @ transform[:3, :3].T + transform[:3, 3] + bumps[:, None] * self.up + numpy.array(shift_mm) / 1000

    def below(self, place):
        """Height over the tissue (negative inside), its outward normal, its stiffness there; nothing farther beside it than 3 mm."""
        away = self.vertices - numpy.asarray(place)
        squares = numpy.einsum("ij,ij->i", away, away)
        near = numpy.argpartition(squares, AROUND)[:AROUND]
        weights = numpy.exp(-squares[near] / (squares[near].mean() + 1e-12))
        weights /= weights.sum()
        centre = weights @ away[near]
        spread = (away[near] - centre) * numpy.sqrt(weights)[:, None]
        normal = numpy.linalg.eigh(spread.T @ spread)[1][:, 0]
        normal = normal if normal @ self.up > 0 else -normal
        height = -(centre @ normal)
        beside = math.sqrt(max(0.0, squares[near].min() - height * height))
        if beside > 0.003:
            return math.inf, normal, 0.0
        # Shepard's interpolation at the foot: at a vertex what is there, and between vertices nothing that is not around.
        beside_all = away[near] + height * normal
        closeness = 1.0 / (numpy.einsum("ij,ij->i", beside_all, beside_all) ** 2 + SAME_PLACE_M**4)
        return height, normal, float(closeness @ self.stiffness[near] / closeness.sum())
