"""`Settings`: what a run is asked to be, and how exact it is to be."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf
from typing import Any

import numpy as np

from ...base import Array, ModelError, above, between, demand, finite, one_of, optional, whole

SOLVERS = ("auto", "cvodes", "idas", "rosenbrock", "compiled")
# Of runs that ask for none; with so little, motions of micrometres are as exact as those of metres.
RTOL, ATOL = 1e-6, 1e-12
FINEST, COARSEST = 1e-14, 0.1  # relative tolerances
EVENT_SHARE, EVENT_RTOL = 0.01, 1e-10  # of the tolerance, between events, and its least
MOST_OUTPUTS = 20_000_000


@dataclass(frozen=True)
class Tolerance:
    """Relative and absolute tolerance of a run."""

    rtol: float
    atol: float

    def of(self, sizes: Any, nominal: Any = 1.0) -> Array:
        """Return by how much values of some sizes may be wrong."""
        error: Array = self.rtol * sizes + self.atol * nominal
        return error

    def times(self, share: float) -> Tolerance:
        """Return a share of it."""
        return Tolerance(share * self.rtol, share * self.atol)

    def between_events(self) -> Tolerance:
        """Return what a multistep method keeps to: each event makes it start anew at order 1.

        Not so little that rounding errors rule its steps, unless that was asked for.
        """
        share = min(1.0, max(EVENT_SHARE, EVENT_RTOL / self.rtol))
        return Tolerance(share * self.rtol, max(share * self.atol, min(self.atol, ATOL)))


@dataclass(frozen=True)
class Settings:
    """What a run is asked to be."""

    begin: float
    stop: float
    step: float | None = None
    rtol: float = RTOL
    atol: float = ATOL
    solver: str = "auto"
    progress: bool | None = None
    max_steps: int | None = None
    max_step: float = inf

    def __post_init__(self) -> None:
        demand(
            "this run",
            begin=(self.begin, finite("s")),
            stop=(self.stop, finite("s")),
            step=(self.step, optional(above(0, "s"))),
            rtol=(self.rtol, between(FINEST, COARSEST)),
            atol=(self.atol, above(0)),
            solver=(self.solver, one_of(SOLVERS)),
            max_steps=(self.max_steps, optional(whole(1))),
            max_step=(self.max_step, _longest),
        )
        if problem := self._problem(self.stop - self.begin):
            raise ModelError("this run cannot be done:", [problem])

    def _problem(self, span: float) -> str:
        if not span > 0:
            return f"stop must be after begin ({self.begin:g} s), got {self.stop:g} s"
        if self.step is not None and span / self.step > MOST_OUTPUTS:
            return (
                f"step = {self.step:g} s asks for {span / self.step:.3g} outputs of {span:g} s, more "
                f"than {MOST_OUTPUTS:.0e}; give step={span / MOST_OUTPUTS:.1g} or more (the integrator's own "
                "steps are as small as rtol= wants them)"
            )
        if self.begin + span / 500 == self.begin:
            return f"stop = {self.stop!r} s is too near to begin = {self.begin!r} s for numbers between them"
        return ""

    @property
    def tolerance(self) -> Tolerance:
        """Relative and absolute tolerance."""
        return Tolerance(self.rtol, self.atol)

    @property
    def outputs(self) -> Array:
        """Output instants, 501 if there is no step; a step is adjusted to divide the run."""
        count = 500 if self.step is None else max(1, round((self.stop - self.begin) / self.step))
        return np.linspace(self.begin, self.stop, count + 1)


def _longest(step: Any) -> str:
    """Say that a longest step must be above 0 s, and may be infinite."""
    return "" if isinstance(step, float) and step == inf else above(0, "s")(step)
