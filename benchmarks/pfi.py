"""The planetary flywheel inerter on the rig, as the library runs it: 1 s at 3 Hz and 10 mm."""

from __future__ import annotations

from math import pi

import numpy as np
from inertance import DAE, simulate
from inertance.machines import Sinusoid, ge_wang, inerter_rig
from numpy.typing import NDArray
from peers.pfi_casadi import LEAD, R_PLANET, R_SCREW

AMPLITUDE, FREQUENCY, DURATION, STEP = 0.010, 3.0, 1.0, 1e-3
RTOL, ATOL = 1e-6, 1e-8
SMOOTH = 0.1  # rad/s
RUNS_TO_WARM = 500
SOLVERS = ("auto", "cvodes", "compiled")
GRID = np.linspace(0.0, DURATION, 1001)
FORCE = "inerter.flange_a.f"

Array = NDArray[np.float64]


def reduced(regularised: float | None = None) -> DAE:
    """Return the prototype on the rig, assembled and reduced."""
    return inerter_rig(
        ge_wang.planetary_inerter(regularised=regularised), Sinusoid(AMPLITUDE, FREQUENCY)
    ).dae()


def rolling() -> dict[str, float]:
    """Return start values with which screw and planets already roll with the rod."""
    w_s = 2 * pi / LEAD * AMPLITUDE * 2 * pi * FREQUENCY
    planet = "inerter.flywheel.planet"
    return {f"{planet}.w_s": w_s, f"{planet}.w_p": w_s * R_SCREW / R_PLANET}


def warmed(regularised: float | None = None) -> DAE:
    """Return the prototype once "auto" means for it what it means for all later runs, as on a second day."""
    dae = reduced(regularised)
    for _ in range(RUNS_TO_WARM):
        if (
            simulate(dae, DURATION, step=STEP, start=rolling(), rtol=RTOL, atol=ATOL).stats["solver"]
            == "compiled"
        ):
            break
    return dae


def force(dae: DAE, solver: str = "auto") -> Array:
    """Return the force on the rod at the instants of GRID, after the event where there is one."""
    run = simulate(dae, DURATION, step=STEP, start=rolling(), rtol=RTOL, atol=ATOL, solver=solver)
    force: Array = run[FORCE]
    if len(run.time) == len(GRID):
        return force
    return force[np.searchsorted(run.time, GRID + 1e-9, side="right") - 1]


def error(force: Array, exact: Array) -> str:
    """Say how far a force is from the exact one, over the range of that."""
    return f"error {np.abs(force - exact).max() / np.ptp(exact):.1e}"
