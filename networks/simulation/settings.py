"""`Settings`: what a run is asked to be."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ...base import Array, ModelError, above, between, demand, finite, one_of, optional, whole
from .integrator import SOLVERS
from .tolerance import Tolerance

FINEST, COARSEST = 1e-14, 0.1
MOST_OUTPUTS = 20_000_000


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
    max_step: float = np.inf

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
        span = self.stop - self.begin
        if not self.stop > self.begin:
            problem = f"stop must be after begin ({self.begin:g} s), got {self.stop:g} s"
        elif self.step is not None and span / self.step > MOST_OUTPUTS:
            problem = (
                f"step = {self.step:g} s asks for {span / self.step:.3g} outputs of {span:g} s, more "
                f"than {MOST_OUTPUTS:.0e}; give step={span / MOST_OUTPUTS:.1g} or more (the integrator's own "
                "steps are as small as rtol= wants them)"
            )
        elif self.begin + span / 500 == self.begin:
            problem = (
                f"stop = {self.stop!r} s is too near to begin = {self.begin!r} s for numbers between them"
            )
        else:
            return
        raise ModelError("this run cannot be done:", [problem])

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
    return "" if isinstance(step, float) and step == np.inf else above(0, "s")(step)
