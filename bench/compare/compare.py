#!/usr/bin/env python3
"""Runs the comparisons with other programs, and writes their tables into docs/performance.md.

Usage: bench/compare/compare.py BUILD [TABLE...]

BUILD is a build folder of the preset bench. TABLE is numbers, rays or default; without it all are run. A table stands
between the lines "<!-- table: NAME -->" and "<!-- end -->". Peers are packages: GSL (libgsl-dev) for `numbers` and
Embree (libembree-dev) for `rays`. A table without its peer has our rows only, or is skipped; both are said.
All times are user CPU times of one thread.
"""

import csv
import io
import os
import re
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
PAGE = os.path.join(ROOT, "docs", "performance.md")
SCENES = "cbox smallpt book1-cover book3-cornell-glass veach-mi materials metals mesh-formats".split()


def run(build, program, *arguments, folder=ROOT):
    path = os.path.join(build, "bench", program)
    if not os.path.exists(path):
        return None
    return subprocess.run([path, *arguments], cwd=folder, capture_output=True, text=True, check=True).stdout


def numbers(build):
    """Times of random numbers and points: bench_speed."""
    text = run(build, "bench_speed", "--benchmark_filter=^normal|^exponential|Sobol 4-D|Halton dims 0")
    if "GSL" not in text:
        print("numbers: GSL is absent; its rows are left out", file=sys.stderr)
    yield ["number", "ns", "ns in batches"]
    yield ["---"] * 3
    for line in text.splitlines()[1:-1]:
        name, figures = line[:44].strip(), line[44:].split()
        has_aim = len(figures) in (3, 5)
        batch = figures[3 if has_aim else 2] if len(figures) > 3 else ""
        yield [name, figures[0], batch]


def rays(build):
    """Our rays beside Embree's: bench_render_accel_bvh."""
    text = run(build, "bench_render_accel_bvh")
    if text is None:
        print("rays: Embree is absent; the table is skipped", file=sys.stderr)
        return
    yield ["world", "rays", "Mrays/s", "over Embree", "hits", "Embree's hits"]
    yield ["---"] * 6
    for line in text.splitlines():
        row = re.match(r"(.{16}) (primary|bounce|shadow) +([\d.]+) +([\d.]+) +([\d.]+) +([\d.]+)", line)
        if row:
            yield [column.strip() for column in row.groups()]


def default(build):
    """What a render without options gains over even sampling: bench_render_adaptive."""
    scenes = [os.path.join(ROOT, "librender", "scenes", name + ".xml") for name in SCENES]
    text = run(build, "bench_render_adaptive", *scenes, "--", "8", "48", "64", "2048")
    rows = {}
    for row in csv.DictReader(io.StringIO(text)):
        rows.setdefault(row["scene"], {})[row["spending"]] = row
    ways = ["adaptive", "tiles", "splat", "default"]
    yield ["scene", *ways]
    yield ["---"] * (1 + len(ways))
    for scene, of in rows.items():
        yield [scene, *(f"{of[way]['gain']} +- {of[way]['gain_error']}" for way in ways)]


TABLES = {"numbers": numbers, "rays": rays, "default": default}


def write(name, rows):
    with open(PAGE) as file:
        page = file.read()
    begin, end = f"<!-- table: {name} -->\n", "<!-- end -->"
    start = page.index(begin) + len(begin)
    table = "".join("| " + " | ".join(row) + " |\n" for row in rows)
    page = page[:start] + table + page[page.index(end, start):]
    with open(PAGE, "w") as file:
        file.write(page)


if __name__ == "__main__":
    if len(sys.argv) < 2 or any(name not in TABLES for name in sys.argv[2:]):
        sys.exit(__doc__)
    for name in sys.argv[2:] or TABLES:
        rows = list(TABLES[name](os.path.abspath(sys.argv[1])))
        if rows:
            write(name, rows)
            print(f"{name}: {len(rows) - 2} rows")
