"""Hybrid planetary flywheel inerter, with true sticking: 1 s at 3 Hz, rtol 1e-6, 1001 outputs.

Measured as in the smooth benchmark. Error: of the force against SciPy's LSODA at rtol 1e-10, which
stops at every event.
"""

from __future__ import annotations

from math import pi

import pfi
from c_program import CProgram, MissingError
from measure import Contender, compare, once, timed
from peers import scipy_pfi
from table import show

TO_C = 1.6


def main(rounds: int) -> None:
    drive = scipy_pfi.Drive(pfi.AMPLITUDE, 2 * pi * pfi.FREQUENCY)

    def scipy(method: str, rtol: float = pfi.RTOL, atol: float = pfi.ATOL) -> pfi.Array:
        return scipy_pfi.solve_hybrid(drive, pfi.GRID, method=method, rtol=rtol, atol=atol).force

    exact = scipy("LSODA", 1e-10, 1e-12)
    error = pfi.error(scipy("Radau"), exact)
    peers = [Contender("SciPy Radau, events", once(lambda: scipy("Radau")), error)]
    notes = []
    try:
        program = CProgram("hybrid")
        error = pfi.error(program.force(), exact)
        remark = f"{error}, {program.steps()} steps"
        peers.insert(0, Contender("C on CVODE, root finding", program.go, remark, TO_C))
    except MissingError as missing:
        notes.append(f"C on CVODE left out: {missing}.")
    dae = pfi.warmed()
    for solver in pfi.SOLVERS:
        ours = Contender("library", timed(lambda solver=solver: pfi.force(dae, solver)))
        error = pfi.error(pfi.force(dae, solver), exact)
        show(f"Hybrid PFI, solver '{solver}' ({error})", compare(ours, peers, rounds), notes)
