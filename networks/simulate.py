"""Simulate: start a run, choose how it goes on, gather what it computed."""

from __future__ import annotations

import time as clock
from collections.abc import Mapping
from typing import Any

import numpy as np

from ..components.base import InitialConditionError, SimulationError
from .closed import Closed
from .dae import DAE
from .events import Point, Switcher
from .hybrid import NODES, run_hybrid
from .initial import Wishes, initial_values, wishes
from .progress import Progress
from .result import Result
from .run import Run, Settings, failure, limiting_state
from .sensitivity import Sensitivities
from .smooth import run_smooth, smooth_nodes
from .stepper import Array, IntegratorError, Stepper


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
    numbers = dae.system.flat.table.values(dict(parameters))
    others = closed.q.numel() - len(numbers)
    q = np.concatenate([numbers, np.zeros(others)])
    wanted = wishes(dae, start, guess)
    run = _started(closed, settings, q, wanted)
    outputs = settings.outputs
    nodes = NODES if run.switcher else smooth_nodes(len(outputs) - 1)
    stepper = closed.stepper(settings.solver, settings.tolerance, nodes)
    follow = Sensitivities(closed, sensitivities, run.point, wanted) if sensitivities else None
    run.open_segment()
    with Progress(dae.name, settings.begin, settings.stop, settings.progress) as progress:
        try:
            if run.switcher is None:
                run_smooth(run, stepper, outputs, progress, follow)
            else:
                run_hybrid(run, run.switcher, stepper, outputs, progress)
        except (IntegratorError, SimulationError) as error:
            partial = _result(run, stepper, began, follow)
            raise SimulationError(failure(run, error), partial) from error
    return _result(run, stepper, began, follow)


def _started(closed: Closed, settings: Settings, q: Array, wanted: Wishes) -> Run:
    """Find start values and the modes they imply, again until both agree."""
    t = settings.begin
    switcher = Switcher(closed) if closed.dae.hybrid or closed.dae.blocks else None
    for _ in range(10):
        if switcher is not None:
            guess = Point(t, np.zeros(closed.dae.x.numel()), np.zeros(closed.dae.z.numel()), q)
            switcher.complete(guess)
        x, z, decisions = initial_values(closed, q, t, wanted)
        point = Point(t, x, z, q)
        run = Run(closed, settings, point, switcher, decisions)
        if switcher is None:
            return run
        try:
            run.events = switcher.settle(point)
        except SimulationError as error:
            raise SimulationError(f"'{closed.dae.name}': {error}") from error
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


def _result(run: Run, stepper: Stepper, began: float, follow: Sensitivities | None) -> Result:
    by_component: dict[str, int] = {}
    for event in run.events:
        by_component[event.component] = by_component.get(event.component, 0) + 1
    stats = {
        "solver": stepper.solver,
        "steps": run.steps,
        "integrator calls": run.calls,
        "events": len(run.events),
        "events by component": by_component,
        "limiting state": limiting_state(run),
        "seconds": clock.perf_counter() - began,
    }
    notes = run.switcher.notes if run.switcher else []
    sensitivities = follow.collected() if follow else {}
    return Result(run.closed, run.segments, run.events, stats, run.initial, notes, sensitivities)
