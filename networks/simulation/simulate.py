"""Simulate: start a run, choose how it goes on, gather what it computed."""

from __future__ import annotations

import time as clock
from collections.abc import Callable, Iterable, Mapping
from functools import partial
from math import inf
from typing import Any, Never

import numpy as np

from ...base import (
    Array,
    Interrupted,
    ModelError,
    RunInterruptedError,
    SimulationError,
    check_keywords,
    heed,
    interruptible,
    listed,
    named,
)
from ...components.language import Component
from ..dae import DAE
from ..given import dae_of
from ..results.result import Result
from .bound_dae import bound
from .consistent_start import started
from .coverage import check_covered, data_notes
from .dense_output import DenseOutput
from .events.hybrid import MOST_STEPS, NODES, run_hybrid
from .initialization import StartValues, start_values
from .integrator import IntegratorError
from .progress import Progress
from .resolution import resolution_notes
from .run import Run, failure, interruption, limiting_state
from .sensitivity import Sensitivities
from .settings import Settings
from .smooth import run_smooth, smooth_stepper
from .tolerance import ATOL, RTOL


def simulate(
    network: Component | DAE,
    stop: float,
    *,
    start: Mapping[str, float] | None = None,
    guess: Mapping[str, float] | None = None,
    inputs: Mapping[str, Any] | None = None,
    parameters: Mapping[str, float] | None = None,
    begin: float = 0.0,
    step: float | None = None,
    rtol: float = RTOL,
    atol: float = ATOL,
    solver: str = "auto",
    sensitivities: Iterable[str] = (),
    progress: bool | None = None,
    max_steps: int | None = None,
    max_step: float = inf,
    **unknown: Never,
) -> Result:
    """Run a network from `begin` to `stop` and return the result.

    A network that runs often is assembled once: `dae = net.dae()`, then `simulate(dae, ...)`.

    Args:
        network: a `Network`, or its equations.
        stop: end time [s].
        start: fixed start values by name (of states or of anything that determines them).
        guess: start values that may give way to fixed ones.
        inputs: signals by name: a number, a function of time (CasADi or NumPy functions), a
            `Sampled` or a pair (time, values).
        parameters: changed parameters by name.
        begin: start time [s].
        step: output interval [s]; a 500th of the run if not given.
        rtol: relative tolerance.
        atol: absolute tolerance, times the nominal value of each state.
        solver: "auto", "cvodes", "idas", "rosenbrock", or "compiled" (in C, needs a compiler). "auto" is
            "idas" where algebraic unknowns are left and "cvodes" elsewhere; `fit` and `diagnose`, which run a
            model again and again, let it be "compiled" if that pays.
        sensitivities: parameters whose forward sensitivities are wanted (smooth networks).
        progress: show progress; by default on runs that last over a second on a terminal.
        max_steps: steps of the integrator after which the run is given up; no limit if not given. Solver
            "compiled" also gives up where events between two outputs are 20 times their share of it.
        max_step: longest step of the integrator [s]; runs stop by themselves where inputs switch, and
            keep steps short where inputs move.
        unknown: refused, with the nearest argument that there is.

    Raises:
        ModelError: for unknown names or arguments, values out of range, and tolerances or steps that no
            run can keep to.
        InitialConditionError: for start values that contradict each other.
        SimulationError: if the run cannot be finished; its `result` keeps what was computed.
        RunInterruptedError: on Ctrl-C; its `result` likewise.
    """
    check_keywords("simulate()", unknown, simulate)
    settings = Settings(begin, stop, step, rtol, atol, solver, progress, max_steps, max_step)
    began, dae = clock.perf_counter(), dae_of(network)
    followed = listed("sensitivities", sensitivities)
    closed = bound(dae, named("inputs", inputs))
    check_covered(dae.name, closed.signals, begin, stop)
    q = closed.blank(dae.parameters.values(dict(named("parameters", parameters))))
    wanted = start_values(dae, named("start", start), named("guess", guess))
    run = started(closed, settings, q, wanted)
    run.legs = closed.legs(q, begin, stop)
    return _finished(run, wanted, followed, began)


def _finished(run: Run, wanted: StartValues, sensitivities: tuple[str, ...], began: float) -> Result:
    """Go from the start of a run to its end; return what it computed."""
    closed, settings, outputs = run.closed, run.settings, run.settings.outputs
    compiled = settings.solver == "compiled"
    if compiled and sensitivities:
        raise ModelError("solver 'compiled' does not follow sensitivities; use 'auto'")
    follow = Sensitivities(closed, sensitivities, run.point, wanted) if sensitivities else None
    solver, go = _compiled(run, outputs) if compiled else _interpreted(run, outputs, follow)
    show = Progress(closed.dae.name, settings.begin, settings.stop, settings.progress)
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
        closed,
        run.segments,
        run.events,
        stats,
        run.initial,
        notes,
        sensitivities,
        partial(limiting_state, run),
        partial(DenseOutput, run.legs, solver, run.settings.tolerance),
    )
