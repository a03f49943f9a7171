#!/usr/bin/env python3
"""`palpate mesh repair` as a person meets it: what is asked for is done and told, nothing else is. Usage: mesh_test.py PALPATE (Python 3)."""

import sys
import unittest

from support import InFolder

SQUARE = "v 0 0 0\nv 10 0 0\nv 10 10 0\nv 0 10 0\n"
# In line 8 a triangle on the diagonal, in 9 a copy of the first, in 11 one of its own on vertices 6 to 8.
FAULTY = SQUARE + "v 5 5 0\nf 1 2 5\nf 5 2 3\nf 1 5 3\nf 2 5 1\nf 1 3 4\nf 6 7 8\nv 20 0 0\nv 21 0 0\nv 21 1 0\n"
ALL = ("--weld", "--triangulate", "--drop-duplicates", "--drop-degenerate", "--largest")


class Repair(InFolder):
    def setUp(self):
        super().setUp()
        self.out = self.folder / "out.obj"

    def repair(self, mesh, *options, code=0, says=()):
        told = self.ends(code, "mesh", "repair", mesh, self.out, *options)
        for words in [says] if isinstance(says, str) else says:
            self.assertIn(words, told)
        return told

    def test_each_repair_is_told_with_its_first_place(self):
        told = self.repair(self.write("in.obj", FAULTY), "--unit", "mm", *ALL, says=(
            "1 triangle with the corners of an earlier one was dropped: face 4 in line 9, whose first corner is at (10, 0, 0)",
            "1 triangle without an area was dropped: face 3 in line 8, whose first corner is at (0, 0, 0)",
            "1 triangle of 1 smaller component, 0.5 % of the area, was dropped: face 6 in line 11",
            "3 vertices belong to no face and were dropped",
            "out.obj: 5 vertices, 4 triangles, 10.00 x 10.00 x 0.00 mm"))
        self.assertIn("no crack", told)
        info = self.done("info", self.out, "--unit", "mm")
        self.assertIn("Area: 1.000 cm2", info)
        self.assertNotIn("Warning", info)

    def test_nothing_is_done_that_was_not_asked_for(self):
        mesh = self.write("in.obj", FAULTY)
        self.repair(mesh, "--unit", "mm", code=2, says="nothing is repaired that is not asked for")
        self.repair(mesh, *ALL, code=2)  # in which unit?
        self.repair(mesh, "--unit", "mm", "--drop-degenerate", "--largest", code=3, says="in.obj:9: face 4: has the corners of face 1 again")
        self.assertFalse(self.out.exists())
        self.repair(self.write("in.obj", SQUARE + "f 1 2 3\nf 1 3 4\n"), "--unit", "mm", *ALL, says="Nothing of what was asked for was found in it.")
        self.assertEqual([line for line in self.out.read_text().splitlines() if line[0] in "vf"], (SQUARE + "f 1 2 3\nf 1 3 4").splitlines())

    def test_what_is_still_wrong_is_told_and_nothing_is_written(self):
        mesh = self.write("in.obj", FAULTY)
        self.repair(mesh, "--unit", "mm", "--drop-duplicates", code=3, says=("after these repairs", "1 triangle has no area", "--drop-degenerate", "Nothing was written"))
        wings = self.write("wings.obj", SQUARE + "v 0 0 5\nv 0 0 -5\nf 1 2 3\nf 1 3 4\nf 1 3 5\nf 1 3 6\n")
        self.repair(wings, "--unit", "mm", *ALL, code=3, says="1 edge is in more than two triangles")
        crossed = self.write("crossed.obj", "v 0 0 0\nv 30 10 0\nv 30 0 0\nv 0 20 0\nf 1 2 3 4\n")
        self.repair(crossed, "--unit", "mm", "--triangulate", code=3, says="no fan of triangles covers once")
        self.assertFalse(self.out.exists())

    def test_a_polygon_is_cut_where_it_is_asked_for(self):
        comb = "v 0 0 0\nv 30 0 0\nv 30 30 0\nv 20 30 0\nv 20 10 0\nv 10 10 0\nv 10 30 0\nv 0 30 0\nf 1 2 3 4 5 6 7 8\n"
        mesh = self.write("in.obj", comb)
        self.repair(mesh, "--unit", "mm", "--weld", code=3, says="in.obj:9: face 1: is a polygon that no fan of triangles covers once")
        self.repair(mesh, "--unit", "mm", "--triangulate", says="1 face with more than three corners was cut into triangles: face 1 in line 9")
        info = self.done("info", self.out, "--unit", "mm")
        self.assertIn("Area: 7.000 cm2", info)

    def test_files_are_not_replaced_unasked(self):
        mesh = self.write("in.obj", FAULTY)
        self.out.write_text("mine")
        self.repair(mesh, "--unit", "mm", *ALL, code=3, says="is there already: replace it by --overwrite")
        self.assertEqual(self.out.read_text(), "mine")
        self.repair(mesh, "--unit", "mm", *ALL, "--overwrite")
        before = self.out.stat().st_size
        self.repair(mesh, "--unit", "mm", *ALL)  # the same again is no loss
        self.assertEqual(self.out.stat().st_size, before)
        self.out = mesh
        self.repair(mesh, "--unit", "mm", *ALL, "--overwrite", code=3, says="was read in this run")
        self.assertEqual(mesh.read_text(), FAULTY)

    def test_height_sd_needs_a_ply(self):
        ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\nproperty double height_sd\n" \
              "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0 0.1\n10 0 0 0.2\n0 10 0 0.3\n3 0 1 2\n"
        mesh = self.write("in.ply", ply)
        self.repair(mesh, "--unit", "mm", "--weld", code=2, says="OUT must end with .ply")
        self.out = self.folder / "out.ply"
        self.repair(mesh, "--unit", "mm", "--weld")
        self.assertIn(b"height_sd", self.out.read_bytes())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
