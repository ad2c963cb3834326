"""Participants: FMUs that advance in communication steps, whatever their kind."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .errors import FMUError
from .foreign import Group, Instance, Values, finite
from .import_inputs import chosen_values, groups
from .import_run import ForeignEvent, ForeignRun, recorded_variables
from .import_solver import Chatter, Solver
from .imported import FMU

Array = NDArray[np.float64]
Course = Callable[[float], Values]


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
            self.instance.start(*span, rtol, values, references)
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

    def settle(self, inputs: Values) -> bool:
        """Iterate the event that the last step ended at; tell whether there was one."""
        if not self._pending:
            return False
        self.instance.enter_events()
        self.instance.drive(inputs)
        self._updated()
        self.run.events.append(ForeignEvent(self.t, self._pending))
        self._chatter.happened(self.t)
        self._pending = ""
        return True

    def close(self) -> None:
        """Free the instance."""
        self.instance.close()

    def _first(self, inputs: Values) -> None:
        raise NotImplementedError

    def _values(self, inputs: Values) -> Values:
        raise NotImplementedError

    def _updated(self) -> None:
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

    def _updated(self) -> None:
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
    """A Co-Simulation FMU, which holds its inputs over a step unless it can interpolate them.

    What is held is the mean of the course over the step. An input x whose derivative der(x) is an input,
    too, is given where the step begins: it follows der(x).
    """

    def _first(self, inputs: Values) -> None:
        self._only: float | None = None
        if self.instance.event_mode:
            self._updated()

    def _values(self, inputs: Values) -> Values:
        self.instance.drive(inputs)
        return self.instance.get(self._wanted)

    def _updated(self) -> None:
        self.ended = self.instance.update().terminate

    def advance(self, target: float, course: Course) -> float:
        duration = target - self.t
        self._check_step(duration)
        first, middle, last = (np.array(course(self.t + share * duration)) for share in (0.0, 0.5, 1.0))
        if self.instance.interpolates:
            inputs, rates = first, (last - first) / duration
        else:
            inputs, rates = (first + 4 * middle + last) / 6, 0 * first
        for place, rate in self._followed.items():
            inputs[place], rates[place] = first[place], inputs[rate]
        stepped = self.instance.step(self.t, duration, inputs.tolist(), rates.tolist())
        self.t, _ = stepped.landed(self.fmu.name, self.t, target)
        self.ended = stepped.terminate
        self._pending = "state" if stepped.event and self.instance.event_mode else ""
        return self.t

    def _check_step(self, duration: float) -> None:
        if self.fmu.capable("CS", "canHandleVariableCommunicationStepSize"):
            return
        self._only = self._only or duration
        if abs(duration - self._only) > 1e-6 * self._only:
            raise FMUError(
                f"FMU '{self.fmu.name}' takes communication steps of one size only ({self._only:g} s) and "
                f"cannot stop at the event of another at t = {self.t + duration:g} s"
            )

    def keep(self) -> None:
        super().keep()
        self._kept = self.t

    def go_back(self) -> None:
        super().go_back()
        self.t = self._kept


def followed_inputs(inputs: list[str]) -> dict[int, int]:
    """Return the places of inputs whose derivative is an input, too, and of that: x and der(x), der(x,2)."""
    found = {}
    for place, name in enumerate(inputs):
        inner, _, order = name.removeprefix("der(").removesuffix(")").partition(",")
        rate = f"der({name})" if inner == name else f"der({inner},{int(order or 1) + 1})"
        if rate in inputs:
            found[place] = inputs.index(rate)
    return found


def participant(kind: str, *arguments: Any) -> Participant:
    """Return a participant of a kind."""
    classes: dict[str, type[Participant]] = {"ME": ExchangeParticipant, "CS": SlaveParticipant}
    return classes[kind](arguments[0], kind, *arguments[1:])
