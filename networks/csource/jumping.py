"""Jumping: jumps of prescribed motions as C, for shocks.c."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import casadi as ca
import numpy as np

from ..dae import DAE
from ..evaluation.compiled import dense
from ..flattening.vectors import pick
from .tables import Tables


def jump_functions(dae: DAE, function: Callable[[str, list[Any], list[Any]], Any]) -> list[Any]:
    """Return what jumps are told by, how far they go, and what they move; `function` makes one of a DAE."""
    jumps = dae.jumps
    if jumps is None:
        return []
    told = [jumps.before, jumps.after, dae.constants, dae.time]
    moving = ca.vertcat(jumps.ode, jumps.forces, jumps.alg)
    return [
        function("model_seen", [], [pick(dae.variables, jumps.reads)]),
        ca.Function("model_jump", told, dense(jumps.jump, jumps.size), {"cse": True}),
        function("model_moving", [jumps.courses], [moving]),
    ]


def jump_tables(dae: DAE, tables: Tables) -> None:
    """Add sizes and names of what jumps; all zero and empty where nothing does."""
    jumps = dae.jumps
    signals, reads = (jumps.signals, jumps.reads) if jumps else ([], [])
    counts = [len(s.signs) for s in signals]
    tables.sizes(NREAD=len(reads), NSIGNAL=len(signals), NJ=sum(counts))
    tables.sizes(NPUSH=len(jumps.motions) if jumps else 0, MODEL_JUMPS=bool(signals))
    own = set(ca.jacobian_sparsity(jumps.jump, dae.modes).get_col()) if jumps else set()
    place = {variable: k for k, variable in enumerate(reads)}
    resets = [r for change in dae.switching.changes for r in change.resets]
    tables.integers(
        jump_start=np.cumsum([0, *counts]),
        jump_sign=[sign for s in signals for sign in s.signs],
        jump_mode=[mode in own for mode in range(dae.modes.numel())],
        reset_read=[place.get(r[0], -1) for r in resets],
    )
    tables.strings(jump_name=[s.name for s in signals])
