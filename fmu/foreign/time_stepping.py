"""Time stepping: an FMU of either kind makes a step, arrives where that ended, and switches at events."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..errors import FMUError
from .description import FMUDescription
from .instance import Group, Instance, Values

Course = Callable[[float], Values]
CHATTERING_EVENTS, CHATTERING_SHARE = 200, 1e-9


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


class TimeStepper(ABC):
    """An instance that leaves initialization mode and advances from event to event.

    Attributes:
        course: the continuous inputs as a function of time; may be exchanged between steps.
        t: where it stands [s].
        event: what the last step ended at: "state", "time", "step" (the FMU asked for it), or empty.
        ended: whether the FMU asked to end.
        switches: whether it has an event mode.
        flexible: whether it takes steps of any size.
        dense: whether variables are known throughout a step.
        stats: what solved it, in how many steps.
    """

    switches = flexible = dense = True
    stats: dict[str, Any]
    _standing: tuple[str, ...]

    def __init__(self, instance: Instance, fmu: FMUDescription, course: Course, stepping: Stepping) -> None:
        self.instance, self.name, self.course = instance, fmu.name, course
        self.t, self.event, self.ended = stepping.begin, "", False
        self._span = stepping.stop - stepping.begin
        self._saved: dict[str, dict[str, Any]] = {}
        self._switched = deque[float](maxlen=CHATTERING_EVENTS)
        instance.started()

    @abstractmethod
    def step(self, limit: float, look_back: Callable[[], None] = lambda: None) -> None:
        """Make one step, at most to `limit`, and arrive there or at the first event.

        Before it arrives it calls `look_back`, while `look` knows variables throughout a dense step.
        """

    def follow(self, course: Course) -> None:
        """Take the inputs from another course, or from one that bends here."""
        self.course = course

    def advance(self, target: float, course: Course) -> None:
        """Go towards `target` with inputs that follow a course, and arrive there or at an event before."""
        self.follow(course)
        self.step(target)

    def switch(self, set_inputs: Callable[[], None] = lambda: None) -> None:
        """Iterate the events where it stands, with inputs that are set in event mode; refuse chattering."""
        self.instance.enter_events()
        set_inputs()
        self._update()
        self.event = ""
        self._switched.append(self.t)
        duration = self.t - self._switched[0]
        if len(self._switched) == CHATTERING_EVENTS and duration < CHATTERING_SHARE * self._span:
            raise FMUError(
                f"FMU '{self.name}' is chattering: {CHATTERING_EVENTS} events within {duration:.3g} s at "
                f"t = {self.t:.9g} s"
            )

    def hold(self, inputs: Values) -> None:
        """Keep the inputs as they are given."""
        self.course = lambda t: inputs

    @abstractmethod
    def look(self, groups: list[Group], t: float | None = None) -> Values:
        """Return variables where it stands, or at t within a dense step before it arrives."""

    def save(self, place: str = "") -> None:
        """Remember where it stands, in one of several places."""
        self.instance.save(place)
        self._saved[place] = {name: getattr(self, name) for name in self._standing}

    def restore(self, place: str = "") -> None:
        """Go back to what was remembered."""
        self.instance.restore(place)
        vars(self).update(self._saved[place], event="")

    @abstractmethod
    def _update(self) -> None:
        """Iterate events until none is left, and leave event mode."""
