#!/usr/bin/env python3
"""Runs the comparisons with other programs, and writes their tables into docs/performance.md.

BUILD is a build folder of the preset bench. Without TABLE all tables are made. A table stands between the lines
"<!-- table: NAME -->" and "<!-- end -->". Times are CPU times of one thread.

| table | peer | where it comes from |
|---|---|---|
| numbers | GSL, OpenQMC | libgsl-dev; cmake --preset bench -DOPENQMC_INCLUDE_DIR=FOLDER |
| rays | Embree 3 | libembree-dev |
| seconds | GSL | libgsl-dev; also writes notebooks-data/truth/seconds.csv |
| python, scipy | C++, SciPy | python3-scipy; also writes notebooks-data/python/overhead.csv |
| default | our own options | |
| lajolla | lajolla | --lajolla FOLDER, a copy of its repository in which it was built as build/lajolla |

A peer that is absent is named, and its rows or its table are left out.
"""

import argparse
import csv
import functools
import glob
import io
import math
import os
import re
import resource
import statistics
import subprocess
import sys
import tempfile

try:
    import numpy
except ImportError:
    numpy = None

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
PAGE = os.path.join(ROOT, "docs", "performance.md")
DATA = os.path.join(ROOT, "notebooks-data")
SCENES = "cbox smallpt book1-cover book3-cornell-glass veach-mi materials metals mesh-formats".split()
# Scenes of lajolla's repository: file, width, height.
LAJOLLA_SCENES = [
    ("cbox/cbox.xml", 256, 256),
    ("sponza/sponza.xml", 128, 96),
    ("matpreview/matpreview.xml", 128, 128),
    ("veach_mi/mi.xml", 192, 128),
]


def absent(table, peer, what):
    print(f"{table}: {peer} is absent; {what}", file=sys.stderr)


def program(options, *name):
    """Path of a program of the build."""
    path = os.path.join(options.build, *name)
    if not os.path.exists(path):
        sys.exit(f"{path} is missing; configure with --preset bench, and build")
    return path


def run(path, *arguments):
    return subprocess.run([path, *arguments], cwd=ROOT, capture_output=True, text=True, check=True).stdout


def numbers(options):
    """Times of random numbers and points."""
    names = "^normal|^exponential|Sobol 4-D|Halton dims 0"
    text = run(program(options, "bench", "bench_speed"), f"--benchmark_filter={names}")
    for peer in "GSL", "OpenQMC":
        if peer not in text:
            absent("numbers", peer, "its rows are left out")
    yield ["number", "ns", "ns in batches"]
    for line in text.splitlines()[1:-1]:
        name, figures = line[:44].strip(), line[44:].split()
        has_aim = len(figures) in (3, 5)
        batch = figures[3 if has_aim else 2] if len(figures) > 3 else ""
        yield [name, figures[0], batch]


def rays(options):
    """Our rays beside Embree's."""
    path = os.path.join(options.build, "bench", "bench_render_accel_bvh")
    if not os.path.exists(path):
        absent("rays", "Embree", "the table is left out")
        return
    yield ["world", "rays", "Mrays/s", "over Embree", "hits", "Embree's hits"]
    for line in run(path).splitlines():
        row = re.match(r"(.{16}) (primary|bounce|shadow) +([\d.]+) +([\d.]+) +([\d.]+) +([\d.]+)", line)
        if row:
            yield [column.strip() for column in row.groups()]


def seconds(options):
    """CPU time of integrals to an error, beside GSL: the least of each kind of method."""
    path = os.path.join(options.build, "bench", "bench_mc_estimate_seconds")
    if not os.path.exists(path):
        absent("seconds", "GSL", "the table is left out")
        return
    text = run(path, "6")
    with open(os.path.join(DATA, "truth", "seconds.csv"), "w") as file:
        file.write(text)
    kinds = {"auto": 0, "sobol_unscrambled": 2} | dict.fromkeys(
        ["gsl_plain", "gsl_miser", "gsl_vegas", "gsl_vegas_warm", "sobol_shifted"], 1
    )
    least = {}
    for row in csv.reader(line for line in text.splitlines() if line[0] != "#"):
        if row[2] in kinds:
            times = least.setdefault(row[0], [math.inf] * 6)
            for column in 0, 1:
                i = kinds[row[2]] + 3 * column
                times[i] = min(times[i], float(row[3 + column]))
    yield ["integrand", "`auto`, 1e-3", "peer", "Sobol'", "`auto`, 1e-4", "peer", "Sobol'"]
    for name, times in least.items():
        yield [name, *("-" if math.isinf(t) else f"{t:.3g}" for t in times)]


@functools.cache
def overhead(build):
    """Rows of bench/python/overhead.py; none where it fails."""
    command = [sys.executable, os.path.join(ROOT, "bench", "python", "overhead.py")]
    command += [os.path.join(build, *name) for name in (("bench", "bench_python_batch"), ("tools", "carlo"))]
    paths = [os.path.join(build, "python"), os.environ.get("PYTHONPATH", "")]
    environment = dict(os.environ, PYTHONPATH=os.pathsep.join(filter(None, paths)))
    result = subprocess.run(command, env=environment, capture_output=True, text=True)
    if result.returncode:
        print("python, scipy: left out, since overhead.py failed:", *result.stderr.splitlines()[-1:], file=sys.stderr)
        return []
    with open(os.path.join(DATA, "python", "overhead.csv"), "w") as file:
        file.write(result.stdout)
    return list(csv.DictReader(io.StringIO(result.stdout)))


def python(options):
    """Calls from Python with an array for the results, over those of C++."""
    rows = [row for row in overhead(options.build) if row["against"] == "C++ batch"]
    yield ["call", "warps", "median ratio", "number of ratios up to 1.5", "largest ratio"]
    for call, pattern in (
        ("`sample(u)`", r"(\w+)\(?.*\.sample\(.., out=x\)"),
        ("`pdf(x)`", r"(\w+)\(?.*\.pdf\(.., out=x\)"),
        ("`invert(x)`", r"(\w+)\(?.*\.invert\(.., out=x\)"),
        ("`sample_index(u)`, without `out`", r"(\w+)\(?.*\.sample_index\(..\)"),
    ):
        of = [(float(row["ratio"]), match[1]) for row in rows if (match := re.fullmatch(pattern, row["what"]))]
        if of:
            ratios, (most, name) = [ratio for ratio, _ in of], max(of)
            below = sum(ratio <= 1.5 for ratio in ratios)
            yield [call, str(len(of)), f"{statistics.median(ratios):.2f}", str(below), f"{most:.1f}: `{name}`"]


def scipy(options):
    """Points and integrals from Python, beside SciPy and carlo."""

    def time(ns):
        return f"{float(ns) / 1e6:.3g} ms" if float(ns) >= 1e6 else f"{float(ns):.3g} ns"

    yield ["work", "libmc in Python", "compared with", "its time", "ratio"]
    for row in overhead(options.build):
        if row["against"] != "C++ batch":
            yield [row["what"], time(row["ns"]), row["against"], time(row["ns_against"]), row["ratio"]]


def default(options):
    """What a render without options gains over even sampling."""
    scenes = [os.path.join(ROOT, "librender", "scenes", name + ".xml") for name in SCENES]
    text = run(program(options, "bench", "bench_render_adaptive"), *scenes, "--", "8", "48", "64", "2048")
    rows = {}
    for row in csv.DictReader(io.StringIO(text)):
        rows.setdefault(row["scene"], {})[row["spending"]] = row
    ways = ["adaptive", "tiles", "splat", "default"]
    yield ["scene", *ways]
    for scene, of in rows.items():
        yield [scene, *(f"{of[way]['gain']} +- {of[way]['gain_error']}" for way in ways)]


def read_pfm(path):
    with open(path, "rb") as file:
        file.readline()
        width, height = map(int, file.readline().split())
        scale = float(file.readline())
        return numpy.frombuffer(file.read(), "<f4" if scale < 0 else ">f4").reshape(height, width, 3).astype(float)


def timed(command, folder):
    """User CPU seconds of a command."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    result = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    if result.returncode:
        sys.exit(f"{' '.join(command)}: {result.stderr.strip()}")
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def scene_folder(scene, folder, width, height, samples):
    """A folder like that of the scene, whose film and sampler are as given."""
    with open(scene) as file:
        text = file.read()
    for name, value in ("sampleCount", samples), ("width", width), ("height", height):
        text, found = re.subn(rf'(<integer name="{name}" value=")[^"]*', rf"\g<1>{value}", text)
        if not found:
            sys.exit(f"{scene}: has no {name}")
    for path in glob.glob(os.path.join(os.path.dirname(scene), "*")):
        link = os.path.join(folder, os.path.basename(path))
        if path != scene and not os.path.lexists(link):
            os.symlink(path, link)
    path = os.path.join(folder, os.path.basename(scene))
    with open(path, "w") as file:
        file.write(text)
    return path


def lajolla(options):
    """Relative variance times CPU seconds of a picture, beside lajolla's."""
    peer = options.lajolla and os.path.join(os.path.abspath(options.lajolla), "build", "lajolla")
    if not peer or not os.path.exists(peer):
        absent("lajolla", "lajolla", "the table is left out")
        return
    if not numpy:
        absent("lajolla", "NumPy", "the table is left out")
        return
    carlo = program(options, "tools", "carlo")
    yield ["scene", "samples a pixel", "lajolla: variance x s", "`carlo`", "ratio", "mean over lajolla's"]
    for file, width, height in LAJOLLA_SCENES:
        scene = os.path.join(os.path.abspath(options.lajolla), "scenes", file)
        name = os.path.splitext(os.path.basename(scene))[0]
        for samples in 64, 256:
            times, pictures = ([], []), ([], [])  # lajolla's and ours
            with tempfile.TemporaryDirectory() as folder:
                for i in range(4):  # in turn
                    # lajolla has no seed. Another number of samples takes other random numbers for nearly all pixels.
                    copy = scene_folder(scene, folder, width, height, samples + i)
                    times[0].append(timed([peer, "-t", "1", "-o", "a.pfm", copy], folder))
                    pictures[0].append(read_pfm(os.path.join(folder, "a.pfm"))[::-1])  # its first row is the top
                    command = [carlo, "render", copy, "--dialect", "lajolla", "-o", "b.pfm", "--threads", "1"]
                    times[1].append(timed([*command, "--spp", str(samples + i), "--seed", str(i)], folder))
                    pictures[1].append(read_pfm(os.path.join(folder, "b.pfm")))
            square = numpy.mean(pictures, axis=(0, 1)) ** 2 + 0.01
            theirs, ours = (
                numpy.mean(numpy.var(p, axis=0, ddof=1) / square) * statistics.median(t) for p, t in zip(pictures, times)
            )
            mean = numpy.mean(pictures[1]) / numpy.mean(pictures[0])
            yield [name, str(samples), f"{theirs:.3g}", f"{ours:.3g}", f"{ours / theirs:.2f}", f"{mean:.3f}"]


TABLES = {f.__name__: f for f in (numbers, rays, seconds, python, scipy, default, lajolla)}


def write(name, rows):
    with open(PAGE) as file:
        page = file.read()
    begin, end = f"<!-- table: {name} -->\n", "<!-- end -->"
    start = page.index(begin) + len(begin)
    rows = [rows[0], ["---"] * len(rows[0]), *rows[1:]]
    table = "".join("| " + " | ".join(row) + " |\n" for row in rows)
    page = page[:start] + table + page[page.index(end, start):]
    with open(PAGE, "w") as file:
        file.write(page)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", metavar="BUILD")
    parser.add_argument("tables", metavar="TABLE", nargs="*")
    parser.add_argument("--lajolla", metavar="FOLDER")
    arguments = parser.parse_args()
    arguments.build = os.path.abspath(arguments.build)
    for name in arguments.tables:
        if name not in TABLES:
            parser.error(f"no table {name}; use {', '.join(TABLES)}")
    for name in arguments.tables or TABLES:
        rows = list(TABLES[name](arguments))
        if len(rows) > 1:
            write(name, rows)
            print(f"{name}: {len(rows) - 1} rows", flush=True)
