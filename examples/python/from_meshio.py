#!/usr/bin/env python3
"""An organ's mesh read by meshio, and what was found written back with it, for any program that meshio writes for.

usage: from_meshio.py MESH_IN_MM     needs numpy, meshio and the module palpation (src/python/README.md); writes found.vtk
"""

import sys

import meshio  # type: ignore[import]
import numpy as np

import palpation as pp


def main() -> None:
    if len(sys.argv) != 2:
        sys.exit("usage: from_meshio.py MESH_IN_MM")
    mesh = meshio.read(sys.argv[1])
    tissue = pp.Surface(mesh.points, mesh.cells_dict["triangle"], unit="mm")
    print(f"{len(tissue.vertices)} vertices, can be laid flat: {tissue.has_chart}")

    top = tissue.vertices[np.argmax(tissue.vertices[:, 2])]
    phantom = pp.Phantom(tissue, [pp.Disk(top, 0.005)], noise=0.05)
    random = pp.Random(1)
    exploration = pp.Exploration(tissue, pp.Model(metric="ambient"), pp.Plan(batches=5))
    while stops := exploration.ask():
        exploration.tell(phantom.touch(stops.vertices, random))

    conclusion = exploration.conclusion
    error = pp.compare(tissue, conclusion.region(), phantom.true_region())
    print(f"{len(conclusion.readings)} readings, dice against the truth {error['dice']:.2f}")
    fields = {"mean": conclusion.mean, "stddev": conclusion.stddev, "probability_inside": conclusion.probability_inside}
    meshio.Mesh(mesh.points, mesh.cells, point_data=fields).write("found.vtk", binary=True)
    again = meshio.read("found.vtk")
    print("found.vtk has", ", ".join(sorted(again.point_data)))


if __name__ == "__main__":
    main()
