"""What ensembles of the PyPI peers share: the quarter car's numbers, the protocol of a measurement."""

import json
from collections.abc import Callable
from time import perf_counter, process_time

import numpy as np

MEMBERS, STOP, RTOL, ATOL = 2000, 3.0, 1e-6, 1e-8
M_S, M_U, K_T, K = 250.0, 35.0, 150e3, 60e3
GRID = np.linspace(0.0, STOP, 501)
DRAW = np.random.default_rng(0)
DAMPERS, INERTERS = DRAW.uniform(1e3, 6e3, MEMBERS), DRAW.uniform(50.0, 500.0, MEMBERS)


def tell(run: Callable[[], np.ndarray]) -> None:
    """Run once uncounted, then once; print costs of a member and how the first body moves as JSON."""
    run()
    wall, cpu = perf_counter(), process_time()
    accelerations = run()
    wall, cpu = (perf_counter() - wall) / MEMBERS, (process_time() - cpu) / MEMBERS
    told = {"wall": wall, "cpu": cpu, "d": DAMPERS[0], "b": INERTERS[0]}
    print(json.dumps({**told, "a": np.asarray(accelerations[0], dtype=float).tolist()}))
