"""What the scripts of the PyPI peers share: the problem's numbers, and the protocol of a measurement."""

import json
from collections.abc import Callable
from math import pi
from statistics import median
from time import perf_counter, process_time

import numpy as np

AMPLITUDE, OMEGA, SMOOTH = 0.010, 2 * pi * 3.0, 0.1  # m, rad/s, rad/s
RTOL, ATOL = 1e-6, 1e-8
GRID = np.linspace(0.0, 1.0, 1001)


def tell(run: Callable[[], np.ndarray], repeats: int = 3) -> None:
    """Run once uncounted (unless once is all), then some times; print median costs and force as JSON."""
    if repeats > 1:
        run()
    costs = []
    for _ in range(repeats):
        wall, cpu = perf_counter(), process_time()
        force = run()
        costs.append((perf_counter() - wall, process_time() - cpu))
    wall, cpu = (median(column) for column in zip(*costs, strict=True))
    print(json.dumps({"wall": wall, "cpu": cpu, "force": np.asarray(force, dtype=float).tolist()}))
