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

from ...base import Array, InitialConditionError, ModelError, aligned, is_number
from ...base.html import page, table_of_texts
from ...components.language import Variable, values_of
from ..dae import DAE
from .blame import GUARD, told_without_value
from .bound_dae import BoundDAE
from .events.constants import LEAD_ROUNDS, MEET_ROUNDS, START_CLOSE, START_MISSED, START_WEAK
from .point import Point

SOLVED = "solved from fixed values of other variables"
RELATED = "from the start values of the motions it relates"
AS_GUESSED = "guess kept"


START_HEADERS = ("state", "start", "unit", "decided")


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

    def __str__(self) -> str:
        return "\n".join(aligned([START_HEADERS, *self._rows()], right={1}))

    def _repr_html_(self) -> str:
        return page(self.dae.name, "start values", table_of_texts(START_HEADERS, self._rows()))

    def _rows(self) -> list[tuple[str, ...]]:
        return [(one.name, f"{one.value:.6g}", one.unit, one.reason) for one in self]


@dataclass(eq=False)
class StartValues:
    """Start values by joined variable: fixed ones and guesses, each with the name it was given by."""

    fixed: dict[int, tuple[str, float]]
    guesses: dict[int, float]

    def giving_way(self) -> StartValues:
        """Return the same with what was fixed as guesses, behind those there are."""
        return StartValues({}, {v: value for v, (_, value) in self.fixed.items()} | self.guesses)


def start_values(dae: DAE, start: Mapping[str, float], guess: Mapping[str, float]) -> StartValues:
    """Gather start values from components and from the run (which goes first).

    Where the run fixes every state, it leaves components nothing to fix.

    Raises:
        ModelError: for unknown names.
        InitialConditionError: for two different fixed values of one variable.
    """
    _check_names(dae, {**start, **guess})
    from_run = {dae.root(name)[0] for name in start}
    everywhere = bool(dae.states) and from_run.issuperset(dae.states)
    given = {n: v for n, v in _given(dae) if not everywhere and dae.root(n)[0] not in from_run}
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
    roots = {name: dae.root(name) for name in guess}
    return StartValues(fixed, {root: sign * float(guess[name]) for name, (root, sign) in roots.items()})


def _given(dae: DAE) -> Iterator[tuple[str, float]]:
    """Yield the start values that components were given."""
    for instance in dae.flat.instances.values():
        fields = type(instance.component).fields
        for name, value in values_of(instance.component).items():
            if isinstance(fields.get(name), Variable):
                yield f"{instance.path}.{name}".lstrip("."), float(value)


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


def initial_values(closed: BoundDAE, q: Array, t: float, wanted: StartValues) -> tuple[Point, StartReport]:
    """Return where a run begins, and how that was decided.

    Raises:
        InitialConditionError: if no start satisfies the fixed values.
    """
    dae = closed.dae
    wanted = following(closed, q, t, wanted)
    point = Point(t, *guessed(dae, wanted), q)
    states = set(dae.states)
    hard = {v: value for v, (_, value) in wanted.fixed.items() if v not in states}
    related, solved = np.zeros((2, len(point.x)), dtype=bool)
    for _ in range(2 if hard else 1):
        before = point.x
        for soft, movable in leading(dae, wanted):
            point = _nearer(closed, point, hard, soft, movable)
        related |= point.x != before
        before = point.x
        if hard or len(point.z):
            there, found = (point, False) if hard else _gauss_newton(closed, point, [], {})
            point = there if found else _met(closed, point, hard, wanted)
        solved |= point.x != before
    reasons = np.select([solved, related], [SOLVED, RELATED], AS_GUESSED)
    return point, StartReport(dae, point.x.copy(), reasons, wanted)


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
    closed: BoundDAE, start: Point, hard: dict[int, float], soft: dict[int, float], movable: list[int]
) -> Point:
    """Move states so that `hard` is met and, as far as that allows, `soft` is nearest."""
    point = start.copy()
    for _ in range(LEAD_ROUNDS):
        s, to_s = _missed(closed, soft, point)[:2]
        step = _step(_missed(closed, hard, point)[:2] if hard else None, s, to_s, movable)
        if not np.isfinite(step).all():
            return start
        point.x[movable] += step
        if np.abs(step).max(initial=0.0) <= START_CLOSE * (1 + np.abs(point.x).max(initial=0.0)):
            break
    return point


def _step(hard: tuple[Array, Array] | None, s: Array, to_s: Array, movable: list[int]) -> Array:
    """Return the step of movable states that takes s to zero as nearly as what is `hard` allows."""
    to_s = to_s[:, movable]
    if hard is None:
        return np.asarray(np.linalg.lstsq(to_s, -s, rcond=START_WEAK)[0], dtype=float)
    h, to_h = hard[0], hard[1][:, movable]
    must = np.linalg.pinv(to_h, rcond=START_WEAK) @ -h
    _, strength, right = np.linalg.svd(to_h)
    free = right[np.count_nonzero(strength > START_WEAK * strength.max(initial=0.0)) :].T
    may = free @ np.linalg.lstsq(to_s @ free, -(s + to_s @ must), rcond=START_WEAK)[0]
    step: Array = must + may
    return step


def guessed(dae: DAE, wanted: StartValues) -> tuple[Array, Array]:
    """Return states and algebraic unknowns where the search for start values begins."""
    starts = dae.declared.start
    known = wanted.guesses | {v: value for v, (_, value) in wanted.fixed.items()}

    def value(variable: int) -> float:
        return known.get(variable, float(starts[variable]) if variable < len(starts) else 0.0)

    return np.array([*map(value, dae.states)]), np.array([*map(value, dae.algebraic)])


def following(closed: BoundDAE, q: Array, t: float, wanted: StartValues) -> StartValues:
    """Return start values with guesses for what starts where an input does."""
    known = {*wanted.fixed, *wanted.guesses}
    followed = {v: leader for v, leader in closed.dae.followed.items() if v not in known}
    if not followed:
        return wanted
    aims = {leader: 0.0 for leader, _ in followed.values()}
    guess = Point(t, *guessed(closed.dae, wanted), q)
    values = dict(zip(aims, _missed(closed, aims, guess)[0].tolist(), strict=True))
    guesses = {v: sign * values[leader] for v, (leader, sign) in followed.items()}
    return StartValues(wanted.fixed, wanted.guesses | guesses)


def _gauss_newton(
    closed: BoundDAE, start: Point, free: list[int], aims: dict[int, float]
) -> tuple[Point, bool]:
    """Meet aims and equations by steps of least norm in free states and z; tell whether they came to rest."""
    point = start.copy()
    for _ in range(MEET_ROUNDS):
        value, to_x, to_z = _missed(closed, aims, point, algebraic=True)
        slope = np.hstack([to_x[:, free], to_z])
        if not (np.isfinite(value).all() and np.isfinite(slope).all()):
            break
        step = np.linalg.lstsq(slope, -value, rcond=START_WEAK)[0]
        point.x[free] += step[: len(free)]
        point.z += step[len(free) :]
        size = np.abs(np.append(point.x, point.z)).max(initial=0.0)
        if np.abs(step).max(initial=0.0) <= START_CLOSE * (1 + size):
            return point, True
    return point, False


def _met(closed: BoundDAE, start: Point, hard: dict[int, float], wanted: StartValues) -> Point:
    """Move free states and z so that fixed values and equations hold."""
    free = [i for i, s in enumerate(closed.dae.states) if s not in wanted.fixed]
    point, _ = _gauss_newton(closed, start, free, hard)
    missed = _missed(closed, hard, point, algebraic=True)
    size = 1 + np.abs(point.x).max(initial=0.0)
    wrong = np.flatnonzero(~(np.abs(missed[0]) <= START_MISSED * size))
    if not len(wrong):
        return point
    finite = all(np.isfinite(m).all() for m in missed)
    blamed = "" if finite else told_without_value(closed, point)
    if blamed:
        told = f"'{closed.dae.name}': its equations have no value at the start: {blamed}; {GUARD}"
        raise InitialConditionError(told)
    raise InitialConditionError(_contradiction(closed.dae, list(hard), wrong, wanted))


def _missed(
    closed: BoundDAE, aims: dict[int, float], point: Point, algebraic: bool = False
) -> tuple[Array, Array, Array]:
    """Return by how much variables miss their aims (and algebraic equations zero), with slopes in x, z."""
    tangent = closed.tangent(tuple(aims), algebraic)
    value, *slopes = tangent(point.x, point.z, point.q, point.t)
    to_x, to_z = (
        slope.reshape(len(moved), len(value)).T
        for slope, moved in zip(slopes, (point.x, point.z), strict=True)
    )
    value[: len(aims)] -= list(aims.values())
    return value, to_x, to_z


def _contradiction(dae: DAE, others: list[int], wrong: Any, wanted: StartValues) -> str:
    told = {
        name: f"'{name}' = {dae.root(name)[1] * value:g} {dae.unit(name)}"
        for name, value in wanted.fixed.values()
    }
    failed = ", ".join(told.pop(wanted.fixed[others[i]][0]) for i in wrong if i < len(others))
    if not failed:
        return f"'{dae.name}': no start satisfies the equations; give guess= for the states"
    given = f"with {', '.join(told.values())}" if told else "by any choice of the states"
    return f"'{dae.name}': {failed} cannot be reached {given}; give some as guess= instead of start="
