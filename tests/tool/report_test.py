#!/usr/bin/env python3
"""report.html, first as a text: its structure, its figures, what hostile names do to it. Then in Chromium, where there is one: its view of the tissue.

usage: report_test.py PALPATE PROJECT_ROOT [Page.test_... | Browser.test_...]        needs Python 3; Chromium for what is looked at
"""

import base64
import fcntl
import hashlib
import html.parser
import json
import os
import pathlib
import re
import select
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest

from support import PALPATE, palpate, rows_of, skip

ROOT = pathlib.Path(sys.argv[2]).resolve()
WEB = ROOT / "src" / "draw" / "report"
CHROMIUM = next((found for found in map(shutil.which, ("chromium", "chromium-browser", "google-chrome")) if found), None)

SCENE = {
    "surface": {"plane": {"size_mm": [24, 30], "vertices": [41, 51]}},
    "reading_unit": "N/mm",
    "plan": {"batches": 4},
    "probe": {"noise": 0.03, "tumours": [{"shape": "disk", "centre_mm": [9, 12, 0], "radius_mm": 4}]},
}
TWO = {**SCENE["probe"], "tumours": [{"shape": "disk", "centre_mm": [7, 8, 0], "radius_mm": 3.5}, {"shape": "disk", "centre_mm": [24, 24, 0], "radius_mm": 4}]}
HOSTILE = '</script><script>document.title="caught"</script><img src=x onerror=alert(1)> & "\'.json'


class Text(html.parser.HTMLParser):
    """A page taken apart: elements with their attributes, and what stands in script, style and text."""

    def __init__(self, page):
        super().__init__()
        self.elements, self.data, self.raw, self.words, self.open = [], {}, {"script": [], "style": []}, "", []
        self.feed(page)
        self.close()

    def handle_starttag(self, tag, attributes):
        self.elements.append((tag, dict(attributes)))
        if tag in self.raw:
            self.raw[tag].append("")
            self.open.append(tag)
        if tag == "data" and "data-key" in dict(attributes):
            self.data[dict(attributes)["data-key"]] = float(dict(attributes)["value"])

    def handle_endtag(self, tag):
        if self.open and self.open[-1] == tag:
            self.open.pop()

    def handle_data(self, data):
        if self.open:
            self.raw[self.open[-1]][-1] += data
        else:
            self.words += data

    def named(self, tag):
        return [attributes for name, attributes in self.elements if name == tag]


class Runs:
    """A folder with runs of every kind, each made once."""

    holder = tempfile.TemporaryDirectory()
    folder = pathlib.Path(holder.name)
    made = {}

    @classmethod
    def of(cls, name, make):
        if name not in cls.made:
            cls.made[name] = cls.folder / name
            make(cls.folder / name)
        return cls.made[name]

    @classmethod
    def simulated(cls, name, scene=SCENE, *arguments):
        def make(out):
            (cls.folder / f"{name}.json").write_text(json.dumps(scene))
            result = palpate("simulate", cls.folder / f"{name}.json", "--out", out, "--quiet", *arguments)
            assert result.returncode == 0, result.stderr
        return cls.of(name, make)

    @classmethod
    def found(cls):
        return cls.simulated("found")

    @classmethod
    def two(cls):
        return cls.simulated("two", {**SCENE, "probe": TWO})

    @classmethod
    def nothing(cls):
        return cls.simulated("nothing", {**SCENE, "probe": {"noise": 0.03, "tumours": []}})

    @classmethod
    def unknown(cls):
        def make(out):
            (cls.folder / "unknown.json").write_text(json.dumps({**SCENE, "probe": {}}))
            felt = cls.folder / "set_aside.csv"
            felt.write_text("x,y,z,reading,set_aside\n" + "".join(f"0.00{i},0.005,0,{i % 3},slipped\n" for i in range(1, 9)))
            assert palpate("boundary", cls.folder / "unknown.json", "--measurements", felt, "--out", out, "--quiet").returncode == 0
        return cls.of("unknown", make)

    @classmethod
    def dome(cls):
        surface = {"mesh": str(cls.folder / "dome.ply"), "unit": "mm"}
        if not (cls.folder / "dome.ply").exists():
            assert palpate("mesh", "dome", "--edge-mm", "1.2", cls.folder / "dome.ply").returncode == 0
        tumour = {"shape": "disk", "centre_mm": [5, 4, 0], "radius_mm": 5}
        return cls.simulated("dome", {**SCENE, "surface": surface, "probe": {"noise": 0.03, "tumours": [tumour]}})

    @classmethod
    def interrupted(cls):
        def make(out):
            (cls.folder / "long.json").write_text(json.dumps(SCENE))
            run = subprocess.Popen([PALPATE, "simulate", cls.folder / "long.json", "--out", out, "--quiet", "--set", "plan.batches=10000"],
                                   stderr=subprocess.DEVNULL)
            until = time.monotonic() + 60
            while not (out / "steps" / "step_002.vtp").exists() and time.monotonic() < until:
                time.sleep(0.02)
            run.send_signal(signal.SIGTERM)
            assert run.wait(timeout=60) == 130
        return cls.of("interrupted", make)


def page_of(run, *arguments):
    """The page of a run; made where it has none."""
    path = run / "report.html"
    if not path.exists():
        result = palpate("report", run, *arguments)
        assert result.returncode == 0, result.stderr
    return path.read_text(encoding="utf-8")


def at(summary, key):
    for part in key.split("."):
        summary = summary[int(part)] if isinstance(summary, list) else summary[part]
    return summary


class Page(unittest.TestCase):
    def check_figures(self, run):
        summary = json.loads((run / "summary.json").read_text())
        page = Text(page_of(run))
        for key, value in page.data.items():
            self.assertEqual(value, at(summary, key), key)
        return page, summary

    def test_every_figure_is_the_summarys(self):
        for run, more in ((Runs.found(), {"error.missed_mm2", "error.dice", "parts.0.area_mm2", "band.half_width_mm"}),
                          (Runs.two(), {"parts.1.area_mm2", "parts.1.probability"}), (Runs.nothing(), {"nothing_wider_than_mm"})):
            page, _ = self.check_figures(run)
            self.assertLessEqual({"area_mm2", "measurements", "search_area_mm2", *more}, page.data.keys() | {"area_mm2"}, run)

    def test_where_nothing_is_known_the_verdict_rules_nothing_out(self):
        words = re.sub(r"\s+", " ", Text(page_of(Runs.unknown())).words)
        self.assertIn("No tumour was found, but these readings rule none out.", words)

    def test_the_verdict_comes_first_and_says_what_was_found(self):
        for run, words in ((Runs.found(), r"One tumour of \d+(\.\d)? mm² was found; [\d.]+ mm² are expected to be wrong\."),
                           (Runs.two(), r"Two tumours were found, \d+(\.\d)? mm² in all; [\d.]+ mm² are expected to be wrong\."),
                           (Runs.nothing(), r"No tumour was found\. With a probability of 95(\.0)? % there is none that is wider than [\d.]+ mm\."),
                           (Runs.interrupted(), r"This run did not end \(interrupted\): this is what was believed after its last batch, and nothing is")):
            words_of_page = re.sub(r"\s+", " ", Text(page_of(run)).words)
            verdict = re.search(words, words_of_page)
            self.assertIsNotNone(verdict, words_of_page[:400])
            self.assertLess(verdict.start(), 200)
            if (run / "summary.json").exists():
                summary = json.loads((run / "summary.json").read_text())
                wanted = [summary["area_mm2"], summary["expected_error_mm2"]] if summary["parts"] else [95.0, summary["nothing_wider_than_mm"]]
                told = [float(number) for number in re.findall(r"[\d.]+(?= (?:mm|%))", verdict[0])]
                self.assertEqual(told, [float(f"{number:.{digits}g}") for number, digits in zip(wanted, (3, 2) if summary["parts"] else (3, 3))])
        summary = json.loads((Runs.found() / "summary.json").read_text())
        for warning in summary["warnings"]:
            self.assertIn(warning, Text(page_of(Runs.found())).words)

    def test_a_run_that_did_not_end_says_what_was_known_before_its_end(self):
        run = Runs.interrupted()
        page = Text(page_of(run))
        felt = rows_of(run / "measurements.csv")
        listed = [attributes for attributes in page.named("tr") if attributes.get("id", "").startswith("reading-")]
        self.assertEqual([attributes["id"] for attributes in listed], [f"reading-{i + 1}" for i in range(len(felt))])
        self.assertGreaterEqual(len({row["batch"] for row in felt}), len(list((run / "steps").iterdir())) - 1)
        words = re.sub(r"\s+", " ", page.words)
        self.assertIn("All of the tissue was searched", words)
        self.assertIn("Palpation of long.json", words)
        self.assertIn(f"scene{Runs.folder}/long.json seed1 made by", words)
        self.assertIn('"batches": 10000', words)
        digest = hashlib.sha256((Runs.folder / "long.json").read_bytes()).hexdigest()
        self.assertIn(f"read: {Runs.folder}/long.json{digest} (SHA-256)", words)
        if (PALPATE.parent / "palpate-draw").exists():
            self.assertEqual([attributes["src"][:22] for attributes in page.named("img")], ["data:image/png;base64,"])
            self.assertNotIn("has no pictures", words)

    def test_a_picture_that_a_person_put_into_a_run_that_did_not_end_stays(self):
        run = pathlib.Path(shutil.copytree(Runs.interrupted(), Runs.folder / "with picture"))
        (run / "picture.png").write_bytes(b"a person's")
        result = palpate("report", run, "--overwrite")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual((run / "picture.png").read_bytes(), b"a person's")

    def test_it_says_whether_the_border_is_reached_and_what_was_not_searched(self):
        self.assertIn("its border is not reached", page_of(Runs.found()))
        self.assertIn("One of them reaches the border", page_of(Runs.two()))
        self.assertIn("All of the tissue was searched", page_of(Runs.found()))
        corner = "x,y,z,reading\n" + "".join(f"0.00{i},0.00{j},0,{7 + 0.01 * ((3 * i + j) % 4)}\n" for i in range(4) for j in range(4))
        (Runs.folder / "corner.csv").write_text(corner)
        (Runs.folder / "corner.json").write_text(json.dumps(SCENE))
        run = Runs.of("corner", lambda out: palpate("boundary", Runs.folder / "corner.json", "--measurements", Runs.folder / "corner.csv", "--out", out))
        told = re.search(r"([\d.]+) % of the tissue \(([\d.]+) mm²\) was not searched", page_of(run))
        # Searched is what lies within 8 mm of the square from 0 to 3 mm; of the tissue that is a square, two rectangles and a quarter of a disk.
        searched_mm2 = 3 * 3 + 2 * 3 * 8 + 3.14159 * 64 / 4
        self.assertAlmostEqual(float(told[2]), 720 - searched_mm2, delta=5)
        self.assertAlmostEqual(float(told[1]), 100 * float(told[2]) / 720, delta=0.1)

    def test_readings_are_all_there_and_those_set_aside_with_their_reason(self):
        run = Runs.folder / "aside"
        rows = (Runs.found() / "measurements.csv").read_text().splitlines()
        head = rows[0].split(",")
        odd = rows[5].split(",")
        odd[head.index("set_aside")] = "the <b>tool</b> slipped"
        rows[5] = ",".join(odd)
        (Runs.folder / "aside.csv").write_text("\n".join(rows) + "\n")
        (Runs.folder / "aside.json").write_text(json.dumps(SCENE))
        result = palpate("boundary", Runs.folder / "aside.json", "--measurements", Runs.folder / "aside.csv", "--out", run)
        self.assertEqual(result.returncode, 0, result.stderr)
        page = Text(page_of(run))
        listed = [attributes for attributes in page.named("tr") if attributes.get("id", "").startswith("reading-")]
        felt = rows_of(run / "readings_used.csv")
        self.assertEqual([attributes["id"] for attributes in listed], [f"reading-{i + 1}" for i in range(len(felt))])
        for attributes, row in zip(listed, felt):
            self.assertAlmostEqual(float(attributes["data-reading"].split()[0]), float(row["reading"]), delta=1e-3)
        self.assertEqual(listed[4]["data-why"], "set aside: the <b>tool</b> slipped")
        self.assertNotIn("data-why", listed[3])
        self.assertIn("set aside: the <b>tool</b> slipped", page.words)
        self.assertEqual(page.named("b"), [])

    def test_it_asks_nobody_for_anything(self):
        page = Text(page_of(Runs.found()))
        (policy,) = (meta["content"] for meta in page.named("meta") if meta.get("http-equiv") == "Content-Security-Policy")
        rules = dict(rule.strip().split(" ", 1) for rule in policy.split(";"))
        self.assertEqual(rules["default-src"], "'none'")
        self.assertEqual(rules["img-src"], "data:")
        data, *scripts = page.raw["script"]
        allowed = ["'sha256-" + base64.b64encode(hashlib.sha256(code.encode()).digest()).decode() + "'" for code in (*scripts, *page.raw["style"])]
        self.assertEqual(rules["script-src"].split(), allowed[:2])
        self.assertEqual(rules["style-src"].split(), allowed[2:])
        self.assertIsInstance(json.loads(data), dict)
        for _, attributes in page.elements:
            for name, value in attributes.items():
                self.assertFalse(name.startswith("on"), name)
                if name in ("src", "href"):
                    self.assertRegex(value, r"^(data:|#reading-\d+$)")

    def test_script_and_style_are_those_that_are_kept_and_the_bundle_keeps_its_licence(self):
        page = Text(page_of(Runs.found()))
        self.assertEqual(page.raw["script"][1].encode(), (WEB / "three.bundle.js").read_bytes())
        self.assertEqual(page.raw["script"][2].encode(), (WEB / "viewer.js").read_bytes())
        self.assertEqual(page.raw["style"][0].encode(), (WEB / "report.css").read_bytes())
        digest, name = (WEB / "three.bundle.js.sha256").read_text().split()
        self.assertEqual((hashlib.sha256((WEB / name).read_bytes()).hexdigest(), name), (digest, "three.bundle.js"))
        self.assertIn("SPDX-License-Identifier: MIT", (WEB / "three.bundle.js").read_text())
        self.assertIn("three.js authors", (WEB / "three.LICENSE").read_text())

    def test_hostile_names_are_shown_and_do_nothing(self):
        folder = Runs.folder / "hostile"
        folder.mkdir(exist_ok=True)
        scene = folder / HOSTILE.replace("/", "\u2215")
        unit = '</script><script>document.title="caught"</script>'
        scene.write_text(json.dumps({**SCENE, "reading_unit": unit, "plan": {"batches": 0}}))
        run = folder / "run"
        result = palpate("simulate", scene, "--out", run, "--quiet")
        self.assertEqual(result.returncode, 0, result.stderr)
        page = Text(page_of(run))
        self.assertEqual(len(page.named("script")), 3)
        self.assertTrue(all(attributes["src"].startswith("data:image/png") for attributes in page.named("img")))
        self.assertIn(scene.name, page.words)
        self.assertEqual(json.loads(page.raw["script"][0])["unit"], unit)
        self.assertNotIn("<", page.raw["script"][0])

    def test_it_says_where_it_comes_from(self):
        run = Runs.found()
        page = Text(page_of(run))
        for path in (Runs.folder / "found.json", run / "surface.vtp", run / "summary.json"):
            self.assertIn(hashlib.sha256(path.read_bytes()).hexdigest(), page.words, path)
        summary = json.loads((run / "summary.json").read_text())
        self.assertEqual(summary["inputs"], [{"file": str(Runs.folder / "found.json"), "sha256": hashlib.sha256((Runs.folder / "found.json").read_bytes()).hexdigest()}])
        version = palpate("--version").stdout.strip()
        self.assertRegex(page.words, rf"made by\s*palpate {re.escape(version)}, simulate")

    def test_a_later_report_is_the_same_page_and_a_persons_page_stays(self):
        run = Runs.found()
        before = page_of(run)
        again = palpate("report", run)
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertEqual((run / "report.html").read_text(), before)
        elsewhere = Runs.folder / "page.html"
        self.assertEqual(palpate("report", run, "--out", elsewhere).returncode, 0)
        self.assertEqual(elsewhere.read_text(), before)
        elsewhere.write_text("what a person wrote\n")
        refused = palpate("report", run, "--out", elsewhere)
        self.assertEqual((refused.returncode, elsewhere.read_text()), (3, "what a person wrote\n"))
        self.assertEqual(palpate("report", Runs.folder).returncode, 3)

    def test_pictures_are_in_the_page_for_those_who_cannot_draw(self):
        page = Text(page_of(Runs.found()))
        if not (PALPATE.parent / "palpate-draw").exists():
            skip(self, "palpate-draw is not built")
        inside = [base64.b64decode(image["src"].split(",", 1)[1]) for image in page.named("img")]
        self.assertEqual(inside, [(Runs.found() / name).read_bytes() for name in ("picture.png", "convergence.png")])

    def test_the_view_holds_the_fields_of_the_surface(self):
        page = Text(page_of(Runs.found()))
        view = json.loads(page.raw["script"][0])
        self.assertEqual(view["vertices"], 41 * 51)
        mean = struct.unpack(f"<{41 * 51}f", base64.b64decode(view["fields"]["mean"]["values"]))
        self.assertAlmostEqual(max(mean), view["fields"]["mean"]["high"], delta=1e-6)
        places = struct.unpack(f"<{3 * 41 * 51}H", base64.b64decode(view["positions"]))
        self.assertEqual((min(places), max(places)), (0, 65535))
        self.assertEqual([view["low"], view["high"]], [[0, 0, 0], [24, 30, 0]])
        self.assertEqual([state["batch"] for state in view["states"]], [0, 1, 2, 3, 4])


class Chromium:
    """A browser without a window, asked through pipes."""

    def __init__(self, *flags):
        self.profile = tempfile.TemporaryDirectory()
        there, self.out = os.pipe()
        self.back, here = os.pipe()

        def give():  # Chromium reads what it is asked from 3 and answers on 4
            low, high = fcntl.fcntl(there, fcntl.F_DUPFD, 10), fcntl.fcntl(here, fcntl.F_DUPFD, 10)
            os.dup2(low, 3)
            os.dup2(high, 4)

        command = [CHROMIUM, "--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--disable-extensions", "--disable-background-networking",
                   "--no-first-run", "--hide-scrollbars", f"--user-data-dir={self.profile.name}", "--remote-debugging-pipe", *flags, "about:blank"]
        self.process = subprocess.Popen(command, preexec_fn=give, close_fds=False, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                        stderr=subprocess.DEVNULL, start_new_session=True)
        os.close(there)
        os.close(here)
        self.buffer, self.number, self.events = b"", 0, []
        target = self.ask("Target.createTarget", url="about:blank")["targetId"]
        self.session = None
        self.session = self.ask("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.ask(f"{domain}.enable")

    def close(self):
        os.killpg(self.process.pid, signal.SIGKILL)
        self.process.wait()
        os.close(self.out)
        os.close(self.back)
        self.profile._rmtree(self.profile.name, ignore_errors=True)

    def ask(self, method, **parameters):
        self.number += 1
        message = {"id": self.number, "method": method, "params": parameters}
        if getattr(self, "session", None):
            message["sessionId"] = self.session
        os.write(self.out, json.dumps(message).encode() + b"\0")
        until = time.monotonic() + 60
        while time.monotonic() < until:
            if b"\0" not in self.buffer:
                if select.select([self.back], [], [], 1.0)[0]:
                    self.buffer += os.read(self.back, 1 << 16)
                continue
            text, self.buffer = self.buffer.split(b"\0", 1)
            answer = json.loads(text)
            if answer.get("id") == self.number:
                if "error" in answer:
                    raise AssertionError(f"{method}: {answer['error']}")
                return answer["result"]
            self.events.append(answer)
        raise AssertionError(f"{method}: no answer")

    def do(self, code):
        result = self.ask("Runtime.evaluate", expression=code, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in result:
            raise AssertionError(f"{code}: {result['exceptionDetails']}")
        return result["result"].get("value")

    def open(self, path, width=1400, height=1000):
        self.events = []
        self.ask("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)
        self.ask("Page.navigate", url=path.as_uri())
        until = time.monotonic() + 60
        while self.do("document.readyState") != "complete" and time.monotonic() < until:
            time.sleep(0.05)
        self.do("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")

    def complaints(self):
        """What was printed, what failed, and what was asked for but the page itself."""
        self.do("0")
        said = [event["params"] for event in self.events if event.get("method") in ("Runtime.consoleAPICalled", "Runtime.exceptionThrown", "Log.entryAdded")]
        asked = [event["params"]["request"]["url"] for event in self.events if event.get("method") == "Network.requestWillBeSent"]
        return said, [url for url in asked if not url.startswith("data:")]

    def click(self, x, y):
        for kind in ("mousePressed", "mouseReleased"):
            self.ask("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", clickCount=1)

    def key(self, key):
        for kind in ("keyDown", "keyUp"):
            self.ask("Input.dispatchKeyEvent", type=kind, key=key, code=key, windowsVirtualKeyCode={"ArrowLeft": 37, "ArrowRight": 39}.get(key, 0))


@unittest.skipIf(CHROMIUM is None, "no Chromium is installed")
class Browser(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.browser = Chromium("--enable-unsafe-swiftshader", "--use-angle=swiftshader")

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()

    def open(self, run, width=1400, height=1000):
        page_of(run)
        self.browser.open(run / "report.html", width, height)

    def at_peace(self, run):
        said, asked = self.browser.complaints()
        self.assertEqual(said, [])
        self.assertEqual(asked, [(run / "report.html").as_uri()])

    def inked(self):
        """How much of the canvas is not white, as the browser paints it, and what it shows, as a digest."""
        box = self.browser.do("(() => { const b = document.getElementById('tissue').getBoundingClientRect(); return [b.left, b.top, b.width, b.height]; })()")
        x, y, width, height = box
        clip = {"x": x, "y": y + self.browser.do("window.scrollY"), "width": width, "height": height, "scale": 1}
        return hashlib.sha256(base64.b64decode(self.browser.ask("Page.captureScreenshot", format="png", clip=clip)["data"])).hexdigest()

    def frame(self):
        self.browser.do("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")

    def test_every_kind_of_run_is_shown_without_a_complaint_or_a_request(self):
        for run in (Runs.found(), Runs.two(), Runs.nothing(), Runs.dome(), Runs.interrupted()):
            for width in (1400, 400):
                self.open(run, width)
                self.assertEqual(self.browser.do("document.documentElement.dataset.ready"), "yes", run)
                self.at_peace(run)
                self.assertEqual(self.browser.do("document.querySelectorAll('.viewer, .pictures').length"), 2)
                self.assertLessEqual(self.browser.do("document.documentElement.scrollWidth"), width, run)
                self.assertEqual(self.browser.do("getComputedStyle(document.querySelector('.pictures')).display"), "none")

    def test_a_click_tells_the_values_of_the_surface(self):
        run = Runs.found()
        self.open(run)
        self.browser.do("document.getElementById('show-touches').click()")
        tables = Runs.folder / "tables"
        self.assertEqual(palpate("export", run, "--for", "csv", "--out", tables).returncode, 0)  # of surface.vtp
        columns = {"mean": "mean [N/mm]", "stddev": "stddev [N/mm]", "probability_inside": "probability_inside"}
        values = {name: [float(row[column]) for row in rows_of(tables / "tissue.csv")] for name, column in columns.items()}
        x, y, width, height = self.browser.do("(() => { const b = document.getElementById('tissue').getBoundingClientRect(); return [b.left, b.top, b.width, b.height]; })()")
        seen = set()
        for across, down in ((0.5, 0.5), (0.45, 0.6), (0.55, 0.3)):
            self.browser.click(x + across * width, y + down * height)
            self.frame()
            told = self.browser.do("({...document.getElementById('picked').dataset})")
            vertex = int(told["vertex"])
            seen.add(vertex)
            for name, key in (("mean", "mean"), ("stddev", "stddev"), ("probability_inside", "probability")):
                self.assertAlmostEqual(float(told[key]), values[name][vertex], delta=1e-6 * (1 + abs(values[name][vertex])))  # single precision
            # The window's middle is the tissue's, up is y, and a pixel is what the scale bar says.
            mm_each = self.browser.do("parseFloat(document.getElementById('scale-words').textContent) / parseFloat(document.getElementById('scale-line').style.width)")
            place = (12 + (across - 0.5) * width * mm_each, 15 - (down - 0.5) * height * mm_each)
            at_vertex = (24 * (vertex % 41) / 40, 30 * (vertex // 41) / 50)
            self.assertLess(max(abs(a - b) for a, b in zip(place, at_vertex)), 0.5)
        self.assertEqual(len(seen), 3)
        self.at_peace(run)

    def test_the_slider_the_switches_and_the_keys_change_what_is_shown(self):
        run = Runs.found()
        self.open(run)
        seen = {self.inked()}
        for code in ("document.querySelector('input[value=stddev]').click()", "document.querySelector('input[value=probability_inside]').click()",
                     "document.getElementById('show-band').click()", "document.getElementById('show-cut').click()",
                     "document.getElementById('show-tour').click()", "document.getElementById('show-touches').click()",
                     "(() => { const b = document.getElementById('batch'); b.value = 1; b.dispatchEvent(new Event('input')); })()",
                     "document.getElementById('closer').click()"):
            self.browser.do(code)
            self.frame()
            now = self.inked()
            self.assertNotIn(now, seen, code)
            seen.add(now)
        self.assertEqual(self.browser.do("document.getElementById('batch-words').textContent"), "After batch 1: 26 readings")
        self.browser.do("document.getElementById('tissue').focus()")
        for key in ("ArrowLeft", "]", "0"):
            self.browser.key(key)
            self.frame()
            now = self.inked()
            self.assertNotIn(now, seen, key)
            seen.add(now)
        self.at_peace(run)

    def test_a_row_of_the_table_shows_its_touch(self):
        run = Runs.found()
        self.open(run)
        before = self.inked()
        self.browser.do("document.querySelectorAll('button.show-touch')[6].click()")
        self.frame()
        self.assertEqual(self.browser.do("document.getElementById('picked').dataset.touch"), "7")
        self.assertEqual(self.browser.do("document.querySelector('tr.chosen').id"), "reading-7")
        self.assertNotEqual(self.inked(), before)

    def test_forty_thousand_vertices_take_less_than_five_megabytes_and_two_seconds(self):
        run = Runs.simulated("large", {**SCENE, "surface": {"plane": {"size_mm": [25, 50], "vertices": [200, 200]}}, "plan": {"batches": 9}})
        self.assertLess((run / "report.html").stat().st_size, 5e6)
        self.browser.ask("Performance.enable", timeDomain="threadTicks")  # the page's own work, however busy the machine is
        try:
            self.open(run)
            self.assertEqual(self.browser.do("document.documentElement.dataset.ready"), "yes")
            told = {one["name"]: one["value"] for one in self.browser.ask("Performance.getMetrics")["metrics"]}
        finally:
            self.browser.ask("Performance.disable")
        self.assertGreater(told["TaskDuration"], 0.01)
        self.assertLess(told["TaskDuration"], 2.0)
        self.at_peace(run)

    def test_hostile_names_do_nothing(self):
        Page("test_hostile_names_are_shown_and_do_nothing").test_hostile_names_are_shown_and_do_nothing()
        run = Runs.folder / "hostile" / "run"
        self.open(run)
        self.at_peace(run)
        self.assertNotEqual(self.browser.do("document.title"), "caught")
        self.assertEqual(self.browser.do("document.documentElement.dataset.ready"), "yes")

    def test_without_webgl_the_pictures_are_shown(self):
        without = Chromium("--disable-gpu", "--disable-3d-apis", "--disable-software-rasterizer")
        try:
            run = Runs.found()
            page_of(run)
            without.open(run / "report.html")
            said, asked = without.complaints()
            self.assertEqual((said, asked), ([], [(run / "report.html").as_uri()]))
            self.assertEqual(without.do("getComputedStyle(document.querySelector('.viewer')).display"), "none")
            self.assertEqual(without.do("getComputedStyle(document.querySelector('.pictures')).display"), "block")
            self.assertFalse(without.do("document.getElementById('no-3d').hidden"))
            if (run / "picture.png").exists():
                self.assertEqual(without.do("[...document.images].map((image) => image.naturalWidth > 0)"), [True, True])
        finally:
            without.close()


if __name__ == "__main__":
    if CHROMIUM is None:
        print("skipped: no Chromium is installed, so no page is looked at", file=sys.stderr)
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
