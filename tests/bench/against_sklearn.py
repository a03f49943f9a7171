#!/usr/bin/python3
"""Planning by palpation against scikit-learn doing the same, side by side on one core, in interleaved rounds.

    cmake --build build/release --target bench_against_sklearn && tests/bench/against_sklearn.py build/release/bin/bench_against_sklearn

Needs Debian's python3-sklearn and libopenblas0; says which BLAS is active. About five minutes; --rounds, --quick (no whole run, no million
vertices). CPU seconds of one pinned thread on both sides; ratios are taken inside a round, and the table has their median and range.

The work: 40,000 vertices of a jittered plane, 25 x 50 mm, squared exponential of 3.3 mm, signal 1, noise variance 1e-4, zero mean, n
readings. An iteration: ten readings come in, then ten places are chosen by 0.5 sd - 0.5 |mean - level|, each pending place taken to be read
at its predicted mean. scikit-learn fits and predicts anew for each of the ten. Both sides must agree to 1e-8 and choose the same places.
"""
import argparse
import os
import subprocess
import sys
import tempfile
import time
import warnings

os.environ.update(OPENBLAS_NUM_THREADS="1", OMP_NUM_THREADS="1")
# OpenBLAS 0.3.21 takes processors that are newer than it for very old ones: tell it what they can do, or its side would not be fair.
with open("/proc/cpuinfo") as cpu:
    flags = cpu.read()
if "OPENBLAS_CORETYPE" not in os.environ and " avx2 " in flags:
    os.environ["OPENBLAS_CORETYPE"] = "SkylakeX" if " avx512dq " in flags and "GenuineIntel" in flags else "Haswell" if "GenuineIntel" in flags else "Zen"
import numpy as np  # noqa: E402
import sklearn  # noqa: E402
from sklearn.gaussian_process import GaussianProcessRegressor  # noqa: E402
from sklearn.gaussian_process.kernels import RBF, ConstantKernel, WhiteKernel  # noqa: E402

LENGTH_M, NOISE_VARIANCE, LEVEL, BATCH, INITIAL, MOST = 0.0033, 1e-4, 0.5, 10, 5, 2005
START = 0.005, 2.0, 0.05  # of learning: length in metres, standard deviations of signal and noise
warnings.filterwarnings("ignore")


class Ours:
    """The other side of the pipe."""

    def __init__(self, program, cores):
        self.process = subprocess.Popen([program], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
                                        preexec_fn=lambda: os.sched_setaffinity(0, cores))

    def ask(self, *words):
        print(*words, file=self.process.stdin, flush=True)
        answer = self.process.stdout.readline().split()
        if not answer:
            sys.exit(f"no answer to {words}")
        return [float(word) for word in answer]

    def batch(self, *words):
        """Seconds, evaluations, places."""
        seconds, evaluations, *places = self.ask(*words)
        return seconds, evaluations, [int(place) for place in places]

    def close(self):
        self.process.stdin.close()
        self.process.wait()


class Scene:
    def __init__(self, ours, side, folder, readings=MOST):
        path = os.path.join(folder, "scene")
        ours.ask("scene", side, readings, path)
        values, n = np.fromfile(path), side * side
        self.uv = values[:2 * n].reshape(n, 2)
        self.felt = values[2 * n:3 * n]
        self.touched = values[3 * n:].astype(int)


def fitted(places, readings):
    kernel = ConstantKernel(1.0, "fixed") * RBF(LENGTH_M, "fixed")
    return GaussianProcessRegressor(kernel, alpha=NOISE_VARIANCE, optimizer=None).fit(places, readings)


def choose(scene, touched):
    """The next ten places; and mean and sd at the first of them."""
    places, readings = scene.uv[touched], scene.felt[touched]
    picks, first = [], None
    for _ in range(BATCH):
        mean, sd = fitted(places, readings).predict(scene.uv, return_std=True)
        if first is None:
            first = mean, sd
        pick = int(np.argmax(0.5 * sd - 0.5 * np.abs(mean - LEVEL)))
        picks.append(pick)
        places, readings = np.vstack([places, scene.uv[pick]]), np.append(readings, mean[pick])
    return picks, first


def learned(places, readings):
    """Length, signal and noise by scikit-learn's own L-BFGS-B from START, no restarts."""
    length_m, signal_sd, noise_sd = START
    kernel = ConstantKernel(signal_sd**2, (1e-6, 1e6)) * RBF(length_m, (1e-5, 1.0)) + WhiteKernel(noise_sd**2, (1e-12, 1e2))
    return GaussianProcessRegressor(kernel, alpha=0.0).fit(places, readings)


def timed(function, *arguments):
    start = time.process_time()
    result = function(*arguments)
    return time.process_time() - start, result


def dgemm_rate():
    a, b = np.ones((1500, 1500)), np.ones((1500, 1500))
    return max(2.0 * 1500**3 / timed(np.matmul, a, b)[0] for _ in range(8))


class Table:
    def __init__(self):
        print(f"{'':46s} {'ours, ms':>9s} {'theirs, ms':>10s} {'ratio (range)':>24s} {'must':>8s}  {'floor, ms':>9s} {'of floor':>8s}")

    def row(self, name, ours, theirs, must, floor=None):
        ratios = np.array(theirs) / np.array(ours)
        spread = f"{np.median(ratios):.0f} ({ratios.min():.0f}-{ratios.max():.0f})" if ratios.min() >= 10 else \
            f"{np.median(ratios):.2f} ({ratios.min():.2f}-{ratios.max():.2f})"
        end = "" if floor is None else f"  {1e3 * floor:9.2f} {np.median(ours) / floor:7.2f}x"
        print(f"{name:46s} {1e3 * np.median(ours):9.2f} {1e3 * np.median(theirs):10.1f} {spread:>24s} {must:>8s}{end}", flush=True)


def agree(path, theirs, what):
    ours = np.fromfile(path).reshape(2, -1)
    errors = np.abs(ours[0] - theirs[0]).max(), np.abs(ours[1] - theirs[1]**2).max()
    if max(errors) > 1e-8:
        sys.exit(f"{what}: ours and scikit-learn's differ by {errors[0]:.1e} in mean, {errors[1]:.1e} in variance")
    return errors


def same(ours, theirs, what):
    if ours != theirs:
        sys.exit(f"{what}: not the same places: {ours} and {theirs}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--quick", action="store_true")
    options = parser.parse_args()
    core = {max(os.sched_getaffinity(0))}
    both = os.sched_getaffinity(0)
    os.sched_setaffinity(0, core)
    folder = tempfile.mkdtemp()
    dump = os.path.join(folder, "posterior")

    print(f"scikit-learn {sklearn.__version__}, numpy {np.__version__}")
    try:
        import threadpoolctl
        for pool in threadpoolctl.threadpool_info():
            print("BLAS:", pool.get("internal_api"), pool.get("version"), pool.get("architecture"), "threads", pool.get("num_threads"))
    except ImportError:
        print("BLAS:", os.path.realpath("/etc/alternatives/libblas.so.3-x86_64-linux-gnu"))

    ours = Ours(options.program, core)
    scene = Scene(ours, 200, folder)
    count = len(scene.felt)

    measured = []

    def limits():
        """Reads, dgemm and exponentials a second: measured again in every round, since other work on the machine slows them like us."""
        measured.append((ours.ask("bandwidth", 8 * 205 * count)[0], dgemm_rate(), ours.ask("exponentials")[0]))
    for _ in range(3):
        limits()

    def floor_of_update(n):
        bandwidth, flops, exponentials = np.median(measured, axis=0)
        return max(8 * (n - BATCH) * count / bandwidth, (2 * BATCH * n + 3 * BATCH) * count / flops + BATCH * count / exponentials)

    def floor_once(n):
        _, flops, exponentials = np.median(measured, axis=0)
        return n * n * count / flops + n * count / exponentials

    def evaluated_again(evaluations, batches):
        return (evaluations - batches * count) / (BATCH * batches * count)

    print()
    table = Table()
    theirs = {}
    for n, must, floor_must in ((205, "250", "1.5"), (105, "200", "1.8")):
        mine = {"grown": [], "cold": [], "foreseen": []}
        theirs[n] = []
        for _ in range(options.rounds):
            limits()
            seconds, (picks, first) = timed(choose, scene, scene.touched[:n])
            theirs[n].append(seconds)
            for how, times in mine.items():
                ours.ask("iterate", how, n)  # the second time nothing is new to the machine, as in a run
                seconds, _, places = ours.batch("iterate", how, n)
                times.append(seconds)
                same(places, picks, f"{how}, n = {n}")
                ours.ask("dump", dump)
                errors = agree(dump, first, f"{how}, n = {n}")
        table.row(f"planning iteration, n = {n}", mine["grown"], theirs[n], must, floor_of_update(n))
        table.row(f"the same, nothing kept (cold), n = {n}", mine["cold"], theirs[n], "30" if n == 205 else "", floor_once(n))
        table.row(f"last reading to next plan, foreseen, n = {n}", mine["foreseen"], theirs[n], "800" if n == 205 else "")
        print(f"    agreement: mean {errors[0]:.0e}, variance {errors[1]:.0e}; the same 10 places")

    lazy, exhaustive = [], []
    for _ in range(options.rounds):
        seconds, _, some = ours.batch("greedy", "lazy", 205)
        lazy.append(seconds)
        seconds, _, all_of_them = ours.batch("greedy", "exhaustive", 205)
        exhaustive.append(seconds)
        same(some, all_of_them, "lazy")
    table.row("batch of ten, lazy against every vertex, n = 205", lazy, exhaustive, "20")

    mine, others = [], []
    for _ in range(options.rounds):
        seconds, model = timed(learned, scene.uv[scene.touched[:205]], scene.felt[scene.touched[:205]])
        others.append(seconds)
        seconds, likelihood, length_m, signal_sd, noise_sd = ours.ask("learn", 205, *START)
        mine.append(seconds)
        at_ours = model.log_marginal_likelihood(np.log([signal_sd**2, length_m, noise_sd**2]))
        least = model.log_marginal_likelihood_value_ - 1e-7 * abs(likelihood)
        if abs(likelihood - at_ours) > 1e-7 * abs(likelihood) or likelihood < least:
            sys.exit(f"learning: log likelihood {likelihood} of ours, {at_ours} by scikit-learn, whose own is {model.log_marginal_likelihood_value_}")
    table.row("learning three hyperparameters, n = 205", mine, others, "8")
    print(f"    log likelihood {likelihood:.9g}, theirs {model.log_marginal_likelihood_value_:.9g}; of the same values {at_ours - likelihood:+.0e}")

    for n in (15, 55, 105, 205, 505, 1005, 2005):
        mine, others = [], []
        for _ in range(options.rounds if n <= 505 else min(options.rounds, 3 if n <= 1005 else 2)):
            seconds, posterior = timed(lambda: fitted(scene.uv[scene.touched[:n]], scene.felt[scene.touched[:n]]).predict(
                scene.uv, return_std=True))
            others.append(seconds)
            mine.append(ours.ask("once", n, dump)[0])
            agree(dump, posterior, f"once, n = {n}")
        table.row(f"mean and variance once, n = {n}", mine, others, "2.7" if n == 205 else "1", floor_once(n))

    def threads_row():
        pair = Ours(options.program, both)
        pair.ask("scene", 200, 205)
        for step, must in (("build", "1.8"), ("update", "1.8")):
            times = {1: [], 2: []}
            for _ in range(max(15, options.rounds)):
                for count_of_threads in times:
                    times[count_of_threads].append(pair.ask("threads", count_of_threads, step, 205)[0])
            table.row(f"{step} on two threads against one (wall)", times[2], times[1], must)
        pair.close()
    threads_row()

    for how in ("keep", "once"):
        alone = Ours(options.program, core)
        alone.ask("scene", 200, 205)
        grown, peak = alone.ask("memory", how, 205)
        alone.close()
        print(f"memory, n = 205, {how}: {grown:.0f} MB more than the tissue itself, {peak:.0f} MB in all (V: {8e-6 * 205 * count:.0f} MB)")

    bandwidth, flops, exponentials = np.median(measured, axis=0)
    print(f"this core, median over the rounds: reads {1e-9 * bandwidth:.1f} GB/s, dgemm {1e-9 * flops:.1f} Gflop/s,"
          f" {1e-9 * exponentials:.2f} G exponentials/s")
    if options.quick:
        return
    million = {}
    for how in ("keep", "once"):
        alone = Ours(options.program, core)
        alone.ask("scene", 1000, 205)
        million[how] = alone.ask("memory", how, 205)
        print(f"memory, a million vertices, {how}: {million[how][0]:.0f} MB more than the tissue itself, {million[how][1]:.0f} MB in all"
              f" (V: {8 * 205:.0f} MB)")
        if how == "keep":
            times = [alone.batch("iterate", "grown", 205)[0] for _ in range(options.rounds + 1)][1:]
            table.row("iteration, a million vertices; theirs: 25 x P1", times, [25 * t for t in theirs[205][:len(times)]], "300",
                      25 * floor_of_update(205))
        alone.close()

    mine, others = [], []
    for _ in range(options.rounds):
        seconds, evaluations, places = ours.batch("run", 20)
        mine.append(seconds)
        touched, total = list(scene.touched[:INITIAL]), 0.0
        for batch in range(20):
            seconds, (picks, _) = timed(choose, scene, touched)
            total += seconds
            same(places[BATCH * batch:BATCH * (batch + 1)], picks, f"batch {batch} of the run")
            touched += picks
        others.append(total)
    table.row("whole run, 5 to 205 readings in 20 batches", mine, others, "200")
    print(f"    the same 200 places; looked at again: {100 * evaluated_again(evaluations, 20):.2f} % of what every vertex for every pick is")


if __name__ == "__main__":
    main()
