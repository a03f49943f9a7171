#!/usr/bin/env python3
"""palpate serve, as a program in another language uses it: a line in, a line out, what was answered is on the disk, killed or not.

usage: serve_test.py PALPATE [Serve.test_...]        needs Python 3 and nothing else
"""

import json
import random
import subprocess
import sys
import time
import unittest

from support import PALPATE, PATIENCE_S, InFolder, main_without_pictures

SCENE = {"certainty": "laplace", "surface": {"plane": {"size_mm": [20, 20], "vertices": [14, 14]}}, "plan": {"initial": {"count": 9}, "batch": 4, "batches": 2}}


class Caller:
    def __init__(self, folder):
        self.process = subprocess.Popen([PALPATE, "serve", folder / "run"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.opened = self.ask(do="open", scene=str(folder / "scene.json"))

    def tell(self, *requests):
        self.process.stdin.write("".join(json.dumps(request) + "\n" for request in requests).encode())
        self.process.stdin.flush()

    def hear(self):
        return json.loads(self.process.stdout.readline())

    def ask(self, **request):
        self.tell(request)
        return self.hear()

    def end(self):
        self.process.stdin.close()
        said = self.process.stdout.read()
        errors = self.process.stderr.read()
        self.process.stdout.close()
        self.process.stderr.close()
        return self.process.wait(timeout=PATIENCE_S), said, errors


def felt(place, number):
    return {"do": "record", "place": place, "reading": 7 + 0.001 * (number % 97), "t": 0.01 * number, "kind": "way"}


class Serve(InFolder):
    def setUp(self):
        super().setUp()
        self.write("scene.json", json.dumps(SCENE))

    def rows(self):
        lines = (self.folder / "run" / "journal.jsonl").read_text().splitlines()
        return [json.loads(line[17:]) for line in lines if '"kind":"reading"' in line]

    def test_every_line_is_answered_in_order_and_the_end_of_the_input_is_the_end(self):
        caller = Caller(self.folder)
        self.assertTrue(caller.opened["ok"], caller.opened)
        stops = caller.ask(do="next")["stops"]
        self.assertEqual(len(stops), 9)
        caller.tell(*[{"do": "record", "place": stop["place"], "reading": 7.1, "stop": stop["index"], "id": stop["index"]} for stop in stops], {"do": "x", "id": 99})
        self.assertEqual([caller.hear()["id"] for _ in range(10)], [*range(9), 99])
        self.assertEqual(caller.ask(do="show")["open"], [])
        caller.process.stdin.write(b"x" * 2_000_000 + b"\n")
        self.assertIn("longer than 1 MiB", caller.hear()["error"])
        code, said, errors = caller.end()
        self.assertEqual((code, said, errors), (0, b"", b""))
        self.assertEqual(len(self.rows()), 9)

    def test_what_comes_together_is_synced_together(self):
        caller = Caller(self.folder)
        caller.ask(do="next")
        count = 2000
        began = time.monotonic()
        caller.tell(*[felt([0.001 + 1e-6 * number, 0.01, 0], number) for number in range(count)])
        answers = [caller.hear() for _ in range(count)]
        seconds = time.monotonic() - began
        self.assertEqual([answer["number"] for answer in answers], list(range(1, count + 1)))
        print(f"{count / seconds:.0f} readings a second, synced")
        self.assertEqual(caller.end()[0], 0)
        self.assertEqual(len(self.rows()), count)

    def test_killed_at_any_moment_it_has_what_it_answered_once(self):
        dice, number, acknowledged = random.Random(1), 0, set()
        for kill in range(10):
            caller = Caller(self.folder)
            caller.ask(do="next")
            fresh = range(number, number + 300)
            caller.tell(*[felt([0.001 + 1e-6 * one, 0.01, 0], one) for one in fresh])
            for _ in range(dice.randrange(1, 250)):
                caller.hear()
                acknowledged.add(number)
                number += 1
            caller.process.kill()
            caller.end()
            number = fresh[0] + dice.randrange(len(fresh))  # who was not told says some of it again
            number = min(number, max(acknowledged))
            taken = [round(row["t"] * 100) for row in self.rows()]
            self.assertEqual(len(taken), len(set(taken)), "taken twice")
            self.assertLessEqual(acknowledged, set(taken))


if __name__ == "__main__":
    main_without_pictures()
