"""A run in progress: where it stands, what it has recorded, and how it fails."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field, replace
from itertools import repeat
from typing import Any

import numpy as np

from ...base import Array, Interrupted, RunInterruptedError, SimulationError, interruptible
from ..results.result import Result, Segment
from .blame import GUARD, told_without_value, with_remedies
from .bound_dae import BoundDAE
from .events.switcher import Event, Switcher
from .initialization import StartReport
from .integrator import IntegratorError, Stepper, Stretch
from .legs import Leg
from .point import Point, solve_algebraic
from .settings import Settings

RESULTS_KEPT = "Results up to there are kept in the error's `result`"


@dataclass(eq=False)
class Run:
    """A run in progress: where it stands and what it has recorded.

    `tried` is what q was when start values and modes were sought that agree; `on_the_way` is called between
    stretches.
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
    on_the_way: Callable[[], None] | None = None

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
        if self.on_the_way is not None:
            self.on_the_way()
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
    last = run.leg.end
    if run.point.t < last or run.leg_number + 1 == len(run.legs):
        return False
    run.leg_number += 1
    leg = run.leg
    if leg.jumps:
        record_here(run)
        seen = seen_of_jumps(run, last)
        run.point = run.point.copy(leg.begin)
        solve_algebraic(run.closed, run.point)
        shock(run, seen)
    else:
        run.point = run.point.copy(leg.begin)
    settle(run, leg.jumps)
    return True


def settle(run: Run, jumped: bool) -> bool:
    """Fire the transitions that are due where a run stands; tell whether there were any.

    A segment is opened then, and if what is given has jumped here.
    """
    happened = run.switcher.settle(run.point) if run.switcher else []
    run.events += happened
    if happened or jumped:
        run.open_segment()
    return bool(happened)


def seen_of_jumps(run: Run, t: float) -> Array | None:
    """Return what tells, after a jump at time t of what is given, how far it jumped; None if nothing acts."""
    shocks = run.closed.shocks
    return shocks.seen(replace(run.point, t=t)) if shocks else None


def shock(run: Run, seen: Array | None) -> None:
    """Let what is given act where it has jumped since it was `seen`."""
    if seen is not None:
        switcher = run.switcher or Switcher(run.closed)
        run.events += switcher.jump(run.point, seen, {})


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
            x, z = (np.tile(values, (stepper.nodes, 1)) for values in (point.x, point.z))
            return Stretch(x, z, 0)
    return stepper.run(replace(point, t=t), end - t, run.max_step)


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
            times = point.t + span / stepper.nodes * np.arange(1, len(done.states) + 1)
            _keep(run, map(Point, times.tolist(), done.states, done.algebraic, repeat(point.q)))
        raise


def _keep(run: Run, points: Iterable[Point]) -> None:
    """Record what is not recorded yet of a stretch that came to no end."""
    for point in points:
        if point.t > run.segments[-1].times[-1][-1]:
            run.point = point
            run.record(point.t, point.x, point.z)


def attempt(run: Run, stepper: Stepper, point: Point, span: float) -> Stretch:
    """Integrate one stretch at once."""
    run.calls += 1
    stretch = _advance(run, stepper, point, span)
    run.count(stretch.steps)
    return stretch


def _node_by_node(run: Run, stepper: Stepper, point: Point, span: float) -> Stretch:
    """Integrate each interval on its own, which allows more steps; save what is reached on failure."""
    step, nodes, before = span / stepper.nodes, [point], run.steps
    for number in range(stepper.nodes):
        try:
            piece = _advance(run, stepper, nodes[-1], step)
        except (IntegratorError, Interrupted) as error:
            failed = isinstance(error, IntegratorError)
            if failed or run.switcher is None:
                _keep(run, nodes[1:])
            if failed:
                _approach(run, stepper, nodes[-1], step)
            raise
        nodes.append(piece.end(point.t + step * (number + 1), point.q))
        run.count(piece.steps)
    x, z = (np.array([getattr(node, name) for node in nodes[1:]]) for name in "xz")
    return Stretch(x, z, run.steps - before)


def _approach(run: Run, stepper: Stepper, point: Point, span: float) -> None:
    """Advance towards a failure in ever smaller strides, recording what is reached."""
    smallest = max(1e-6 * span, 1e-14 * abs(point.t))
    strider = run.closed.stepper(stepper.solver, run.settings.tolerance, 1, stepper.most_steps)
    while span > smallest:
        span /= 2
        with suppress(IntegratorError):
            stretch = _advance(run, strider, point, span)
            run.count(stretch.steps)
            point = stretch.end(point.t + span, point.q)
            run.record(point.t, point.x, point.z)
    run.point = point


def limiting_state(run: Run) -> str:
    """Name the state that bends most for its tolerance at most outputs: the one that limits steps."""
    dae = run.closed.dae
    if run.limiting or not dae.states:
        return run.limiting
    votes = np.zeros(len(dae.states), dtype=int)
    for segment in run.segments:
        states = np.vstack(segment.states)
        bend = np.abs(np.diff(states, 2, axis=0)) / run.settings.tolerance.of(np.abs(states[1:-1]))
        votes += np.bincount(bend.argmax(axis=1), minlength=len(votes))
    return dae.name_of(dae.states[int(votes.argmax())]) if votes.any() else ""


@contextmanager
def ending_in_results(run: Run, result: Callable[[], Result]) -> Iterator[None]:
    """Let Ctrl-C end a run between calls; what ends it early is told with the `result` so far.

    Raises:
        SimulationError: if it cannot be finished.
        RunInterruptedError: on Ctrl-C.
    """
    with interruptible():
        try:
            yield
        except (IntegratorError, SimulationError) as error:
            raise SimulationError(_failure(run, error), result()) from error
        except Interrupted:
            dae, stop = run.closed.dae, run.settings.stop
            told = f"'{dae.name}': interrupted at t = {run.point.t:.9g} s of {stop:g} s. {RESULTS_KEPT}"
            raise RunInterruptedError(told, result()) from None


def _failure(run: Run, error: Exception) -> str:
    """Say when a run ended and which state was bending most for its tolerance."""
    closed, point, settings = run.closed, run.point, run.settings
    if isinstance(error, SimulationError):
        return f"'{closed.dae.name}': {with_remedies(closed.dae, str(error))}"
    names, begin, step = closed.dae.state_names, settings.begin, float(settings.outputs[1] - settings.begin)
    ode = closed.close(closed.dae.ode)
    motion = closed.function("motion", ode, closed.rate(ode))
    rate, bend = (m.full().ravel() for m in motion(point.x, point.z, point.q, point.t))
    wrong = [names[i] for i in np.flatnonzero(~np.isfinite(rate))]
    blamed = told_without_value(closed, point, step)
    if wrong or blamed:
        rates = f"the rate of {', '.join(wrong[:5])} is not a finite number"
        return (
            f"'{closed.dae.name}': at t = {point.t:.9g} s {rates if wrong else 'the solver cannot go on'}: "
            f"{blamed or 'a division by zero makes it so'}; {GUARD}. {RESULTS_KEPT}"
        )
    state = "no state"
    if names:
        weight = np.abs(bend) / settings.tolerance.of(np.abs(point.x))
        worst = int(np.argmax(np.where(np.isfinite(weight), weight, np.inf)))
        state = f"{names[worst]} = {point.x[worst]:.6g} with rate {rate[worst]:.6g}"
    return (
        f"'{closed.dae.name}': integration failed at t = {point.t:.9g} s; the state that limited the step is "
        f"{state}. If it is really that fast, give a smaller step= than {step:.3g} s, or a shorter run than "
        f"{settings.stop - begin:.3g} s. {RESULTS_KEPT}. Solver: {str(error).strip().splitlines()[-1]}"
    )
