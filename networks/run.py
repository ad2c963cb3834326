"""A run in progress: where it stands, what it has recorded, and how it fails."""

from __future__ import annotations

from dataclasses import dataclass, field
from numbers import Real
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..components.base import ModelError, SimulationError
from .closed import Closed
from .events import Event, Switcher
from .initial import Decisions
from .point import Point
from .result import Segment
from .stepper import Array, IntegratorError, Stepper, Stretch, Tolerance


@dataclass(frozen=True)
class Settings:
    """What a run is asked to be."""

    begin: float
    stop: float
    step: float | None
    rtol: float
    atol: float
    solver: str
    progress: bool | None
    max_steps: int | None = None

    def __post_init__(self) -> None:
        named = {name: getattr(self, name) for name in ("begin", "stop", "step", "rtol", "atol")}
        if self.step is None:
            del named["step"]
        problems = [
            f"{name} must be a number, got {value!r}"
            for name, value in named.items()
            if not isinstance(value, Real)
        ]
        if problems:
            raise ModelError("this run cannot be done:", problems)
        if not all(np.isfinite([*named.values()])):
            problems.append("begin, stop, step, rtol and atol must be finite numbers")
        elif not self.stop > self.begin:
            problems.append(f"stop must be after begin ({self.begin:g} s), got {self.stop:g} s")
        for name, unit in (("step", " s"), ("rtol", ""), ("atol", "")):
            value = named.get(name, 1.0)
            if value <= 0:
                problems.append(f"{name} must be above 0{unit}, got {value:g}{unit}")
        if self.max_steps is not None and not self.max_steps > 0:
            problems.append(f"max_steps must be above 0, got {self.max_steps!r}")
        if problems:
            raise ModelError("this run cannot be done:", problems)

    @property
    def tolerance(self) -> Tolerance:
        """Relative and absolute tolerance."""
        return Tolerance(self.rtol, self.atol)

    @property
    def outputs(self) -> NDArray[np.float64]:
        """Output instants, 501 if there is no step; a step is adjusted to divide the run."""
        count = 500 if self.step is None else max(1, round((self.stop - self.begin) / self.step))
        return np.linspace(self.begin, self.stop, count + 1)


@dataclass(eq=False)
class Run:
    """A run in progress: where it stands and what it has recorded."""

    closed: Closed
    settings: Settings
    point: Point
    switcher: Switcher | None
    initial: Decisions
    segments: list[Segment] = field(default_factory=list)
    events: list[Event] = field(default_factory=list)
    calls: int = 0
    steps: int = 0
    limiting: str = ""

    def record(self, times: Any, states: Any, algebraic: Any) -> None:
        """Append points to the present segment."""
        self.segments[-1].extend(np.atleast_1d(times), np.atleast_2d(states), np.atleast_2d(algebraic))

    def count(self, steps: int) -> None:
        """Add to the steps done.

        Raises:
            SimulationError: if they are more than were granted.
        """
        self.steps += steps
        most = self.settings.max_steps
        if most is not None and self.steps > most:
            raise SimulationError(f"given up after {self.steps} steps: max_steps = {most} grants no more")

    def open_segment(self) -> None:
        """Start a segment at the present point, with its modes."""
        p = self.point
        self.segments.append(Segment(p.q.copy()))
        self.record(p.t, p.x, p.z)


def integrate(run: Run, stepper: Stepper, point: Point, span: float) -> Stretch:
    """Integrate one stretch; when that fails at once, from node to node."""
    try:
        return attempt(run, stepper, point, span)
    except IntegratorError:
        return _node_by_node(run, stepper, point, span)


def attempt(run: Run, stepper: Stepper, point: Point, span: float) -> Stretch:
    """Integrate one stretch at once."""
    run.calls += 1
    stretch = stepper.run(point.t, point.x, point.z, point.q, span)
    run.count(stretch.steps)
    return stretch


def _node_by_node(run: Run, stepper: Stepper, point: Point, span: float) -> Stretch:
    """Integrate each interval on its own, which allows more steps; save what is reached on failure."""
    step = span / stepper.nodes
    t, x, z, steps = point.t, point.x, point.z, 0
    states: list[Array] = []
    algebraic: list[Array] = []
    for number in range(stepper.nodes):
        try:
            piece = stepper.run(t, x, z, point.q, step)
        except IntegratorError:
            if number:
                times = point.t + step * np.arange(1, number + 1)
                run.record(times, np.array(states), np.array(algebraic))
            _approach(run, stepper, Point(t, x, z, point.q), step)
            raise
        t, x, z = t + step, piece.states[-1], piece.algebraic[-1]
        states.append(x)
        algebraic.append(z)
        steps += piece.steps
        run.count(piece.steps)
    return Stretch(np.array(states), np.array(algebraic), steps)


def _approach(run: Run, stepper: Stepper, point: Point, span: float) -> None:
    """Advance towards a failure in ever smaller strides, recording what is reached."""
    t, x, z = point.t, point.x, point.z
    smallest = max(1e-6 * span, 1e-14 * abs(t))
    while span > smallest:
        span /= 2
        try:
            stretch = stepper.run(t, x, z, point.q, span)
        except IntegratorError:
            continue
        run.count(stretch.steps)
        times = t + span * np.arange(1, stepper.nodes + 1) / stepper.nodes
        run.record(times, stretch.states, stretch.algebraic)
        t, x, z = float(times[-1]), stretch.states[-1], stretch.algebraic[-1]
    run.point = Point(t, x, z, point.q)


def limiting_state(run: Run) -> str:
    """Name the state that bends most for its tolerance at most outputs: the one that limits steps."""
    if run.limiting:
        return run.limiting
    settings, dae = run.settings, run.closed.dae
    votes = np.zeros(len(dae.states), dtype=int)
    for segment in run.segments:
        states = np.vstack(segment.states)
        if len(states) > 2 and dae.states:
            bend = np.abs(states[2:] - 2 * states[1:-1] + states[:-2])
            weight = settings.rtol * np.abs(states[1:-1]) + settings.atol
            votes += np.bincount((bend / weight).argmax(axis=1), minlength=len(votes))
    return dae.system.name(dae.states[int(votes.argmax())]) if votes.any() else ""


def failure(run: Run, error: Exception) -> str:
    """Say when a run ended and which state was bending most for its tolerance."""
    dae, point, settings = run.closed.dae, run.point, run.settings
    if isinstance(error, SimulationError):
        return f"'{dae.name}': {error}"
    rate, bend = _motion(run)
    wrong = [dae.state_names[i] for i in np.flatnonzero(~np.isfinite(rate))]
    if wrong:
        return (
            f"'{dae.name}': at t = {point.t:.9g} s the rate of {', '.join(wrong[:5])} is not a finite "
            "number; an input, a division by zero, or a root of a negative number there makes it so. "
            "Results up to there are kept in the error's `result`"
        )
    weight = bend / (settings.rtol * np.abs(point.x) + settings.atol)
    worst = int(np.argmax(np.where(np.isfinite(weight), weight, np.inf))) if len(rate) else 0
    name = dae.state_names[worst] if len(rate) else "no state"
    state = f"{name} = {point.x[worst]:.6g} with rate {rate[worst]:.6g}" if len(rate) else name
    reason = str(error).strip().splitlines()[-1]
    return (
        f"'{dae.name}': integration failed at t = {point.t:.9g} s; the state that limited the step is "
        f"{state}. If it is really that fast, give a smaller step=. Results up to there are kept in the "
        f"error's `result`. Solver: {reason}"
    )


def _motion(run: Run) -> tuple[Array, Array]:
    """Return the rates of the states where a run stands, and the size of the rates' own rates."""
    closed, point = run.closed, run.point
    ode = closed.close(closed.dae.ode)
    function = closed.function("motion", ode, closed.rate(ode))
    rate, bend = (m.full().ravel() for m in function(point.x, point.z, point.q, point.t))
    return rate, np.abs(bend)
