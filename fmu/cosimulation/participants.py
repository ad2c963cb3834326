"""Participants: FMUs that advance in communication steps, whatever their kind."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import FMUError
from ..fmu import FMU
from ..foreign.inputs import chosen_values, groups
from ..foreign.instance import Group, Instance, Values, finite
from ..foreign.me_integrator import Chatter, Solver
from ..foreign.simulate import ForeignEvent, ForeignRun, recorded_variables
from .communication_steps import Course, StepSizes, followed_inputs, given, untaken

Array = NDArray[np.float64]
SAME = 1e-9


class Participant:
    """One FMU in co-simulation: it is initialised, advances step by step, and switches at its events.

    Args:
        fmu: which.
        kind: "ME" or "CS".
        inputs: names of the inputs that are driven.
        outputs: names of the variables that the others need.
        span: begin and stop [s].
        rtol: relative tolerance.
        parameters, start: values by name.
    """

    def __init__(
        self, fmu: FMU, kind: str, inputs: list[str], outputs: list[str], span: tuple[float, float],
        rtol: float, parameters: dict[str, Any], start: dict[str, Any],
    ) -> None:  # fmt: skip
        self.fmu, self.span, self.rtol = fmu, span, rtol
        self.t, self.ended, self._pending = span[0], False, ""
        self._last_event = -np.inf
        values = chosen_values(fmu, parameters, start)
        recorded = recorded_variables(fmu, tuple(outputs))
        names = [c for v in recorded for c in v.columns]
        self.run = ForeignRun(fmu.name, {c: v.unit for v in recorded for c in v.columns})
        self._places = [names.index(name) for name in outputs]
        self._wanted: list[Group] = groups(recorded)
        self.reversible = fmu.capable(kind, "canGetAndSetFMUstate")
        self._chatter = Chatter(fmu.name, span[1] - span[0], [])
        self._followed = followed_inputs(inputs)
        self.instance: Instance = fmu.instantiate(kind)
        references = [fmu.variables[name].reference for name in inputs]
        try:
            self.instance.start(*span, rtol, list(values.values()), references)
            self.run.notes += untaken(fmu, self.instance, values)
        except BaseException:
            self.instance.close()
            raise

    def initial(self, inputs: Values) -> Array:
        """Return the outputs that inputs bring about while it is initialised."""
        self.instance.drive(inputs)
        return self._read(self.instance.get(self._wanted))

    def begin(self, inputs: Values) -> Array:
        """Leave initialisation and return the outputs."""
        self.instance.drive(inputs)
        self.instance.started()
        self._first(inputs)
        return self.outputs(inputs)

    def _read(self, values: Values) -> Array:
        found: Array = finite(self.fmu.name, "an output", self.t, values)
        self._row = found
        return found[self._places]

    def outputs(self, inputs: Values) -> Array:
        """Return the outputs where it stands."""
        return self._read(self._values(inputs))

    def record(self) -> None:
        """Keep all that was read last."""
        self.run.record(self.t, self._row.tolist())

    def settle(self, inputs: Values, jumped: bool = False) -> bool:
        """Iterate the event that the last step ended at, or that inputs which jumped bring about.

        Return whether there was one.
        """
        cause = self._pending or ("input" if jumped and self.switches else "")
        if not cause or self.ended:
            return False
        self.instance.enter_events()
        self.instance.drive(inputs)
        self._updated(inputs)
        if self._pending or self.t > self._last_event:
            self.run.events.append(ForeignEvent(self.t, cause))
        self._last_event, self._pending = self.t, ""
        self._chatter.happened(self.t)
        return True

    @property
    def switches(self) -> bool:
        """Whether it has an event mode."""
        raise NotImplementedError

    @property
    def flexible(self) -> bool:
        """Whether it takes communication steps of any size."""
        raise NotImplementedError

    def tell(self) -> list[str]:
        """Return notes on how it went."""
        if self.ended and self.t < self.span[1]:
            self.run.notes.append(f"the FMU asked to end at t = {self.t:.9g} s, and so the run did")
        return [f"FMU '{self.fmu.name}': {note}" for note in self.run.notes]

    def close(self) -> None:
        """Free the instance."""
        self.instance.close()

    def _first(self, inputs: Values) -> None:
        raise NotImplementedError

    def _values(self, inputs: Values) -> Values:
        raise NotImplementedError

    def _updated(self, inputs: Values) -> None:
        raise NotImplementedError

    def advance(self, target: float, course: Course) -> float:
        """Go towards `target` with inputs that follow a course; return where it ended, at an event maybe."""
        raise NotImplementedError

    def keep(self) -> None:
        """Remember where it stands."""
        self.instance.save()

    def go_back(self) -> None:
        """Return to what was remembered."""
        self.instance.restore()
        self._pending = ""


class ExchangeParticipant(Participant):
    """A Model Exchange FMU, integrated here with error control and event location."""

    @property
    def switches(self) -> bool:
        return True

    @property
    def flexible(self) -> bool:
        return True

    def _first(self, inputs: Values) -> None:
        update = self.instance.update()
        if update.terminate:
            raise FMUError(f"FMU '{self.fmu.name}' asked to end at its start")
        watched = self.fmu.description.numberOfEventIndicators
        begin, stop = self.span
        self.solver = Solver(
            self.fmu.name,
            self.instance,
            watched,
            lambda t: inputs,
            begin,
            self.rtol,
            stop - begin,
            intervals=True,
        )
        self.solver.next_event = np.inf if update.next_event is None else update.next_event

    def _values(self, inputs: Values) -> Values:
        return self.instance.look(self.t, self.solver.x.tolist(), inputs, self._wanted)

    def _updated(self, inputs: Values) -> None:
        self.solver.drive = lambda t: inputs
        self.ended = self.solver.updated().terminate

    def advance(self, target: float, course: Course) -> float:
        solver = self.solver
        solver.drive = course
        solver.restart()
        while solver.t < target and not self._pending and not self.ended:
            piece = solver.step(target)
            asked, self.ended = solver.arrive()
            timed = solver.t >= solver.next_event
            self._pending = "state" if piece.event else "time" if timed else "step" if asked else ""
        self.t = solver.t
        return self.t

    def keep(self) -> None:
        super().keep()
        self._kept = self.solver.t, self.solver.x, self.solver.next_event

    def go_back(self) -> None:
        super().go_back()
        self.solver.t, self.solver.x, self.solver.next_event = self._kept
        self.t = self.solver.t


class SlaveParticipant(Participant):
    """A Co-Simulation FMU, which holds its inputs over a step unless it can interpolate them."""

    @property
    def switches(self) -> bool:
        """Whether it has an event mode."""
        return self.instance.event_mode

    @property
    def flexible(self) -> bool:
        """Whether it takes communication steps of any size."""
        return self._sizes.flexible

    def _first(self, inputs: Values) -> None:
        self._sizes = StepSizes(self.fmu)
        if self.switches:
            self._updated(inputs)

    def _values(self, inputs: Values) -> Values:
        self.instance.drive(inputs)
        return self.instance.get(self._wanted)

    def _updated(self, inputs: Values) -> None:
        self.ended = self.instance.update().terminate

    def advance(self, target: float, course: Course) -> float:
        duration = target - self.t
        self._sizes.check(self.t, duration)
        inputs, rates = given(course, self.t, duration, self.instance.interpolates, self._followed)
        stepped = self.instance.step(self.t, duration, inputs, rates)
        self.t, _ = stepped.landed(self.fmu.name, self.t, target)
        self.ended = stepped.terminate
        self._pending = "state" if stepped.event and self.switches else ""
        return self.t

    def keep(self) -> None:
        super().keep()
        self._kept = self.t

    def go_back(self) -> None:
        super().go_back()
        self.t = self._kept


def jumped(before: Values, now: Values) -> bool:
    """Tell whether values are others than before, by more than rounding."""
    size = np.abs([*before, *now]).max(initial=0.0)
    return bool(np.abs(np.subtract(now, before)).max(initial=0.0) > SAME * size)


def participant(kind: str, *arguments: Any) -> Participant:
    """Return a participant of a kind."""
    classes: dict[str, type[Participant]] = {"ME": ExchangeParticipant, "CS": SlaveParticipant}
    return classes[kind](arguments[0], kind, *arguments[1:])
