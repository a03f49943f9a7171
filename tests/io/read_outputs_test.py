#!/usr/bin/env python3
"""Other people's eyes: opens every .vtp and .pvd of an output folder with VTK's own Python package and looks for the arrays that the contract names.

usage: read_outputs_test.py OUT_DIR [--truth] [--steps N]        needs Debian's python3-vtk9
  --truth     surface.vtp and boundary.vtp must hold the truth as well
  --steps N   steps.pvd must list exactly N files
Ends with 0 if all is there, 1 with one line for each fault, 77 (ctest: skipped) where VTK's Python package is not installed.
"""

import argparse
import math
import pathlib
import sys
import xml.etree.ElementTree

try:
    from vtkmodules.vtkCommonCore import VTK_DOUBLE, VTK_INT
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
except ImportError:
    print("python3-vtk9 is not installed")
    sys.exit(77)

FIELDS = ["mean", "stddev", "acquisition"]  # probability_inside and truth only where they are known
KINDS = {0: "estimate", 1: "truth", 2: "band_inner", 3: "band_outer", 4: "cut"}


class Faults:
    def __init__(self):
        self.count = 0

    def expect(self, condition, path, words):
        if not condition:
            self.count += 1
            print(f"{path}: {words}")
        return condition


def read(path, faults):
    reader = vtkXMLPolyDataReader()
    messages = []
    reader.AddObserver("ErrorEvent", lambda *_: messages.append("VTK reports an error"))
    if not faults.expect(reader.CanReadFile(str(path)), path, "VTK cannot read it"):
        return None
    reader.SetFileName(str(path))
    reader.Update()
    faults.expect(reader.GetErrorCode() == 0 and not messages, path, f"VTK's reader fails with code {reader.GetErrorCode()}")
    return reader.GetOutput()


def check_surface(path, wanted, faults):
    surface = read(path, faults)
    if surface is None:
        return
    count = surface.GetNumberOfPoints()
    faults.expect(count >= 3 and surface.GetNumberOfPolys() >= 1, path, f"{count} points and {surface.GetNumberOfPolys()} triangles")
    faults.expect(surface.GetPoints().GetDataType() == VTK_DOUBLE, path, "coordinates are no doubles")
    arrays = surface.GetPointData()
    for name in wanted:
        array = arrays.GetArray(name)
        if faults.expect(array is not None, path, f"no point array named {name}"):
            faults.expect(array.GetNumberOfTuples() == count, path, f"{name} has {array.GetNumberOfTuples()} values for {count} points")
            faults.expect(array.GetDataType() == VTK_DOUBLE and array.GetNumberOfComponents() == 1, path, f"{name} holds no plain doubles")
    for name in ["stddev", "probability_inside"]:
        array = arrays.GetArray(name)
        if array is not None and count > 0:
            low, high = array.GetRange()
            faults.expect(low >= 0.0 and (name == "stddev" or high <= 1.0), path, f"{name} ranges from {low} to {high}")


def check_boundary(path, wanted_kinds, faults):
    boundary = read(path, faults)
    if boundary is None:
        return
    lines = boundary.GetNumberOfLines()
    arrays = boundary.GetCellData()
    kinds, names = arrays.GetArray("kind"), arrays.GetAbstractArray("kind_name")
    parts, holes = arrays.GetArray("part"), arrays.GetArray("hole")
    for name, array in [("kind", kinds), ("kind_name", names), ("part", parts), ("hole", holes)]:
        if not faults.expect(array is not None, path, f"no cell array named {name}"):
            return
        faults.expect(array.GetNumberOfTuples() == lines, path, f"{name} has {array.GetNumberOfTuples()} values for {lines} lines")
    for array in [kinds, parts, holes]:
        faults.expect(array.GetDataType() == VTK_INT, path, f"{array.GetName()} holds no integers")
    seen = set()
    for i in range(lines):
        kind = int(kinds.GetTuple1(i))
        seen.add(KINDS.get(kind))
        faults.expect(KINDS.get(kind) == names.GetValue(i), path, f"line {i} is of kind {kind}, but named {names.GetValue(i)}")
        faults.expect(holes.GetTuple1(i) in (0, 1) and parts.GetTuple1(i) >= 0, path, f"line {i} has an odd part or hole")
        ids = boundary.GetCell(i).GetPointIds()
        faults.expect(ids.GetNumberOfIds() >= 3 and ids.GetId(0) == ids.GetId(ids.GetNumberOfIds() - 1), path, f"line {i} is not closed")
    for i in range(boundary.GetNumberOfPoints()):
        faults.expect(all(math.isfinite(x) for x in boundary.GetPoint(i)), path, f"point {i} is not finite")
    for kind in wanted_kinds:
        faults.expect(kind in seen, path, f"no line of kind {kind}")


def check_steps(path, wanted_fields, wanted_steps, faults):
    files = [entry.get("file") for entry in xml.etree.ElementTree.parse(path).getroot().iter("DataSet")]
    times = [entry.get("timestep") for entry in xml.etree.ElementTree.parse(path).getroot().iter("DataSet")]
    faults.expect(times == [str(i) for i in range(len(files))], path, f"times are {times}")
    faults.expect(wanted_steps is None or len(files) == wanted_steps, path, f"lists {len(files)} steps, not {wanted_steps}")
    for name in files:
        if faults.expect((path.parent / name).is_file(), path, f"names {name}, which is not there"):
            check_surface(path.parent / name, wanted_fields, faults)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--truth", action="store_true")
    parser.add_argument("--steps", type=int)
    wish = parser.parse_args()

    faults = Faults()
    fields = FIELDS + (["truth"] if wish.truth else [])
    for name in ["surface.vtp", "boundary.vtp"] + ([] if wish.steps is None else ["steps.pvd"]):
        faults.expect((wish.folder / name).is_file(), wish.folder / name, "is not there")
    if faults.count:
        return 1
    check_surface(wish.folder / "surface.vtp", fields, faults)
    check_boundary(wish.folder / "boundary.vtp", ["truth"] if wish.truth else [], faults)
    for path in sorted(wish.folder.glob("*.pvd")):
        check_steps(path, fields, wish.steps, faults)
    for path in sorted(wish.folder.rglob("*.vtp")):
        read(path, faults)
    if faults.count == 0:
        print(f"{wish.folder}: every named array is there")
    return 1 if faults.count else 0


if __name__ == "__main__":
    sys.exit(main())
