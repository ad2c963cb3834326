"""Stepwise runs: they go on when told, and take inputs that are set on the way."""

from __future__ import annotations

import time as clock
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ..components.base import SimulationError
from .hybrid import MOST_STEPS, NODES, run_hybrid
from .initial import wishes
from .progress import Progress
from .result import Result
from .run import Settings, failure, integrate
from .simulate import collected, started
from .smooth import smooth_pieces
from .stepper import Array, IntegratorError

if TYPE_CHECKING:
    from .dae import DAE


class Stepwise:
    """A run that goes on when told, for co-simulation and for loops in time.

    Args:
        dae: the equations.
        begin: start time [s].
        stop: latest time [s]; nothing but events is recorded between the calls of `advance`.
        inputs: signals by name; a `Polynomial` is set on the way.
        courses: coefficients that the polynomials begin with; see `set`.
        start: fixed start values, as for `DAE.simulate`; likewise what follows.
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
        rtol: float = 1e-6, atol: float = 1e-8, solver: str = "auto",
    ) -> None:  # fmt: skip
        self._began = clock.perf_counter()
        settings = Settings(begin, stop, stop - begin, rtol, atol, solver, False)
        self.closed, self.settings = dae.closed(inputs), settings
        numbers = dae.system.flat.table.values(dict(parameters or {}))
        q = np.concatenate([numbers, np.zeros(self.closed.q.numel() - len(numbers))])
        self._write(q, settings.begin, courses)
        self.run = started(self.closed, settings, q, wishes(dae, start or {}, guess or {}))
        pieces = (NODES, MOST_STEPS) if self.run.switcher else smooth_pieces(1)
        self._stepper = self.closed.stepper(settings.solver, settings.tolerance, *pieces)
        self.run.open_segment()
        self._observers: dict[tuple[tuple[str, int], ...], Any] = {}

    def _write(self, q: Array, t: float, courses: Mapping[str, Sequence[float]]) -> None:
        for path, coefficients in courses.items():
            place = self.closed.courses[path]
            q[place] = 0.0
            q[place.start] = t
            q[place.start + 1 : place.start + 1 + len(coefficients)] = coefficients

    @property
    def time(self) -> float:
        """Where the run stands [s]."""
        return self.run.point.t

    def set(self, courses: Mapping[str, Sequence[float]]) -> None:
        """Set the course of inputs from now on: c0 + c1 (t - now) + c2 (t - now)^2 + ..."""
        self._write(self.run.point.q, self.time, courses)

    def observe(self, wanted: Sequence[tuple[str, int]]) -> Array:
        """Return variables where the run stands, or their time derivatives: pairs (name, order).

        Raises:
            KeyError: for an unknown name, with the nearest one.
        """
        key = tuple(wanted)
        if key not in self._observers:
            rows = [self._derived(name, order) for name, order in wanted]
            self._observers[key] = self.closed.compiled("observe", *rows)
        point = self.run.point
        return np.array([float(v[0]) for v in self._observers[key](point.x, point.z, point.q, point.t)])

    def _derived(self, name: str, order: int) -> Any:
        expression = self.closed.close(self.closed.dae.expression(name))
        for _ in range(order):
            expression = self.closed.rate(expression)
        return expression

    def advance(self, t: float) -> None:
        """Go on to time t, with the events on the way.

        Raises:
            SimulationError: if that fails; its `result` keeps what was computed.
        """
        run = self.run
        try:
            self._go(t)
        except (IntegratorError, SimulationError) as error:
            raise SimulationError(failure(run, error), self.result()) from error

    def _go(self, t: float) -> None:
        run, first = self.run, len(self.run.segments)
        happened = run.switcher.settle(run.point) if run.switcher else []
        run.events += happened
        run.open_segment()
        if run.switcher:
            with Progress("", run.point.t, t, False) as quiet:
                run_hybrid(run, run.switcher, self._stepper, np.array([run.point.t, t]), quiet)
        else:
            point = run.point
            stretch = integrate(run, self._stepper, point, t - point.t)
            run.record(t, stretch.states[-1], stretch.algebraic[-1])
            run.point = type(point)(t, stretch.states[-1], stretch.algebraic[-1], point.q)
        if not happened:
            _drop_first(run.segments[first])

    def result(self) -> Result:
        """Return what was computed so far."""
        return collected(self.run, self._stepper.solver, self._began, None)


def _drop_first(segment: Any) -> None:
    """Forget where a segment begins when the one before ends there alike."""
    if len(segment.times) > 1:
        for column in (segment.times, segment.states, segment.algebraic):
            del column[0]
