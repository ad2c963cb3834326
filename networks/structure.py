"""The structural check: is there one equation for every unknown, and if not, who is concerned?"""

from __future__ import annotations

import casadi as ca
import numpy as np

from ..components.base import ModelError
from .families import Ints
from .index import System, counted


def check_structure(system: System) -> None:
    """Raise a ModelError that names the components of a singular network.

    Orders of differentiation are set aside: a variable and its derivatives count as one unknown, so
    what fails here cannot be mended by any index reduction.
    """
    bases = _bases(system)
    chain = (bases == np.arange(system.size)) & system.is_root()
    chain[bases[list(system.known)]] = False
    chains = np.flatnonzero(chain).tolist()
    number = counted(chain)[bases]
    rows, columns = system.incidence(number)
    owners = system.equations()
    pattern = ca.Sparsity.triplet(len(owners), len(chains), rows.tolist(), columns.tolist())
    _, order, permuted, _, _, coarse_rows, coarse_columns = pattern.btf()
    over = [owners[i] for i in order[: coarse_rows[2]]] if coarse_rows[1] else []
    under = [chains[i] for i in permuted[coarse_columns[2] :]] if coarse_columns[3] < len(chains) else []
    if over or under:
        problems = [*_too_many(system, over), *_too_few(system, under)]
        raise ModelError(f"'{system.flat.name}' is structurally singular:", problems)


def _bases(system: System) -> Ints:
    """Return, for every variable, the one it is a derivative of."""
    lower = np.arange(system.size)
    for variable, (upper, _) in system.derivative.items():
        lower[upper] = variable
    while (lower[lower] != lower).any():
        lower = lower[lower]
    return lower


def _too_many(system: System, over: list[tuple[int, int]]) -> list[str]:
    if not over:
        return []
    names = sorted({system.label(equation) for equation in over})
    return [
        f"too many equations for the same motion in {_listed(names)}: two rigid sources, two grounds "
        "or a ground and a source act on one node; remove one or put a Spring between"
    ]


def _too_few(system: System, under: list[int]) -> list[str]:
    if not under:
        return []
    names = sorted(system.name(v) for v in under)
    return [
        f"nothing determines {_listed(names)}: a Mass or a Fixed is missing at the node, "
        "or rigid elements close a loop and share a force that no equation splits"
    ]


def _listed(names: list[str], most: int = 8) -> str:
    rest = len(names) - most
    return ", ".join(names[:most]) + (f" and {rest} more" if rest > 0 else "")
