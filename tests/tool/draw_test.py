#!/usr/bin/env python3
"""What pictures show, read back from their pixels. Usage: draw_test.py PALPATE [Draw.test_...] (Python 3, standard library only)."""

import json
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

PALPATE = pathlib.Path(sys.argv[1]).resolve()
SCENE = {
    "surface": {"plane": {"size_mm": [20, 20], "vertices": [41, 41]}},
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


class Draw(unittest.TestCase):
    def setUp(self):
        if not (PALPATE.parent / "palpate-draw").exists():
            print("skipped: palpate-draw is not built", file=sys.stderr)
            self.skipTest("palpate-draw is not built")
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)
        (self.folder / "scene.json").write_text(json.dumps(SCENE))

    def picture_of(self, command, out, *arguments):
        subprocess.run([PALPATE, command, self.folder / "scene.json", "--out", self.folder / out, "--quiet", *map(str, arguments)], check=True, timeout=120)
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

    def test_noise_is_not_coloured_like_a_tumour(self):
        found = share_of(self.picture_of("simulate", "found"), is_strong)
        nothing = share_of(self.picture_of("simulate", "nothing", "--set", "probe.tumours=[]"), is_strong)
        self.assertGreater(found, 0.1)
        self.assertLess(nothing, 0.3 * found)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
