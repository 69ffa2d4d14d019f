#!/usr/bin/env python3
"""The cheapest way to a wanted error of every scene file, as CSV.

Usage: bench/scene_trades.py CARLO SCENE.xml... > trades.csv

Costs are millions of rays, which are the same on every machine; errors are roots of relmse. Where no way came to the
error, `way` is the one that came nearest and `reached` its error. `as_good` are the ways that cannot be told from the
best. `gain` is the cost of plain Monte Carlo, independent paths that meet lights by chance, over that of the best; empty
where chance does not meet all lights. A scene whose pictures have no noise has one row: any way reaches any error.
"""
import csv
import json
import os
import subprocess
import sys
import tempfile

OPTIONS = "--cost rays --size 32x24 --max-spp 128 --samplers independent,sobol --error 0.2,0.1,0.05".split()


def rows(carlo, scene, folder):
    ran = subprocess.run([carlo, "trade", scene, *OPTIONS, "-o", folder], capture_output=True, text=True)
    name = os.path.splitext(os.path.basename(scene))[0]
    if "no picture has any noise" in ran.stderr:
        yield [name, 0, "any", *[""] * 9]
        return
    if ran.returncode not in (0, 1):
        print(ran.stderr.strip(), file=sys.stderr)
        return
    with open(os.path.join(folder, "trade.json")) as file:
        wanted = json.load(file)["errors"]
    for error in wanted:
        best = (error["offers"] or error["nearest"])[0]
        cost, reached = best["million_rays"], best["rms_error"]["value"] or best["rms_error"]["hi"]
        as_good = [offer["way"] for offer in error["offers"][1:error["as_good"]]]
        gain = error.get("gain_over_plain", {})
        yield [name, error["wanted"], best["way"], f"{best['n']:.3g}", f"{reached:.3g}",
               *(f"{cost[end]:.3g}" for end in ("value", "lo", "hi")),
               *(f"{gain[end]:.3g}" if gain else "" for end in ("value", "lo", "hi")), "; ".join(as_good)]


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    out = csv.writer(sys.stdout, lineterminator="\n")
    out.writerow("scene wanted way spp reached mrays mrays_lo mrays_hi gain gain_lo gain_hi as_good".split())
    for scene in sys.argv[2:]:
        with tempfile.TemporaryDirectory() as folder:
            out.writerows(rows(sys.argv[1], scene, folder))
        sys.stdout.flush()
