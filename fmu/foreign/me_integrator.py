"""Solving a Model Exchange FMU: integration steps with error control, and where events end them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...base import Array
from ..errors import FMUError
from .communication_steps import Course
from .description import FMUDescription
from .instance import Instance, finite

States = Callable[[float], Array]
SMALLEST = 1e-6
MANY_STEPS = 25
INSIDE = (0.25, 0.5, 0.75, 1.0)
NOTHING = 1e-100


@dataclass(frozen=True)
class Stepping:
    """What the time steps of a run keep to.

    Attributes:
        begin, stop: of the run [s].
        rtol: relative tolerance; of a state, absolute is 1e-6 rtol times its nominal value.
        inputs: names of the continuous inputs.
        longest: longest integration step [s].
        intervals: whether inputs change their course in short intervals.
    """

    begin: float
    stop: float
    rtol: float
    inputs: Sequence[str]
    longest: float = np.inf
    intervals: bool = False


class Integrator:
    """Integrates an instance of Model Exchange from event to event, with methods of SciPy.

    LSODA (ODEPACK) serves long stretches. Where inputs change their course in short intervals, it would begin
    anew each time with low order; there the Runge-Kutta method of Dormand and Prince does, until an interval
    takes it more than 25 steps, as happens when the FMU is stiff.

    Event location: a state event is where an indicator changes between positive and not positive; it is
    looked for at four points of the dense output of every step and bisected to rounding error.

    Args:
        fmu: what the FMU says of itself.
        instance: of it.
        course: the continuous inputs as a function of time.
        stepping: what the steps keep to.
    """

    def __init__(self, fmu: FMUDescription, instance: Instance, course: Course, stepping: Stepping) -> None:
        self.name, self.instance, self.course, self.t = fmu.name, instance, course, stepping.begin
        self._indicator_count = fmu.description.numberOfEventIndicators
        self._rtol, self._longest = stepping.rtol, stepping.longest
        self._intervals, self._taken, self._stride = stepping.intervals, 0, np.inf
        self.stats: dict[str, Any] = {"solver": "LSODA", "steps": 0, "evaluations": 0}

    def refresh(self) -> None:
        """Read the states in continuous-time mode, at the start and after events."""
        self.x = finite(self.name, "a continuous state", self.t, self.instance.states())
        nominals = np.abs(self.instance.nominals())
        self._nominals = np.where(nominals > 0, nominals, 1.0)
        self._method: Any = None
        self._domains = self._indicators(self.t, self.x)

    def restart(self) -> None:
        """Begin anew with the next step, as the inputs take another course."""
        self._method = None
        self._taken = 0

    def _rates(self, t: float, x: Array) -> Array:
        self.stats["evaluations"] += 1
        rates = self.instance.derivatives(float(t), x.tolist(), self.course(float(t)))
        found: Array = finite(self.name, "a derivative", t, rates)
        found[np.abs(found) < NOTHING] = 0.0  # LSODA divides by what underflows
        return found

    def _indicators(self, t: float, x: Array) -> NDArray[np.bool_]:
        if not self._indicator_count:
            return np.zeros(0, dtype=bool)
        values = self.instance.indicators(float(t), x.tolist(), self.course(float(t)))
        above: NDArray[np.bool_] = finite(self.name, "an event indicator", t, values) > 0
        return above

    def step(self, limit: float) -> tuple[States, bool]:
        """Make one step, at most to `limit`; return its dense output, and whether a state event ended it.

        Raises:
            FMUError: if the step size falls to nothing, or the FMU returns no finite numbers.
        """
        states, end = self._advanced(limit)
        event = self._first_event(self.t, end, states)
        if event is not None:
            self.x = np.asarray(states(event))
        elif self._method is not None:
            self.x = self._method.y
        self.t = end if event is None else event
        return states, event is not None

    def _advanced(self, limit: float) -> tuple[States, float]:
        if not len(self.x) or limit - self.t <= 4 * np.spacing(max(abs(limit), abs(self.t))):
            x, self._method = self.x, None
            return lambda t: x, min(limit, self.t + self._longest)
        self._intervals = self._intervals and self._taken <= MANY_STEPS
        if self._method is None or self._method.t_bound != limit or self._taken == MANY_STEPS + 1:
            self._method = self._begun(limit)
        message = self._method.step()
        self.stats["steps"] += 1
        self._taken += 1
        if self._method.status == "failed":
            raise FMUError(self._failure(message))
        self._stride = max(self._method.h_abs, self._method.step_size) if self._intervals else np.inf
        return self._method.dense_output(), float(self._method.t)

    def _begun(self, limit: float) -> Any:
        from scipy.integrate import LSODA, RK45

        options: dict[str, Any] = {"rtol": self._rtol, "atol": SMALLEST * self._rtol * self._nominals}
        options["max_step"] = self._longest
        if not self._intervals:
            return LSODA(self._rates, self.t, self.x, limit, **options)
        return RK45(
            self._rates, self.t, self.x, limit, first_step=min(limit - self.t, self._stride), **options
        )

    def _failure(self, message: str) -> str:
        rates = self._rates(self.t, self.x)
        fastest = int(np.argmax(np.abs(rates) / self._nominals))
        return (
            f"FMU '{self.name}': integration failed at t = {self.t:.9g} s, where state {fastest + 1} of "
            f"{len(rates)} moves fastest ({rates[fastest]:.4g}/s): {message}"
        )

    def _first_event(self, begin: float, end: float, states: States) -> float | None:
        low = begin
        if not self._indicator_count:
            return None
        for share in INSIDE:
            high = begin + share * (end - begin)
            if (self._indicators(high, np.asarray(states(high))) != self._domains).any():
                return self._bisected(low, high, states)
            low = high
        return None

    def _bisected(self, low: float, high: float, states: States) -> float:
        while high - low > 4 * np.spacing(max(abs(low), abs(high))):
            middle = 0.5 * (low + high)
            if (self._indicators(middle, np.asarray(states(middle))) != self._domains).any():
                high = middle
            else:
                low = middle
        return high
