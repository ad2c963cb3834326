"""Initialization: start values that satisfy the equations and what the user fixed.

Fixed values hold exactly; states nobody fixed move from their guesses as little as the fixed values
of other variables require, and a default start never becomes a condition. A relative state (of a
friction element, a stop) has no guess of its own worth keeping where the motions it relates have.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from ..components.base import InitialConditionError, ModelError, Variable
from .closed import Closed
from .dae import DAE

Array = NDArray[np.float64]
SOLVED = "solved from fixed values of other variables"
RELATED = "from the start values of the motions it relates"
KEPT = "guess kept"


@dataclass(frozen=True)
class Decision:
    """How one start value came about."""

    name: str
    value: float
    unit: str
    reason: str

    def __str__(self) -> str:
        return f"{self.name} = {self.value:.6g} {self.unit}: {self.reason}"


@dataclass(eq=False)
class Wishes:
    """Start values by joined variable: fixed ones and guesses, each with the name it was given by."""

    fixed: dict[int, tuple[str, float]]
    guesses: dict[int, float]


def wishes(dae: DAE, start: Mapping[str, float], guess: Mapping[str, float]) -> Wishes:
    """Gather start values from components and from the run (which goes first).

    Raises:
        ModelError: for unknown names.
        InitialConditionError: for two different fixed values of one variable.
    """
    given: dict[str, float] = {}
    for instance in dae.system.flat.instances.values():
        for name, value in instance.component._values.items():
            if isinstance(type(instance.component).fields.get(name), Variable):
                given[f"{instance.path}.{name}".lstrip(".")] = float(value)
    run = {_root(dae, name)[0] for name in start}
    given = {name: v for name, v in given.items() if _root(dae, name)[0] not in run}
    fixed: dict[int, tuple[str, float]] = {}
    clashes = []
    for name, value in {**given, **start}.items():
        root, sign = _root(dae, name)
        if not np.isfinite(value):
            raise ModelError(f"start value of '{name}' must be a finite number, got {value}")
        known = fixed.setdefault(root, (name, sign * float(value)))
        if not np.isclose(known[1], sign * float(value), rtol=1e-12, atol=1e-12):
            unit = dae.unit(name)
            clashes.append(f"'{known[0]}' and '{name}' are one variable, fixed at two values [{unit}]")
    if clashes:
        raise InitialConditionError("start values contradict each other: " + "; ".join(clashes))
    guesses = {}
    for name, value in guess.items():
        root, sign = _root(dae, name)
        guesses[root] = sign * float(value)
    return Wishes(fixed, guesses)


def _root(dae: DAE, name: str) -> tuple[int, int]:
    try:
        return dae.root(name)
    except KeyError as error:
        raise ModelError(f"start value: {error.args[0]}") from None


def initial_values(closed: Closed, q: Array, t: float, wanted: Wishes) -> tuple[Array, Array, list[Decision]]:
    """Return states, algebraic unknowns and how they were decided.

    Raises:
        InitialConditionError: if no start satisfies the fixed values.
    """
    dae = closed.dae
    x, z = (_guessed(dae, wanted, variables) for variables in (dae.states, dae.algebraic))
    free = [i for i, s in enumerate(dae.states) if s not in wanted.fixed]
    others = [v for v in wanted.fixed if v not in dae.states]
    conditions = [dae.variables[v] - wanted.fixed[v][1] for v in others]
    before = x.copy()
    for variables, movable in _leading(dae, wanted):
        soft = [dae.variables[v] - value for v, value in variables.items()]
        x = _nearer(closed, q, t, (x, z), ca.vertcat(*conditions), ca.vertcat(*soft), movable)
    related = x != before
    before = x.copy()
    if others or len(z):
        x, z = _solve(closed, q, t, (x, z), free, ca.vertcat(*conditions, dae.alg), others, wanted)
    moved = x != before
    reasons = np.select([moved, related], [SOLVED, RELATED], KEPT)
    return x, z, [_decided(dae, i, float(x[i]), str(reasons[i]), wanted) for i in range(len(x))]


def _leading(dae: DAE, wanted: Wishes) -> Iterator[tuple[dict[int, float], list[int]]]:
    """Yield variables that are no states but whose start values lead, and the states they move."""
    names, states = dae.system.names, set(dae.states)
    open_ = [(i, s) for i, s in enumerate(dae.states) if s not in {*wanted.fixed, *wanted.guesses}]
    relative = [i for i, s in open_ if s < len(names.state) and names.state[s] > 0]
    if relative:
        motions = [
            v
            for v in dae.system.derivative
            if v < len(names.state) and names.state[v] == 0 and v not in {*states, *dae.system.known}
        ]
        values = {v: wanted.guesses.get(v, float(names.start[v])) for v in motions}
        yield {v: value for v, value in values.items() if v not in wanted.fixed}, relative
    guessed = {v: value for v, value in wanted.guesses.items() if v not in states}
    if guessed:
        yield guessed, [i for i, _ in open_]


def _nearer(
    closed: Closed,
    q: Array,
    t: float,
    start: tuple[Array, Array],
    hard: Any,
    soft: Any,
    movable: list[int],
) -> Array:
    """Move states so that `hard` is zero and, as far as that allows, `soft` is least."""
    x, z = start[0].copy(), start[1]
    residuals = [closed.close(ca.vertcat(ca.SX(0, 1), part)) for part in (hard, soft)]
    slopes = [ca.jacobian(residual, closed.x)[:, movable] for residual in residuals]
    function = closed.function("nearer", *residuals, *slopes)
    for _ in range(20):
        h, s, to_h, to_s = (m.full() for m in function(x, z, q, t))
        must = np.linalg.pinv(to_h, rcond=1e-12) @ -h
        _, strength, right = np.linalg.svd(to_h)
        free = right[np.count_nonzero(strength > 1e-12 * strength.max(initial=0.0)) :].T
        may = free @ np.linalg.lstsq(to_s @ free, -(s + to_s @ must), rcond=1e-12)[0]
        step = (must + may).ravel()
        if not np.isfinite(step).all():
            return start[0]
        x[movable] += step
        if np.abs(step).max(initial=0.0) <= 1e-13 * (1 + np.abs(x).max(initial=0.0)):
            break
    return x


def _guessed(dae: DAE, wanted: Wishes, variables: list[int]) -> Array:
    starts = dae.system.names.start
    values = []
    for v in variables:
        default = float(starts[v]) if v < len(starts) else 0.0
        values.append(wanted.fixed[v][1] if v in wanted.fixed else wanted.guesses.get(v, default))
    return np.array(values)


def _solve(
    closed: Closed,
    q: Array,
    t: float,
    start: tuple[Array, Array],
    free: list[int],
    conditions: Any,
    others: list[int],
    wanted: Wishes,
) -> tuple[Array, Array]:
    """Gauss-Newton with steps of least norm in the free states and z."""
    x, z = start[0].copy(), start[1].copy()
    residual = closed.close(conditions)
    slopes = [ca.jacobian(residual, closed.x)[:, free], ca.jacobian(residual, closed.z)]
    function = closed.function("start", residual, ca.horzcat(*slopes))
    for _ in range(50):
        value, slope = (m.full() for m in function(x, z, q, t))
        if not np.isfinite(value).all():
            break
        step = np.linalg.lstsq(slope, -value.ravel(), rcond=1e-12)[0] if slope.size else np.zeros(0)
        x[free] += step[: len(free)]
        z += step[len(free) :]
        if np.abs(step).max(initial=0.0) <= 1e-13 * (1 + np.abs(np.r_[x, z]).max(initial=0.0)):
            break
    value = function(x, z, q, t)[0].full().ravel()
    wrong = np.flatnonzero(~(np.abs(value) <= 1e-8 * (1 + np.abs(x).max(initial=0.0))))
    if len(wrong):
        raise InitialConditionError(_contradiction(closed.dae, others, wrong, wanted))
    return x, z


def _contradiction(dae: DAE, others: list[int], wrong: Any, wanted: Wishes) -> str:
    names = [wanted.fixed[others[i]][0] for i in wrong if i < len(others)]
    told = ", ".join(f"'{n}' = {wanted.fixed[others[i]][1]:g}" for n, i in zip(names, wrong, strict=False))
    fixed = ", ".join(f"'{name}'" for name, _ in wanted.fixed.values())
    if not names:
        return f"'{dae.name}': no start satisfies the equations; give guess= for the states"
    return (
        f"'{dae.name}': the start values {told} cannot be reached together with the others that are "
        f"fixed ({fixed}); give some of them as guess= instead of start="
    )


def _decided(dae: DAE, i: int, value: float, reason: str, wanted: Wishes) -> Decision:
    variable = dae.states[i]
    name = dae.system.name(variable)
    unit = dae.system.names.unit(variable)
    if variable in wanted.fixed:
        given = wanted.fixed[variable][0]
        reason = "fixed" if given == name else f"fixed through {given}"
    return Decision(name, value, unit, reason)
