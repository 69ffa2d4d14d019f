#!/usr/bin/env python3
"""Coverage of the intervals of integrate by method, from a file of bench_mc_estimate_truth."""

import csv
import sys

with open(sys.argv[1]) as file:
    rows = list(csv.DictReader(line for line in file if line[0] != "#"))
for row in rows:
    row.update({k: float(v) for k, v in row.items() if k not in ("class", "method")})
finite = [r for r in rows if not r["class"].endswith("infinite") and r["class"] != "needle"]
infinite = [r for r in rows if r["class"].endswith("infinite")]


def stated(row):
    return row["runs"] * (1 - row["unknown"] - row["flagged"])


print("method, share of stated intervals that hold for each wanted error, lowest class that holds or is named")
for method in dict.fromkeys(r["method"] for r in rows):
    shares = []
    for wanted in sorted({r["rel_error"] for r in rows}):
        own = [r for r in finite if r["method"] == method and r["rel_error"] == wanted]
        shares.append(sum(stated(r) * r["covered"] for r in own) / sum(stated(r) for r in own))
    lowest = [min(r["held"] for r in part if r["method"] == method) for part in (finite, infinite)]
    print(method, *(f"{100 * share:.1f} %" for share in shares + lowest), sep=", ")
called = max(finite, key=lambda r: r["infinite"])
print(f"called infinite: at most {100 * called['infinite']:.1f} % ({called['class']}, {called['method']})")
