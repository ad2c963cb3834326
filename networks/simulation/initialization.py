"""Initialization: start values that satisfy the equations and what the user fixed.

Fixed values hold exactly; states nobody fixed move from their guesses as little as the fixed values
of other variables require, and a default start never becomes a condition. A relative state (of a
friction element, a stop) has no guess of its own worth keeping where the motions it relates have.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, overload

import numpy as np
from numpy.typing import NDArray

from ...base import Array, InitialConditionError, ModelError, is_number
from ...components.language import Variable
from ..dae import DAE
from .blame import GUARD, told_without_value
from .bound_dae import BoundDAE

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


@dataclass(frozen=True, eq=False)
class StartReport(Sequence[Decision]):
    """How every start value came about, named when asked for."""

    dae: DAE
    values: Array
    reasons: NDArray[np.str_]
    wanted: StartValues

    def __len__(self) -> int:
        return len(self.values)

    @overload
    def __getitem__(self, i: int) -> Decision: ...
    @overload
    def __getitem__(self, i: slice) -> list[Decision]: ...
    def __getitem__(self, i: int | slice) -> Decision | list[Decision]:
        if isinstance(i, slice):
            return [self[k] for k in range(*i.indices(len(self)))]
        variable, reason = self.dae.states[i], str(self.reasons[i])
        name, unit = self.dae.name_of(variable), self.dae.declared.unit(variable)
        if variable in self.wanted.fixed:
            given = self.wanted.fixed[variable][0]
            reason = "fixed" if given == name else f"fixed through {given}"
        return Decision(name, float(self.values[i]), unit, reason)


@dataclass(eq=False)
class StartValues:
    """Start values by joined variable: fixed ones and guesses, each with the name it was given by."""

    fixed: dict[int, tuple[str, float]]
    guesses: dict[int, float]


def start_values(dae: DAE, start: Mapping[str, float], guess: Mapping[str, float]) -> StartValues:
    """Gather start values from components and from the run (which goes first).

    Raises:
        ModelError: for unknown names.
        InitialConditionError: for two different fixed values of one variable.
    """
    _check_names(dae, {**start, **guess})
    given: dict[str, float] = {}
    for instance in dae.flat.instances.values():
        for name, value in instance.component._values.items():
            if isinstance(type(instance.component).fields.get(name), Variable):
                given[f"{instance.path}.{name}".lstrip(".")] = float(value)
    run = {dae.root(name)[0] for name in start}
    given = {name: v for name, v in given.items() if dae.root(name)[0] not in run}
    fixed: dict[int, tuple[str, float]] = {}
    clashes = []
    for name, value in {**given, **start}.items():
        root, sign = dae.root(name)
        known, wanted = fixed.setdefault(root, (name, sign * float(value)))
        if known != name and not np.isclose(wanted, sign * float(value), rtol=1e-12, atol=1e-12):
            other = dae.root(known)[1]
            clashes.append(
                f"'{known}' and '{name}' are {'one variable' if sign == other else 'opposite'}, fixed at two "
                f"values, {other * wanted:g} and {value:g} {dae.unit(name)}; fix one"
            )
    if clashes:
        raise InitialConditionError("start values contradict each other: " + "; ".join(clashes))
    guesses = {}
    for name, value in guess.items():
        root, sign = dae.root(name)
        guesses[root] = sign * float(value)
    return StartValues(fixed, guesses)


def _check_names(dae: DAE, given: Mapping[str, Any]) -> None:
    """Raise for names of no variable, and for values that are no numbers."""
    problems = []
    for name, value in given.items():
        try:
            dae.root(name)
        except KeyError as error:
            problems.append(error.args[0])
        if not is_number(value):
            problems.append(f"start value of '{name}' must be a finite number, got {value!r}")
    if problems:
        raise ModelError("these start values cannot be set:", problems)


def initial_values(
    closed: BoundDAE, q: Array, t: float, wanted: StartValues
) -> tuple[Array, Array, StartReport]:
    """Return states, algebraic unknowns and how they were decided.

    Raises:
        InitialConditionError: if no start satisfies the fixed values.
    """
    dae = closed.dae
    wanted = _following(closed, q, t, wanted)
    x, z = (guessed(dae, wanted, variables) for variables in (dae.states, dae.algebraic))
    free = [i for i, s in enumerate(dae.states) if s not in wanted.fixed]
    states = set(dae.states)
    others = [v for v in wanted.fixed if v not in states]
    hard = {v: wanted.fixed[v][1] for v in others}
    related, moved = np.zeros((2, len(x)), dtype=bool)
    for _ in range(2 if others else 1):
        before = x.copy()
        for soft, movable in leading(dae, wanted):
            x = _nearer(closed, q, t, (x, z), hard, soft, movable)
        related |= x != before
        before = x.copy()
        followed = None if others else _followed(closed, q, t, x, z)
        if followed is not None:
            z = followed
        else:
            x, z = _solve(closed, q, t, (x, z), free, hard, wanted)
        moved |= x != before
    return x, z, StartReport(dae, x.copy(), np.select([moved, related], [SOLVED, RELATED], KEPT), wanted)


def leading(dae: DAE, wanted: StartValues) -> Iterator[tuple[dict[int, float], list[int]]]:
    """Yield variables that are no states but whose start values lead, and the states they move."""
    names, states = dae.declared, set(dae.states)
    given = {*wanted.fixed, *wanted.guesses}
    open_ = [(i, s) for i, s in enumerate(dae.states) if s not in given]
    relative = [i for i, s in open_ if s < len(names.state) and names.state[s] > 0]
    if relative:
        led = {*states, *(i.variable for i in dae.inputs)}
        motions = [v for v in dae.derivative if v < len(names.state) and names.state[v] == 0 and v not in led]
        values = {v: wanted.guesses.get(v, float(names.start[v])) for v in motions}
        yield {v: value for v, value in values.items() if v not in wanted.fixed}, relative
    guessed = {v: value for v, value in wanted.guesses.items() if v not in states}
    if guessed:
        yield guessed, [i for i, _ in open_]


def _nearer(
    closed: BoundDAE,
    q: Array,
    t: float,
    start: tuple[Array, Array],
    hard: dict[int, float],
    soft: dict[int, float],
    movable: list[int],
) -> Array:
    """Move states so that `hard` is met and, as far as that allows, `soft` is nearest."""
    x, z = start[0].copy(), start[1]
    for _ in range(20):
        (h, to_h), (s, to_s) = (_missed(closed, aims, x, z, q, t)[:2] for aims in (hard, soft))
        to_h, to_s = to_h[:, movable], to_s[:, movable]
        must = np.linalg.pinv(to_h, rcond=1e-12) @ -h
        _, strength, right = np.linalg.svd(to_h)
        free = right[np.count_nonzero(strength > 1e-12 * strength.max(initial=0.0)) :].T
        may = free @ np.linalg.lstsq(to_s @ free, -(s + to_s @ must), rcond=1e-12)[0]
        step = must + may
        if not np.isfinite(step).all():
            return start[0]
        x[movable] += step
        if np.abs(step).max(initial=0.0) <= 1e-13 * (1 + np.abs(x).max(initial=0.0)):
            break
    return x


def guessed(dae: DAE, wanted: StartValues, variables: list[int]) -> Array:
    """Return where the search for start values begins."""
    starts = dae.declared.start
    values = []
    for v in variables:
        default = float(starts[v]) if v < len(starts) else 0.0
        values.append(wanted.fixed[v][1] if v in wanted.fixed else wanted.guesses.get(v, default))
    return np.array(values)


def _following(closed: BoundDAE, q: Array, t: float, wanted: StartValues) -> StartValues:
    """Return start_values with guesses for what starts where an input does."""
    dae = closed.dae
    known = {*wanted.fixed, *wanted.guesses}
    followed = {v: leader for v, leader in dae.followed.items() if v not in known}
    if not followed:
        return wanted
    x, z = (guessed(dae, wanted, variables) for variables in (dae.states, dae.algebraic))
    values = closed.tangent(tuple(leader for leader, _ in followed.values()), False)(x, z, q, t)[0].full()[
        :, 0
    ]
    signs = [sign for _, sign in followed.values()]
    return StartValues(
        wanted.fixed, wanted.guesses | dict(zip(followed, (values * signs).tolist(), strict=True))
    )


def _followed(closed: BoundDAE, q: Array, t: float, x: Array, start: Array) -> Array | None:
    """Return where algebraic unknowns follow the states; None if Newton finds no place."""
    z = start.copy()
    for _ in range(50 if len(z) else 0):
        value, _, slope = _missed(closed, {}, x, z, q, t, algebraic=True)
        if not (np.isfinite(value).all() and np.isfinite(slope).all()):
            return None
        step = np.linalg.lstsq(slope, -value, rcond=1e-12)[0]
        z += step
        if np.abs(step).max() <= 1e-13 * (1 + np.abs(z).max()):
            return z
    return None if len(z) else z


def _solve(
    closed: BoundDAE,
    q: Array,
    t: float,
    start: tuple[Array, Array],
    free: list[int],
    hard: dict[int, float],
    wanted: StartValues,
) -> tuple[Array, Array]:
    """Gauss-Newton with steps of least norm in the free states and z."""
    x, z = start[0].copy(), start[1].copy()
    for _ in range(50):
        value, to_x, to_z = _missed(closed, hard, x, z, q, t, algebraic=True)
        slope = np.hstack([to_x[:, free], to_z])
        if not np.isfinite(value).all():
            break
        step = np.linalg.lstsq(slope, -value, rcond=1e-12)[0] if slope.size else np.zeros(0)
        x[free] += step[: len(free)]
        z += step[len(free) :]
        if np.abs(step).max(initial=0.0) <= 1e-13 * (1 + np.abs(np.r_[x, z]).max(initial=0.0)):
            break
    value = _missed(closed, hard, x, z, q, t, algebraic=True)[0]
    blamed = "" if np.isfinite(value).all() else told_without_value(closed, x, z, q, t)
    if blamed:
        told = f"'{closed.dae.name}': its equations have no value at the start: {blamed}; {GUARD}"
        raise InitialConditionError(told)
    wrong = np.flatnonzero(~(np.abs(value) <= 1e-8 * (1 + np.abs(x).max(initial=0.0))))
    if len(wrong):
        raise InitialConditionError(_contradiction(closed.dae, list(hard), wrong, wanted))
    return x, z


def _missed(
    closed: BoundDAE, aims: dict[int, float], x: Array, z: Array, q: Array, t: float, algebraic: bool = False
) -> tuple[Array, Array, Array]:
    """Return by how much variables miss their aims (and algebraic equations zero), with slopes in x, z."""
    value, to_x, to_z = (m.full() for m in closed.tangent(tuple(aims), algebraic)(x, z, q, t))
    value[: len(aims), 0] -= list(aims.values())
    return value.ravel(), to_x, to_z


def _contradiction(dae: DAE, others: list[int], wrong: Any, wanted: StartValues) -> str:
    failed = {wanted.fixed[others[i]][0] for i in wrong if i < len(others)}
    told = {
        name: f"'{name}' = {dae.root(name)[1] * value:g} {dae.unit(name)}"
        for name, value in wanted.fixed.values()
    }
    if not failed:
        return f"'{dae.name}': no start satisfies the equations; give guess= for the states"
    kept = ", ".join(told[name] for name in told if name not in failed)
    given = f"with {kept}" if kept else "by any choice of the states"
    return (
        f"'{dae.name}': {', '.join(told[name] for name in failed)} cannot be reached {given}; give some "
        "as guess= instead of start="
    )
