"""Resting: the equilibrium nearest to a point, in modes that are consistent there."""

from __future__ import annotations

from typing import Any
from weakref import WeakKeyDictionary

import casadi as ca
import numpy as np

from ...base import Array, InitialConditionError, ModelError, SimulationError
from ..dae import DAE
from ..simulation.blame import GUARD, told_without_value
from ..simulation.bound_dae import BoundDAE
from ..simulation.consistent_start import begun
from ..simulation.events.switcher import Switcher
from ..simulation.initialization import StartValues
from ..simulation.point import Point, solve_algebraic

REST_ACCURACY = 1e-9
STANDING_SPEED = 1e-12
SHARES_OF_THE_WAY = (0.25, 0.5, 0.75, 0.999)
HOLDING_MODES = ("stuck", "contact")
_REST_FUNCTIONS: WeakKeyDictionary[BoundDAE, Any] = WeakKeyDictionary()


def settle(closed: BoundDAE, point: Point, switcher: Switcher | None) -> list[str]:
    """Move a point to the nearest equilibrium, in modes that are consistent there."""
    for _ in range(20):
        before = Point(point.t, point.x.copy(), point.z.copy(), point.q)
        notes = _rest(closed, point)
        if switcher is None:
            return notes
        _keep_this_side(closed, before, point, switcher)
        try:
            events = switcher.settle(point, begins=True)
        except SimulationError as error:
            raise ModelError(f"'{closed.dae.name}': {error}") from error
        if not events and not _holds_at_rest(closed, point):
            return notes
    raise ModelError(
        f"'{closed.dae.name}': no equilibrium in consistent modes was found; what holds breaks away. "
        "Give start= nearer to it"
    )


def _keep_this_side(closed: BoundDAE, before: Point, point: Point, switcher: Switcher) -> None:
    """Move a point back along the straight way to it, to where a mode switches first: to a stop, say."""

    def passed(share: float) -> Point:
        x, z = (a + share * (b - a) for a, b in ((before.x, point.x), (before.z, point.z)))
        there = Point(point.t, x, z, point.q.copy())
        solve_algebraic(closed, there)
        return there

    def switches(share: float) -> bool:
        try:
            return bool(switcher.copy().settle(passed(share)))
        except SimulationError:
            return True

    last = next((share for share in SHARES_OF_THE_WAY if switches(share)), None)
    if last is None:
        return
    first = max(share for share in (0.0, *SHARES_OF_THE_WAY) if share < last)
    while first < (middle := (first + last) / 2) < last:
        first, last = (first, middle) if switches(middle) else (middle, last)
    there = passed(last)
    point.x, point.z = there.x, there.z


def _holds_at_rest(closed: BoundDAE, point: Point) -> bool:
    """Let what slid up to an equilibrium hold there, as if it had stood there; tell whether it does."""
    dae = closed.dae
    blank = closed.blank(point.q[: dae.p.numel()])
    standing = np.where(np.abs(point.x) < STANDING_SPEED, 0.0, point.x).tolist()
    fixed = zip(dae.states, zip(dae.state_names, standing, strict=True), strict=True)
    try:
        there = begun(closed, blank, point.t, StartValues(dict(fixed), {})).point
    except (InitialConditionError, SimulationError):
        return False
    holds = set(_held_states(dae, point.q)) < set(_held_states(dae, there.q))
    if holds:
        point.x, point.z, point.q = there.x, there.z, there.q
    return holds


def _rest(closed: BoundDAE, point: Point) -> list[str]:
    """Solve ode = 0, alg = 0 by damped Gauss-Newton steps of least norm."""
    dae = closed.dae
    if closed not in _REST_FUNCTIONS:
        residual = closed.close(ca.vertcat(dae.ode, dae.alg))
        slopes = ca.horzcat(ca.jacobian(residual, closed.x), ca.jacobian(residual, closed.z))
        _REST_FUNCTIONS[closed] = closed.function("rest", residual, slopes)
    split, held = len(point.x), _held_states(dae, point.q)
    y = np.concatenate([point.x, point.z])

    def at(y: Array) -> tuple[Array, Array]:
        value, slope = (m.full() for m in _REST_FUNCTIONS[closed](y[:split], y[split:], point.q, point.t))
        slope[:, held] = 0.0
        return value.ravel(), slope

    value, slope = at(y)
    if not (np.isfinite(value).all() and np.isfinite(slope).all()):
        blamed = told_without_value(closed, point)
        raise ModelError(
            f"'{dae.name}': its equations have no value or slope at the start: "
            f"{blamed or 'a parameter of 0 may remove what they are solved for'}; {GUARD}"
        )
    for _ in range(100):
        rows, length = _scales(slope), 1.0
        least = (
            np.linalg.lstsq(slope / rows[:, None], -value / rows, rcond=1e-12)[0] if slope.size else 0.0 * y
        )
        step = np.asarray(least, dtype=float)
        while length > 1e-6:
            trial = at(y + length * step)
            enough = _size(value, slope) * (1 - 0.1 * length)
            if np.isfinite(trial[0]).all() and _size(trial[0], slope) <= enough:
                break
            length /= 2
        y, (value, slope) = y + length * step, at(y + length * step)
        if np.abs(length * step).max(initial=0.0) <= 1e-14 * (1 + np.abs(y).max(initial=0.0)):
            break
    _check_rest(dae, value, slope, y)
    point.x, point.z = y[:split], y[split:]
    return _free_directions(dae, slope, held)


def _scales(slope: Array) -> Array:
    rows: Array = np.abs(slope).max(axis=1, initial=0.0)
    return np.where(rows == 0, 1.0, rows)


def _size(value: Array, slope: Array) -> float:
    return float(np.abs(value / _scales(slope)).max(initial=0.0))


def _check_rest(dae: DAE, value: Array, slope: Array, y: Array) -> None:
    left = np.abs(value / _scales(slope))
    moving = np.flatnonzero(~(left <= REST_ACCURACY * (1 + np.abs(y).max(initial=0.0))))
    if not len(moving):
        return
    names = dae.state_names
    told = ", ".join(f"der({names[i]}) = {value[i]:.4g}" for i in moving if i < len(names)) or "its equations"
    raise ModelError(
        f"'{dae.name}' has no equilibrium near its start: {told} remains. A force or speed drives it "
        "on; give start= nearer to rest, other inputs=, or linearise at='start' or at a run"
    )


def _held_states(dae: DAE, q: Array) -> list[int]:
    """Return the states of what holds: they stay where they are."""
    holding = {
        name.rpartition(".")[0] for name, value in mode_values(dae, q).items() if value in HOLDING_MODES
    }
    return [k for k, name in enumerate(dae.state_names) if name.rpartition(".")[0] in holding]


def _free_directions(dae: DAE, slope: Array, held: list[int]) -> list[str]:
    """Tell motions along which the equilibrium may be shifted."""
    if not slope.size:
        return []
    slope = np.vstack([slope, np.eye(slope.shape[1])[held]])
    _, strength, right = np.linalg.svd(slope / _scales(slope)[:, None])
    rank = int(np.count_nonzero(strength > 1e-12 * strength.max(initial=1e-300)))
    free = np.abs(right[rank:, : len(dae.state_names)])
    moving = free > 1e-3 * free.max(axis=1, keepdims=True, initial=0.0)
    directions = (", ".join(np.array(dae.state_names)[names]) for names in moving)
    taken = "the one nearest to the start is taken"
    return [f"the equilibrium is free along {direction}; {taken}" for direction in directions]


def mode_values(dae: DAE, q: Array) -> dict[str, str]:
    """Return the name of each mode's value."""
    switching, at = dae.switching, dae.p.numel()
    numbers = q[at : at + len(switching.mode_names)].astype(int)
    named = zip(switching.mode_names, switching.mode_values, numbers, strict=True)
    return {name: values[number] for name, values, number in named}
