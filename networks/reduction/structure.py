"""The structural check: is there one equation for every unknown?"""

from __future__ import annotations

import numpy as np

from ...base import ModelError
from .pantelides import System, counted
from .singular import tell_singular


def check_structure(system: System) -> None:
    """Raise a ModelError that names the components of a singular network.

    Orders of differentiation are set aside: a variable and its derivatives count as one unknown, so
    what fails here cannot be mended by any index reduction.
    """
    bases = system.bases()
    chain = (bases == np.arange(system.size)) & system.is_root()
    chain[bases[list(system.known)]] = False
    chains = np.flatnonzero(chain).tolist()
    owners, pattern = system.equations(), system.incidence(counted(chain)[bases])
    _, order, permuted, _, _, coarse_rows, coarse_columns = pattern.btf()
    over = [owners[i] for i in order[: coarse_rows[2]]] if coarse_rows[1] else []
    under = [chains[i] for i in permuted[coarse_columns[2] :]] if coarse_columns[3] < len(chains) else []
    if over or under:
        problems = tell_singular(system, over, under)
        raise ModelError(f"'{system.flat.name}' is structurally singular:", problems)
