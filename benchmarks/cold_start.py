"""First result of a two-mass system, from the start of the interpreter to its end.

Measured: whole processes, after an uncounted go of each that warms files and compiles Python's bytecode,
as an installer does; each writes its final states.
"""

from __future__ import annotations

import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from measure import Contender, compare, process
from table import show

HERE = Path(__file__).parent
TARGET = 2.0


def main(rounds: int) -> None:
    with TemporaryDirectory(prefix="inertance-") as cache:
        _compare(rounds, cache)


def _compare(rounds: int, cache: str) -> None:
    library = process([sys.executable, str(HERE / "ours" / "two_mass.py")], cache)
    casadi = process([sys.executable, str(HERE / "peers" / "two_mass_casadi.py")], cache)
    imports = process([sys.executable, "-c", "import casadi, numpy"], cache)
    for go in (library, casadi, imports):
        go()
    peers = [
        Contender("bare CasADi", casadi, target=TARGET),
        Contender("importing CasADi and NumPy", imports, "nothing run"),
    ]
    show("Cold start, two masses", compare(Contender("library", library), peers, 2 * rounds))
