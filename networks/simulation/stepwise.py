"""Stepwise runs: they go on when told, and take inputs that are set on the way."""

from __future__ import annotations

import time as clock
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np

from ...base import (
    Array,
    ModelError,
    SimulationError,
    UnknownNameError,
    between,
    by_name,
    demand,
    instance,
    named,
    nearest,
    number,
    numbers,
    shown,
)
from ..dae import DAE
from ..evaluation.compiled import Compiled
from ..results.result import Result
from .bound_dae import bound
from .consistent_start import started
from .coverage import check_covered
from .events.hybrid import MOST_STEPS, NODES, run_hybrid
from .events.switcher import Event, Switcher
from .initialization import start_values
from .integrator import IntegratorError
from .point import solve_algebraic
from .progress import Progress
from .run import ending_in_results, seen_of_jumps, settle, shock
from .settings import ATOL, RTOL, Settings
from .simulate import collected
from .smooth import MOST_STEPS as SMOOTH_STEPS
from .smooth import run_smooth

BEND_MARGIN = 4  # times its bend so far that an indicator may bend until the next instant


class Stepwise:
    """A run that goes on when told, for co-simulation and for loops in time.

    Args:
        dae: the equations.
        begin: start time [s].
        stop: latest time [s]; nothing but events is recorded between the calls of `advance`.
        inputs: signals by name; a `Polynomial` is set on the way.
        courses: coefficients that the polynomials begin with; see `set`.
        start: fixed start values, as for `simulate`; likewise what follows.
        guess: start values that may give way.
        parameters: changed parameters.
        rtol: relative tolerance.
        atol: absolute tolerance.
        solver: "auto", "cvodes", "idas", "rosenbrock".
    """

    def __init__(
        self, dae: DAE, begin: float, stop: float, inputs: Mapping[str, Any],
        courses: Mapping[str, Sequence[float]], *, start: Mapping[str, float] | None = None,
        guess: Mapping[str, float] | None = None, parameters: Mapping[str, float] | None = None,
        rtol: float = RTOL, atol: float = ATOL, solver: str = "auto",
    ) -> None:  # fmt: skip
        self._began = clock.perf_counter()
        demand("Stepwise", dae=(dae, instance(DAE)), courses=(courses, by_name(numbers(number))))
        settings = Settings(begin, stop, rtol=rtol, atol=atol, solver=solver)
        closed = self.closed = bound(dae, inputs)
        check_covered(dae.name, closed.signals, begin, stop)
        q = closed.blank(dae.parameters.values(named("parameters", parameters)))
        self._write(q, begin, courses)
        wanted = start_values(dae, named("start", start), named("guess", guess))
        self.run = started(closed, settings, q, wanted)
        self.run.legs = closed.legs(q, begin, stop)
        pieces = (NODES, MOST_STEPS) if self.run.switcher else (1, SMOOTH_STEPS)
        self._stepper = closed.stepper(solver, settings.tolerance, *pieces)
        self.run.open_segment()
        self._watched: tuple[float, Array, Array] | None = None
        self._observer = cache(self._compiled)

    def _write(self, q: Array, t: float, courses: Mapping[str, Sequence[float]]) -> None:
        for path, coefficients in courses.items():
            if path not in self.closed.courses:
                known = nearest(path, self.closed.courses)
                raise UnknownNameError(f"'{path}' is no input that is a Polynomial{known}")
            course = q[self.closed.courses[path]]
            if len(coefficients) >= len(course):
                most = len(course) - 1
                raise ModelError(f"input '{path}' takes {most} coefficients, got {len(coefficients)}")
            course[:] = 0.0
            course[0], course[1 : 1 + len(coefficients)] = t, coefficients

    @property
    def time(self) -> float:
        """Where the run stands [s]."""
        return self.run.point.t

    @property
    def name(self) -> str:
        """Name of the network."""
        return self.closed.dae.name

    @property
    def modes(self) -> Sequence[str]:
        """Full names of its modes."""
        return self.closed.dae.switching.mode_names

    @property
    def events(self) -> Sequence[Event]:
        """Its events so far."""
        return self.run.events

    @property
    def jumps(self) -> int:
        """How many times something has jumped so far: events, and what is given."""
        run = self.run
        return len(run.events) + sum(leg.jumps for leg in run.legs[: run.leg_number + 1])

    def set(self, courses: Mapping[str, Sequence[float]], *, jumps: bool = False) -> None:
        """Set the course of inputs from now on: c0 + c1 (t - now) + c2 (t - now)^2 + ...

        Args:
            courses: coefficients by input.
            jumps: whether they jump here. A motion they prescribe then acts as a shock; else they are pieces
                of one smooth course, and what they miss of it counts for nothing.

        Raises:
            SimulationError: for a jump that takes infinite forces.
        """
        demand("set()", courses=(courses, by_name(numbers(number))), jumps=(jumps, instance(bool)))
        run = self.run
        seen = seen_of_jumps(run, self.time) if jumps else None
        self._write(run.point.q, self.time, courses)
        solve_algebraic(self.closed, run.point)
        if seen is not None:
            shock(run, seen)
            run.open_segment()

    def settle(self, jumped: bool = False) -> bool:
        """Fire the transitions that are due where the run stands; tell whether there were any.

        Args:
            jumped: whether inputs jump here, so that two points share this instant: before and after.
        """
        return settle(self.run, jumped)

    def first_event(self, t: float) -> float | None:
        """Return when something jumps first until t, an event or what is given; the run does not move."""
        run = self.run
        jump = next((leg.begin for leg in run.legs[run.leg_number + 1 :] if leg.jumps), np.inf)
        event = None
        if run.switcher and self.closed.dae.hybrid:
            event = self._foreseen(run.switcher, min(t, jump))
        return event if event is not None else jump if jump <= t else None

    def _foreseen(self, switcher: Switcher, t: float) -> float | None:
        """Return when the first event until t comes if inputs keep their course."""
        p = self.run.point
        if not p.t < t or not self._within_reach(switcher, t):
            return None
        apart = switcher.copy()
        trial = replace(self.run, point=p.copy(), switcher=apart, segments=[], events=[])
        trial.open_segment()
        with suppress(IntegratorError, SimulationError), Progress("", p.t, t, False) as quiet:
            run_hybrid(trial, apart, self._stepper, np.array([p.t, t]), quiet, first=True)
        return trial.events[0].time if trial.events else None

    def _within_reach(self, switcher: Switcher, t: float) -> bool:
        """Tell whether an indicator may cross until t, by its rate and how that has changed lately."""
        point, was = self.run.point, self._watched
        values, rates = switcher.indicators.watch(point)
        self._watched = point.t, rates, switcher.indicators.modes(point.q).copy()
        span = t - point.t
        if was is None or was[0] >= point.t or (was[2] != self._watched[2]).any() or self.run.max_step < span:
            return True
        bend = np.abs(rates - was[1]) / (point.t - was[0])
        reach = values + span * (np.maximum(rates, 0.0) + BEND_MARGIN * span * bend)
        return bool((reach > -switcher.indicators.tolerance())[switcher.indicators.active(point.q)].any())

    def observe(self, wanted: Sequence[tuple[str, int]]) -> Array:
        """Return variables where the run stands, or their time derivatives: pairs (name, order).

        Raises:
            UnknownNameError: for an unknown name, with the nearest one.
        """
        given: Any = wanted
        if not isinstance(given, Sequence) or {np.shape(pair) for pair in given} != {(2,)}:
            raise ModelError(f"observe() takes pairs (name, order), got {shown(wanted)}")
        point = self.run.point
        found = self._observer(*wanted)(point.x, point.z, point.q, point.t)
        return np.array([float(v[0]) for v in found])

    def _compiled(self, *wanted: tuple[str, int]) -> Compiled:
        return self.closed.compiled("observe", *(self._derived(name, order) for name, order in wanted))

    def shocks(self, name: str, order: int = 0) -> frozenset[str]:
        """Return the paths of the components whose impulses a variable, or its derivative, would show."""
        closed, dae = self.closed, self.closed.dae
        before = dae.p.numel() + dae.modes.numel()
        rows = [self._derived(name, order), closed.close(dae.alg)]
        shown, algebraic = (closed.function("shown", row).jac_sparsity(0, 2).get_triplet()[1] for row in rows)
        if closed.function("through", rows[0]).jac_sparsity(0, 1).nnz():
            shown = [*shown, *algebraic]
        names = dae.switching.impulse_names
        return frozenset(names[k - before].rpartition(".")[0] for k in shown if 0 <= k - before < len(names))

    def _derived(self, name: str, order: int) -> Any:
        expression = self.closed.close(self.closed.dae.expression(name))
        for _ in range(order):
            expression = self.closed.rate(expression)
        return expression

    def advance(self, t: float) -> None:
        """Go on to time t, with the events on the way.

        Raises:
            ModelError: for a time before where the run stands, or after its `stop`.
            SimulationError: if that fails; its `result` keeps what was computed.
        """
        demand("advance()", t=(t, between(self.time, self.run.settings.stop, "s")))
        with ending_in_results(self.run, self.result):
            self._go(t)

    def _go(self, t: float) -> None:
        run = self.run
        first, happened = len(run.segments), self.settle()
        if not happened:
            run.open_segment()
        outputs = np.array([run.point.t, t])
        with Progress("", run.point.t, t, False) as quiet:
            if run.switcher:
                run_hybrid(run, run.switcher, self._stepper, outputs, quiet)
            else:
                run_smooth(run, outputs, quiet, None)
        segment = run.segments[first]
        if not happened and len(segment.times) > 1:  # which begins as the one before ends
            for column in (segment.times, segment.states, segment.algebraic):
                del column[0]

    def result(self) -> Result:
        """Return what was computed so far."""
        return collected(self.run, self._stepper.solver, "it is stepped from outside", self._began, None)
