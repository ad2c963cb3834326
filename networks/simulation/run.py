"""A run in progress: where it stands, what it has recorded, and how it fails."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from ...base import Array, Interrupted, SimulationError
from ..results.result import Segment
from .blame import GUARD, told_without_value
from .bound_dae import BoundDAE
from .events.switcher import Event, Switcher, pushed
from .initialization import StartReport
from .integrator import IntegratorError, Stepper, Stretch
from .legs import Leg
from .point import Point, solve_algebraic
from .settings import Settings


@dataclass(eq=False)
class Run:
    """A run in progress: where it stands and what it has recorded.

    `tried` is what q was when start values and modes were sought that agree.
    """

    closed: BoundDAE
    settings: Settings
    point: Point
    switcher: Switcher | None
    initial: StartReport
    tried: Array = field(default_factory=lambda: np.zeros(0))
    legs: list[Leg] = field(default_factory=lambda: [Leg(-np.inf, np.inf)])
    leg_number: int = 0
    segments: list[Segment] = field(default_factory=list)
    events: list[Event] = field(default_factory=list)
    calls: int = 0
    steps: int = 0
    limiting: str = ""

    @property
    def leg(self) -> Leg:
        """The leg on which the run is."""
        return self.legs[self.leg_number]

    @property
    def max_step(self) -> float:
        """The longest step that the present leg and the settings allow [s]."""
        return min(self.leg.max_step, self.settings.max_step)

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


def enter_next_leg(run: Run) -> bool:
    """Go on to the next leg if the present one is done, fire what fires there; tell whether it was.

    What was given may jump there: two points, before and after, share that instant.
    """
    if run.point.t < run.leg.end or run.leg_number + 1 == len(run.legs):
        return False
    shocks, last = run.closed.shocks, run.leg.end
    run.leg_number += 1
    jumps = run.leg.jumps
    if jumps:
        record_here(run)
    seen = shocks.seen(replace(run.point, t=last)) if shocks and jumps else None
    point = run.point = Point(run.leg.begin, run.point.x.copy(), run.point.z.copy(), run.point.q)
    if jumps:
        solve_algebraic(run.closed, point)
    happened = shock(run, seen) if seen is not None else []
    happened += run.switcher.settle(point) if run.switcher else []
    run.events += happened
    if jumps or happened:
        run.open_segment()
    return True


def shock(run: Run, seen: Array) -> list[Event]:
    """Let what is given act where it has jumped."""
    if run.switcher:
        return run.switcher.jump(run.point, seen, {})
    shocks = run.closed.shocks
    assert shocks is not None
    size = shocks.since(seen, run.point, {})
    if not size.any():
        return []
    states = run.point.x
    pushes = shocks.act(run.point, size)
    if np.array_equal(run.point.x, states) and not pushes.any():
        return []
    solve_algebraic(run.closed, run.point)
    return pushed(run.point.t, shocks.jumps, pushes)


def record_here(run: Run) -> None:
    """Record where a run stands, unless that was done."""
    point = run.point
    if point.t > run.segments[-1].times[-1][-1]:
        run.record(point.t, point.x, point.z)


def _advance(run: Run, stepper: Stepper, point: Point, span: float) -> Stretch:
    """Integrate from a point, a little inside the present leg where that ends."""
    leg, t, end = run.leg, point.t, point.t + span
    if len(run.legs) > 1:
        inside = 2 * np.spacing(max(abs(leg.begin), abs(leg.end)))
        t, end = max(t, leg.begin + inside), min(end, leg.end - inside)
        if end - t < 2 * inside:
            resting = [np.tile(values, (stepper.nodes, 1)) for values in (point.x, point.z)]
            return Stretch(resting[0], resting[1], 0)
    return stepper.run(t, point.x, point.z, point.q, end - t, run.max_step)


def integrate(run: Run, stepper: Stepper, point: Point, span: float) -> Stretch:
    """Integrate one stretch; when that fails at once, from node to node."""
    try:
        return attempt(run, stepper, point, span)
    except IntegratorError:
        return _node_by_node(run, stepper, point, span)
    except Interrupted:
        if run.switcher is None:  # otherwise nodes may lie beyond an event
            done = stepper.reached()
            run.steps += done.steps
            _keep(run, point, span / stepper.nodes, done.states, done.algebraic)
        raise


def _keep(run: Run, point: Point, step: float, states: Array, algebraic: Array) -> None:
    """Record those of the first nodes of a stretch that came to no end that are not recorded yet."""
    times = point.t + step * np.arange(1, len(states) + 1)
    new = times > run.segments[-1].times[-1][-1]
    if new.any():
        run.record(times[new], states[new], algebraic[new])
        run.point = Point(float(times[-1]), states[-1], algebraic[-1], point.q)


def attempt(run: Run, stepper: Stepper, point: Point, span: float) -> Stretch:
    """Integrate one stretch at once."""
    run.calls += 1
    stretch = _advance(run, stepper, point, span)
    run.count(stretch.steps)
    return stretch


def _node_by_node(run: Run, stepper: Stepper, point: Point, span: float) -> Stretch:
    """Integrate each interval on its own, which allows more steps; save what is reached on failure."""
    step = span / stepper.nodes
    t, x, z, steps = point.t, point.x, point.z, 0
    states: list[Array] = []
    algebraic: list[Array] = []
    for _ in range(stepper.nodes):
        try:
            piece = _advance(run, stepper, Point(t, x, z, point.q), step)
        except IntegratorError:
            _keep(run, point, step, np.array(states), np.array(algebraic))
            _approach(run, stepper, Point(t, x, z, point.q), step)
            raise
        except Interrupted:
            if run.switcher is None:
                _keep(run, point, step, np.array(states), np.array(algebraic))
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
    strider = run.closed.stepper(stepper.solver, run.settings.tolerance, 1, stepper.most_steps)
    while span > smallest:
        span /= 2
        try:
            stretch = _advance(run, strider, Point(t, x, z, point.q), span)
        except IntegratorError:
            continue
        run.count(stretch.steps)
        t, x, z = t + span, stretch.states[-1], stretch.algebraic[-1]
        run.record(t, x, z)
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
    return dae.name_of(dae.states[int(votes.argmax())]) if votes.any() else ""


def failure(run: Run, error: Exception) -> str:
    """Say when a run ended and which state was bending most for its tolerance."""
    dae, point, settings = run.closed.dae, run.point, run.settings
    if isinstance(error, SimulationError):
        return f"'{dae.name}': {error}"
    rate, bend = _motion(run)
    wrong = [dae.state_names[i] for i in np.flatnonzero(~np.isfinite(rate))]
    blamed = told_without_value(run.closed, point.x, point.z, point.q, point.t, _output_step(run))
    if wrong or blamed:
        told = (
            f"the rate of {', '.join(wrong[:5])} is not a finite number"
            if wrong
            else "the solver cannot go on"
        )
        return (
            f"'{dae.name}': at t = {point.t:.9g} s {told}: {blamed or 'a division by zero makes it so'}; "
            f"{GUARD}. Results up to there are kept in the error's `result`"
        )
    weight = bend / (settings.rtol * np.abs(point.x) + settings.atol)
    worst = int(np.argmax(np.where(np.isfinite(weight), weight, np.inf))) if len(rate) else 0
    name = dae.state_names[worst] if len(rate) else "no state"
    state = f"{name} = {point.x[worst]:.6g} with rate {rate[worst]:.6g}" if len(rate) else name
    reason = str(error).strip().splitlines()[-1]
    return (
        f"'{dae.name}': integration failed at t = {point.t:.9g} s; the state that limited the step is "
        f"{state}. If it is really that fast, give a smaller step= than {_output_step(run):.3g} s, or "
        f"a shorter run than {settings.stop - settings.begin:.3g} s. Results up to there are kept in the "
        f"error's `result`. Solver: {reason}"
    )


def interruption(run: Run) -> str:
    """Say when a run was interrupted."""
    dae, point, settings = run.closed.dae, run.point, run.settings
    return (
        f"'{dae.name}': interrupted at t = {point.t:.9g} s of {settings.stop:g} s. Results up to there are "
        "kept in the error's `result`"
    )


def _output_step(run: Run) -> float:
    first, second = run.settings.outputs[:2]
    return float(second - first)


def _motion(run: Run) -> tuple[Array, Array]:
    """Return the rates of the states where a run stands, and the size of the rates' own rates."""
    closed, point = run.closed, run.point
    ode = closed.close(closed.dae.ode)
    function = closed.function("motion", ode, closed.rate(ode))
    rate, bend = (m.full().ravel() for m in function(point.x, point.z, point.q, point.t))
    return rate, np.abs(bend)
