#!/usr/bin/env python3
"""What the driver finds with a simulated arm, beside what `palpate simulate` finds of the same scene and seed: the wrong area of both, mm2.

Both against the simulated run's truth, at 36 places in each triangle. What the journal held before each of its plans must give that plan's bytes by
`palpate plan`, and all of it what the session concludes by `palpate boundary`. --ros N takes the arm over a ROS 1 master, N times as fast as time; without, it is in this process's neighbour.

usage: arm_seeds.py PALPATE PROJECT_ROOT SCENE.json [--seeds N] [--first N] [--ros SPEED] [--set KEY=VALUE]...        needs numpy and vtk
"""

import argparse
import contextlib
import json
import os
import pathlib
import socket
import subprocess
import sys
import tempfile
import time

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

TISSUE = ["robot.frame=PSM1_base", "robot.from_tissue=[1,0,0,-0.01,0,1,0,-0.02,0,0,1,-0.12,0,0,0,1]", "robot.standoff_mm=3", "robot.indent_mm=1.5",
          "probe.low=0.3", "probe.high=0.5", "probe.noise=0.05"]
NOISE = 0.05 * (0.5 - 0.3)  # of the arm's touches: as simulate's
PLACES = [((a + (1 / 3)) / 8, (b + (1 / 3)) / 8) for a in range(8) for b in range(8 - a)]


def surface(folder):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(folder / "surface.vtp"))
    reader.Update()
    mesh = reader.GetOutput()
    arrays = mesh.GetPointData()
    triangles = vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    points = vtk_to_numpy(mesh.GetPoints().GetData())
    return points, triangles, {arrays.GetArrayName(i): vtk_to_numpy(arrays.GetArray(i)) for i in range(arrays.GetNumberOfArrays())}


def wrong_mm2(found, world, level):
    points, triangles, fields = surface(found)
    truth = surface(world)[2]["truth"] - level
    above = fields.get("above_level", numpy.full(len(points), -1.0))
    corners = points[triangles]
    areas = numpy.linalg.norm(numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
    total = 0.0
    for a, b in PLACES:
        weights = numpy.array([a, b, 1 - a - b])
        total += areas[(above[triangles] @ weights >= 0) != (truth[triangles] @ weights >= 0)].sum()
    return 1e6 * total / len(PLACES)


def told(*words):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{words}: {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


@contextlib.contextmanager
def arm_over_ros(programs, world, noise, seed, speed, log):
    with socket.socket() as one:
        one.bind(("localhost", 0))
        port = one.getsockname()[1]
    environment = {**os.environ, "ROS_MASTER_URI": f"http://localhost:{port}", "ROS_HOSTNAME": "localhost", "ROS_LOG_DIR": str(log), "ROS_VERSION": "1"}
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL, "env": environment}
    started = [subprocess.Popen(["rosmaster", "--core", "-p", str(port)], **quiet)]
    try:
        while socket.socket().connect_ex(("localhost", port)):
            time.sleep(0.1)
        words = [sys.executable, programs / "palpate-simulated-arm", "--tissue", world, "--noise", noise, "--seed", seed, "--speed", speed]
        started.append(subprocess.Popen([str(word) for word in words], **{**quiet, "stdout": subprocess.PIPE}))
        started[-1].stdout.readline()
        yield environment
    finally:
        for process in started:
            process.kill()
            process.wait()


def plans_of(session):
    lines = (session / "journal.jsonl").read_text(encoding="utf-8").splitlines()
    return [entry for entry in (json.loads(line[17:]) for line in lines) if entry["kind"] == "plan" and entry["stops"]]


def concluded(palpate, scene, session, settings):
    """What the session itself says."""
    requests = [{"do": "open", "scene": str(scene), "folder": str(session), "set": settings}, {"do": "conclude"}]
    done = subprocess.run([palpate, "serve"], input="".join(json.dumps(request) + "\n" for request in requests), capture_output=True, text=True)
    return json.loads(done.stdout.splitlines()[1])["summary"]


def what_differs(palpate, scene, folder, settings):
    """Of the session's plans and conclusion, from what plan and boundary make of its export."""
    asked, differs = [word for value in settings for word in ("--set", value)], []
    for plan in plans_of(folder / "session"):
        export, out = folder / f"export{plan['plan']}", folder / f"plan{plan['plan']}"
        told(palpate, "session", scene, folder / "session", "export", "--out", export, "--plan", plan["plan"], *asked)
        told(palpate, "plan", export / "scene.json", "--measurements", export / "measurements.csv", "--out", out)
        differs += [f"{name} of plan {plan['plan']}" for name in ("waypoints", "path") if (out / f"{name}.csv").read_text(encoding="utf-8") != plan[name]]
    told(palpate, "session", scene, folder / "session", "export", "--out", folder / "export", *asked)
    told(palpate, "boundary", folder / "export" / "scene.json", "--measurements", folder / "export" / "measurements.csv", "--out", folder / "boundary")
    summary, of_session = json.loads((folder / "boundary" / "summary.json").read_text(encoding="utf-8")), concluded(palpate, scene, folder / "session", settings)
    return differs + [key for key in ("area_mm2", "parts", "level", "level_sd", "expected_error_mm2", "measurements") if summary[key] != of_session[key]]


def one(asked, seed, folder):
    palpate, programs = asked.palpate, asked.root / "src" / "robot" / "ros"
    values = [*TISSUE, *asked.set, f"seed={seed}"]
    settings = [word for value in values for word in ("--set", value)]
    told(palpate, "simulate", asked.scene, "--out", folder / "world", *settings)
    told(palpate, "export", folder / "world", "--for", "csv")
    words = [sys.executable, programs / "palpate-arm", asked.scene, folder / "session", "--palpate", palpate, "--yes", *settings]
    begun = time.monotonic()
    if asked.ros:
        with arm_over_ros(programs, folder / "world", NOISE, seed, asked.ros, folder) as environment:
            done = subprocess.run([str(word) for word in words], capture_output=True, text=True, env=environment)
    else:
        done = subprocess.run([str(word) for word in [*words, "--simulated", folder / "world", "--noise", NOISE, "--seed", seed]], capture_output=True, text=True)
    seconds = time.monotonic() - begun
    if done.returncode != 0:
        return print(f"seed {seed}: {done.returncode} {done.stdout[-500:]}{done.stderr[-500:]}", flush=True)
    differing = what_differs(palpate, asked.scene, folder, values)
    errors = [wrong_mm2(found, folder / "world", 0.4) for found in (folder / "world", folder / "boundary")]
    print(f"seed {seed}: simulate {errors[0]:.2f}, arm {errors[1]:.2f} mm2, {seconds:.0f} s, differs: {differing or 'nothing'}", flush=True)
    return errors


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("palpate", type=lambda word: pathlib.Path(word).resolve())
    parser.add_argument("root", type=lambda word: pathlib.Path(word).resolve())
    parser.add_argument("scene", type=lambda word: pathlib.Path(word).resolve())
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--first", type=int, default=1)
    parser.add_argument("--ros", type=float)
    parser.add_argument("--set", action="append", default=[])
    asked = parser.parse_args()
    errors = []
    for seed in range(asked.first, asked.first + asked.seeds):
        with tempfile.TemporaryDirectory() as folder:
            errors.append(one(asked, seed, pathlib.Path(folder)))
    simulated, arm = numpy.array([pair for pair in errors if pair]).mean(axis=0)
    print(f"{len(errors)} seeds, {sum(pair is None for pair in errors)} held: simulate {simulated:.2f}, arm {arm:.2f} mm2, {arm / simulated:.2f} times")


if __name__ == "__main__":
    main()
