"""A small scene for an arm, and what `palpate` makes of it: the world that lies under a simulated one."""

import json
import subprocess

SCENE = {
    "surface": {"plane": {"size_mm": [20, 20], "vertices": [27, 27]}},
    "field": {"length_mm": 4, "signal_sd": 0.1, "noise": 0.005},
    "certainty": "laplace",
    "plan": {"initial": {"count": 9}, "batch": 5, "batches": 2},
    "probe": {"low": 0.3, "high": 0.5, "noise": 0.025, "tumours": [{"shape": "disk", "centre_mm": [11, 9, 0], "radius_mm": 5}]},
    "robot": {"frame": "PSM1_base", "standoff_mm": 3, "indent_mm": 1, "from_tissue": [1, 0, 0, -0.01, 0, 1, 0, -0.01, 0, 0, 1, -0.12, 0, 0, 0, 1]},
    "reading_unit": "N/mm",
}
STOPS = 9 + 2 * 5


def world_of(palpate, folder, **changes):
    """Writes scene.json and the simulated run `world` into the folder. `changes`: of whole sections' keys."""
    scene = {section: {**values, **changes.get(section, {})} if isinstance(values, dict) else values for section, values in SCENE.items()}
    (folder / "scene.json").write_text(json.dumps(scene), encoding="utf-8")
    for words in (["simulate", folder / "scene.json", "--out", folder / "world", "--set", "plan.batches=1"], ["export", folder / "world", "--for", "csv"]):
        subprocess.run([palpate, *words], check=True, capture_output=True)
    return folder / "world"


def rows_of(session):
    """What the journal took for readings."""
    lines = (session / "journal.jsonl").read_text(encoding="utf-8").splitlines()
    return [entry for entry in (json.loads(line[17:]) for line in lines) if entry["kind"] == "reading"]
