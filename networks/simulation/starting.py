"""Where a network starts from by itself: what is given, what that moves, and in which modes it is sought."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np

from ...base import Array
from ..dae import DAE
from ..flattening.vectors import column
from .bound_dae import bound
from .consistent_start import begun
from .coverage import check_covered
from .initialization import StartValues, following, guessed, leading, start_values
from .integrator import nominal_sizes

MOST_SOUGHT = 400


@dataclass(frozen=True)
class Aim:
    """A start value of a variable that is no state; a `fixed` one is met, others as nearly as that allows."""

    name: str
    variable: int
    value: float
    fixed: bool


@dataclass(frozen=True, eq=False)
class Start:
    """Where the search for start values begins, and what it seeks.

    Attributes:
        dae: the equations.
        x: states, z: algebraic unknowns, modes: modes, all before anything is sought.
        nominal: sizes of the states.
        aims: start values of variables that are no states, fixed ones first.
        given: names of the variables whose start is fixed, states among them.
        led: states that first go to where the aims are met most nearly.
        free: states that then go where the fixed aims are met.
    """

    dae: DAE
    x: Array
    z: Array
    modes: Array
    nominal: Array
    aims: Sequence[Aim]
    given: Sequence[str]
    led: Sequence[int]
    free: Sequence[int]

    @property
    def fixed(self) -> list[Aim]:
        """The aims that are met."""
        return [aim for aim in self.aims if aim.fixed]

    @property
    def moved(self) -> set[int]:
        """The states that are sought."""
        return {*self.led, *self.free}


def starting_point(dae: DAE, inputs: Mapping[str, Any], start: Mapping[str, float]) -> Start:
    """Return where a run of a network begins at t = 0; see `simulate` for the arguments.

    Where more than 400 start values hang together, they are those that were found, and nothing is sought.

    Raises:
        InitialConditionError: for start values that contradict each other.
    """
    closed = bound(dae, inputs)
    check_covered(dae.name, closed.signals, 0.0, 0.0)
    numbers = dae.parameters.values({})
    wanted = following(closed, closed.blank(numbers), 0.0, start_values(dae, start, {}))
    run = begun(closed, closed.blank(numbers), 0.0, wanted)
    modes, sizes = run.tried[len(numbers) :][: dae.modes.numel()], nominal_sizes(dae, dae.states)
    names = [name for name, _ in wanted.fixed.values()]
    found = search(dae, wanted)
    if found is None:
        return Start(dae, run.initial.values, run.point.z, modes, sizes, [], names, [], [])
    return Start(dae, *guessed(dae, wanted), modes, sizes, found[0], names, *found[1:])


def states_at_start(
    dae: DAE,
    *,
    inputs: Mapping[str, Any],
    parameters: Mapping[str, float],
    guess: Mapping[str, float],
    time: float,
) -> Array:
    """Return the states with which a run from `time` [s] on begins; see `simulate` for the arguments.

    What is guessed tells how this run began: values that components fix give way to it.

    Raises:
        InitialConditionError: for start values that contradict each other.
    """
    closed = bound(dae, inputs)
    check_covered(dae.name, closed.signals, time, time)
    numbers = dae.parameters.values(dict(parameters))
    wanted = start_values(dae, {}, guess)
    found = begun(closed, closed.blank(numbers), time, wanted.giving_way() if guess else wanted)
    return found.initial.values.copy()


def search(dae: DAE, wanted: StartValues) -> tuple[list[Aim], list[int], list[int]] | None:
    """Return what is sought, the states that this leads and those left free; None where that is too much."""
    aims = _aims(dae, wanted)
    fixed = [aim for aim in aims if aim.fixed]
    led = _reached(dae, aims, [i for _, movable in leading(dae, wanted) for i in movable])
    unfixed = [i for i, s in enumerate(dae.states) if s not in wanted.fixed]
    free = _reached(dae, fixed, unfixed, algebra=True) if fixed else []
    if max(len(aims), len(fixed) + dae.z.numel() if fixed else 0, len(led), len(free)) > MOST_SOUGHT:
        return None
    return aims if led else fixed, led, free


def _aims(dae: DAE, wanted: StartValues) -> list[Aim]:
    """Return start values of variables that are no states, fixed ones first."""
    states = set(dae.states)
    fixed = {v: given for v, given in wanted.fixed.items() if v not in states}
    aims = [Aim(name, v, dae.root(name)[1] * value, True) for v, (name, value) in fixed.items()]
    for soft, _ in leading(dae, wanted):
        aims += [Aim(dae.name_of(v), v, value, False) for v, value in soft.items()]
    return aims


def _reached(dae: DAE, aims: Sequence[Aim], states: Sequence[int], algebra: bool = False) -> list[int]:
    """Return those of some states that variables (and algebraic equations) depend on, also through others."""
    values = column([dae.expression(aim.name) for aim in aims])
    values = ca.vertcat(values, dae.alg) if algebra else values
    columns = np.diff(ca.jacobian_sparsity(values, dae.x).colind()) > 0
    return [i for i in states if columns[i]]
