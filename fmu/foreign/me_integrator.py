"""Model Exchange: integration steps with error control, and event location in their dense output."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...base import Array
from ..errors import FMUError
from .description import FMUDescription
from .instance import Group, Instance, Values, finite
from .time_stepping import Course, Stepping, TimeStepper

ATOL_SHARE = 1e-6
STIFF_STEPS = 25
WATCHED_SHARES = (0.25, 0.5, 0.75, 1.0)
UNDERFLOWING_RATE = 1e-100


class ModelExchange(TimeStepper):
    """Integrates an instance of Model Exchange from event to event, with methods of SciPy.

    LSODA (ODEPACK) serves long stretches. Where inputs change their course in short intervals, it would begin
    anew each time with low order; there the Runge-Kutta method of Dormand and Prince does, until an interval
    takes it more than 25 steps, as happens when the FMU is stiff.

    Event location: a state event is where an indicator changes between positive and not positive; it is
    looked for at four points of the dense output of every step and bisected to rounding error.
    """

    _standing = "t", "_x", "_next_event", "ended"
    _method: Any
    _next_event: float

    def __init__(self, instance: Instance, fmu: FMUDescription, course: Course, stepping: Stepping) -> None:
        super().__init__(instance, fmu, course, stepping)
        self._indicator_count = fmu.description.numberOfEventIndicators
        self._rtol, self._longest = stepping.rtol, stepping.longest
        self._intervals, self._taken, self._stride = stepping.intervals, 0, np.inf
        self.stats = {"solver": "LSODA", "steps": 0, "evaluations": 0}
        self._update()
        if self.ended:
            raise FMUError(f"FMU '{fmu.name}' asked to end at its start")

    def step(self, limit: float, look_back: Callable[[], None] = lambda: None) -> None:
        self._states, end = self._advanced(min(limit, self._next_event))
        located = self._first_event(end)
        if located is not None:
            self._x = np.asarray(self._states(located))
        elif self._method is not None:
            self._x = self._method.y
        self.t = end if located is None else located
        look_back()
        self.look([])
        asked, self.ended = self.instance.completed_step()
        timed = self.t >= self._next_event
        self.event = "state" if located is not None else "time" if timed else "step" if asked else ""

    def follow(self, course: Course) -> None:
        super().follow(course)
        self._method, self._taken = None, 0

    def advance(self, target: float, course: Course) -> None:
        self.follow(course)
        while self.t < target and not self.event and not self.ended:
            self.step(target)

    def look(self, groups: list[Group], t: float | None = None) -> Values:
        x = self._x if t is None else np.asarray(self._states(t))
        t = self.t if t is None else t
        return self.instance.look(t, x.tolist(), self.course(t), groups)

    def _update(self) -> None:
        update = self.instance.update()
        self.ended = update.terminate
        self._next_event = np.inf if update.next_event is None else update.next_event
        if self.ended:
            return
        self._x = finite(self.name, "a continuous state", self.t, self.instance.states())
        nominals = np.abs(self.instance.nominals())
        self._nominals = np.where(nominals > 0, nominals, 1.0)
        self._method = None
        self._domains = self._indicators(self.t, self._x)

    def _rates(self, t: float, x: Array) -> Array:
        self.stats["evaluations"] += 1
        rates = self.instance.derivatives(float(t), x.tolist(), self.course(float(t)))
        found: Array = finite(self.name, "a derivative", t, rates)
        found[np.abs(found) < UNDERFLOWING_RATE] = 0.0  # LSODA divides by what underflows
        return found

    def _indicators(self, t: float, x: Array) -> NDArray[np.bool_]:
        if not self._indicator_count:
            return np.zeros(0, dtype=bool)
        values = self.instance.indicators(float(t), x.tolist(), self.course(float(t)))
        above: NDArray[np.bool_] = finite(self.name, "an event indicator", t, values) > 0
        return above

    def _advanced(self, limit: float) -> tuple[Callable[[float], Array], float]:
        if not len(self._x) or limit - self.t <= 4 * np.spacing(max(abs(limit), abs(self.t))):
            x, self._method = self._x, None
            return lambda t: x, min(limit, self.t + self._longest)
        self._intervals = self._intervals and self._taken <= STIFF_STEPS
        if self._method is None or self._method.t_bound != limit or self._taken == STIFF_STEPS + 1:
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

        atol = ATOL_SHARE * self._rtol * self._nominals
        options = {"rtol": self._rtol, "atol": atol, "max_step": self._longest}
        if self._intervals:
            options["first_step"] = min(limit - self.t, self._stride)
        return (RK45 if self._intervals else LSODA)(self._rates, self.t, self._x, limit, **options)

    def _failure(self, message: str) -> str:
        rates = self._rates(self.t, self._x)
        fastest = int(np.argmax(np.abs(rates) / self._nominals))
        return (
            f"FMU '{self.name}': integration failed at t = {self.t:.9g} s, where state {fastest + 1} of "
            f"{len(rates)} moves fastest ({rates[fastest]:.4g}/s): {message}"
        )

    def _first_event(self, end: float) -> float | None:
        """Return the first instant of the last step at which an indicator has changed its domain."""
        low, begin = self.t, self.t
        for share in WATCHED_SHARES if self._indicator_count else ():
            high = begin + share * (end - begin)
            if self._crossed(high):
                return self._bisected(low, high)
            low = high
        return None

    def _crossed(self, t: float) -> bool:
        return bool((self._indicators(t, np.asarray(self._states(t))) != self._domains).any())

    def _bisected(self, low: float, high: float) -> float:
        while high - low > 4 * np.spacing(max(abs(low), abs(high))):
            middle = 0.5 * (low + high)
            low, high = (low, middle) if self._crossed(middle) else (middle, high)
        return high
