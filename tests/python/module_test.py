#!/usr/bin/env python3
"""The Python module: what it gives back, what it refuses and in which words, how long what it hands out lives, and that ask and tell are the tool's run.

usage: module_test.py PALPATE PROJECT_ROOT [CLAIM...]     with the package `palpation` on PYTHONPATH
Ends with 77 (ctest: skipped) where numpy is missing. Claims whose package is missing (shapely) are told and left out.
"""

import copy
import gc
import json
import os
import pathlib
import pickle
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import warnings

try:
    import numpy as np
except ImportError:
    print("skipped: numpy is not installed")
    sys.exit(77)
try:
    import vtkmodules.util.numpy_support as vtk_numpy
    import vtkmodules.vtkIOXML as vtk_xml
except ImportError:
    vtk_xml = None
try:
    import shapely.geometry
    import shapely.wkt
except ImportError:
    shapely = None

import palpation as pp

PALPATE = ROOT = None
PROBE_STREAM = 0x70726F6265  # how the tool makes the probe's stream of a scene's seed


def square(cells=20, side_m=0.02):
    return pp.make_plane(size_m=(side_m, side_m), columns=cells + 1, rows=cells + 1).surface()


def ring(*places):
    return np.array(places, dtype=float)


UNIT = ring((0, 0), (1, 0), (1, 1), (0, 1))


class Meshes(unittest.TestCase):
    def test_a_height_field_in_millimetres_is_a_surface_in_metres(self):
        x, y = np.meshgrid(np.arange(4.0), np.arange(3.0))
        vertices = np.column_stack([x.ravel(), y.ravel(), np.zeros(12)])
        faces = [(0, 1, 5), (0, 5, 4), (1, 2, 6), (1, 6, 5), (2, 3, 7), (2, 7, 6), (4, 5, 9), (4, 9, 8), (5, 6, 10), (5, 10, 9), (6, 7, 11), (6, 11, 10)]
        tissue = pp.Surface(vertices, faces, unit="mm")
        self.assertEqual(tissue.vertices.shape, (12, 3))
        self.assertEqual(tissue.vertices[11].tolist(), [0.003, 0.002, 0.0])
        self.assertAlmostEqual(tissue.area_m2, 6e-6, delta=1e-20)  # rounding of 6e-6 is 1e-21
        self.assertTrue(tissue.has_chart)
        self.assertTrue(tissue.topology["is_planar"])
        self.assertEqual(tissue.normals.tolist(), [[0, 0, 1]] * 12)

    def test_what_is_written_comes_back_to_the_bit(self):
        mesh = pp.make_dome(edge_m=0.004)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "dome.ply"
            pp.write_mesh(path, mesh.vertices, mesh.faces, unit="m")
            again = pp.read_mesh(str(path), unit="m")
        self.assertTrue(np.array_equal(again.vertices, mesh.vertices))
        self.assertTrue(np.array_equal(again.faces, mesh.faces))
        self.assertEqual(again.format, "binary PLY")

    def test_a_repair_is_told(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "spare.obj"
            path.write_text("v 0 0 0\nv 10 0 0\nv 0 10 0\nv 5 5 5\nf 1 2 3\n")
            mesh = pp.read_mesh(path, "mm")
        self.assertEqual(len(mesh.warnings), 1)
        self.assertIn("1 vertices belong to no face", mesh.warnings[0])

    def test_what_is_asked_for_is_mended_and_told_with_its_first_place(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "broken.obj"
            square = "v 0 0 0\nv 10 0 0\nv 10 10 0\nv 0 10 0\nv 5 0 0\nv 90 0 0\nv 95 0 0\nv 90 5 0\n"
            path.write_text(square + "f 1 2 3\nf 1 3 4\nf 3 4 1\nf 1 5 2\nf 6 7 8\n", encoding="utf-8")
            self.assertRaises(pp.IoError, pp.read_mesh, path, "mm")
            mesh = pp.read_mesh(path, "mm", repair=("drop-duplicates", "drop-degenerate", "largest"))
            for kind in (["holes"], ["weld", ""]):
                with self.assertRaises(pp.InvalidInput) as caught:
                    pp.read_mesh(path, "mm", repair=kind)
                self.assertIn("must be 'weld', 'triangulate', 'drop-duplicates'", str(caught.exception))
            with self.assertRaises(TypeError):
                pp.read_mesh(path, "mm", repair="weld")
        self.assertAlmostEqual(mesh.surface().area_m2, 1e-4, delta=1e-18)
        told = " ".join(mesh.warnings)
        for words in ("face 3 in line 11", "without an area was dropped: face 4", "1 smaller component"):
            self.assertIn(words, told)

    def test_every_generator_makes_a_disk(self):
        for make in (pp.make_cylinder, pp.make_dome, pp.make_saddle, pp.make_wave, pp.make_folded):
            with self.subTest(make.__name__):
                self.assertTrue(make(edge_m=0.003).surface().topology["is_disk"])

    def test_places_project_and_distances_run_along_the_tissue(self):
        tissue = square()
        self.assertEqual(tissue.project([[0.004, 0.005, 0.3]]).tolist(), [[0.004, 0.005, 0.0]])
        distance = tissue.distance_from([0])
        self.assertAlmostEqual(distance[-1], 0.02 * np.sqrt(2), delta=1e-15)
        self.assertTrue(np.allclose(tissue.to_chart([[0.004, 0.005, 0.001]]), [[0.004, 0.005]], atol=1e-10))


class Errors(unittest.TestCase):
    def refused(self, kind, words, call):
        with self.assertRaises(kind) as caught:
            call()
        self.assertIn(words, str(caught.exception))

    def test_errors_are_one_to_one(self):
        for error, built_in in ((pp.InvalidInput, ValueError), (pp.IoError, OSError), (pp.InvalidMesh, ValueError), (pp.NumericalError, ArithmeticError)):
            self.assertTrue(issubclass(error, pp.Error) and issubclass(error, built_in))
        self.assertTrue(issubclass(pp.WriteError, pp.IoError))
        self.refused(pp.IoError, "/nowhere.ply", lambda: pp.read_mesh("/nowhere.ply", "mm"))
        self.refused(pp.WriteError, "/nowhere/x.ply", lambda: pp.write_mesh("/nowhere/x.ply", np.eye(3), [[0, 1, 2]], "m"))
        self.refused(pp.InvalidInput, "inch", lambda: pp.read_mesh("x.ply", "inch"))
        self.refused(pp.InvalidMesh, "triangle 0 of vertices 0, 1, 1", lambda: pp.Surface(np.eye(3), [[0, 1, 1]], unit="m"))
        noiseless = pp.Model(noise_sd=0.0, length_m=0.1, signal_sd=1.0, level=0.5)
        tissue = square(50)
        twins = pp.Readings(tissue, tissue.vertices[:200], np.sin(np.arange(200)))
        self.refused(pp.NumericalError, "", lambda: pp.conclude(twins, noiseless))

    def test_arrays_are_refused_with_function_name_row_and_rule(self):
        good = np.eye(3)
        faces = [[0, 1, 2]]
        nan = good.copy()
        nan[1, 2] = np.nan
        for words, vertices, triangles in (
            ("Surface: vertices: row 1 is (0, 1, nan), must be finite", nan, faces),
            ("Surface: vertices: has the shape (3, 2), must be (n, 3)", good[:, :2], faces),
            ("Surface: vertices: has the shape (3,), must be (n, 3)", good[0], faces),
            ("Surface: faces: has the shape (1, 2), must be (n, 3)", good, [[0, 1]]),
            ("Surface: faces: entry 2 is -1, must be from 0", good, [[0, 1, -1]]),
            ("Surface: faces: entry 2 is 18446744073709551615, must be from 0", good, np.array([[0, 1, 2**64 - 1]], dtype=np.uint64)),
            ("Surface: vertices: is a masked array", np.ma.masked_greater(good, 0.5), faces),
        ):
            with self.subTest(words):
                self.refused(pp.InvalidInput, words, lambda: pp.Surface(vertices, triangles, unit="m"))
        for words, vertices, triangles in (
            ("Surface: vertices: is of dtype('complex128'), must be of real numbers", good + 0j, faces),
            ("Surface: vertices: is of dtype('bool'), must be of real numbers", good > 0, faces),
            ("Surface: faces: is of dtype('float64'), must be of whole numbers", good, [[0.0, 1.0, 2.0]]),
            ("Surface: vertices: is of dtype('<U4'), must be of real numbers", "mesh", faces),
        ):
            with self.subTest(words):
                self.refused(TypeError, words, lambda: pp.Surface(vertices, triangles, unit="m"))

    def test_places_in_millimetres_are_refused_with_the_unit_that_is_expected(self):
        self.refused(pp.InvalidInput, "metres in the mesh's frame", lambda: pp.Readings(square(), [[4.0, 5.0, 0.0]], [1.0]))

    def test_readings_beyond_what_can_be_computed_are_refused(self):
        tissue = square(4)
        self.refused(pp.InvalidInput, "readings: row 1 is 1e+31, must be at most 1e30", lambda: pp.Readings(tissue, [0, 1], [1.0, 1e31]))
        self.refused(pp.InvalidInput, "noise_variance: row 0 is -1", lambda: pp.Readings(tissue, [0], [1.0], noise_variance=-1.0))
        self.refused(pp.InvalidInput, "has 2 numbers, must have 1", lambda: pp.Readings(tissue, [0], [1.0, 2.0]))
        self.refused(pp.InvalidInput, "row 0 is inf", lambda: pp.Readings(tissue, [0], [np.inf]))

    def test_an_argument_that_is_none_is_named_with_those_that_are(self):
        self.refused(TypeError, "Model: there is no argument 'lenght_m': there are metric, kernel, length_m", lambda: pp.Model(lenght_m=1))
        self.refused(pp.InvalidInput, "'euclid' must be one of 'chart', 'ambient', 'intrinsic'", lambda: pp.Model(metric="euclid"))
        self.refused(TypeError, "batch must be a whole number", lambda: pp.Plan(batch=2.5))
        self.refused(pp.InvalidInput, "batch = -1", lambda: pp.Plan(batch=-1))
        self.refused(pp.InvalidInput, "seed = -1 must be from 0", lambda: pp.Plan(seed=-1))
        self.refused(pp.InvalidInput, "level = nan", lambda: pp.Model(level=float("nan")))


class Lifetimes(unittest.TestCase):
    def test_views_are_read_only_and_outlive_their_owner(self):
        tissue = square(50)
        vertices, faces = tissue.vertices, tissue.faces
        expected = vertices.copy()
        with self.assertRaises(ValueError):
            vertices[0, 0] = 1.0
        with self.assertRaises(ValueError):
            vertices.setflags(write=True)
        del tissue
        gc.collect()
        self.assertTrue(np.array_equal(vertices, expected))
        self.assertEqual(int(faces.max()), 51 * 51 - 1)

    def test_views_share_memory_and_what_is_given_is_copied(self):
        given = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])
        tissue = pp.Surface(given, [[0, 1, 2]], unit="m")
        given[0] = 7.0
        self.assertEqual(tissue.vertices[0].tolist(), [0, 0, 0])
        self.assertTrue(np.shares_memory(tissue.vertices, tissue.vertices))

    def test_a_conclusion_stays_when_more_is_told(self):
        exploration = pp.Exploration(square(), plan=pp.Plan(initial_count=6, batch=3, batches=2))
        exploration.tell(np.arange(6.0))
        before = exploration.conclusion
        mean = before.mean
        expected = mean.copy()
        exploration.tell([3.0, 4.0, 5.0])
        del before
        gc.collect()
        self.assertTrue(np.array_equal(mean, expected))
        self.assertFalse(np.array_equal(exploration.conclusion.mean, expected))

    def test_surfaces_and_regions_can_be_pickled(self):
        tissue = square(5)
        again = pickle.loads(pickle.dumps(tissue))
        self.assertTrue(np.array_equal(again.vertices, tissue.vertices) and np.array_equal(again.faces, tissue.faces))
        region = pp.Region([(UNIT, [])])
        self.assertEqual(copy.deepcopy(region).wkt, region.wkt)


class Regions(unittest.TestCase):
    def test_booleans_keep_areas(self):
        a, b = pp.Region([(UNIT, [])]), pp.Region([(UNIT + 0.5, [])])
        self.assertEqual((a | b).area_m2, 1.75)
        self.assertEqual((a & b).area_m2, 0.25)
        self.assertEqual((a - b).area_m2, 0.75)
        self.assertEqual((a ^ b).area_m2, 1.5)
        self.assertFalse(pp.Region())
        self.assertEqual(a.contains([[0.5, 0.5], [1.0, 1.0], [2.0, 0.5]]).tolist(), [True, True, False])

    def test_wkt_comes_back_and_is_refused_at_its_byte(self):
        region = pp.Region([(UNIT, [UNIT * 0.5 + 0.25])])
        self.assertEqual(pp.Region.from_wkt(region.wkt).wkt, region.wkt)
        self.assertEqual(pp.Region.from_wkt("POLYGON ((0 0, 1 0, 1 1, 0 1, 0 0))").area_m2, 1.0)
        self.assertEqual(pp.Region.from_wkt("MULTIPOLYGON EMPTY").wkt, "MULTIPOLYGON EMPTY")
        with self.assertRaises(pp.InvalidInput) as caught:
            pp.Region.from_wkt("POLYGON ((0 0, 1 0, x 1, 0 0))")
        self.assertIn("byte 20", str(caught.exception))

    def test_what_is_tidied_away_is_a_warning(self):
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            region = pp.Region([(np.vstack([UNIT, UNIT[:1]]), [])])
        self.assertEqual(region.area_m2, 1.0)
        self.assertEqual(len(told), 1)
        with self.assertRaises(UserWarning), warnings.catch_warnings():
            warnings.simplefilter("error")
            pp.Region([(np.vstack([UNIT, UNIT[:1]]), [])])

    def test_an_outline_that_crosses_itself_is_refused(self):
        with self.assertRaises(pp.InvalidInput):
            pp.Region([(ring((0, 0), (1, 1), (1, 0), (0, 1)), [])])

    @unittest.skipUnless(shapely, "shapely is not installed")
    def test_shapely_takes_it_and_gives_it_back(self):
        region = pp.Region([(UNIT, [UNIT * 0.5 + 0.25]), (UNIT + 3.0, [])])
        shape = shapely.geometry.shape(region)
        self.assertAlmostEqual(shape.area, 1.75, delta=1e-15)
        self.assertTrue(shape.is_valid)
        with warnings.catch_warnings():
            warnings.simplefilter("error")  # a closed ring is nothing to tidy away
            self.assertEqual(pp.Region.from_shape(shape).wkt, region.wkt)
        self.assertEqual(shapely.wkt.loads(region.wkt).area, shape.area)
        self.assertFalse(pp.Region.from_shape(shapely.geometry.Polygon()))
        with self.assertRaises(pp.InvalidInput):
            pp.Region.from_shape(shapely.geometry.Point(0, 0))

    def test_what_is_no_shape_is_refused(self):
        for shape in ({"type": "Point", "coordinates": (0, 0)}, {"type": "Polygon"}, {"type": "Polygon", "coordinates": [[(0, 0, 1), (1, 0, 1), (1, 1, 1)]]}):
            with self.subTest(shape), self.assertRaises(pp.InvalidInput):
                pp.Region.from_shape(shape)
        with self.assertRaises(TypeError):
            pp.Region.from_shape(3)

    def test_a_known_disk_has_its_area(self):
        tissue = square(80)
        phantom = pp.Phantom(tissue, [pp.Disk((0.01, 0.01, 0.0), 0.004)])
        found = phantom.true_region()
        self.assertAlmostEqual(found.area_m2, np.pi * 0.004**2, delta=2e-7)  # chords of a mesh of .25 mm
        same = pp.superlevel_region(tissue, phantom.truth, phantom.true_level)
        self.assertEqual(pp.compare(tissue, found, same)["symmetric_difference_m2"], 0.0)
        self.assertEqual(pp.compare(tissue, pp.Region(), same)["missed_m2"], pp.surface_area(tissue, same))
        self.assertIsNone(pp.compare(tissue, pp.Region(), same)["hausdorff_m"])


class AskAndTell(unittest.TestCase):
    def test_it_is_the_tools_run_to_the_byte(self):
        scene = json.loads((ROOT / "examples/planar.json").read_text())
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([PALPATE, "simulate", ROOT / "examples/planar.json", "--out", f"{folder}/run", "--quiet"], check=True)
            expected = pathlib.Path(f"{folder}/run/measurements.csv").read_bytes()
            boundary = pathlib.Path(f"{folder}/run/boundary.wkt").read_text()
            summary = json.loads(pathlib.Path(f"{folder}/run/summary.json").read_text())

        tissue = pp.read_mesh(ROOT / "examples" / scene["surface"]["mesh"], scene["surface"]["unit"]).surface()
        probe, plan = scene["probe"], scene["plan"]
        disks = [pp.Disk(np.array(tumour["centre_mm"]) / 1000, tumour["radius_mm"] / 1000) for tumour in probe["tumours"]]
        phantom = pp.Phantom(tissue, disks, low=probe["low"], high=probe["high"], slope_per_m=probe["slope_per_m"], noise=probe["noise"])
        exploration = pp.Exploration(
            tissue,
            plan=pp.Plan(
                acquisition=plan["acquisition"], initial_count=plan["initial"]["count"], batch=plan["batch"], batches=plan["batches"], seed=scene["seed"]
            ),
        )
        random = pp.Random(scene["seed"] ^ PROBE_STREAM)
        while stops := exploration.ask():
            exploration.tell(phantom.touch(stops.vertices, random, travel=stops.travel))

        exploration.draw_outlines(scene["seed"])
        readings = exploration.readings
        self.assertEqual(readings.to_csv().encode(), expected)
        conclusion = exploration.conclusion
        self.assertEqual(conclusion.region().wkt, boundary.strip())
        self.assertEqual(conclusion.level, summary["level"])
        self.assertEqual(exploration.stop_reason, summary["stop_reason"])
        error = pp.compare(tissue, conclusion.region(), phantom.true_region())
        self.assertEqual(error["dice"], summary["error"]["dice"])

        # The same readings from the file lead to the same conclusion and to the same stops.
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "measurements.csv"
            path.write_bytes(expected)
            read = pp.Readings.read_csv(path, tissue)
        self.assertEqual(read.to_csv().encode(), expected)
        again = pp.conclude(read, sampling_seed=scene["seed"])
        self.assertTrue(np.array_equal(again.mean, conclusion.mean) and np.array_equal(again.score, conclusion.score))
        self.assertEqual(again.region().wkt, boundary.strip())

        inner, outer = conclusion.band()
        self.assertFalse(inner - conclusion.region())
        self.assertFalse(conclusion.region() - outer)
        self.assertFalse(conclusion.region() - conclusion.cut(risk=0.05))

    def test_asking_changes_nothing_and_telling_too_little_neither(self):
        exploration = pp.Exploration(square(), plan=pp.Plan(initial_count=5, batch=3, batches=1))
        first = exploration.ask()
        self.assertEqual(first.vertices.tolist(), exploration.ask().vertices.tolist())
        self.assertEqual((len(first), first.batch, first.positions.shape), (5, 0, (5, 3)))
        for wrong in ([1.0], np.full(5, 1e31), np.full(5, np.inf), "abcde", [[1.0] * 5]):
            with self.subTest(wrong), self.assertRaises((ValueError, TypeError)):
                exploration.tell(wrong)
        self.assertEqual((exploration.batch, len(exploration.readings)), (0, 0))
        exploration.tell([1, 2, 3, 4, float("nan")])
        self.assertEqual(exploration.readings.kind.count("missed"), 1)
        self.assertNotIn(first.vertices[4], exploration.ask().vertices.tolist())
        exploration.tell([1.0, 2.0, 1.5])
        self.assertFalse(exploration.ask())
        self.assertEqual(exploration.stop_reason, "budget")
        with self.assertRaises(pp.InvalidInput):
            exploration.tell([])

    def test_readings_of_other_places_count_and_stops_without_are_missed(self):
        tissue = square()
        exploration = pp.Exploration(tissue, plan=pp.Plan(initial_count=4))
        stops = exploration.ask()
        way = pp.Readings(tissue, stops.positions[:2] + [0.0002, 0.0001, 0.0], [1.0, 2.0], kind="way", travel=[[2, 0, 0], [0, 0, 0]])
        there = pp.Readings(tissue, stops.vertices[:3], [1.0, 2.0, 3.0], noise_variance=[0.1, np.nan, 0.2])
        exploration.tell(way + there)
        readings = exploration.readings
        self.assertEqual(sorted(readings.kind), ["missed", "stop", "stop", "stop", "way", "way"])
        self.assertEqual(readings.travel[readings.kind.index("way")].tolist(), [1, 0, 0])
        self.assertEqual(sorted(readings.as_dict()), ["batch", "kind", "noise_variance", "positions", "set_aside", "travel", "values"])
        self.assertEqual(exploration.batch, 1)

    def test_only_what_is_in_reach_is_asked_for(self):
        tissue = square()
        left = np.flatnonzero(tissue.vertices[:, 0] < 0.0101)
        exploration = pp.Exploration(tissue, plan=pp.Plan(initial_count=4, batches=2), reach=left, touch_once=True)
        asked = []
        while stops := exploration.ask():
            asked += stops.vertices.tolist()
            exploration.tell(np.sin(np.arange(len(stops))))
        self.assertTrue(set(asked) <= set(left.tolist()))
        self.assertEqual(len(asked), len(set(asked)))

    def test_poses_are_the_librarys(self):
        tissue = square()
        down = np.diag([1.0, -1.0, -1.0, 1.0])
        down[:3, 3] = [0.0, 0.0, 0.1]
        poses = pp.waypoints(tissue, [[0.004, 0.005, 0.0]], from_tissue=down, indent_m=0.003, spring_n_per_m=100.0)
        self.assertTrue(np.allclose(poses["position"], [[0.004, -0.005, 0.1]], atol=1e-12))
        self.assertTrue(np.allclose(poses["approach"], [[0.004, -0.005, 0.095]], atol=1e-12))
        self.assertTrue(np.allclose(poses["indented"], [[0.004, -0.005, 0.103]], atol=1e-12))
        self.assertAlmostEqual(poses["expected_force_n"][0], 0.3, delta=1e-12)
        self.assertAlmostEqual(np.linalg.norm(poses["quaternion"][0]), 1.0, delta=1e-12)
        self.assertEqual(len(pp.reachable_vertices(tissue, shaft_direction=(0, 0, 1))), 441)
        self.assertEqual(len(pp.reachable_vertices(tissue, shaft_direction=(0, 0, -1))), 0)


@unittest.skipUnless(vtk_xml, "VTK's Python modules are not installed")
class Vtk(unittest.TestCase):
    def read(self, path):
        reader = vtk_xml.vtkXMLPolyDataReader()
        reader.SetFileName(str(path))
        reader.Update()
        return reader.GetOutput()

    def assert_alike(self, mine, its, but=()):
        """The same points, cells and arrays, by their names, types and numbers."""
        points = [vtk_numpy.vtk_to_numpy(one.GetPoints().GetData()) for one in (mine, its)]
        self.assertTrue(np.array_equal(*points) and points[0].dtype == points[1].dtype)
        for cells in ("GetPolys", "GetLines"):
            arrays = [vtk_numpy.vtk_to_numpy(getattr(one, cells)().GetConnectivityArray()) for one in (mine, its)]
            self.assertTrue(np.array_equal(*arrays), cells)
        for part in ("GetPointData", "GetCellData", "GetFieldData"):
            names = [[getattr(one, part)().GetAbstractArray(i).GetName() for i in range(getattr(one, part)().GetNumberOfArrays())] for one in (mine, its)]
            self.assertEqual(set(names[0]), set(names[1]) - set(but), part)
            for name in names[0]:
                a, b = (getattr(one, part)().GetAbstractArray(name) for one in (mine, its))
                self.assertEqual((a.GetDataType(), a.GetNumberOfValues()), (b.GetDataType(), b.GetNumberOfValues()), name)
                self.assertEqual([a.GetValue(i) for i in range(a.GetNumberOfValues())], [b.GetValue(i) for i in range(b.GetNumberOfValues())], name)

    def test_a_conclusion_is_the_tools_surface_and_boundary(self):
        with tempfile.TemporaryDirectory() as folder:
            run = pathlib.Path(folder) / "run"
            scene = ROOT / "examples/planar.json"
            subprocess.run([PALPATE, "simulate", scene, "--out", run, "--quiet", "--set", "plan.batches=3"], check=True)
            tissue = pp.read_mesh(ROOT / "meshes/planar_phantom.ply", "mm").surface()
            conclusion = pp.conclude(pp.Readings.read_csv(run / "measurements.csv", tissue), sampling_seed=json.loads(scene.read_text())["seed"])
            self.assert_alike(pp.to_vtk(conclusion), self.read(run / "surface.vtp"), but=("acquisition", "truth"))
            subprocess.run([PALPATE, "boundary", scene, "--measurements", run / "measurements.csv", "--out", run / "b", "--quiet"], check=True)
            self.assert_alike(pp.boundary_to_vtk(conclusion), self.read(run / "b/boundary.vtp"))

    def test_fields_of_ones_own_are_arrays_at_the_points(self):
        tissue = square(4)
        heights = np.arange(25)
        polydata = pp.to_vtk(tissue, {"height": heights})
        self.assertEqual((polydata.GetNumberOfPoints(), polydata.GetNumberOfCells()), (25, 32))
        self.assertEqual(vtk_numpy.vtk_to_numpy(polydata.GetPointData().GetArray("height")).tolist(), heights.tolist())
        for name, given in (("height", heights[:3]), ("", heights), ("height", ["x"] * 25)):
            with self.subTest(name), self.assertRaises(pp.InvalidInput) as caught:
                pp.to_vtk(tissue, {name: given})
            self.assertIn("to_vtk: field '" + name, str(caught.exception))
        with self.assertRaises(TypeError):
            pp.to_vtk(3)
        nothing = pp.boundary_to_vtk(pp.conclude(pp.Readings(tissue, [], [])))
        self.assertEqual((nothing.GetNumberOfPoints(), nothing.GetNumberOfCells()), (0, 0))

    def test_without_vtk_it_says_what_to_install(self):
        script = "import sys\nfor name in ('vtkCommonCore', 'vtkCommonDataModel'):\n    sys.modules['vtkmodules.' + name] = None\n"
        script += "import palpation as pp\ntry:\n    pp.to_vtk(pp.make_plane(columns=3, rows=3).surface())\nexcept ImportError as error:\n    print(error)"
        done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
        self.assertIn("python3-vtk9", done.stdout, done.stderr)


class OwnAcquisition(unittest.TestCase):
    def run_with(self, acquisition, batches=3):
        tissue = square(25)
        phantom = pp.Phantom(tissue, [pp.Disk((0.011, 0.009, 0.0), 0.004)], noise=0.05)
        exploration = pp.Exploration(tissue, pp.Model(level=8.0), pp.Plan(acquisition=acquisition, batch=6, batches=batches))
        random, asked = pp.Random(3), []
        while stops := exploration.ask():
            asked.append(stops.vertices.tolist())
            exploration.tell(phantom.touch(stops.vertices, random))
        return asked

    def test_straddle_in_python_touches_what_straddle_touches(self):
        seen = []

        def mine(mean, stddev, level):
            seen.append((mean.shape, stddev.shape, level))
            return 1.96 * stddev - np.abs(mean - level)

        self.assertEqual(self.run_with(mine), self.run_with("straddle"))
        self.assertEqual(set(seen), {((26 * 26,), (26 * 26,), 8.0)})
        self.assertGreaterEqual(len(seen), 6)  # for every pick

    def test_what_it_raises_comes_out_and_nothing_is_recorded(self):
        class Mine(Exception):
            pass

        def mine(mean, stddev, level):
            raise Mine("no idea")

        tissue = square()
        exploration = pp.Exploration(tissue, pp.Model(level=0.5, safe_start=False), pp.Plan(acquisition=mine, initial_count=4))
        with self.assertRaises(Mine):
            exploration.tell([0.0, 1.0, 0.0, 1.0])
        self.assertEqual((exploration.batch, len(exploration.readings), len(exploration.ask())), (0, 0, 4))

    def test_scores_that_are_none_are_refused(self):
        for scores, kind in ((np.zeros(3), pp.InvalidInput), (np.full(21 * 21, np.nan), pp.InvalidInput), (None, TypeError), ("x", TypeError)):
            tissue = square()
            plan = pp.Plan(acquisition=lambda mean, stddev, level: scores, initial_count=4)
            exploration = pp.Exploration(tissue, pp.Model(level=0.5, safe_start=False), plan)
            with self.subTest(repr(scores)[:20]), self.assertRaises(kind):
                exploration.tell([0.0, 1.0, 0.0, 1.0])

    def test_who_asks_it_for_itself_is_told_so(self):
        box = []
        plan = pp.Plan(acquisition=lambda mean, stddev, level: box[0].ask() and stddev, initial_count=4)
        box.append(pp.Exploration(square(), pp.Model(level=0.5, safe_start=False), plan))
        with self.assertRaises(RuntimeError) as caught:
            box[0].tell([0.0, 1.0, 0.0, 1.0])
        self.assertIn("take turns", str(caught.exception))
        box.clear()

    def test_the_function_lives_as_long_as_it_is_needed_and_no_longer(self):
        class Score:
            def __call__(self, mean, stddev, level):
                return stddev

        import weakref

        score = Score()
        there = weakref.ref(score)
        exploration = pp.Exploration(square(), pp.Model(level=0.5, safe_start=False), pp.Plan(acquisition=score, initial_count=4, batches=1))
        del score
        gc.collect()
        exploration.tell([0.0, 1.0, 0.0, 1.0])
        self.assertIsNotNone(there())
        del exploration
        gc.collect()
        self.assertIsNone(there())


class Threads(unittest.TestCase):
    def test_other_threads_run_while_the_library_works(self):
        tissue = pp.make_saddle(edge_m=0.0004).surface()
        ticks, done = [], threading.Event()

        def tick():
            while not done.is_set():
                ticks.append(time.monotonic())
                time.sleep(0.001)

        thread = threading.Thread(target=tick)
        thread.start()
        start = time.monotonic()
        tissue.distance_from([0])
        end = time.monotonic()
        done.set()
        thread.join()
        self.assertGreater(sum(start < at < end for at in ticks), 2, f"in {end - start:.3f} s")

    def test_an_exploration_is_one_callers_at_a_time(self):
        started, release = threading.Event(), threading.Event()

        def slow(mean, stddev, level):
            started.set()
            release.wait(60)
            return stddev

        exploration = pp.Exploration(square(), pp.Model(level=0.5, safe_start=False), pp.Plan(acquisition=slow, initial_count=4, batches=1))
        thread = threading.Thread(target=lambda: exploration.tell([0.0, 1.0, 0.0, 1.0]))
        thread.start()
        started.wait(60)
        with self.assertRaises(RuntimeError):
            exploration.ask()
        release.set()
        thread.join()
        self.assertEqual(exploration.batch, 1)

    def test_threads_that_share_a_surface_agree(self):
        tissue = pp.make_dome(edge_m=0.001).surface()
        found = []

        def chart():
            found.append((tissue.chart[17].tolist(), tissue.project([[0, 0, 0.01]]).tolist(), tissue.normals[3].tolist()))

        threads = [threading.Thread(target=chart) for _ in range(8)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join(120)
        self.assertEqual(len(found), 8)
        self.assertTrue(all(one == found[0] for one in found))

    def test_the_number_of_threads_changes_nothing(self):
        before = pp.thread_count()
        self.addCleanup(pp.set_thread_count, before)
        results = []
        for count in (1, 3):
            pp.set_thread_count(count)
            tissue = square(60)
            readings = pp.Readings(tissue, np.arange(0, 3600, 97), np.sin(np.arange(0, 3600, 97)))
            results.append(pp.conclude(readings).mean)
        self.assertTrue(np.array_equal(results[0], results[1]))
        with self.assertRaises(pp.InvalidInput):
            pp.set_thread_count(0)


INTERRUPTED = """
import os, signal, sys, threading, time
import palpation as pp
tissue = pp.make_saddle(edge_m=0.00016).surface()
model = pp.Model(metric="intrinsic")
threading.Timer(0.7, os.kill, (os.getpid(), signal.SIGINT)).start()
try:
    pp.Exploration(tissue, model)
    print("finished")
except KeyboardInterrupt:
    print("interrupted")
small = pp.make_saddle(edge_m=0.003).surface()
print(len(pp.Exploration(small, model).ask()))
"""


class Interruption(unittest.TestCase):
    def test_ctrl_c_ends_a_long_call_and_the_module_goes_on(self):
        done = subprocess.run([sys.executable, "-c", INTERRUPTED], capture_output=True, text=True, timeout=300)
        self.assertEqual((done.stdout.split(), done.returncode), (["interrupted", "16"], 0), done.stderr)


class Words(unittest.TestCase):
    def test_everything_says_what_it_is(self):
        for name in pp.__all__:
            thing = getattr(pp, name)
            if name.startswith("__"):
                continue
            with self.subTest(name):
                self.assertTrue(thing.__doc__ and len(thing.__doc__) > 20)
                if isinstance(thing, type):
                    self.assertEqual(thing.__module__, "palpation")
        self.assertEqual(pp.__version__, subprocess.run([PALPATE, "--version"], capture_output=True, text=True).stdout.split()[-1])

    def test_options_show_themselves_and_make_themselves_again(self):
        model = pp.Model(length_m=0.004, trend="linear", level=3)
        self.assertEqual(pp.Model(**model.as_dict()).as_dict(), model.as_dict())
        self.assertIn("length_m=0.004", repr(model))
        plan = pp.Plan(acquisition="ils-ucb", batch=7)
        self.assertEqual(pp.Plan(**plan.as_dict()).as_dict(), plan.as_dict())
        self.assertEqual((pp.Plan().as_dict()["edge_share"], plan.as_dict()["edge_share"]), (0.65, 0.0))


def main():
    global PALPATE, ROOT
    if len(sys.argv) < 3:
        sys.exit("usage: module_test.py PALPATE PROJECT_ROOT [CLAIM...]")
    PALPATE, ROOT = os.path.abspath(sys.argv[1]), pathlib.Path(sys.argv[2]).resolve()
    if shapely is None:
        print("skipped: shapely is not installed: to and from its polygons")
    if vtk_xml is None:
        print("skipped: VTK's Python modules are not installed: tissue and boundaries as VTK holds them")
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=1)


if __name__ == "__main__":
    main()
