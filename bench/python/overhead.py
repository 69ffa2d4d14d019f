#!/usr/bin/env python3
"""Overhead of the Python module, as CSV: warps against C++ batches, points against SciPy, integrals against carlo.

Usage: PYTHONPATH=build/bench/python bench/python/overhead.py build/bench/bench/bench_python_batch build/bench/tools/carlo
Every time is the shortest of several runs, which alternate between the two programs.
"""

import csv
import io
import json
import subprocess
import sys
import tempfile
import time

import numpy as np
from scipy.stats import qmc

import libmc

RUNS = 15


def shortest(*functions):
    best = [np.inf] * len(functions)
    for _ in range(RUNS):
        for i, f in enumerate(functions):
            start = time.perf_counter()
            f()
            best[i] = min(best[i], time.perf_counter() - start)
    return best


def warps(bench):
    rows = {}
    for _ in range(3):
        for row in csv.DictReader(io.StringIO(subprocess.run([bench], capture_output=True, text=True).stdout)):
            rows[row["warp"]] = min(float(row["ns"]), rows.get(row["warp"], np.inf))
    n = 1_000_000
    for name, cpp in rows.items():
        warp = eval(name, vars(libmc.warps))
        u = libmc.samplers.random(n, warp.dim)
        out = warp.sample(u[:, 0] if warp.dim == 1 else u)
        u = u[:, 0].copy() if warp.dim == 1 else u
        into, fresh = shortest(lambda: warp.sample(u, out=out), lambda: warp.sample(u))
        yield f"{name}.sample(u, out=x)", "C++ sample_n", into / n * 1e9, cpp
        yield f"{name}.sample(u)", "C++ sample_n", fresh / n * 1e9, cpp


def points():
    n, d = 1 << 16, 8
    ours, theirs = shortest(lambda: libmc.samplers.sobol(n, d, 1), lambda: qmc.Sobol(d, seed=1).random(n))
    yield f"sobol({n}, {d}, seed)", "scipy.stats.qmc.Sobol, scrambled", ours / n * 1e9, theirs / n * 1e9
    ours, theirs = shortest(lambda: libmc.samplers.halton(n, d, 1), lambda: qmc.Halton(d, seed=1).random(n))
    yield f"halton({n}, {d}, seed)", "scipy.stats.qmc.Halton, scrambled", ours / n * 1e9, theirs / n * 1e9
    p = libmc.samplers.sobol(4096, 4)
    ours, theirs = shortest(lambda: libmc.points.centered_discrepancy(p), lambda: qmc.discrepancy(p))
    yield "centered_discrepancy, 4096 points", "scipy.stats.qmc.discrepancy", ours * 1e9, theirs * 1e9


def integrals(carlo):
    def f(x):
        return np.exp(-x[:, 0] ** 2) * np.cos(x[:, 1])

    calls = 1 << 20
    options = {"rel_error": 0, "abs_error": 0, "max_calls": calls, "method": "rqmc"}
    with tempfile.NamedTemporaryFile(suffix=".json") as file:
        command = [carlo, "integrate", "exp(-x*x)*cos(y)", "-d", "x=0:1,y=-1:2", "--rel-error", "0", "--method", "rqmc"]
        seconds = np.inf
        for _ in range(5):
            subprocess.run(command + ["--max-calls", str(calls), "--threads", "1", "--json", file.name], capture_output=True)
            seconds = min(seconds, json.load(open(file.name))["seconds"])
    ours = min(libmc.integrate(f, [(0, 1), (-1, 2)], **options).seconds for _ in range(5))
    yield "integrate(numpy function), one thread", "carlo integrate, one thread", ours / calls * 1e9, seconds / calls * 1e9


def main(bench, carlo):
    out = csv.writer(sys.stdout, lineterminator="\n")
    out.writerow(["what", "against", "ns", "ns_against", "ratio"])
    for rows in (warps(bench), points(), integrals(carlo)):
        for what, against, ours, theirs in rows:
            out.writerow([what, against, f"{ours:.2f}", f"{theirs:.2f}", f"{ours / theirs:.2f}"])
            sys.stdout.flush()


if __name__ == "__main__":
    main(*sys.argv[1:])
