#!/usr/bin/env python3
"""What `palpate export` gives to other programs, read back by VTK's own Python package where it is installed.

usage: export_test.py PALPATE [Export.test_...]        needs Python 3; Debian's python3-vtk9 for what is read back
"""

import json
import math
import pathlib
import sys
import tempfile
import unittest
import xml.etree.ElementTree

from support import main_without_pictures, palpate, rows_of, skip

try:
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
except ImportError:
    vtkXMLPolyDataReader = None

# Tissue that is its own mirror image in no direction: a corner is missing, and it rises towards another. Millimetres.
STEPS, EDGE_MM = 24, 1.0
LANDMARK_MM = (20.0, 3.0, 1.85)
DISK_MM = (7.0, 15.0)


def height_mm(x, y):
    return 0.1 * x - 0.05 * y if (x, y) != (20.0, 3.0) else LANDMARK_MM[2]


def write_asymmetric_mesh(path):
    number, vertices, faces = {}, [], []
    for row in range(STEPS + 1):
        for column in range(STEPS + 1):
            x, y = column * EDGE_MM, row * EDGE_MM
            if x > 14 and y > 14:
                continue
            number[row, column] = len(vertices) + 1
            vertices.append(f"v {x} {y} {height_mm(x, y)}\n")
    for row in range(STEPS):
        for column in range(STEPS):
            corners = [(row, column), (row, column + 1), (row + 1, column + 1), (row + 1, column)]
            if all(corner in number for corner in corners):
                a, b, c, d = (number[corner] for corner in corners)
                faces.append(f"f {a} {b} {c}\nf {a} {c} {d}\n")
    path.write_text("".join(vertices + faces))


SCENE = {
    "surface": {"mesh": "tissue.obj", "unit": "mm"},
    "reading_unit": "N/mm",
    "certainty": "laplace",
    "plan": {"initial": {"count": 25}, "batches": 3},
    "probe": {"noise": 0.02, "tumours": [{"shape": "disk", "centre_mm": [*DISK_MM, 0.0], "radius_mm": 4}]},
}

# What Slicer's schema of markups (v1.0.3) asks of a list of points: keys with their types, and the words that some may have.
LIST = {"type": str, "name": str, "coordinateSystem": str, "coordinateUnits": str, "locked": bool, "labelFormat": str, "controlPoints": list, "display": dict}
POINT = {"id": str, "label": str, "description": str, "position": list, "selected": bool, "locked": bool, "visibility": bool, "positionStatus": str}
DISPLAY = {"visibility": bool, "color": list, "selectedColor": list, "propertiesLabelVisibility": bool, "pointLabelsVisibility": bool, "useGlyphScale": bool,
           "glyphSize": float}


def names_in(folder):
    return {path.name for path in folder.iterdir()}


def read(path):
    """(poly data, texts of its field data) by VTK."""
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    assert reader.GetErrorCode() == 0, path
    model = reader.GetOutput()
    data = model.GetFieldData()
    return model, {data.GetAbstractArray(i).GetName(): data.GetAbstractArray(i).GetValue(0) for i in range(data.GetNumberOfArrays())}


def points_of(model):
    return [model.GetPoint(i) for i in range(model.GetNumberOfPoints())]


def to_patient(point, space):
    """Where Slicer shows it, in its own frame RAS (vtkMRMLModelStorageNode: LPS is turned about z)."""
    return point if space == "RAS" else (-point[0], -point[1], point[2])


class Export(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.holder = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.holder.name)
        write_asymmetric_mesh(cls.folder / "tissue.obj")
        (cls.folder / "scene.json").write_text(json.dumps(SCENE))
        cls.run_folder = cls.folder / "run"
        result = palpate("simulate", cls.folder / "scene.json", "--out", cls.run_folder, "--quiet")
        assert result.returncode == 0, result.stderr
        cls.summary = json.loads((cls.run_folder / "summary.json").read_text())

    @classmethod
    def tearDownClass(cls):
        cls.holder.cleanup()

    def export(self, program, *arguments, run=None):
        out = pathlib.Path(tempfile.mkdtemp(dir=self.folder)) / program
        result = palpate("export", run or self.run_folder, "--for", program, "--out", out, *arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        return out

    def need_vtk(self):
        if vtkXMLPolyDataReader is None:
            skip(self, "python3-vtk9 is not installed")

    def nearest(self, points, wanted):
        return min(points, key=lambda point: math.dist(point, wanted))

    def test_slicer_shows_a_landmark_where_it_is_in_either_frame(self):
        self.need_vtk()
        for frame, in_patient in (("RAS", LANDMARK_MM), ("LPS", (-LANDMARK_MM[0], -LANDMARK_MM[1], LANDMARK_MM[2]))):
            out = self.export("slicer", "--frame", frame)
            tissue, told = read(out / "tissue.vtp")
            self.assertEqual(told, {"UNIT": "mm", "FRAME": frame, "SPACE": frame})
            shown = [to_patient(point, told["SPACE"]) for point in points_of(tissue)]
            self.assertLess(math.dist(self.nearest(shown, in_patient), in_patient), 1e-9)
            mirrored = (-in_patient[0], in_patient[1], in_patient[2])
            self.assertGreater(math.dist(self.nearest(shown, mirrored), mirrored), 1.0)
            tumour, told = read(out / "tumour.vtp")
            bounds = tumour.GetBounds()
            centre = to_patient(((bounds[0] + bounds[1]) / 2, (bounds[2] + bounds[3]) / 2, 0.0), told["SPACE"])
            disk = to_patient((*DISK_MM, 0.0), frame)
            self.assertLess(math.dist(centre[:2], disk[:2]), 1.0)
            marks = json.loads((out / "touches.mrk.json").read_text())["markups"][0]
            self.assertEqual(marks["coordinateSystem"], frame)
            felt = rows_of(self.run_folder / "measurements.csv")
            for point in marks["controlPoints"]:
                row = felt[int(point["label"]) - 1]
                self.assertLess(math.dist(point["position"], [1000.0 * float(row[axis]) for axis in "xyz"]), 1e-9)

    def test_models_have_the_areas_that_the_summary_tells(self):
        self.need_vtk()
        from vtkmodules.vtkFiltersCore import vtkMassProperties
        out = self.export("slicer", "--frame", "RAS")
        band = self.summary["band"]
        for name, area_mm2 in (("tissue", self.summary["search_area_mm2"]), ("tumour", self.summary["area_mm2"]),
                               ("band", band["outer_area_mm2"] - band["inner_area_mm2"])):
            model, _ = read(out / f"{name}.vtp")
            measured = vtkMassProperties()
            measured.SetInputData(model)
            self.assertAlmostEqual(measured.GetSurfaceArea(), area_mm2, delta=1e-6 * area_mm2, msg=name)
        line, _ = read(out / "cut_line.vtp")
        self.assertGreaterEqual(line.GetNumberOfLines(), 1)

    def test_paraview_gets_metres_and_a_list_of_files_that_are_there(self):
        self.need_vtk()
        out = self.export("paraview")
        tissue, told = read(out / "tissue.vtp")
        self.assertEqual(told, {"UNIT": "m", "FRAME": "mesh"})
        landmark_m = [0.001 * value for value in LANDMARK_MM]
        self.assertLess(math.dist(self.nearest(points_of(tissue), landmark_m), landmark_m), 1e-12)
        listed = (out / "palpation.pvd").read_text()
        for name in names_in(out) - {"palpation.pvd", "export.json"}:
            self.assertIn(f'file="{name}"', listed)
        self.assertEqual(listed.count("<DataSet"), len(names_in(out)) - 2)
        touches, _ = read(out / "touches.vtp")
        self.assertEqual(touches.GetNumberOfVerts(), self.summary["measurements"])

    def test_all_files_of_a_run_say_unit_and_frame(self):
        self.need_vtk()
        framed = self.folder / "framed"
        result = palpate("simulate", self.folder / "scene.json", "--out", framed, "--quiet", "--set", "surface.frame=LPS")
        self.assertEqual(result.returncode, 0, result.stderr)
        files = [framed / "surface.vtp", framed / "boundary.vtp", *(framed / "steps").iterdir()]
        self.assertEqual(len(files), 6)
        for path in files:
            self.assertEqual(read(path)[1], {"UNIT": "m", "FRAME": "LPS", "SPACE": "LPS"}, path)
        for path in (self.run_folder / "surface.vtp", self.run_folder / "boundary.vtp"):
            self.assertEqual(read(path)[1], {"UNIT": "m", "FRAME": "mesh"}, path)
        self.export("slicer", run=framed)
        mirrored = palpate("export", framed, "--for", "slicer", "--frame", "RAS")
        self.assertEqual(mirrored.returncode, 3)
        self.assertIn("would mirror them", mirrored.stderr)
        self.assertFalse((framed / "slicer").exists())

    def test_a_mesh_that_says_its_frame_and_unit_is_believed_and_contradictions_are_refused(self):
        tissue = self.export("slicer", "--frame", "LPS") / "tissue.vtp"
        scene = self.folder / "again.json"
        scene.write_text(json.dumps({**SCENE, "surface": {"mesh": str(tissue), "unit": "mm"}, "plan": {"initial": {"count": 9}, "batches": 0}}))
        again = self.folder / "again"
        self.assertEqual(palpate("simulate", scene, "--out", again, "--quiet").returncode, 0)
        self.export("slicer", run=again)
        for override, words in (("surface.unit=m", "its field data say that its lengths are in mm (UNIT), but it is to be read in m"),
                                ("surface.frame=RAS", 'surface.frame: is "RAS", but must be LPS, as the field data of')):
            refused = palpate("simulate", scene, "--set", override)
            self.assertEqual(refused.returncode, 3, override)
            self.assertIn(words, refused.stderr)

    def test_the_frame_is_asked_for_and_never_guessed(self):
        refused = palpate("export", self.run_folder, "--for", "slicer")
        self.assertEqual(refused.returncode, 2)
        for words in ("surface.frame", "--frame RAS", "--frame LPS"):
            self.assertIn(words, refused.stderr)
        self.assertFalse((self.run_folder / "slicer").exists())

    def test_markups_are_as_slicers_schema_asks(self):
        out = self.export("slicer", "--frame", "LPS")
        document = json.loads((out / "touches.mrk.json").read_text())
        self.assertRegex(document["@schema"], r"markups-schema-v1\.0\.3\.json#$")
        (marks,) = document["markups"]
        for keys, found in ((LIST, marks), (DISPLAY, marks["display"]), *((POINT, point) for point in marks["controlPoints"])):
            self.assertEqual(found.keys(), keys.keys())
            for key, kind in keys.items():
                self.assertIsInstance(found[key], kind, key)
        self.assertEqual((marks["type"], marks["coordinateUnits"]), ("Fiducial", "mm"))
        self.assertEqual(len(marks["controlPoints"]), self.summary["measurements"])
        for point in marks["controlPoints"]:
            self.assertEqual(len(point["position"]), 3)
            self.assertEqual(point["positionStatus"], "defined")
            self.assertRegex(point["description"], r"^reading [0-9.]+ N/mm, batch [0-3]$")

    def test_slicers_scene_opens_every_file_in_its_colour(self):
        out = self.export("slicer", "--frame", "LPS")
        nodes = list(xml.etree.ElementTree.parse(out / "palpation.mrml").getroot())
        by_id = {node.get("id"): node for node in nodes}
        self.assertEqual(len(by_id), len(nodes))
        for node in nodes:
            self.assertTrue(node.get("id").startswith(f"vtkMRML{node.tag}Node"))
        shown, files = {}, set()
        for node in nodes:
            if node.tag not in ("Model", "MarkupsFiducial"):
                continue
            storage, display = by_id[node.get("storageNodeRef")], by_id[node.get("displayNodeRef")]
            self.assertEqual(storage.get("fileName").split(".")[0], node.get("name"))
            self.assertEqual(storage.get("coordinateSystem"), "LPS" if node.tag == "Model" else None)  # without one, Slicer takes a model for RAS
            files.add(storage.get("fileName"))
            shown[node.get("name")] = display
        self.assertEqual(files, names_in(out) - {"palpation.mrml", "export.json"})
        self.assertEqual(len({display.get("color") for display in shown.values()}), len(shown))
        tissue = shown["tissue"]
        self.assertEqual((tissue.get("scalarVisibility"), tissue.get("activeScalarName"), tissue.get("scalarRangeFlag")), ("true", "mean", "UseManual"))
        low, high = map(float, tissue.get("scalarRange").split())
        self.assertAlmostEqual((low + high) / 2, self.summary["level"], delta=0.02 * (high - low))
        self.assertEqual([name for name, display in shown.items() if display.get("visibility") == "false"], ["band", "tumour"])
        marks = json.loads((out / "touches.mrk.json").read_text())["markups"][0]
        self.assertEqual(list(map(float, shown["touches"].get("selectedColor").split())), marks["display"]["selectedColor"])

    def test_tables_name_their_units_and_hold_what_the_run_holds(self):
        out = self.export("csv")
        self.assertEqual(names_in(out), {"tissue.csv", "touches.csv", "boundary.csv", "parts.csv", "batches.csv", "export.json"})
        felt = rows_of(self.run_folder / "measurements.csv")
        told = rows_of(out / "touches.csv")
        self.assertEqual(len(told), len(felt))
        for mine, theirs in zip(told, felt):
            self.assertAlmostEqual(float(mine["x [mm]"]), 1000.0 * float(theirs["x"]), delta=1e-9)
            self.assertEqual(mine["reading [N/mm]"], theirs["reading"])
        (part,) = rows_of(out / "parts.csv")
        self.assertEqual(float(part["area [mm2]"]), self.summary["parts"][0]["area_mm2"])
        rows = rows_of(out / "tissue.csv")
        self.assertEqual(len(rows), self.summary["vertices"])
        self.assertTrue({"mean [N/mm]", "stddev [N/mm]", "probability_inside", "searched"} <= rows[0].keys())

    def test_what_no_reading_is_near_is_not_searched(self):
        self.need_vtk()
        felt = self.folder / "corner.csv"
        felt.write_text("x,y,z,reading\n" + "".join(f"0.00{i},0.00{j},{1e-3 * height_mm(i, j)},{7 + 0.01 * i}\n" for i in range(4) for j in range(4)))
        run = self.folder / "corner"
        self.assertEqual(palpate("boundary", self.folder / "scene.json", "--measurements", felt, "--out", run, "--quiet").returncode, 0)
        out = self.export("slicer", "--frame", "RAS", run=run)
        model, _ = read(out / "not_searched.vtp")
        readings = [(i, j, height_mm(i, j)) for i in range(4) for j in range(4)]
        nearest = [min(math.dist(point, reading) for reading in readings) for point in points_of(model)]
        self.assertGreater(min(nearest), 8.0 - 0.1)  # cut along triangles, over which distance is taken to be linear
        self.assertLess(min(nearest), 8.0 + 0.1)
        self.assertGreater(max(nearest), 20.0)
        self.assertNotIn("not_searched.vtp", names_in(self.export("slicer", "--frame", "RAS")))

    def test_a_plan_shows_its_next_stops_in_the_frame_of_the_mesh(self):
        felt = self.folder / "felt.csv"
        felt.write_text("".join((self.run_folder / "measurements.csv").read_text().splitlines(True)[:20]))
        turned = "robot.from_tissue=[0,-1,0,0.3, 1,0,0,0.1, 0,0,1,0.2, 0,0,0,1]"
        places = []
        for name, extra in (("straight", ()), ("turned", ("--set", turned))):
            run = self.folder / name
            self.assertEqual(palpate("plan", self.folder / "scene.json", "--measurements", felt, "--out", run, "--quiet", *extra).returncode, 0)
            marks = json.loads((self.export("slicer", "--frame", "RAS", run=run) / "next_stops.mrk.json").read_text())["markups"][0]
            places.append([point["position"] for point in marks["controlPoints"]])
        self.assertEqual(len(places[0]), 10)
        for straight, turned_back in zip(*places):
            self.assertLess(math.dist(straight, turned_back), 1e-9)

    def test_a_persons_files_stay_and_an_exports_own_are_replaced(self):
        out = self.export("slicer", "--frame", "RAS")
        first = {path.name: path.read_bytes() for path in out.iterdir()}
        self.assertEqual(palpate("export", self.run_folder, "--for", "slicer", "--frame", "LPS", "--out", out).returncode, 0)
        self.assertEqual(names_in(out), first.keys())
        self.assertNotEqual((out / "tissue.vtp").read_bytes(), first["tissue.vtp"])
        (out / "tumour.vtp").write_text("what a person wrote\n")
        refused = palpate("export", self.run_folder, "--for", "slicer", "--frame", "RAS", "--out", out)
        self.assertEqual(refused.returncode, 3)
        self.assertIn("tumour.vtp: is there already", refused.stderr)
        self.assertEqual((out / "tumour.vtp").read_text(), "what a person wrote\n")
        tables = palpate("export", self.run_folder, "--for", "csv", "--out", out)
        self.assertEqual(tables.returncode, 0, tables.stderr)
        self.assertEqual(names_in(out) - {"tumour.vtp"}, {"tissue.csv", "touches.csv", "boundary.csv", "parts.csv", "batches.csv", "export.json"})
        self.assertEqual((out / "tumour.vtp").read_text(), "what a person wrote\n")
        into_run = palpate("export", self.run_folder, "--for", "csv", "--out", self.run_folder)
        self.assertEqual(into_run.returncode, 3)
        self.assertIn("holds a run", into_run.stderr)

    def test_what_is_no_run_is_refused_by_name(self):
        empty = self.folder / "empty"
        empty.mkdir()
        torn = self.folder / "torn"
        torn.mkdir()
        (torn / "surface.vtp").write_bytes((self.run_folder / "surface.vtp").read_bytes()[:5000])
        odd = self.folder / "odd"
        odd.mkdir()
        (odd / "surface.vtp").write_bytes((self.run_folder / "surface.vtp").read_bytes())
        (odd / "summary.json").write_text("[1, 2")
        for run, words in ((empty, "holds no run of palpate"), (torn, "surface.vtp"), (odd, "summary.json: is no JSON object")):
            refused = palpate("export", run, "--for", "csv")
            self.assertEqual(refused.returncode, 3)
            self.assertIn(words, refused.stderr)


if __name__ == "__main__":
    main_without_pictures()
