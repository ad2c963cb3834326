"""The smooth planetary flywheel inerter on PathSim: one ODE block, equations and Jacobian as for SciPy."""

from math import tanh

import numpy as np
from pathsim import Connection, Simulation
from pathsim.blocks import ODE, Scope
from pathsim.solvers import ESDIRK43
from pypi_run import AMPLITUDE, ATOL, GRID, OMEGA, RTOL, SMOOTH, tell
from scipy_pfi import Drive, jacobian, rates, rolling_start, terminal_force

DRIVE = Drive(AMPLITUDE, OMEGA)


def run() -> np.ndarray:
    plant = ODE(
        lambda x, u, t: np.array(rates(DRIVE, lambda _, w: tanh(w / SMOOTH), t, x)),
        rolling_start(DRIVE),
        jac=lambda x, u, t: jacobian(DRIVE, SMOOTH, t, x),
    )
    scope = Scope(labels=["th_s", "w_s", "th_p", "w_p"])
    wires = [Connection(plant[i], scope[i]) for i in range(4)]
    tolerances = {"tolerance_lte_rel": RTOL, "tolerance_lte_abs": ATOL}
    simulation = Simulation([plant, scope], wires, dt=1e-5, log=False, Solver=ESDIRK43, **tolerances)
    simulation.run(GRID[-1])
    time, states = scope.read()
    force = terminal_force(DRIVE, time, states)
    return np.interp(GRID, time, force)


tell(run, repeats=1)  # takes a minute
