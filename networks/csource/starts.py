"""Starts: what a program needs to know to find start values by itself."""

from __future__ import annotations

from typing import Any

import casadi as ca

from ..evaluation.compiled import dense
from ..flattening.vectors import column, pick
from ..simulation.starting import Start
from .tables import Tables


def start_functions(start: Start, arguments: list[Any]) -> list[Any]:
    """Return the functions that start values make zero, with their slopes, a column for each.

    The network is taken as it is, without corners as modes: which side of a corner it starts on is not known.
    """
    dae = start.dae
    led, free = pick(dae.x, start.led), ca.vertcat(pick(dae.x, start.free), dae.z)
    aims = column([dae.expression(aim.name) for aim in start.aims])
    met = column([dae.expression(aim.name) for aim in start.fixed])
    met = ca.vertcat(met, dae.alg) if start.fixed else ca.SX(0, 1)
    laws = ("model_lead", aims, led), ("model_meet", met, free)
    return [
        ca.Function(name, arguments, dense(values, ca.jacobian(values, unknowns).T), {"cse": True})
        for name, values, unknowns in laws
    ]


def start_tables(tables: Tables, start: Start, modes: int) -> None:
    """Add sizes and tables of a start to those of a program with so many modes."""
    dae, fixed = start.dae, start.fixed
    place = {v: k for k, v in enumerate(dae.algebraic)}
    tables.sizes(NAIM=len(start.aims), NFIXED=len(fixed), NLEAD=len(start.led), NFREE=len(start.free))
    tables.doubles(
        guess=[*start.x, *start.z],
        first_mode=[*start.modes, *[0.0] * (modes - len(start.modes))],
        aim=[aim.value for aim in start.aims],
    )
    tables.strings(
        aim_name=[aim.name for aim in start.aims], aim_unit=[dae.unit(aim.name) for aim in start.aims]
    )
    tables.integers(
        lead_state=start.led,
        free_state=start.free,
        aim_unknown=[place.get(aim.variable, -1) for aim in fixed],
    )
