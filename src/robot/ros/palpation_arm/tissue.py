"""The tissue under a simulated arm, from tissue.csv of `palpate export RUN --for csv`: its shape, and as stiffness, N/mm, the truth that a simulated run knew.

Between vertices it is the plane through those around, weighted by their distance: within some hundredths of a millimetre of the mesh. It must face up.
"""

import csv
import math

import numpy

AROUND = 10  # vertices


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
        design = spread @ numpy.linalg.pinv(spread.T @ spread + 1e-12 * numpy.eye(3))
        values = self.stiffness[near]
        gradient = design.T @ (numpy.sqrt(weights) * (values - weights @ values))
        here = -centre - height * normal  # of the foot, from the centre
        return height, normal, float(numpy.clip(weights @ values + gradient @ here, values.min(), values.max()))
