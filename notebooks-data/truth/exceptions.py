#!/usr/bin/env python3
"""Coverage of `carlo integrate` where its intervals are known to miss, as a table. carlo must be in the PATH."""

import json
import math
import subprocess

PEAKS = ["-d", "x=-inf:inf", "--peak", "x=1000 width 1", "--peak", "x=-500 width 1"]
CASES = [  # expression, arguments, exact value
    ("exp(y)*(x<0.2501)", ["-d", "x=0:1,y=0:1"], 0.2501 * (math.e - 1)),
    ("1/(x*log(x)^2)", ["-d", "x=0:0.5", "--max-calls", "1e5"], 1 / math.log(2)),
    ("x^-0.95", ["-d", "x=0:1", "--max-calls", "1e5"], 20),
    ("exp(-(x-1000)^2)+exp(-(x+500)^2)", PEAKS, 2 * math.sqrt(math.pi)),
    ("x^-0.48", ["-d", "x=0:1"], 1 / 0.52),
    ("exp(x*y)", ["-d", "x=0:1,y=0:1"], 1.3179021514544038),
]

print("expression, seeds, with an interval, too low, too high, holds or is named, mean deviation [standard errors]")
for expression, arguments, truth in CASES:
    seeds, known, low, high, deviation = 300, 0, 0, 0, 0.0
    for seed in range(1, seeds + 1):
        command = ["carlo", "integrate", expression, *arguments, "--seed", str(seed), "--threads", "1", "--json", "-"]
        run = subprocess.run(command, capture_output=True, text=True, check=False)
        output = json.loads(run.stdout)["outputs"][0]
        if output["error_bar"] != "known":
            continue
        known += 1
        low += output["hi"] < truth
        high += output["lo"] > truth
        deviation += (output["value"] - truth) / output["std_error"]
    held = 1 - (low + high) / seeds
    print(f"{expression}, {seeds}, {known}, {low}, {high}, {held:.3f}, {deviation / max(known, 1):.2f}", flush=True)
