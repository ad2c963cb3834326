"""The smooth planetary flywheel inerter written in other libraries of PyPI, where they are installed.

Each peer is a script that another interpreter may run (`--peers-python`): these libraries bring much
with them. Measured and compared as in the smooth benchmark; what a peer compiles before is not counted.
"""

from __future__ import annotations

import json
import subprocess
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pfi
from measure import Contender, Cost, compare, timed
from peers.pfi_casadi import SmoothInerter
from table import show

PEERS = {
    "rumoca": "Modelica source, BDF",
    "jaxonomy": "JAX, BDF",
    "pathsim": "one ODE block, ESDIRK43, exact Jacobian, once",
}
SLOW = ("pathsim",)


class _Script:
    """A peer's script; its last answer is kept."""

    def __init__(self, python: str, name: str) -> None:
        self.command = [python, str(Path(__file__).parent / "peers" / f"pypi_{name}.py")]
        self.force = np.zeros(0)

    def go(self) -> Cost:
        done = subprocess.run(self.command, check=True, capture_output=True, text=True)
        told = json.loads(done.stdout.splitlines()[-1])
        self.force = np.array(told["force"])
        return Cost(told["wall"], told["cpu"])


def main(rounds: int, python: str) -> None:
    bare = SmoothInerter(pfi.AMPLITUDE, pfi.FREQUENCY, pfi.SMOOTH, pfi.GRID)
    exact = bare.run(bare.integrator(1e-11, 1e-13))
    dae = pfi.reduced(pfi.SMOOTH)
    ours = Contender("library", timed(lambda: pfi.force(dae)))
    error = pfi.error(pfi.force(dae), exact)
    peers, notes = [], []
    for name, remark in PEERS.items():
        found = version(python, name)
        if found is None:
            notes.append(f"{name} left out: not installed for {Path(python).name}; see --peers-python.")
            continue
        script = _Script(python, name)
        first = script.go()
        told = f"{remark}; {pfi.error(script.force, exact)}"
        go: Callable[[], Cost] = script.go
        if name in SLOW:
            go = _always(first)
        peers.append(Contender(f"{name} {found}", go, told))
    show(f"Smooth PFI ({error}), PyPI", compare(ours, peers, rounds), notes)


def version(python: str, name: str) -> str | None:
    """Return the version of a package that an interpreter has."""
    asked = f"import importlib.metadata as m; print(m.version('{name}'))"
    done = subprocess.run([python, "-c", asked], capture_output=True, text=True)
    return done.stdout.strip() if done.returncode == 0 else None


def _always(cost: Cost) -> Callable[[], Cost]:
    return lambda: cost
