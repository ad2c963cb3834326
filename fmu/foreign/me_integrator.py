"""Solving a Model Exchange FMU: integration steps with error control, and where events end them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import FMUError
from .instance import Instance, Update, Values, finite

Array = NDArray[np.float64]
SMALLEST = 1e-6
MANY_STEPS = 25
INSIDE = (0.25, 0.5, 0.75, 1.0)
CHATTER, MOMENT = 200, 1e-9
NOTHING = 1e-100


@dataclass(frozen=True, eq=False)
class Piece:
    """One accepted step, or its part before a state event; `states` is defined throughout."""

    begin: float
    end: float
    states: Callable[[float], Array]
    event: bool


class Solver:
    """Integrates an instance of Model Exchange from event to event, with methods of SciPy.

    LSODA (ODEPACK) serves long stretches. Where inputs change their course in short intervals, it would begin
    anew each time with low order; there the Runge-Kutta method of Dormand and Prince does, until an interval
    takes it more than 25 steps, as happens when the FMU is stiff.

    A state event is where an indicator changes between positive and not positive; it is looked for at
    four points of every step and bisected to rounding error.

    Args:
        name: of the FMU, for errors.
        instance: in continuous-time mode.
        watched: number of event indicators.
        drive: the driven inputs as a function of time; may be exchanged between steps.
        t: where it stands [s].
        rtol: relative tolerance; absolute is 0.01 rtol times the nominal value of a state.
        longest: longest step [s].
        intervals: whether inputs change their course in short intervals.
    """

    def __init__(
        self, name: str, instance: Instance, watched: int, drive: Callable[[float], Values], t: float,
        rtol: float, longest: float, intervals: bool = False,
    ) -> None:  # fmt: skip
        self.name, self.instance, self.drive, self.t = name, instance, drive, t
        self.watched, self.rtol, self.longest = watched, rtol, longest
        self.next_event = np.inf
        self.intervals, self._taken, self._stride = intervals, 0, np.inf
        self.steps = self.evaluations = 0
        self.refresh()

    def refresh(self) -> None:
        """Read the states anew, after events."""
        self.x = finite(self.name, "a continuous state", self.t, self.instance.states())
        nominals = np.abs(self.instance.nominals())
        self.nominals = np.where(nominals > 0, nominals, 1.0)
        self._method: Any = None
        self._domains = self._indicators(self.t, self.x)

    def restart(self) -> None:
        """Begin anew with the next step, as the inputs take another course."""
        self._method = None
        self._taken = 0

    def _rates(self, t: float, x: Array) -> Array:
        self.evaluations += 1
        rates = self.instance.derivatives(float(t), x.tolist(), self.drive(float(t)))
        found: Array = finite(self.name, "a derivative", t, rates)
        found[np.abs(found) < NOTHING] = 0.0  # LSODA divides by what underflows
        return found

    def _indicators(self, t: float, x: Array) -> NDArray[np.bool_]:
        if not self.watched:
            return np.zeros(0, dtype=bool)
        values = self.instance.indicators(float(t), x.tolist(), self.drive(float(t)))
        above: NDArray[np.bool_] = finite(self.name, "an event indicator", t, values) > 0
        return above

    def step(self, limit: float) -> Piece:
        """Make one step, at most to `limit`; end it at the first state event.

        Raises:
            FMUError: if the step size falls to nothing, or the FMU returns no finite numbers.
        """
        limit = min(limit, self.next_event)
        begin = self.t
        states, end = self._advanced(limit)
        event = self._first_event(begin, end, states)
        if event is not None:
            end = event
            self.x = np.asarray(states(end))
        elif self._method is not None:
            self.x = self._method.y
        self.t = end
        return Piece(begin, end, states, event is not None)

    def _advanced(self, limit: float) -> tuple[Callable[[float], Array], float]:
        if not len(self.x) or limit - self.t <= 4 * np.spacing(max(abs(limit), abs(self.t))):
            x, self._method = self.x, None
            return lambda t: x, min(limit, self.t + self.longest)
        self.intervals = self.intervals and self._taken <= MANY_STEPS
        if self._method is None or self._method.t_bound != limit or self._taken == MANY_STEPS + 1:
            self._method = self._begun(limit)
        message = self._method.step()
        self.steps += 1
        self._taken += 1
        if self._method.status == "failed":
            raise FMUError(self._failure(message))
        self._stride = max(self._method.h_abs, self._method.step_size) if self.intervals else np.inf
        return self._method.dense_output(), float(self._method.t)

    def _begun(self, limit: float) -> Any:
        from scipy.integrate import LSODA, RK45

        options: dict[str, Any] = {"rtol": self.rtol, "atol": SMALLEST * self.rtol * self.nominals}
        options["max_step"] = self.longest
        if not self.intervals:
            return LSODA(self._rates, self.t, self.x, limit, **options)
        return RK45(
            self._rates, self.t, self.x, limit, first_step=min(limit - self.t, self._stride), **options
        )

    def _failure(self, message: str) -> str:
        rates = self._rates(self.t, self.x)
        fastest = int(np.argmax(np.abs(rates) / self.nominals))
        return (
            f"FMU '{self.name}': integration failed at t = {self.t:.9g} s, where state {fastest + 1} of "
            f"{len(rates)} moves fastest ({rates[fastest]:.4g}/s): {message}"
        )

    def _first_event(self, begin: float, end: float, states: Callable[[float], Array]) -> float | None:
        low = begin
        if not self.watched:
            return None
        for share in INSIDE:
            high = begin + share * (end - begin)
            if (self._indicators(high, np.asarray(states(high))) != self._domains).any():
                return self._bisected(low, high, states)
            low = high
        return None

    def _bisected(self, low: float, high: float, states: Callable[[float], Array]) -> float:
        while high - low > 4 * np.spacing(max(abs(low), abs(high))):
            middle = 0.5 * (low + high)
            if (self._indicators(middle, np.asarray(states(middle))) != self._domains).any():
                high = middle
            else:
                low = middle
        return high

    def arrive(self) -> tuple[bool, bool]:
        """Bring the FMU to where the last step ended; return whether it wants event mode, or an end."""
        self.instance.look(self.t, self.x.tolist(), self.drive(self.t), [])
        return self.instance.completed_step()

    def switch(self) -> Update:
        """Iterate events where the solver stands, and continue from what comes of them."""
        self.instance.enter_events()
        return self.updated()

    def updated(self) -> Update:
        """Iterate events in event mode (as after the start)."""
        update = self.instance.update()
        self.next_event = np.inf if update.next_event is None else update.next_event
        if not update.terminate:
            self.refresh()
        return update


@dataclass(eq=False)
class Chatter:
    """Notices events that crowd into no time."""

    name: str
    span: float
    times: list[float]

    def happened(self, t: float) -> None:
        """Count an event.

        Raises:
            FMUError: if there were too many within a moment.
        """
        self.times = [*self.times[1 - CHATTER :], t]
        if len(self.times) == CHATTER and t - self.times[0] < MOMENT * self.span:
            raise FMUError(
                f"FMU '{self.name}' is chattering: {CHATTER} events within {t - self.times[0]:.3g} s at "
                f"t = {t:.9g} s"
            )
