"""The world of a simulated run: what `palpate simulate` and `palpate export --for csv` left of a scene in a folder, as tissue under an arm."""

import json
import pathlib

from palpation_arm import wrist
from palpation_arm.poses import unit
from palpation_arm.tissue import Tissue

START_OVER_M = 0.02  # the tip begins so high over the tissue's highest place


class World:
    """Of the folder: tissue.csv (in csv/), and from summary.json where the tissue is for the robot, and the arm's frame. Throws OSError, ValueError."""

    def __init__(self, folder, **tissue):
        folder = pathlib.Path(folder)
        told = folder / "csv" / "tissue.csv"
        if not told.is_file():
            raise ValueError(f"{told} is missing: palpate export {folder} --for csv makes it of a run of palpate simulate")
        robot = json.loads((folder / "summary.json").read_text(encoding="utf-8"))["options"]["robot"]
        self.frame = robot.get("frame") or ""
        self.tissue = Tissue(told, robot["from_tissue"], **tissue)

    def start(self):
        """Joints over the middle of the tissue, the probe along its mean normal. Throws ValueError where the arm does not reach that."""
        middle, up = self.tissue.vertices.mean(axis=0), self.tissue.up
        height = ((self.tissue.vertices - middle) @ up).max() + START_OVER_M
        # From straight down, by the shortest turn.
        tilt = unit([float(up[1]), -float(up[0]), 0.0, 1.0 + float(up[2])])
        quaternion = wrist.times(tilt, [1.0, 0.0, 0.0, 0.0])
        joints = wrist.joints_of([float(a) for a in middle + height * up], quaternion)
        if joints is None:
            raise ValueError("the arm does not reach the tissue: robot.from_tissue must put it below the remote centre, such as 0.12 m under it")
        return joints
