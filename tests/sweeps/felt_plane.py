"""A plane of tissue that was felt at some places, concluded by `palpate boundary`."""

import json
import subprocess


def concluded(palpate, folder, size_mm, vertices, at_mm, readings):
    """The summary; the other files lie in folder/out. size_mm, vertices: of the plane, two each; at_mm: a row a place."""
    (folder / "scene.json").write_text(json.dumps({"surface": {"plane": {"size_mm": list(size_mm), "vertices": list(vertices)}}}))
    rows = [f"{x / 1e3},{y / 1e3},0,{reading}\n" for (x, y), reading in zip(at_mm, readings)]
    (folder / "felt.csv").write_text("x,y,z,reading\n" + "".join(rows))
    subprocess.run([palpate, "boundary", folder / "scene.json", "--measurements", folder / "felt.csv", "--out", folder / "out", "--overwrite", "--quiet"],
                   check=True, capture_output=True)
    return json.loads((folder / "out" / "summary.json").read_text())
