"""Operating points: where a network is looked at, in which modes, and how the point was found."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any
from weakref import WeakKeyDictionary

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from ...components.base import (
    ModelError,
    SimulationError,
    between,
    demand,
    finite,
    instance,
    named,
    text,
    whole,
)
from ..blame import GUARD, told_without_value
from ..closed import Closed
from ..coverage import check_covered
from ..dae import DAE
from ..events import Point, Switcher
from ..initial import wishes
from ..keywords import check_keywords
from ..result import Result
from ..run import Settings
from ..simulate import started

Array = NDArray[np.float64]
TINY = 1e-9
HOLDING = ("stuck", "contact")
_KNOWN: WeakKeyDictionary[Closed, Any] = WeakKeyDictionary()


@dataclass(eq=False)
class OperatingPoint:
    """States, algebraic unknowns, inputs and constants at one instant, and what is to be known about them.

    Attributes:
        values: states by name.
        modes: name of each mode's present value.
        notes: free directions, other equilibria, friction that holds.
    """

    dae: DAE
    t: float
    x: Array
    z: Array
    u: Array
    q: Array
    notes: list[str] = field(default_factory=list)

    @property
    def values(self) -> dict[str, float]:
        """States by name."""
        return dict(zip(self.dae.state_names, map(float, self.x), strict=True))

    @property
    def modes(self) -> dict[str, str]:
        """Name of each mode's present value."""
        return _mode_values(self.dae, self.q)


def operating_point(
    dae: DAE,
    at: str | Result = "equilibrium",
    *,
    time: float = 0.0,
    start: Mapping[str, float] | None = None,
    inputs: Mapping[str, Any] | None = None,
    parameters: Mapping[str, float] | None = None,
) -> OperatingPoint:
    """Return where a network stands still, where it starts, or where a run was.

    Args:
        dae: the equations.
        at: "equilibrium" (nearest to the start), "start", or a `Result` to look at.
        time: instant [s], of a run or of the signals.
        start: start values by name, from which the equilibrium is looked for.
        inputs: signals by name; 0 where an input has none. At an equilibrium they keep their value at `time`.
        parameters: changed parameters by name.

    Raises:
        ModelError: for an unknown `at`, or if there is no equilibrium.
    """
    demand("operating_point()", dae=(dae, instance(DAE)), time=(time, finite("s")))
    if isinstance(at, Result):
        return _of_run(at, time)
    if text(at) or at not in ("equilibrium", "start"):
        raise ModelError(f"'{dae.name}': at is 'equilibrium', 'start' or a Result, got {at!r}")
    signals = {i.path: 0.0 for i in dae.inputs if i.order == 0 and i.signal is None} | named("inputs", inputs)
    check_covered(dae.name, dae.closed(signals).signals, time, time)
    if at == "equilibrium":
        signals = _held(dae, signals, time)
    closed = dae.closed(signals)
    numbers = dae.system.flat.table.values(named("parameters", parameters))
    q = np.concatenate([numbers, np.zeros(closed.q.numel() - len(numbers))])
    settings = Settings(time, time + 1.0, 1.0, 1e-6, 1e-8, "auto", False)
    run = started(closed, settings, q, wishes(dae, named("start", start), {}))
    notes = list(run.switcher.notes) if run.switcher else []
    if at == "equilibrium":
        notes += _settle(closed, run.point, run.switcher)
    notes += _holding(dae, run.point.q)
    return _point(closed, run.point, notes)


def equilibria(
    dae: DAE, starts: int = 30, spread: float = 1.0, *, seed: int = 0, **options: Any
) -> list[OperatingPoint]:
    """Return the equilibria that a search from several starts finds, each once, nearest first.

    Args:
        dae: the equations.
        starts: number of random starts.
        spread: their standard deviation about the start, in the SI unit of each state.
        seed: of the random starts.
        options: `inputs`, `parameters`, `start` as for `operating_point`.

    Raises:
        ModelError: if none is found.
    """
    demand(
        "equilibria()",
        dae=(dae, instance(DAE)),
        starts=(starts, whole(0)),
        spread=(spread, between(0, 1e100)),
        seed=(seed, whole(0)),
    )
    check_keywords("equilibria()", options, operating_point)
    begin = named("start", options.pop("start", None))
    rng = np.random.default_rng(seed)
    first = operating_point(dae, "start", start=begin, **options)
    found: list[OperatingPoint] = []
    problem: ModelError | None = None
    for k in range(starts + 1):
        tried = first.x + (spread * rng.standard_normal(len(first.x)) if k else 0.0)
        values = dict(zip(dae.state_names, tried, strict=True)) | begin
        try:
            point = operating_point(dae, start=values, **options)
        except ModelError as error:
            problem = error
            continue
        if not any(np.allclose(point.x, other.x, rtol=1e-6, atol=1e-8) for other in found):
            found.append(point)
    if not found and problem:
        raise problem
    return found


def _held(dae: DAE, signals: dict[str, Any], time: float) -> dict[str, Any]:
    """Return every signal's value at an instant, as a constant."""
    closed = dae.closed(signals)
    values = ca.Function("signals", [closed.t], [closed.u])(time).full().ravel()
    return {i.path: float(i.sign * v) for i, v in zip(dae.inputs, values, strict=True) if i.order == 0}


def _of_run(run: Result, time: float) -> OperatingPoint:
    segments = run._segments
    for segment in segments:
        times = np.concatenate(segment.times)
        if times[0] <= time <= times[-1]:
            break
    else:
        begin, end = run.time[0], run.time[-1]
        raise ModelError(f"'{run.name}' ran from {begin:g} s to {end:g} s, not to {time:g} s")
    rows = np.vstack(segment.states), np.vstack(segment.algebraic)
    x, z = (np.array([np.interp(time, times, column) for column in table.T]) for table in rows)
    closed = run._closed
    point = Point(time, x, z, segment.q.copy())
    return _point(closed, point, _holding(closed.dae, point.q))


def _point(closed: Closed, point: Point, notes: list[str]) -> OperatingPoint:
    u = ca.Function("u", [closed.t], [closed.u])(point.t).full().ravel()
    return OperatingPoint(closed.dae, point.t, point.x, point.z, u, point.q, notes)


def _settle(closed: Closed, point: Point, switcher: Switcher | None) -> list[str]:
    """Move a point to the nearest equilibrium, in modes that are consistent there."""
    for _ in range(20):
        notes = _rest(closed, point)
        if switcher is None:
            return notes
        try:
            events = switcher.settle(point, begins=True)
        except SimulationError as error:
            raise ModelError(f"'{closed.dae.name}': {error}") from error
        if not events:
            return notes
    raise ModelError(
        f"'{closed.dae.name}': no equilibrium in consistent modes was found; what holds breaks away. "
        "Give start= nearer to it"
    )


def _rest(closed: Closed, point: Point) -> list[str]:
    """Solve ode = 0, alg = 0 by damped Gauss-Newton steps of least norm."""
    dae = closed.dae
    function = _rest_function(closed)
    split = len(point.x)
    held = _held_states(dae, point.q)
    y = np.concatenate([point.x, point.z])

    def at(y: Array) -> tuple[Array, Array]:
        value, slope = function(y[:split], y[split:], point.q, point.t)
        slope = slope.full()
        slope[:, held] = 0.0
        return value.full().ravel(), slope

    value, slope = at(y)
    if not (np.isfinite(value).all() and np.isfinite(slope).all()):
        blamed = told_without_value(closed, point.x, point.z, point.q, point.t)
        raise ModelError(
            f"'{dae.name}': its equations have no value or slope at the start: "
            f"{blamed or 'a parameter of 0 may remove what they are solved for'}; {GUARD}"
        )
    for _ in range(100):
        step = _least_step(value, slope)
        length = 1.0
        while length > 1e-6:
            trial = at(y + length * step)
            if np.isfinite(trial[0]).all() and _size(trial[0], slope) <= _size(value, slope) * (
                1 - 0.1 * length
            ):
                break
            length /= 2
        y, (value, slope) = y + length * step, at(y + length * step)
        if np.abs(length * step).max(initial=0.0) <= 1e-14 * (1 + np.abs(y).max(initial=0.0)):
            break
    _check_rest(dae, value, slope, y)
    point.x, point.z = y[:split], y[split:]
    return _free_directions(dae, slope, held)


def _rest_function(closed: Closed) -> Any:
    """Return what must vanish at rest, and its slopes; compiled once."""
    if closed not in _KNOWN:
        residual = closed.close(ca.vertcat(closed.dae.ode, closed.dae.alg))
        slopes = ca.horzcat(ca.jacobian(residual, closed.x), ca.jacobian(residual, closed.z))
        _KNOWN[closed] = closed.function("rest", residual, slopes)
    return _KNOWN[closed]


def _scales(slope: Array) -> Array:
    rows: Array = np.abs(slope).max(axis=1, initial=0.0)
    rows[rows == 0] = 1.0
    return rows


def _size(value: Array, slope: Array) -> float:
    return float(np.abs(value / _scales(slope)).max(initial=0.0))


def _least_step(value: Array, slope: Array) -> Array:
    if not slope.size:
        return np.zeros(slope.shape[1])
    rows = _scales(slope)
    step: Any = np.linalg.lstsq(slope / rows[:, None], -value / rows, rcond=1e-12)[0]
    return np.asarray(step, dtype=float)


def _check_rest(dae: DAE, value: Array, slope: Array, y: Array) -> None:
    left = np.abs(value / _scales(slope))
    moving = np.flatnonzero(~(left <= TINY * (1 + np.abs(y).max(initial=0.0))))
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
    holding = {name.rpartition(".")[0] for name, value in _mode_values(dae, q).items() if value in HOLDING}
    return [k for k, name in enumerate(dae.state_names) if name.rpartition(".")[0] in holding]


def _free_directions(dae: DAE, slope: Array, held: list[int]) -> list[str]:
    """Tell motions along which the equilibrium may be shifted."""
    if not slope.size:
        return []
    slope = np.vstack([slope, np.eye(slope.shape[1])[held]])
    _, strength, right = np.linalg.svd(slope / _scales(slope)[:, None])
    rank = int(np.count_nonzero(strength > 1e-12 * strength.max(initial=1e-300)))
    free = np.abs(right[rank:, : len(dae.state_names)])
    notes = []
    for direction in free:
        names = [n for n, c in zip(dae.state_names, direction, strict=True) if c > 1e-3 * direction.max()]
        notes.append(
            f"the equilibrium is free along {', '.join(names)}; the one nearest to the start is taken"
        )
    return notes


def _mode_values(dae: DAE, q: Array) -> dict[str, str]:
    switching, at = dae.switching, dae.p.numel()
    numbers = q[at : at + len(switching.mode_names)]
    named = zip(switching.mode_names, switching.mode_values, numbers, strict=True)
    return {name: values[int(number)] for name, values, number in named}


def _holding(dae: DAE, q: Array) -> list[str]:
    return [
        f"{name} is '{value}': linear only while it holds"
        for name, value in _mode_values(dae, q).items()
        if value in HOLDING
    ]
