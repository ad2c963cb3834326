"""Time stepping: an FMU of either kind makes a step, arrives where that ended, and switches at events."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from typing import Any

import numpy as np

from ..errors import FMUError
from .communication_steps import Course, StepSizes, rated_inputs, step_inputs
from .description import FMUDescription
from .instance import Group, Instance, Values
from .me_integrator import Integrator, Stepping

CHATTER, MOMENT = 200, 1e-9


class TimeStepper(ABC):
    """An instance that leaves initialization mode and advances from event to event.

    Args:
        instance: in initialization mode.
        fmu: what it says of itself.
        course: the continuous inputs as a function of time; may be exchanged between steps.
        stepping: what the steps keep to.

    Attributes:
        t: where it stands [s].
        event: what the last step ended at: "state", "time", "step" (the FMU asked for it), or empty.
        ended: whether the FMU asked to end.
        switches: whether it has an event mode.
        flexible: whether it takes steps of any size.
        dense: whether variables are known throughout a step.
        stats: what solved it, in how many steps.

    Raises:
        FMUError: if Model Exchange asks to end at its start.
    """

    switches = flexible = dense = True
    stats: dict[str, Any]

    def __init__(self, instance: Instance, fmu: FMUDescription, course: Course, stepping: Stepping) -> None:
        self.instance, self.name, self.course = instance, fmu.name, course
        self.t, self.event, self.ended = stepping.begin, "", False
        self._span, self._switched = stepping.stop - stepping.begin, list[float]()
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
        """Iterate the events where it stands, with inputs that are set in event mode.

        Raises:
            FMUError: if events crowd into no time.
        """
        self.instance.enter_events()
        set_inputs()
        self._update()
        self.event = ""
        self._switched = [*self._switched[1 - CHATTER :], self.t]
        duration = self.t - self._switched[0]
        if len(self._switched) == CHATTER and duration < MOMENT * self._span:
            raise FMUError(
                f"FMU '{self.name}' is chattering: {CHATTER} events within {duration:.3g} s at "
                f"t = {self.t:.9g} s"
            )

    def hold(self, inputs: Values) -> None:
        """Keep the inputs as they are given."""
        self.course = lambda t: inputs

    @abstractmethod
    def look(self, groups: list[Group], t: float | None = None) -> Values:
        """Return variables where it stands, or at t within a dense step before it arrives."""

    def save(self) -> None:
        """Remember where it stands."""
        self.instance.save()

    def restore(self) -> None:
        """Go back to what was remembered."""
        self.instance.restore()
        self.event = ""

    @abstractmethod
    def _update(self) -> None:
        """Iterate events until none is left, and leave event mode."""


class ModelExchange(TimeStepper):
    """Steps are integrated here, with error control, and end at the first state event or time event."""

    def __init__(self, instance: Instance, fmu: FMUDescription, course: Course, stepping: Stepping) -> None:
        super().__init__(instance, fmu, course, stepping)
        self.integrator = Integrator(fmu, instance, lambda t: self.course(t), stepping)
        self.stats, self._next_event = self.integrator.stats, np.inf
        self._update()
        if self.ended:
            raise FMUError(f"FMU '{fmu.name}' asked to end at its start")

    def step(self, limit: float, look_back: Callable[[], None] = lambda: None) -> None:
        self._states, located = self.integrator.step(min(limit, self._next_event))
        self.t = self.integrator.t
        look_back()
        self.look([])
        asked, self.ended = self.instance.completed_step()
        timed = self.t >= self._next_event
        self.event = "state" if located else "time" if timed else "step" if asked else ""

    def follow(self, course: Course) -> None:
        super().follow(course)
        self.integrator.restart()

    def advance(self, target: float, course: Course) -> None:
        self.follow(course)
        while self.t < target and not self.event and not self.ended:
            self.step(target)

    def look(self, groups: list[Group], t: float | None = None) -> Values:
        x = self.integrator.x if t is None else np.asarray(self._states(t))
        t = self.t if t is None else t
        return self.instance.look(t, x.tolist(), self.course(t), groups)

    def save(self) -> None:
        super().save()
        self._saved = self.t, self.integrator.x, self._next_event

    def restore(self) -> None:
        super().restore()
        self.t, self.integrator.x, self._next_event = self._saved
        self.integrator.t = self.t

    def _update(self) -> None:
        update = self.instance.update()
        self.ended = update.terminate
        self._next_event = np.inf if update.next_event is None else update.next_event
        if not self.ended:
            self.integrator.refresh()


class CoSimulation(TimeStepper):
    """Steps are the FMU's own, from communication point to communication point or an event before."""

    dense = False

    def __init__(self, instance: Instance, fmu: FMUDescription, course: Course, stepping: Stepping) -> None:
        super().__init__(instance, fmu, course, stepping)
        self.switches, self._sizes = instance.event_mode, StepSizes(fmu)
        self.flexible, self.rated = self._sizes.flexible, rated_inputs(stepping.inputs)
        self.stats, self._arrived = {"solver": "the FMU's own", "steps": 0}, True
        if self.switches:
            self._update()

    def step(self, limit: float, look_back: Callable[[], None] = lambda: None) -> None:
        duration = limit - self.t
        if self._arrived:
            self._sizes.check(self.t, duration)
        given = step_inputs(self.course, self.t, duration, self.instance.interpolates, self.rated)
        self.communicate(limit, *given)
        look_back()

    def communicate(self, limit: float, inputs: Values, rates: Values) -> None:
        """Make one step with inputs and their rates, which count if the FMU interpolates."""
        stepped = self.instance.step(self.t, limit - self.t, inputs, rates)
        self.t, self._arrived = stepped.landed(self.name, self.t, limit)
        self.ended = stepped.terminate
        self.event = "state" if stepped.event and self.switches else ""
        self.stats["steps"] += 1

    def look(self, groups: list[Group], t: float | None = None) -> Values:
        self.instance.drive(self.course(self.t))
        return self.instance.get(groups)

    def save(self) -> None:
        super().save()
        self._saved = self.t, self._arrived

    def restore(self) -> None:
        super().restore()
        self.t, self._arrived = self._saved

    def _update(self) -> None:
        self.ended = self.instance.update().terminate


STEPPERS: dict[str, type[TimeStepper]] = {"ME": ModelExchange, "CS": CoSimulation}
