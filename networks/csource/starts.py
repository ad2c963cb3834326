"""Starts: what a program needs to know to find start values by itself."""

from __future__ import annotations

from typing import Any

import casadi as ca

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
    return [
        _function("model_lead", arguments, aims, led),
        _function("model_meet", arguments, met, free),
    ]


def _function(name: str, arguments: list[Any], values: Any, unknowns: Any) -> Any:
    slopes = ca.densify(ca.jacobian(values, unknowns).T)
    return ca.Function(name, arguments, [ca.densify(values), slopes], {"cse": True})


def start_tables(tables: Tables, start: Start, modes: int) -> None:
    """Add sizes and tables of a start to those of a program with so many modes."""
    dae, fixed = start.dae, start.fixed
    tables.size("NAIM", len(start.aims))
    tables.size("NFIXED", len(fixed))
    tables.size("NLEAD", len(start.led))
    tables.size("NFREE", len(start.free))
    tables.doubles("model_guess", [*start.x, *start.z])
    tables.doubles("model_first_mode", [*start.modes, *[0.0] * (modes - len(start.modes))])
    tables.doubles("model_aim", [aim.value for aim in start.aims])
    tables.strings("model_aim_name", [aim.name for aim in start.aims])
    tables.strings("model_aim_unit", [dae.unit(aim.name) for aim in start.aims])
    tables.integers("model_lead_state", start.led)
    tables.integers("model_free_state", start.free)
    place = {v: k for k, v in enumerate(dae.algebraic)}
    tables.integers("model_aim_unknown", [place.get(aim.variable, -1) for aim in fixed])
