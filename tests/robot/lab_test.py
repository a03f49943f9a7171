#!/usr/bin/env python3
"""examples/lab/run, quick: from a log to a report, over a driver that was killed, over ROS where it is installed.

usage: lab_test.py PALPATE PROJECT_ROOT        ends with 77 (ctest: skipped) where examples/lab/run cannot run
"""

import json
import pathlib
import subprocess
import sys
import tempfile

PALPATE, ROOT = (pathlib.Path(word).resolve() for word in sys.argv[1:3])

with tempfile.TemporaryDirectory() as folder:
    out = pathlib.Path(folder) / "lab"
    done = subprocess.run([ROOT / "examples" / "lab" / "run", "--palpate", PALPATE, "--out", out, "--quick"], capture_output=True, text=True)
    print(done.stdout + done.stderr)
    if done.returncode != 0:
        sys.exit(done.returncode)
    assert "The driver was killed in the middle of a plan" in done.stdout
    summary = json.loads((out / "result" / "summary.json").read_text(encoding="utf-8"))
    entries = [json.loads(line[17:]) for line in (out / "session" / "journal.jsonl").read_text(encoding="utf-8").splitlines()]
    rows = [entry for entry in entries if entry["kind"] == "reading"]
    assert len(rows) == 121 + 8, len(rows)  # those of the log, and one plan: none lost, none taken twice
    assert len({tuple(row["place"]) for row in rows}) == len(rows)
    assert len(summary["parts"]) == 1 and 95 < summary["area_mm2"] < 130, summary["area_mm2"]  # a disk of 6 mm: 113
    assert (out / "result" / "report.html").stat().st_size > 100_000
