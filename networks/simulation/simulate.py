"""Simulate: start a run, choose how it goes on, gather what it computed."""

from __future__ import annotations

import time as clock
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from functools import partial
from math import inf
from typing import Any, Never

import numpy as np

from ...base import Array, SimulationError, check_keywords, heed, interruptible, listed, named
from ...components.language import Component
from ..dae import DAE
from ..given import dae_of
from ..results.result import Result
from .bound_dae import bound
from .consistent_start import started
from .coverage import check_covered, data_notes
from .dense_output import DenseOutput
from .energy import energy_book
from .events.hybrid import MOST_STEPS, NODES, run_hybrid
from .initialization import StartValues, start_values
from .progress import Progress
from .resolution import resolution_notes
from .run import Run, ending_in_results, limiting_state
from .run_asked import RUNS, RunAsked
from .sensitivity import Sensitivities, check_followed, sensitivities_along
from .settings import ATOL, RTOL, Settings
from .smooth import run_smooth, smooth_stepper
from .solver_choice import Choice, chosen


@interruptible()
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
            "compiled" where that pays, as where runs are many or long, and can be; "idas" otherwise where
            algebraic unknowns are left, "cvodes" where not. `stats` of the result tell which, and why.
        sensitivities: parameters whose forward sensitivities are wanted. CVODES and IDAS follow those of
            smooth networks; along other runs they are computed from point to point and over events when
            they are asked for, as exactly as the points resolve what happens between them.
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
    asked = RunAsked(
        dae_of(network),
        settings,
        named("start", start),
        named("guess", guess),
        named("inputs", inputs),
        dict(named("parameters", parameters)),
        listed("sensitivities", sensitivities),
    )
    runs = RUNS.get() or run_alone
    return runs(asked)


@interruptible()
def run_alone(asked: RunAsked) -> Result:
    """Return the result of a run that is asked for; see `simulate`."""
    settings, dae, began = asked.settings, asked.dae, clock.perf_counter()
    closed = bound(dae, asked.inputs)
    check_covered(dae.name, closed.signals, settings.begin, settings.stop)
    if asked.sensitivities:
        check_followed(dae, asked.sensitivities)
    q = closed.blank(dae.parameters.values(asked.parameters))
    wanted = start_values(dae, asked.start, asked.guess)

    def run_by(choice: Choice) -> Result:
        run = started(closed, settings, q, wanted)
        run.legs = closed.legs(q, settings.begin, settings.stop)
        return _finished(run, choice, wanted, asked.sensitivities, began)

    choice = chosen(closed, settings, bool(asked.sensitivities))
    if choice.account is None or not choice.compiled or settings.max_steps is not None:
        return run_by(choice)
    try:
        return run_by(choice)
    except SimulationError as error:
        found = run_by(replace(choice, compiled=False, why=f"compiled it failed: {error}"))
        choice.account.against = found.stats["why"]
        return found


def _finished(
    run: Run, choice: Choice, wanted: StartValues, sensitivities: tuple[str, ...], began: float
) -> Result:
    """Go from the start of a run to its end; return what it computed."""
    closed, settings = run.closed, run.settings
    follow = along = None
    if sensitivities and (choice.compiled or closed.dae.hybrid):
        along = partial(sensitivities_along, names=sensitivities, wanted=wanted)
    elif sensitivities:
        follow = Sensitivities(closed, sensitivities, run.point, wanted)
    solver, go = _way(run, choice, follow)
    result = partial(collected, run, solver, choice.why, began, follow, along)
    show = Progress(closed.dae.name, settings.begin, settings.stop, settings.progress)
    with show as progress, ending_in_results(run, result), _counted(run, choice):
        go(progress)
        heed()
    return result()


@contextmanager
def _counted(run: Run, choice: Choice) -> Iterator[None]:
    """Let what a run costs count for the choice of later ones."""
    if choice.compiled or choice.account is None:
        yield
        return
    with choice.account.paying(run.closed) as run.on_the_way:
        yield


def _way(run: Run, choice: Choice, follow: Sensitivities | None) -> tuple[str, Callable[[Progress], None]]:
    """Return by which solver a run goes, and what takes it to its end."""
    closed, settings, outputs, switcher = run.closed, run.settings, run.settings.outputs, run.switcher
    if choice.compiled:
        return "compiled", partial(closed.native.run, run, choice.tolerance, outputs)
    go: Callable[[Progress], None]
    if switcher is None:
        stepper = smooth_stepper(run, outputs)
        go = partial(run_smooth, run, outputs, follow=follow)
    else:
        stepper = closed.stepper(settings.solver, settings.tolerance, NODES, MOST_STEPS)
        go = partial(run_hybrid, run, switcher, stepper, outputs)
    run.open_segment()
    return stepper.solver, go


def collected(
    run: Run,
    solver: str,
    why: str,
    began: float,
    follow: Sensitivities | None = None,
    along: Callable[[Result], dict[str, Array]] | None = None,
) -> Result:
    """Return what a run has recorded, its start at least, with figures on how it went."""
    closed, settings = run.closed, run.settings
    if not run.segments:
        run.open_segment()
    stats = {
        "solver": solver,
        "why": why,
        "rtol": settings.rtol,
        "atol": settings.atol,
        "steps": run.steps,
        "integrator calls": run.calls,
        "events": len(run.events),
        "events by component": dict(Counter(event.component for event in run.events)),
        "seconds": clock.perf_counter() - began,
    }
    notes = list(run.switcher.notes if run.switcher else [])
    notes += data_notes(closed.dae.inputs, closed.signals, settings.begin, settings.stop)
    if closed.dae.states:
        states = np.vstack([block for segment in run.segments for block in segment.states])
        notes += resolution_notes(closed.dae, states, settings.tolerance)
    followed = follow.collected(sum(map(len, run.segments))) if follow else {}
    limiting = partial(limiting_state, run)
    between = partial(DenseOutput, run.legs, solver, settings.tolerance)
    return Result(
        closed,
        run.segments,
        run.events,
        stats,
        run.initial,
        notes,
        along or (lambda _: followed),
        limiting,
        between,
        energy_book,
    )
