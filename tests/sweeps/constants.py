#!/usr/bin/env python3
"""What halving or doubling a constant does to the band, the error and what is said of it: a table, a constant a row.

Copies the source tree, changes one constant at a time, builds palpate there and runs one and the same set of worlds with it. Readings follow the plan: with constants
that no plan asks (those of src/certainty/outline_*) they are the same ones, with the others what is felt differs as well.

usage: constants.py WORK [--world NAME] [--trials N] [--first-seed N] [FILE:NAME ...]        needs Python 3, and what a build needs
FILE:NAME, such as src/certainty/outline_model.cpp:kLean, is a constant as it is defined there: `constexpr double kLean = 0.3;`, or a member with a default value;
without any, those of the list below. WORK keeps tree, build and rows: run again, it goes on where it was.
"""

import argparse
import csv
import pathlib
import re
import shutil
import statistics
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
COPIED = ("CMakeLists.txt", "CMakePresets.json", "src", "include", "meshes", "examples", "tests", "README.md", "LICENSE")
CONSTANTS = [
    f"src/certainty/outline_{name}"
    for name in ("start.cpp:kTurn", "model.cpp:kTurnLogSd", "model.cpp:kBendLogSd", "model.cpp:kSmooth", "model.cpp:kOfSides", "model.cpp:kSigmoidLogSd",
                 "model.cpp:kUnbentLogSd", "draws.cpp:kAlike",
                 "model.cpp:kBentLogSd", "model.cpp:kLean", "scatter.cpp:kGrowth", "start.cpp:kLearnedNoiseLogSd", "start.cpp:kGivenNoiseLogSd", "start.cpp:kWaves",
                 "start.cpp:kDrift", "start.cpp:kTilt", "residuals.cpp:kSdLogSd", "model.cpp:kWildReach", "cut.cpp:kRadius_m", "cut.cpp:kHalfLength_m",
                 "model.cpp:kPieceLogSd", "lines.h:kSpacing_m", "model.h:kLeastSizeLogSd", "model.cpp:kContrastLogSd")
] + [f"src/certainty/turn_law.cpp:{name}" for name in ("kCornersOfSmooth", "kCornersOfAngular", "kCornerBend", "kCorners", "kOfCorner")
     ] + [f"include/palpation/certainty/edge_belief.h:{name}" for name in ("slope_per_m", "slope_log_sd", "correction_sd_m", "correction_length_m")
     ] + ["include/palpation/belief/hyperparameters.h:length_median_m"]


def scaled(text, name, factor):
    """The text with the one constant of this name so many times as large; what it was."""
    defined = re.compile(rf"\b(double {name}\s*=\s*|{name}\s*=\s*)(-?[0-9.]+(?:e-?[0-9]+)?)(?=\s*[;,])")
    found = defined.search(text)
    if found is None:
        sys.exit(f"constants.py: no number is given to {name}")
    return text[:found.start(2)] + repr(float(found.group(2)) * factor) + text[found.end(2):], float(found.group(2))


def rows_of(work, name, arguments):
    """Of the tree as it stands: built and run once."""
    out = work / "rows" / name
    if not (out / "done").exists():
        shutil.rmtree(out, ignore_errors=True)
        subprocess.run([work / "tree/src/cmake/build", "ci", "palpate"], check=True, stdout=subprocess.DEVNULL)
        subprocess.run(
            [work / "tree/build/ci/bin/palpate", "experiment", "coverage", "--world", arguments.world, "--trials", str(arguments.trials),
             "--first-seed", str(arguments.first_seed), "--out", out, "--quiet"],
            check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        (out / "done").touch()
    with open(out / "rows.csv", encoding="utf-8", newline="") as table:
        return [row for row in csv.DictReader(table) if row["has_tumour"] == "1"]


def line_of(name, rows):
    covered = sum(row["covered"] == "1" for row in rows)
    errors = [float(row["error_mm2"]) / float(row["bound_mm2"]) for row in rows]
    truth = [float(row["error_mm2"]) / max(float(row["expected_error_mm2"]), 1e-9) for row in rows]
    widths = [float(row["half_width_mm"]) / float(row["bound_half_width_mm"]) for row in rows if row["half_width_mm"]]
    return (f"| {name} | {covered} of {len(rows)} | {statistics.median(errors):.2f} | {statistics.median(widths):.2f} | "
            f"{statistics.median(truth):.2f} ({sum(one > 2 for one in truth)}) |")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("work", type=pathlib.Path)
    parser.add_argument("constants", nargs="*")
    parser.add_argument("--world", default="shape")
    parser.add_argument("--trials", type=int, default=5)
    parser.add_argument("--first-seed", type=int, default=64000)
    arguments = parser.parse_intermixed_args()
    work = arguments.work.resolve()
    tree = work / "tree"
    for part in COPIED if not tree.exists() else ():
        source = ROOT / part
        if source.is_dir():
            shutil.copytree(source, tree / part, symlinks=True)
        elif source.exists():
            tree.mkdir(parents=True, exist_ok=True)
            shutil.copy2(source, tree / part)
    print("| constant | band holds | error over the bound's | half width over the bound's | true over expected (above 2) |")
    print("|---|---|---|---|---|")
    print(line_of("as they are", rows_of(work, "as-they-are", arguments)), flush=True)
    for constant in arguments.constants or CONSTANTS:
        path, name = constant.split(":")
        as_copied = work / "as-copied" / path  # what a run that was killed leaves in the tree is not
        if not as_copied.exists():
            as_copied.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(tree / path, as_copied)
        text = as_copied.read_text()
        for factor in (0.5, 2.0):
            changed, was = scaled(text, name, factor)
            (tree / path).write_text(changed)
            try:
                rows = rows_of(work, f"{pathlib.Path(path).stem}-{name}-{factor:g}", arguments)
            finally:
                (tree / path).write_text(text)
            print(line_of(f"{name}: {was * factor:g} for {was:g}", rows), flush=True)


if __name__ == "__main__":
    main()
