"""A sweep of 1000 quarter-car runs: two processes against one, and against SciPy in a bare pool of two.

All runs are 3 s over a kerb at rtol 1e-6 and atol 1e-8. Contenders take turns.
"""

from __future__ import annotations

import multiprocessing
from collections.abc import Callable
from statistics import median
from time import perf_counter

import inertance as ia
import numpy as np
from rich.console import Console
from scipy.integrate import solve_ivp

COUNT, STOP, TARGET = 1000, 3.0, 1.8
RTOL, ATOL = 1e-6, 1e-8
M_S, M_U, K_T, K = 250.0, 35.0, 150e3, 60e3
DESIGN = ia.sweeps.latin_hypercube(
    {"strut.rest.damper.d": (1e3, 6e3), "strut.rest.inerter.b": (50.0, 500.0)}, COUNT
)


def build() -> ia.Network:
    return ia.machines.quarter_car(
        ia.machines.suspension("S4", k=K, d=3224.0, b=333.0), m_s=M_S, m_u=M_U, k_t=K_T
    )


def kerb(t: float) -> float:
    return 0.02 / (1 + np.exp(-40 * (t - 1)))


def ride(dae: ia.DAE, values: dict[str, float]) -> float:
    run = ia.simulate(dae, STOP, parameters=values, inputs={"road.s_ref": kerb}, rtol=RTOL, atol=ATOL)
    return float(np.abs(run["body.a"]).max())


def by_hand(point: tuple[float, float]) -> float:
    """Return the same by SciPy: states are wheel, body and the inerter's relative speed."""
    d, b = point

    def rates(t: float, x: list[float]) -> list[float]:
        z_u, v_u, z_s, v_s, w = x
        pull = d * (v_s - v_u - w)
        strut = K * (z_s - z_u) + pull
        return [v_u, (K_T * (kerb(t) - z_u) + strut) / M_U, v_s, -strut / M_S, pull / b]

    times = np.linspace(0.0, STOP, 501)
    run = solve_ivp(rates, (0.0, STOP), np.zeros(5), "LSODA", times, rtol=RTOL, atol=ATOL)
    return float(np.abs(np.array([rates(t, x)[3] for t, x in zip(times, run.y.T, strict=True)])).max())


def ours(workers: int) -> list[float]:
    done = ia.sweeps.sweep(build, DESIGN, ride, workers=workers, progress=False)
    return [float(value) for value in done.table["value"]]


def scipy_pool() -> list[float]:
    with multiprocessing.Pool(2) as pool:
        return pool.map(by_hand, DESIGN.points, chunksize=8)


CONTENDERS: dict[str, Callable[[], list[float]]] = {
    "one process": lambda: ours(1),
    "two processes": lambda: ours(2),
    "SciPy's LSODA in a pool of two": scipy_pool,
}


def main(rounds: int) -> None:
    seconds: dict[str, list[float]] = {name: [] for name in CONTENDERS}
    found = {}
    for number in range(rounds):
        names = list(CONTENDERS)
        for name in names[number % 3 :] + names[: number % 3]:
            started = perf_counter()
            found[name] = np.array(CONTENDERS[name]())
            seconds[name].append(perf_counter() - started)
    one, two, scipy = (median(seconds[name]) for name in CONTENDERS)
    apart = np.abs(found["two processes"] / found["SciPy's LSODA in a pool of two"] - 1).max()
    console = Console(width=110)
    console.print(f"Sweep of {COUNT} quarter cars: wall time [s], median of {rounds} rounds (least to most)")
    for name, spent in seconds.items():
        console.print(f"  {name}: {median(spent):.2f} ({min(spent):.2f} to {max(spent):.2f})")
    met = "met" if one / two >= TARGET else "NOT MET"
    console.print(f"  two processes are {one / two:.2f} times as fast as one; target {TARGET}: {met}")
    console.print(f"  SciPy takes {scipy / two:.2f} times as long; results are at most {apart:.1e} apart")


if __name__ == "__main__":
    main(3)
