#!/usr/bin/env python3
"""`palpate link`, as 3D Slicer meets it: what arrives, where it is, what changes; and what stalled, rude and vanished clients do to others: nothing.

usage: link_test.py PALPATE [Link.test_...]        needs Python 3 and nothing else; skipped where palpate was built without OpenIGTLink
"""

import json
import math
import random
import re
import signal
import socket
import subprocess
import sys
import time
import unittest

import igtl
from support import PALPATE, PATIENCE_S, InFolder, main_without_pictures, palpate, rows_of

# Off its own mirror images, so that no turn is taken for another.
DISK_MM = (7.0, 12.0)
SCENE = {
    "surface": {"plane": {"size_mm": [20, 25], "vertices": [21, 26]}, "frame": "LPS"},
    "certainty": "laplace",
    "plan": {"initial": {"count": 25}, "batch": 4, "batches": 3},
    "probe": {"noise": 0.02, "tumours": [{"shape": "disk", "centre_mm": [*DISK_MM, 0], "radius_mm": 4}]},
}
MODELS = ["tissue", "tumour", "band", "not_searched", "outline", "band_lines", "cut_line"]
MARKS = ["touches", "set_aside", "missed", "next_stops"]
OK, ERROR, NOT_FOUND, BUSY, SHUT_DOWN = 1, 2, 4, 6, 19


def in_ras(x, y, z):
    """Of LPS, millimetres."""
    return -x, -y, z


def status(client):
    return igtl.status_of(client.latest["palpate"].body)


def is_settled(rows):
    """Whether all is shown that follows from so many rows."""
    return lambda client: "palpate" in client.latest and status(client)[0] == OK and status(client)[2].startswith(f"{rows} row")


class Link(InFolder):
    def setUp(self):
        super().setUp()
        self.scene = self.write("scene.json", json.dumps(SCENE))
        self.run_folder = self.folder / "run"

    def session(self, *words, code=0):
        return self.ends(code, "session", self.scene, self.run_folder, *words)

    def feel(self, plan, count=None):
        """So many stops of a plan, or all: 9 in the disk, 7 elsewhere."""
        felt = ["index,x,y,z,reading"]
        rows = rows_of(self.run_folder / f"plan_{plan:03}_waypoints.csv")
        for row in rows[:count]:
            x, y = 1e3 * float(row["x"]), 1e3 * float(row["y"])
            reading = (9 if math.dist((x, y), DISK_MM) < 4 else 7) + 0.01 * (7 * int(row["index"]) % 5)
            felt.append(f"{row['index']},{row['x']},{row['y']},{row['z']},{reading}")
        return self.write("felt.csv", "\n".join(felt) + "\n"), len(felt) - 1

    def record(self, plan, count=None):
        path, number = self.feel(plan, count)
        self.session("record", path)
        return number

    def link(self, *options):
        """The port of a link that has begun; it is ended with the test."""
        self.process = subprocess.Popen([PALPATE, "link", self.scene, self.run_folder, "--port", "0", *map(str, options)], stdin=subprocess.DEVNULL,
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        process = self.process
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        first = process.stdout.readline()
        found = re.search(r"at 127\.0\.0\.1:(\d+), in millimetres, RAS", first)
        if not found:
            self.fail(first + process.stderr.read())
        return int(found[1])

    def connect(self, port, **options):
        client = igtl.Client(port, **options)
        self.addCleanup(client.close)
        return client

    def end(self, by=signal.SIGINT):
        """What the link said: (on standard output, on standard error)."""
        self.process.send_signal(by)
        said = self.process.communicate(timeout=PATIENCE_S)
        self.assertEqual(self.process.returncode, 130, said[1])
        return said

    def begin(self, batches=1):
        """A session with so many batches felt and the next one planned; returns how many rows it has."""
        rows = 0
        for plan in range(batches):
            self.session("next")
            rows += self.record(plan)
        self.session("next")
        return rows

    def tables(self):
        """What `palpate boundary` concludes from the same readings, as tables in millimetres."""
        out = self.folder / "out"
        self.session("export", "--out", out)
        self.done("boundary", out / "scene.json", "--measurements", out / "measurements.csv", "--out", out / "run", "--quiet")
        self.done("export", out / "run", "--for", "csv", "--out", out / "csv")
        return {name: rows_of(out / "csv" / f"{name}.csv") for name in ("tissue", "boundary")}, json.loads((out / "run" / "summary.json").read_text())

    def assert_near(self, found, wanted, tolerance=1e-4):
        """Float32 has 7 digits: of 25 mm, 2e-6."""
        self.assertEqual(len(found), len(wanted))
        for a, b in zip(found, wanted):
            self.assertLess(math.dist(a, b), tolerance)

    def test_what_arrives_is_what_palpate_boundary_concludes_in_millimetres_and_ras(self):
        rows = self.begin(batches=2)
        client = self.connect(self.link()).until(is_settled(rows))
        self.assertEqual(list(client.latest), ["tissue", *MARKS, "probe", "palpate", *MODELS[1:], "conclusion"])
        self.assertEqual({client.latest[name].kind for name in MODELS}, {"POLYDATA"})
        tables, summary = self.tables()

        tissue = igtl.model_of(client.latest["tissue"].body)
        place = lambda row: in_ras(*(float(row[f"{axis} [mm]"]) for axis in "xyz"))
        self.assert_near(tissue.points, [place(row) for row in tables["tissue"]])
        self.assertEqual(len(tissue.polygons), 2 * 20 * 25)
        for field in ("mean", "stddev", "probability_inside"):
            (column,) = [name for name in tables["tissue"][0] if name.split(" ")[0] == field]
            self.assert_near([(value,) for value in tissue.fields["point", field]], [(float(row[column]),) for row in tables["tissue"]])

        for model, kinds in (("outline", ["estimate"]), ("band_lines", ["band_inner", "band_outer"]), ("cut_line", ["cut"])):
            lines = igtl.model_of(client.latest[model].body)
            self.assertTrue(lines.lines, model)
            wanted = [place(row) for kind in kinds for row in tables["boundary"] if row["kind"] == kind]
            self.assert_near(lines.points, wanted)
            for line in lines.lines:
                self.assertEqual(line[0], line[-1], "closed")
        outline = igtl.model_of(client.latest["outline"].body).points
        for point in outline:
            self.assertLess(abs(math.dist(point[:2], in_ras(*DISK_MM, 0)[:2]) - 4), 1.5)
        tumour = igtl.model_of(client.latest["tumour"].body)
        area = sum(0.5 * abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
                   for a, b, c in ([tumour.points[i] for i in corners] for corners in tumour.polygons))
        self.assertLess(abs(area - summary["area_mm2"]), 1e-3)
        self.assertTrue(igtl.model_of(client.latest["band"].body).polygons)

        words = igtl.string_of(client.latest["conclusion"].body)
        self.assertIn(f"One tumour of {area:.1f} mm\u00b2 was found", words)
        self.assertIn("All of the tissue was searched", words)
        self.assertEqual(igtl.model_of(client.latest["not_searched"].body).polygons, [])

    def test_the_probe_the_touches_and_the_next_stops_are_where_the_session_says(self):
        rows = self.begin()
        client = self.connect(self.link()).until(is_settled(rows))
        felt = rows_of(self.run_folder / "plan_000_waypoints.csv")
        place = lambda row: in_ras(*(1e3 * float(row[axis]) for axis in "xyz"))
        touches = igtl.points_of(client.latest["touches"].body)
        self.assertEqual([point.label for point in touches], [str(i + 1) for i in range(len(felt))])
        self.assert_near([point.position for point in touches], [place(row) for row in felt])
        self.assertEqual({(point.group, point.colour) for point in touches}, {("touches", (0, 158, 115, 255))})
        columns, at = igtl.matrix_of(client.latest["probe"].body)
        self.assert_near([at], [place(felt[-1])])
        self.assert_near(columns, [(-1, 0, 0), (0, 1, 0), (0, 0, -1)])  # into the tissue; its x along the robot's, which LPS to RAS turns
        stops = igtl.points_of(client.latest["next_stops"].body)
        self.assert_near([point.position for point in stops], [place(row) for row in rows_of(self.run_folder / "plan_001_waypoints.csv")])
        self.assertEqual([point.label for point in stops], ["0", "1", "2", "3"])

    def test_changes_arrive_after_a_record_and_what_did_not_change_is_not_sent_again(self):
        rows = self.begin()
        client = self.connect(self.link()).until(is_settled(rows))
        before = len(client.all)
        told = self.record(1, count=3)
        client.until(is_settled(rows + told))
        news = [message.device for message in client.all[before:]]
        self.assertLess(news.index("touches"), news.index("outline"), "what the journal says does not wait for what follows from it")
        for device in ("touches", "next_stops", "probe", "tissue", "outline", "conclusion"):
            self.assertEqual(news.count(device), 1, device)
        for device in ("missed", "set_aside"):
            self.assertNotIn(device, news)
        self.assertEqual([point.label for point in igtl.points_of(client.latest["next_stops"].body)], ["3"])
        self.session("skip", 3)
        client.until(is_settled(rows + told + 1))
        self.assertEqual([point.label for point in igtl.points_of(client.latest["missed"].body)], [str(rows + told + 1)])
        self.session("withdraw", 2, "--why", "slipped")
        client.until(lambda it: igtl.points_of(it.latest["set_aside"].body))
        self.assertEqual([point.label for point in igtl.points_of(client.latest["set_aside"].body)], ["2"])
        self.assertNotIn("2", [point.label for point in igtl.points_of(client.latest["touches"].body)])

    def test_what_is_gone_is_taken_away(self):
        rows = self.begin()
        client = self.connect(self.link()).until(is_settled(rows))
        self.assertTrue(igtl.model_of(client.latest["outline"].body).lines)
        self.session("withdraw", *range(1, rows + 1))
        client.until(lambda it: len(igtl.model_of(it.latest["outline"].body).lines) == 0 and status(it)[0] == OK)
        for model in ("outline", "tumour", "band"):
            empty = igtl.model_of(client.latest[model].body)
            self.assertEqual((len(empty.points), empty.verts, empty.lines, empty.polygons), (1, [], [], []))
        self.assertEqual(igtl.points_of(client.latest["touches"].body), [])
        self.assertTrue(igtl.model_of(client.latest["not_searched"].body).polygons)

    def test_a_client_that_stalls_is_dropped_and_nobody_waits_for_it(self):
        fine = json.loads(json.dumps(SCENE))
        fine["surface"]["plane"]["vertices"] = [121, 151]
        self.scene = self.write("scene.json", json.dumps(fine))
        rows = self.begin()
        port = self.link("--patience-s", 1)
        other = self.connect(port).until(is_settled(rows))
        stalled = [self.connect(port, buffer=4096) for _ in range(3)]
        begun = time.monotonic()
        for told in (1, 2, 3):
            self.record(1, count=told)
            rows += 1
            other.until(is_settled(rows))
        while time.monotonic() < begun + 2:
            other.receive(0.1)
        out, err = self.end()
        self.assertEqual(err.count("is dropped: it has taken nothing for 1 s"), 3, out + err)
        self.assertEqual(out.count("is connected"), 4)
        for client in stalled:
            with self.assertRaises((ConnectionError, AssertionError)):
                client.until(is_settled(rows), patience_s=10)

    def test_clients_come_go_and_come_again(self):
        rows = self.begin()
        port = self.link()
        for _ in range(5):
            client = self.connect(port).until(is_settled(rows))
            client.close()
        for _ in range(5):  # in the middle of a message
            client = self.connect(port)
            client.receive(60)
            client.socket.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, b"\1\0\0\0\0\0\0\0")
            client.close()
        several = [self.connect(port) for _ in range(6)]
        for client in several:
            client.until(is_settled(rows))
            self.assertEqual([message.body for message in client.latest.values()], [message.body for message in several[0].latest.values()])
        out, err = self.end()
        self.assertEqual(out.count("is connected"), 16, out + err)

    def test_requests_are_answered(self):
        rows = self.begin()
        client = self.connect(self.link()).until(is_settled(rows))

        def ask(kind, device="", count=1, **options):
            client.say(igtl.packed(kind, device, **options))
            return [client.receive(20) for _ in range(count)]

        self.assertEqual([message.device for message in ask("GET_POLYDATA", "outline")], ["outline"])
        self.assertEqual([message.device for message in ask("GET_POLYDATA", "", len(MODELS), version=2)], MODELS)
        self.assertEqual([message.device for message in ask("GET_TRANS", "probe")], ["probe"])
        self.assertEqual([message.device for message in ask("GET_POINT", "next_stops", body=b"x" * 12)], ["next_stops"])
        self.assertEqual([message.kind for message in ask("GET_STATUS")], ["STATUS"])
        (message,) = ask("GET_CAPABIL")
        self.assertEqual(igtl.kinds_of(message.body), ["POLYDATA", "POINT", "TRANSFORM", "STATUS", "STRING"])
        (message,) = ask("GET_IMAGE", "ultrasound")
        self.assertEqual(igtl.status_of(message.body), (NOT_FOUND, "NotFound", "there is no IMAGE ultrasound"))
        for kind in ("STT_POLYDATA", "TRANSFORM", "COMMAND", "IMAGE"):
            client.say(igtl.packed(kind, "anything", body=b"\xff" * 1000))
        self.assertEqual([message.device for message in ask("GET_STRING", "conclusion")], ["conclusion"], "and those before were ignored")

    def test_garbage_disturbs_nobody_not_even_who_says_it(self):
        rows = self.begin()
        port = self.link()
        other = self.connect(port).until(is_settled(rows))
        dice = random.Random(5)
        good = igtl.packed("GET_POLYDATA", "tissue")
        rude = []
        for attempt in range(60):
            client = self.connect(port)
            if attempt % 3 == 0:  # noise
                client.say(dice.randbytes(dice.choice((1, 57, 58, 59, 5000))))
            elif attempt % 3 == 1:  # a sound message with a byte that is none
                data = bytearray(igtl.packed("GET_POINT", "", b"body") + good * dice.randrange(4))
                for _ in range(dice.randrange(1, 4)):
                    data[dice.randrange(len(data))] = dice.randrange(256)
                client.say(bytes(data))
            else:  # cut anywhere, with a body that never comes
                client.say(igtl.HEADER.pack(dice.choice((0, 1, 2, 3, 65535)), b"GET_STATUS", b"", 0, dice.choice((0, 5, 1 << 39, (1 << 64) - 1)), 0)[:dice.randrange(59)])
            if attempt % 2:
                client.close()
            else:
                rude.append(client)
            if attempt % 20 == 19:  # so that there are fewer than 32: once a newcomer is served, all ends before it have been noticed
                while len(rude) > 1:
                    rude.pop(0).close()
                self.connect(port).until(is_settled(rows)).close()
        told = self.record(1, count=1)
        other.until(is_settled(rows + told))
        rude[-1].until(is_settled(rows + told))
        _, err = self.end(signal.SIGTERM)
        self.assertIn("says what is no OpenIGTLink", err)

    def test_too_many_clients_are_turned_away(self):
        rows = self.begin()
        port = self.link()
        clients = [self.connect(port).until(is_settled(rows)) for _ in range(32)]
        with self.assertRaises((ConnectionError, AssertionError)):
            self.connect(port).until(is_settled(rows), patience_s=10)
        clients.pop().close()
        time.sleep(0.5)
        self.connect(port).until(is_settled(rows))
        self.assertIn("is turned away: there are 32 clients already", self.end()[1])

    def test_it_ends_with_words_when_it_is_told_to(self):
        rows = self.begin()
        for by in (signal.SIGINT, signal.SIGTERM):
            client = self.connect(self.link()).until(is_settled(rows))
            begun = time.monotonic()
            _, err = self.end(by)
            self.assertIn(f"interrupted by {by.name}", err)
            self.assertLess(time.monotonic() - begun, 5)
            client.until(lambda it: status(it)[0] == SHUT_DOWN, patience_s=5)

    def test_a_session_that_is_damaged_while_it_is_shown_is_told_and_taken_up_again(self):
        rows = self.begin()
        client = self.connect(self.link()).until(is_settled(rows))
        journal = self.run_folder / "journal.jsonl"
        sound = journal.read_bytes()
        journal.write_bytes(sound.replace(b'"off_tissue"', b'"off_tissuf"', 1))
        client.until(lambda it: status(it)[0] == ERROR)
        self.assertIn("this line is corrupted", status(client)[2])
        journal.write_bytes(sound)
        client.until(is_settled(rows))
        self.session("next", "--set", "probe.noise=0.3", "--anyway")
        client.until(lambda it: status(it)[0] == ERROR)
        self.assertIn("the scene (probe/noise: 0.3 then, 0.02 now)", status(client)[2])
        self.assertIn("this line is corrupted", self.end()[1])

    def test_what_cannot_begin_says_why(self):
        say = lambda code, *words: self.ends(code, "link", self.scene, self.run_folder, *words)
        self.assertIn("holds no session", say(3))
        self.session("next")
        self.assertIn("would mirror them", say(3, "--frame", "RAS"))
        self.assertIn("probe/noise: 0.02 then, 0.5 now", say(3, "--set", "probe.noise=0.5"))
        nobody = self.write("nobody.json", json.dumps(SCENE | {"surface": {"plane": SCENE["surface"]["plane"]}}))
        self.assertIn("give --frame RAS", self.ends(2, "link", nobody, self.run_folder))
        with socket.socket() as taken:
            taken.bind(("127.0.0.1", 0))
            taken.listen()
            self.assertIn("another program listens there", say(4, "--port", taken.getsockname()[1]))
        self.assertIn("--host is an address of this machine", say(4, "--host", "256.0.0.1"))
        for option, value in (("--port", 65536), ("--port", -1), ("--patience-s", "nan"), ("--patience-s", 0), ("--host", ""), ("--frame", "XYZ")):
            self.assertIn(option, say(2, option, value))
        journal = self.run_folder / "journal.jsonl"
        journal.write_bytes(journal.read_bytes().replace(b'"synced"', b'"sunken"'))
        self.assertIn("journal.jsonl:1", say(3))


if __name__ == "__main__":
    lacking = palpate("link", "scene.json", "run").stderr
    if "was built without OpenIGTLink" in lacking:
        print("skipped: " + lacking.strip())
        sys.exit(77)
    main_without_pictures()
