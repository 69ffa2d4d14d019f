#!/usr/bin/env python3
"""Overhead of the Python module, as CSV: warps against C++ batches, points against SciPy, integrals against carlo.

Usage: PYTHONPATH=build/bench/python bench/python/overhead.py build/bench/bench/bench_python_batch build/bench/tools/carlo
       [FILTER]: only rows of warps whose name contains it
Times are CPU times, user and system, per point. Every time is the shortest of several runs, in turn with the other
program.
"""

import csv
import json
import subprocess
import sys
import tempfile
import time

import numpy
from scipy.stats import qmc

import libmc

RUNS = 15
N = 1_000_000


def ns_of(f):
    start = time.process_time()
    f()
    return (time.process_time() - start) * 1e9 / N


def shortest(*functions):
    """Shortest CPU time of each [s], in turn."""
    best = [numpy.inf] * len(functions)
    for _ in range(RUNS):
        for i, f in enumerate(functions):
            best[i] = min(best[i], ns_of(f) * N * 1e-9)
    return best


class Batches:
    """The C++ program: ns(case, operation) runs one batch."""

    def __init__(self, bench):
        self.cases = [line.split("\t") for line in subprocess.check_output([bench, "--list"], text=True).splitlines()]
        self.process = subprocess.Popen([bench], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def ns(self, case, operation):
        self.process.stdin.write(f"{case}\t{operation}\n")
        self.process.stdin.flush()
        return float(self.process.stdout.readline())


def calls(warp, operation):
    """The operation with an array for the results, and without."""
    if operation == "sample_index":
        u = libmc.samplers.random(N, 1)[:, 0].copy()
        return None, lambda: warp.sample_index(u)
    u = libmc.samplers.random(N, warp.dim)
    u = u[:, 0].copy() if warp.dim == 1 else u
    argument = u if operation == "sample" else warp.sample(u)
    f = getattr(warp, operation)
    out = f(argument)
    return lambda: f(argument, out=out), lambda: f(argument)


def warps(bench, only):
    batches = Batches(bench)
    names = {**vars(libmc.warps), "numpy": numpy}
    for case, operation in batches.cases:
        if only not in f"{case}.{operation}":
            continue
        into, fresh = calls(eval(case, names), operation)
        best = [numpy.inf] * 3
        for _ in range(RUNS):
            best[0] = min(best[0], batches.ns(case, operation))
            best[1] = min(best[1], ns_of(into) if into else numpy.inf)
            best[2] = min(best[2], ns_of(fresh))
        if into:
            yield f"{case}.{operation}(.., out=x)", "C++ batch", best[1], best[0]
        yield f"{case}.{operation}(..)", "C++ batch", best[2], best[0]


def points():
    n, d = 1 << 16, 8
    ours, theirs = shortest(lambda: libmc.samplers.sobol(n, d, 1), lambda: qmc.Sobol(d, seed=1).random(n))
    yield f"a point of `sobol({n}, {d}, seed)`", "`scipy.stats.qmc.Sobol`, scrambled", ours / n * 1e9, theirs / n * 1e9
    ours, theirs = shortest(lambda: libmc.samplers.halton(n, d, 1), lambda: qmc.Halton(d, seed=1).random(n))
    yield f"a point of `halton({n}, {d}, seed)`", "`scipy.stats.qmc.Halton`, scrambled", ours / n * 1e9, theirs / n * 1e9
    p = libmc.samplers.sobol(4096, 4)
    ours, theirs = shortest(lambda: libmc.points.centered_discrepancy(p), lambda: qmc.discrepancy(p))
    yield "`centered_discrepancy` of 4096 points", "`scipy.stats.qmc.discrepancy`", ours * 1e9, theirs * 1e9


def integrals(carlo):
    def f(x):
        return numpy.exp(-x[:, 0] ** 2) * numpy.cos(x[:, 1])

    n = 1 << 20
    options = {"rel_error": 0, "abs_error": 0, "max_calls": n, "method": "rqmc"}
    with tempfile.NamedTemporaryFile(suffix=".json") as file:
        command = [carlo, "integrate", "exp(-x*x)*cos(y)", "-d", "x=0:1,y=-1:2", "--rel-error", "0", "--method", "rqmc"]
        command += ["--max-calls", str(n), "--threads", "1", "--json", file.name]
        ours = theirs = numpy.inf
        for _ in range(RUNS):
            ours = min(ours, ns_of(lambda: libmc.integrate(f, [(0, 1), (-1, 2)], **options)) * N)
            subprocess.run(command, capture_output=True)
            theirs = min(theirs, json.load(open(file.name))["seconds"] * 1e9)
    yield "a call of `integrate` of a NumPy function", "`carlo integrate` of the expression, wall time", ours / n, theirs / n


def main(bench, carlo, only=""):
    out = csv.writer(sys.stdout, lineterminator="\n")
    out.writerow(["what", "against", "ns", "ns_against", "ratio"])
    for rows in (warps(bench, only),) if only else (warps(bench, ""), points(), integrals(carlo)):
        for what, against, ours, theirs in rows:
            out.writerow([what, against, f"{ours:.2f}", f"{theirs:.2f}", f"{ours / theirs:.2f}"])
            sys.stdout.flush()


if __name__ == "__main__":
    main(*sys.argv[1:])
