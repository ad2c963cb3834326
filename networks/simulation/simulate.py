"""Simulate: start a run, choose how it goes on, gather what it computed."""

from __future__ import annotations

import time as clock
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from ...base import (
    InitialConditionError,
    Interrupted,
    ModelError,
    RunInterruptedError,
    SimulationError,
    heed,
    interruptible,
)
from ..dae import DAE
from ..results.result import Result
from .bound_dae import Closed
from .coverage import check_covered, data_notes
from .events.constants import JUST_BEFORE
from .events.hybrid import MOST_STEPS, NODES, run_hybrid
from .events.switcher import Event, Switcher
from .initialization import Wishes, initial_values, wishes
from .integrator import Array, IntegratorError
from .point import Point, solve_algebraic
from .progress import Progress
from .resolution import resolution_notes
from .run import Run, Settings, failure, interruption, limiting_state
from .sensitivity import Sensitivities
from .smooth import run_smooth, smooth_stepper
from .tolerance import ATOL, RTOL


def simulate(
    dae: DAE,
    settings: Settings,
    start: Mapping[str, float],
    guess: Mapping[str, float],
    inputs: Mapping[str, Any],
    parameters: Mapping[str, float],
    sensitivities: tuple[str, ...],
) -> Result:
    """Run a DAE; see `DAE.simulate`."""
    began = clock.perf_counter()
    closed = dae.closed(inputs)
    check_covered(dae.name, closed.signals, settings.begin, settings.stop)
    q = closed.blank(dae.system.flat.table.values(dict(parameters)))
    wanted = wishes(dae, start, guess)
    run = started(closed, settings, q, wanted)
    run.legs = closed.legs(q, settings.begin, settings.stop)
    outputs = settings.outputs
    compiled = settings.solver == "compiled"
    if compiled and sensitivities:
        raise ModelError("solver 'compiled' does not follow sensitivities; use 'auto'")
    follow = Sensitivities(closed, sensitivities, run.point, wanted) if sensitivities else None
    solver, go = _compiled(run, outputs) if compiled else _interpreted(run, outputs, follow)
    show = Progress(dae.name, settings.begin, settings.stop, settings.progress)
    with interruptible(), show as progress:
        try:
            go(progress)
            heed()
        except (IntegratorError, SimulationError) as error:
            result = collected(run, solver, began, follow)
            raise SimulationError(failure(run, error), result) from error
        except Interrupted:
            result = collected(run, solver, began, follow)
            raise RunInterruptedError(interruption(run), result) from None
    return collected(run, solver, began, follow)


def _compiled(run: Run, outputs: Array) -> tuple[str, Callable[[Progress], None]]:
    native = run.closed.native
    return "compiled", lambda progress: native.run(run, outputs, progress)


def _interpreted(
    run: Run, outputs: Array, follow: Sensitivities | None
) -> tuple[str, Callable[[Progress], None]]:
    switcher = run.switcher
    if switcher is None:
        stepper = smooth_stepper(run, outputs)
        run.open_segment()
        return stepper.solver, lambda progress: run_smooth(run, outputs, progress, follow)
    stepper = run.closed.stepper(run.settings.solver, run.settings.tolerance, NODES, MOST_STEPS)
    run.open_segment()
    return stepper.solver, lambda progress: run_hybrid(run, switcher, stepper, outputs, progress)


def started(closed: Closed, settings: Settings, q: Array, wanted: Wishes) -> Run:
    """Find start values and the modes they imply.

    Raises:
        InitialConditionError: if they do not agree in the modes at rest, nor in those that motion or
            what breaks away implies.
    """
    refusals = []
    for modes in _first_modes(closed, q, settings.begin, wanted):
        tried = modes.copy()
        try:
            run = _agreed(closed, settings, modes, wanted)
            run.tried = tried
            return run
        except InitialConditionError as error:
            refusals.append(error)
    raise refusals[min(1, len(refusals) - 1)]


def begun(closed: Closed, q: Array, time: float, wanted: Wishes) -> Run:
    """Return a run that stands where it begins, at `time` [s]."""
    return started(closed, Settings(time, time + 1.0, 1.0, RTOL, ATOL, "auto", False), q, wanted)


def _agreed(closed: Closed, settings: Settings, q: Array, wanted: Wishes) -> Run:
    """Find start values in given modes, then modes, again until both agree."""
    t = settings.begin
    switcher = Switcher(closed) if closed.dae.hybrid or closed.dae.blocks else None
    for _ in range(10):
        if switcher is not None:
            guess = Point(t, np.zeros(closed.dae.x.numel()), np.zeros(closed.dae.z.numel()), q)
            switcher.completion.update(guess)
        x, z, decisions = initial_values(closed, q, t, wanted)
        point = Point(t, x, z, q)
        run = Run(closed, settings, point, switcher, decisions)
        if switcher is None:
            return run
        switcher.tell_inside(point)
        run.events = _settled(switcher, point)
        mentions_others = any(v not in closed.dae.states for v in wanted.fixed)
        struck = any(event.impulse is not None for event in run.events)
        if not run.events or not mentions_others or struck:
            return run
        again = initial_values(closed, point.q, t, wanted)
        if np.allclose(again[0], point.x, rtol=1e-12, atol=1e-14):
            return run
        q = point.q
    raise InitialConditionError(
        f"'{closed.dae.name}': start values and modes do not agree with each other; fix states instead "
        "of accelerations or forces"
    )


def _first_modes(closed: Closed, q: Array, t: float, wanted: Wishes) -> Iterator[Array]:
    """Yield modes to try: at rest, those that positions and speeds imply, and each way out of holding."""
    yield q.copy()
    if not closed.dae.hybrid:
        return
    fixed = {v: value for v, value in wanted.fixed.items() if v in closed.dae.system.derivative}
    x, z, _ = initial_values(closed, q, t, Wishes(fixed, wanted.guesses))
    point = Point(t, x, z, q.copy())
    switcher = Switcher(closed)
    _settled(switcher, point)
    yield point.q.copy()
    switching, modes = closed.dae.switching, switcher.indicators.modes
    held = [k for k, stands in enumerate(switching.in_shock) if int(modes(point.q)[k]) in stands]
    for chosen in [held, *([k] for k in held if len(held) > 1)]:
        for value in range(max((len(switching.mode_values[k]) for k in held), default=0)):
            moving = point.q.copy()
            for k in chosen:
                modes(moving)[k] = min(value, len(switching.mode_values[k]) - 1)
            yield moving


def _settled(switcher: Switcher, point: Point) -> list[Event]:
    """Find the modes in which a run begins; a signal that jumps in its first instant acts on the start."""
    try:
        before = _just_before(switcher, point)
        if before is None:
            return switcher.settle(point, begins=True)
        there, happened = before
        point.x, point.z, point.q = there.x, there.z, there.q
        solve_algebraic(switcher.closed, point)
        return [*happened, *switcher.settle(point)]
    except SimulationError as error:
        raise SimulationError(f"'{switcher.closed.dae.name}': {error}") from error


def _just_before(switcher: Switcher, point: Point) -> tuple[Point, list[Event]] | None:
    """Return where a run stands just before it begins, and what had happened, if a signal jumps then."""
    own = sorted(switcher.shocks.own_modes) if switcher.shocks else []
    if not own:
        return None
    instants = point.t - max(JUST_BEFORE, 8 * float(np.spacing(abs(point.t)))), point.t
    earlier, now = (Point(t, point.x.copy(), point.z.copy(), point.q.copy()) for t in instants)
    try:
        happened = switcher.copy().settle(earlier, begins=True)
        switcher.copy().settle(now, begins=True)
    except SimulationError:
        return None
    modes = switcher.indicators.modes
    if np.array_equal(modes(earlier.q)[own], modes(now.q)[own]):
        return None
    return earlier, [replace(event, time=point.t) for event in happened]


def collected(run: Run, solver: str, began: float, follow: Sensitivities | None) -> Result:
    """Return what a run has recorded, with figures on how it went."""
    by_component: dict[str, int] = {}
    for event in run.events:
        by_component[event.component] = by_component.get(event.component, 0) + 1
    stats = {
        "solver": solver,
        "rtol": run.settings.rtol,
        "atol": run.settings.atol,
        "steps": run.steps,
        "integrator calls": run.calls,
        "events": len(run.events),
        "events by component": by_component,
        "seconds": clock.perf_counter() - began,
    }
    closed, notes = run.closed, list(run.switcher.notes if run.switcher else [])
    notes += data_notes(closed.dae.inputs, closed.signals, run.settings.begin, run.settings.stop)
    if closed.dae.states:
        states = np.vstack([block for segment in run.segments for block in segment.states])
        notes += resolution_notes(closed.dae, states, run.settings.tolerance)
    sensitivities = follow.collected(sum(map(len, run.segments))) if follow else {}
    return Result(
        run.closed,
        run.segments,
        run.legs,
        run.events,
        stats,
        run.initial,
        notes,
        sensitivities,
        partial(limiting_state, run),
    )
