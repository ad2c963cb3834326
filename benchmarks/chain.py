"""A chain of N masses: assemble, reduce, compile and run for the first time, against bare CasADi.

Each measurement is a process of its own, which has run a small problem of another kind before the
clock starts: imports and what the first of all runs costs are not counted (see the cold start).
"""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from statistics import median

import numpy as np
from measure import Contender, Cost, ratio
from table import show

HERE = Path(__file__).parent
SIDES = {"library": HERE / "ours" / "chain.py", "bare": HERE / "peers" / "chain_casadi.py"}
SIZES = (100, 316, 1000, 3162, 10000)
EXPONENT, TARGET = 1.15, 3.0


def main(rounds: int) -> None:
    costs: dict[tuple[str, int], list[Cost]] = {(side, n): [] for side in SIDES for n in SIZES}
    apart = 0.0
    for _ in range(rounds):
        for n in SIZES:
            values = []
            for side, script in SIDES.items():
                cost, value = _go(script, n)
                costs[side, n].append(cost)
                values.append(value)
            apart = max(apart, abs(values[0] - values[1]))
    ratios = []
    for n in SIZES:
        bare = Contender(f"bare CasADi, N = {n}", lambda: Cost(0, 0), target=TARGET)
        ratios.append(ratio(bare, costs["library", n], costs["bare", n]))
    notes = [f"The first masses of both are at most {apart:.1e} m apart."]
    for side in SIDES:
        slope = np.polyfit(np.log(SIZES), [np.log(median(c.cpu for c in costs[side, n])) for n in SIZES], 1)[
            0
        ]
        met = (
            f", target <= {EXPONENT}: {'met' if slope <= EXPONENT else 'NOT MET'}"
            if side == "library"
            else ""
        )
        notes.append(f"Exponent of CPU time over N, {side}: {slope:.2f}{met}.")
    show("Chain of N masses", ratios, notes)


def _go(script: Path, n: int) -> tuple[Cost, float]:
    command = [sys.executable, str(script), str(n)]
    told = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
    return Cost(told["wall"], told["cpu"]), told["value"]
