"""Runs of the assembled planetary flywheel inerter, the first in their process; prints JSON.

Given: smooth or hybrid, a solver, and how many runs; counted is the first one.
"""

import json
import sys
from pathlib import Path
from time import perf_counter, process_time

sys.path.insert(0, str(Path(__file__).parents[1]))
import pfi

kind, solver, count = sys.argv[1:]
dae = pfi.reduced(pfi.SMOOTH if kind == "smooth" else None)
wall, cpu = perf_counter(), process_time()
pfi.force(dae, solver)
wall, cpu = perf_counter() - wall, process_time() - cpu
for _ in range(int(count) - 1):
    pfi.force(dae, solver)
print(json.dumps({"wall": wall, "cpu": cpu}))
