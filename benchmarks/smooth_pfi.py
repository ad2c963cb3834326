"""Smooth planetary flywheel inerter: 1 s at 3 Hz, rtol 1e-6, 1001 outputs.

Measured: a run from numbers to the force on the rod, the model being built and compiled before.
Error: of the force against a run of bare CasADi at rtol 1e-11, as a share of the force's range.
"""

from __future__ import annotations

from math import pi

import pfi
from c_program import CProgram, MissingError
from measure import Contender, compare, once, timed
from peers import scipy_pfi
from peers.pfi_casadi import SmoothInerter
from table import show

TO_C, TO_RADAU = 1.3, 1 / 20


def main(rounds: int) -> None:
    bare = SmoothInerter(pfi.AMPLITUDE, pfi.FREQUENCY, pfi.SMOOTH, pfi.GRID)
    exact = bare.run(bare.integrator(1e-11, 1e-13))
    integrator = bare.integrator(pfi.RTOL, pfi.ATOL)
    error = pfi.error(bare.run(integrator), exact)
    peers = [Contender("bare CasADi CVODES", timed(lambda: bare.run(integrator)), error), *_scipy(exact)]
    notes = []
    try:
        program = CProgram("smooth")
        error = pfi.error(program.force(), exact)
        peers.insert(0, Contender("C on CVODE", program.go, f"{error}, {program.steps()} steps", TO_C))
    except MissingError as missing:
        notes.append(f"C on CVODE left out: {missing}.")
    dae = pfi.warmed(pfi.SMOOTH)
    for solver in pfi.SOLVERS:
        ours = Contender("library", timed(lambda solver=solver: pfi.force(dae, solver)))
        error = pfi.error(pfi.force(dae, solver), exact)
        ratios = compare(ours, peers, rounds)
        show(f"Smooth PFI, solver '{solver}' ({error})", ratios, notes)


def _scipy(exact: pfi.Array) -> list[Contender]:
    drive = scipy_pfi.Drive(pfi.AMPLITUDE, 2 * pi * pfi.FREQUENCY)
    contenders = []
    for method in scipy_pfi.METHODS:
        for jacobian in (False, True):

            def run(method: str = method, jacobian: bool = jacobian) -> scipy_pfi.Run:
                options = {"method": method, "rtol": pfi.RTOL, "atol": pfi.ATOL}
                return scipy_pfi.solve_smooth(drive, pfi.SMOOTH, pfi.GRID, jacobian, **options)

            name = f"SciPy {method}" + (", exact Jacobian" if jacobian else "")
            target = TO_RADAU if method == "Radau" else None
            contenders.append(Contender(name, once(run), pfi.error(run().force, exact), target))
    return contenders
