"""First result of a two-mass system, from the start of the interpreter to its end.

Measured: whole processes, bytecode and files being warm after an uncounted go.
"""

from __future__ import annotations

import sys
from pathlib import Path

from measure import Contender, compare, process
from table import show

HERE = Path(__file__).parent
TARGET = 2.0


def main(rounds: int) -> None:
    library = process([sys.executable, str(HERE / "ours" / "two_mass.py")])
    casadi = process([sys.executable, str(HERE / "peers" / "two_mass_casadi.py")])
    imports = process([sys.executable, "-c", "import casadi, numpy"])
    for go in (library, casadi, imports):
        go()
    peers = [
        Contender("bare CasADi", casadi, target=TARGET),
        Contender("importing CasADi and NumPy", imports, "nothing run"),
    ]
    show("Cold start, two masses", compare(Contender("library", library), peers, 2 * rounds))
