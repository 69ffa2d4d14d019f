#!/usr/bin/env python3
"""What float costs in accuracy and double in time, as CSV.

Usage: bench/precision.py CARLO CARLO_IN_DOUBLE FOLDER [SCENE...]      (the presets release and double)

With scenes only their rows of scenes.csv are measured; the others stay.

  warps.csv   every case of `carlo validate --all`: the worst error of sample and pdf against 50 digits, in epsilons of
              the scalar, and nanoseconds a sample
  scenes.csv  every scene of the gallery, 8 seeds in turn: the median of CPU seconds in double over those in float, and
              the mean of the pictures' brightness in float over that in double with its standard error
"""
import csv
import json
import os
import re
import statistics
import subprocess
import sys
import tempfile

SEEDS, SIZE, SPP = 8, "48x36", "64"


def run(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def warps(carlo, scratch):
    path = os.path.join(scratch, "all.json")
    run(carlo, "validate", "--all", "--samples", "20000", "--json", path)
    with open(path) as file:
        cases = json.load(file)["cases"]
    found = {}
    for case in cases:
        checks = {check["name"]: check["statistic"] for check in case["checks"]}
        errors = [checks.get(f"{what} against 50 digits [eps]") for what in ("sample", "pdf")]
        if case["scalar"] in ("float", "double"):
            found.setdefault((case["name"], case["parameters"]), {})[case["scalar"]] = errors + [case["ns_per_sample"]]
    yield "warp parameters float_sample_eps float_pdf_eps float_ns double_sample_eps double_pdf_eps double_ns".split()
    for (name, parameters), by in found.items():
        if len(by) == 2 and by["float"][0] is not None:
            yield [name, parameters] + [f"{x:.3g}" for scalar in ("float", "double") for x in by[scalar]]


def seconds_of(carlo, scene, seed, picture):
    said = run(carlo, "render", scene, "-o", picture, "--size", SIZE, "--spp", SPP, "--seed", seed, "--threads", "1")
    value, unit = re.search(r"\(([0-9.]+) (ms|s|min) CPU\)", said).groups()
    return float(value) * {"ms": 1e-3, "s": 1, "min": 60}[unit]


def rows_of(path):
    with open(path, newline="") as file:
        return {row[0]: row for row in csv.reader(file)}


def scenes(carlo, in_double, scratch, known, wanted):
    yield "scene float_seconds double_over_float float_over_double_brightness its_error".split()
    a, b = os.path.join(scratch, "float.exr"), os.path.join(scratch, "double.exr")
    for line in run(carlo, "gallery", "--list").splitlines():
        scene = line.split()[0]
        if wanted and scene not in wanted:
            if scene in known:
                yield known[scene]
            continue
        times, slower, brighter = [], [], []
        for seed in map(str, range(SEEDS)):
            times.append(seconds_of(carlo, scene, seed, a))
            slower.append(seconds_of(in_double, scene, seed, b) / times[-1])
            brighter.append(float(run(carlo, "compare", a, b, "--metric", "mean_ratio").split()[-1]))
        error = statistics.stdev(brighter) / SEEDS**0.5
        yield [scene, f"{statistics.median(times):.3g}", f"{statistics.median(slower):.3g}",
               f"{statistics.mean(brighter):.6f}", f"{error:.1e}"]


def write(path, rows):
    with open(path, "w", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows(rows)


if __name__ == "__main__":
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    carlo, in_double, folder, *wanted = sys.argv[1:]
    os.makedirs(folder, exist_ok=True)
    table = os.path.join(folder, "scenes.csv")
    with tempfile.TemporaryDirectory() as scratch:
        if not wanted:
            write(os.path.join(folder, "warps.csv"), warps(carlo, scratch))
        write(table, list(scenes(carlo, in_double, scratch, rows_of(table) if wanted else {}, wanted)))
