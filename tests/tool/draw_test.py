#!/usr/bin/env python3
"""What pictures show, read back from their pixels. Usage: draw_test.py PALPATE [Draw.test_...] (Python 3, standard library only)."""

import json
import re
import struct
import sys
import unittest
import xml.etree.ElementTree
import zlib

from support import InFolder, PALPATE, palpate, rows_of

SCENE = {
    "surface": {"plane": {"size_mm": [20, 20], "vertices": [41, 41]}},
    "certainty": "laplace",
    "plan": {"batches": 2},
    "probe": {"noise": 0.05, "tumours": [{"shape": "disk", "centre_mm": [10, 10, 0], "radius_mm": 5}]},
}
NEXT = (226, 0, 140)  # colour.h: kNext


def pixels_of(path):
    """(width, bytes of red, green and blue) of a PNG without interlacing, eight bits a colour."""
    data = path.read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    at, packed = 8, b""
    while at < len(data):
        (length,), kind = struct.unpack(">I", data[at:at + 4]), data[at + 4:at + 8]
        body = data[at + 8:at + 8 + length]
        if kind == b"IHDR":
            width, height, depth, colour, _, _, interlaced = struct.unpack(">IIBBBBB", body)
            assert (depth, colour, interlaced) == (8, 2, 0)
        if kind == b"IDAT":
            packed += body
        at += 12 + length
    raw, stride, before, image = zlib.decompress(packed), 3 * width, bytearray(3 * width), bytearray()
    for row in range(height):
        method, line = raw[row * (stride + 1)], bytearray(raw[row * (stride + 1) + 1:(row + 1) * (stride + 1)])
        for i in range(stride if method else 0):
            left, up, corner = (line[i - 3] if i >= 3 else 0), before[i], (before[i - 3] if i >= 3 else 0)
            if method == 4:
                guess = left + up - corner
                near = min((abs(guess - left), 0, left), (abs(guess - up), 1, up), (abs(guess - corner), 2, corner))[2]
            else:
                near = (0, left, up, (left + up) // 2)[method]
            line[i] = (line[i] + near) & 255
        image += line
        before = line
    return width, bytes(image)


def share_of(path, belongs):
    """Of the left third of a picture: the part of its pixels that belong."""
    width, image = pixels_of(path)
    rows = len(image) // (3 * width)
    count = sum(belongs(*image[at:at + 3]) for row in range(0, rows, 2) for at in range(3 * width * row, 3 * (width * row + width // 3), 6))
    return count / ((rows // 2) * (width // 6))


def is_next(red, green, blue):
    return max(abs(red - NEXT[0]), abs(green - NEXT[1]), abs(blue - NEXT[2])) < 12


def is_strong(red, green, blue):
    return max(red, green, blue) - min(red, green, blue) > 90


class Draw(InFolder):
    def setUp(self):
        if not (PALPATE.parent / "palpate-draw").exists():
            self.skip("palpate-draw is not built")
        super().setUp()
        self.write("scene.json", json.dumps(SCENE))

    def picture_of(self, command, out, *arguments):
        self.done(command, self.folder / "scene.json", "--out", self.folder / out, "--quiet", *arguments)
        return self.folder / out / "picture.png"

    def test_a_plan_shows_where_to_touch_next_and_a_boundary_does_not(self):
        self.picture_of("simulate", "run")
        felt = self.folder / "felt.csv"
        felt.write_text("".join((self.folder / "run" / "measurements.csv").read_text().splitlines(True)[:17]))
        turned = "robot.from_tissue=[0,-1,0,0.3, 1,0,0,0.1, 0,0,1,0, 0,0,0,1]"
        shown = share_of(self.picture_of("plan", "plan", "--measurements", felt), is_next)
        self.assertGreater(shown, 1e-4)
        self.assertAlmostEqual(share_of(self.picture_of("plan", "turned", "--measurements", felt, "--set", turned), is_next), shown, delta=0.1 * shown)
        self.assertEqual(share_of(self.picture_of("boundary", "boundary", "--measurements", felt), is_next), 0.0)
        self.assertEqual(share_of(self.folder / "run" / "picture.png", is_next), 0.0)

    def test_the_stops_of_a_plan_bear_the_indices_of_waypoints_csv(self):
        self.picture_of("plan", "plan", "--set", "plan.initial.count=12")
        plan = self.folder / "plan"
        stops = rows_of(plan / "waypoints.csv")
        self.draw(plan, "--format", "svg", "--panels", "mean")
        drawn = xml.etree.ElementTree.parse(plan / "figure.svg").getroot()
        texts = list(drawn.iter("{http://www.w3.org/2000/svg}text"))
        bold = {text.text: text for text in texts if text.get("font-weight") == "bold" and text.text.isdigit()}
        self.assertEqual(sorted(bold, key=int), [row["index"] for row in stops])
        self.assertIn("next samples, by their index", [text.text for text in texts])
        places = {name: tuple(float(text.get(axis)) for axis in "xy") for name, text in bold.items()}
        for axis, sign in ((0, 1), (1, -1)):  # they lie as the stops do
            for a, b in ((a, b) for a in stops for b in stops):
                apart = float(b["xy"[axis]]) - float(a["xy"[axis]])
                if apart > 0.004:
                    self.assertGreater(sign * (places[b["index"]][axis] - places[a["index"]][axis]), 0)

    def test_noise_is_not_coloured_like_a_tumour(self):
        found = share_of(self.picture_of("simulate", "found"), is_strong)
        nothing = share_of(self.picture_of("simulate", "nothing", "--set", "probe.tumours=[]"), is_strong)
        self.assertGreater(found, 0.1)
        self.assertLess(nothing, 0.3 * found)


    def test_what_was_not_searched_is_greyed(self):
        (self.folder / "corner.csv").write_text("x,y,z,reading\n" + "".join(f"0.00{i},0.00{j},0,{7 + 0.01 * ((3 * i + j) % 4)}\n" for i in range(4) for j in range(4)))
        (self.folder / "grid.csv").write_text("x,y,z,reading\n" + "".join(f"{0.004 * i:.3f},{0.004 * j:.3f},0,{7 + 0.01 * ((3 * i + j) % 4)}\n" for i in range(6) for j in range(6)))

        def veiled(red, green, blue):
            return max(red, green, blue) - min(red, green, blue) < 16 and 185 < red < 235

        corner = share_of(self.picture_of("boundary", "corner", "--measurements", self.folder / "corner.csv"), veiled)
        grid = share_of(self.picture_of("boundary", "grid", "--measurements", self.folder / "grid.csv"), veiled)
        self.assertGreater(corner, grid + 0.1)

    def draw(self, *arguments):
        result = palpate("draw", *arguments)
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_a_figure_has_the_size_that_is_asked_for_and_each_format_its_words(self):
        self.picture_of("simulate", "run", "--set", "reading_unit=N/mm")
        run = self.folder / "run"
        self.draw(run, "--out", self.folder / "all.png", "--width-mm", 127, "--dpi", 200)
        self.assertEqual(pixels_of(self.folder / "all.png")[0], 1000)
        self.draw(run, "--format", "svg", "--panels", "mean")
        drawn = xml.etree.ElementTree.parse(run / "figure.svg").getroot()
        space = "{http://www.w3.org/2000/svg}"
        self.assertEqual(drawn.get("width"), "180.00mm")
        words = [text.text for text in drawn.iter(f"{space}text")]
        self.assertIn("Estimated stiffness (posterior mean)", words)
        self.assertNotIn("Posterior standard deviation", words)
        self.assertTrue(any("N/mm" in text for text in words), words)
        (image,) = drawn.iter(f"{space}image")
        self.assertTrue(image.get("href").startswith("data:image/png;base64,"))
        self.draw(run, "--out", self.folder / "all.pdf")
        pdf = (self.folder / "all.pdf").read_bytes()
        self.assertTrue(pdf.startswith(b"%PDF-1.4") and pdf.endswith(b"%%EOF\n"))
        at = int(pdf.rsplit(b"startxref\n", 1)[1].split()[0])
        self.assertTrue(pdf[at:].startswith(b"xref\n"))
        for number, line in enumerate(pdf[at:].split(b"trailer")[0].splitlines()[3:], 1):
            self.assertTrue(pdf[int(line[:10]):].startswith(b"%d 0 obj" % number))
        content = zlib.decompress(pdf.split(b"stream\n", 1)[1])
        self.assertIn(b"(Posterior standard deviation) Tj", content)
        self.assertIn(b"N/mm", content)

    def test_runs_side_by_side_have_common_colours_and_their_names(self):
        self.picture_of("simulate", "soft")
        self.picture_of("simulate", "hard", "--set", "probe.high=12")
        scales = []
        for extra in ((), ("--limits", 6, 11)):
            out = self.folder / f"both{len(extra)}.svg"
            self.draw(self.folder / "soft", self.folder / "hard", "--panels", "mean", "--out", out, *extra)
            words = [text.text for text in xml.etree.ElementTree.parse(out).getroot().iter("{http://www.w3.org/2000/svg}text")]
            self.assertTrue({"soft", "hard"} <= set(words))
            scales.append(words)
            ticks = [word for word in words if re.fullmatch(r"[0-9.]+", word)]
            self.assertEqual(len([word for word in words if word == "Estimated stiffness (posterior mean)"]), 2)
            self.assertTrue(all(ticks.count(tick) >= 2 for tick in ticks), "both have the same axes and colours")
        self.assertNotEqual(*scales)

    def test_a_figure_is_refused_in_words(self):
        self.picture_of("simulate", "run")
        (self.folder / "mine.svg").write_text("what a person wrote\n")
        for code, arguments, words in ((3, (self.folder / "run", "--out", self.folder / "mine.svg"), "is there already"),
                                       (2, (self.folder / "run", "--out", self.folder / "a.gif"), "must end with .png, .svg or .pdf"),
                                       (2, (self.folder / "run", "--out", self.folder / "a.png", "--format", "pdf"), "contradict each other"),
                                       (2, (self.folder / "run", self.folder / "run"), "name its file by --out"),
                                       (2, (self.folder / "run", "--limits", 9, 7), "the first must be below the second"),
                                       (3, (self.folder, "--out", self.folder / "a.png"), "holds no run of palpate")):
            result = palpate("draw", *arguments)
            self.assertEqual(result.returncode, code, result.stderr)
            self.assertIn(words, result.stderr)
        self.assertEqual((self.folder / "mine.svg").read_text(), "what a person wrote\n")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
