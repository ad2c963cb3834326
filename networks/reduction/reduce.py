"""Reduce: from flat equations to the `DAE` (index 1, states chosen, solved where possible)."""

from __future__ import annotations

from typing import Any

import casadi as ca

from ...base import ModelError
from ...components.language import values_of
from ..dae import DAE, Input
from ..flattening.families import padded
from ..flattening.flat import Flat
from ..flattening.vectors import column, pick
from .causalise import Solution, causalise
from .dummy_derivatives import select_states
from .jumps import Signal, jumping_signals, jumps_of
from .kinematic_loops import close_loops
from .pantelides import System, joined_system, reduce_index
from .singular import check_structure
from .transitions import Switching, switching


def reduce(flat: Flat) -> DAE:
    """Return the network's equations in the form everything else reads.

    Raises:
        ModelError: if values or connections are wrong or the network is structurally singular, naming the
            components concerned.
    """
    system = _checked(flat)
    reduce_index(system)
    symbols = ca.SX.sym("v", system.size)
    values = padded(symbols)
    switch = switching(system, values)
    states = select_states(system)
    signals = jumping_signals(system, values)
    solution = causalise(system, states, symbols, values, switch.expressions)
    return _dae(system, solution, switch, signals)


def _checked(flat: Flat) -> System:
    """Return the joined equations of a network in which nothing is wrong."""
    told = f"'{flat.name}' cannot be assembled:"
    try:
        system = joined_system(flat)
        close_loops(system)
        check_structure(system)
    except ModelError as error:
        if not flat.problems:
            raise
        raise ModelError(told, [*flat.problems, *error.problems]) from None
    if flat.problems:
        raise ModelError(told, flat.problems)
    return system


def _dae(system: System, solution: Solution, switch: Switching, signals: list[Signal]) -> DAE:
    flat = system.flat
    symbols = solution.symbols
    moving = _rates(system, solution), column(solution.residuals)
    jumps = jumps_of(system, signals, solution.values, symbols, *moving)
    solution.without([signal.course for signal in signals if signal.missed is not None])
    switch.expressions = solution.also
    known = sorted(system.known.items(), key=lambda item: (item[1], item[0]))
    inputs = [_input(flat, number, *fact) for number, fact in known]
    return DAE(
        name=flat.name,
        x=pick(symbols, solution.states),
        z=pick(symbols, solution.algebraic),
        u=pick(symbols, [number for number, _ in known]),
        p=flat.table.symbols,
        modes=flat.mode_symbols,
        impulses=flat.impulse_symbols,
        completion=solution.completion,
        time=flat.time,
        ode=_rates(system, solution),
        alg=column(solution.residuals),
        inputs=inputs,
        states=solution.states,
        algebraic=solution.algebraic,
        blocks=[block for block in solution.blocks if block.hybrid],
        switching=switch,
        variables=solution.values,
        flat=flat,
        parameters=flat.table,
        declared=system.names,
        derivative=system.derivative,
        jumps=jumps,
    )


def _rates(system: System, solution: Solution) -> Any:
    rates = [system.derivative[s] for s in solution.states]
    ode = pick(solution.values, [d for d, _ in rates])
    return ode * ca.DM([sign for _, sign in rates]) if any(sign < 0 for _, sign in rates) else ode


def _input(flat: Flat, number: int, path: str, order: int, sign: int) -> Input:
    owner, _, name = path.rpartition(".")
    component = flat.instances[owner].component
    unit, signal = type(component).fields[name].unit, values_of(component).get(name)
    return Input(path, order, sign, unit, signal, number)
