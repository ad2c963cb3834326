"""Participants: FMUs that advance from communication point to communication point, whatever their kind."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from ...base import Array
from ..fmu import FMU
from ..foreign.initialization import STEPPERS, enter_initialization
from ..foreign.instance import Values, finite
from ..foreign.run import ForeignEvent, empty_run
from ..foreign.time_stepping import Stepping, TimeStepper

Signal = Callable[[float], float]
SAME_VALUE = 1e-9


@dataclass(frozen=True)
class CommunicationPoints:
    """Points from `begin` to `stop`, every `step` [s], and the order of extrapolation between them."""

    begin: float
    stop: float
    step: float
    order: int

    @property
    def times(self) -> Array:
        """The points [s]."""
        count = max(1, round((self.stop - self.begin) / self.step))
        return np.linspace(self.begin, self.stop, count + 1)

    @property
    def halved(self) -> CommunicationPoints:
        """Points at half the step."""
        return replace(self, step=self.step / 2)


@dataclass(frozen=True)
class Member:
    """An FMU in a system: its kind ("ME" or "CS"), parameters, start values, signals of free inputs."""

    fmu: FMU
    kind: str
    parameters: dict[str, Any]
    start: dict[str, Any]
    inputs: dict[str, Signal] = field(default_factory=dict)


class Participant:
    """One FMU in co-simulation: it is initialised, advances step by step, and switches at its events.

    It is given `inputs` by name, and gives the `outputs` that the others need.

    Attributes:
        row: all that is recorded of it, as read last.
    """

    stepper: TimeStepper

    def __init__(
        self, member: Member, inputs: Sequence[str], outputs: Sequence[str], points: CommunicationPoints,
        rtol: float,
    ) -> None:  # fmt: skip
        self.fmu, self.kind = member.fmu, member.kind
        begin, stop = points.begin, points.stop
        self._stepping = Stepping(begin, stop, rtol, inputs, stop - begin, intervals=True)
        self._last_event = -np.inf
        self.run, self._wanted = empty_run(self.fmu, outputs)
        self._places = [list(self.run.units).index(name) for name in outputs]
        self.reversible = self.fmu.capable(self.kind, "canGetAndSetFMUstate")
        self.instance = self.fmu.instantiate(self.kind)
        try:
            self.run.notes += enter_initialization(
                self.instance, self.fmu, self._stepping, member.parameters, member.start
            )
        except BaseException:
            self.instance.close()
            raise

    def initial(self, inputs: Values) -> Array:
        """Return the outputs that inputs bring about while it is initialised."""
        self.instance.drive(inputs)
        return self._read(self._stepping.begin, self.instance.get(self._wanted))

    def begin(self, inputs: Values) -> Array:
        """Leave initialisation and return the outputs."""
        self.instance.drive(inputs)
        self.stepper = STEPPERS[self.kind](self.instance, self.fmu, lambda t: inputs, self._stepping)
        return self.outputs(inputs)

    def outputs(self, inputs: Values) -> Array:
        """Return the outputs where it stands."""
        self.stepper.hold(inputs)
        return self._read(self.stepper.t, self.stepper.look(self._wanted))

    def _read(self, t: float, values: Values) -> Array:
        self.row: Array = finite(self.fmu.name, "an output", t, values)
        return np.asarray(self.row[self._places])

    def record(self) -> None:
        """Record all that was read last."""
        self.run.record(self.stepper.t, self.row.tolist())

    def settle(self, inputs: Values, jumped: bool = False) -> bool:
        """Iterate the event that the last step ended at, or that jumps bring about; tell if there was one."""
        stepper, reached = self.stepper, self.stepper.event
        cause = reached or ("input" if jumped and stepper.switches else "")
        if not cause or stepper.ended:
            return False
        stepper.hold(inputs)
        stepper.switch(lambda: self.instance.drive(inputs))
        if reached or stepper.t > self._last_event:
            self.run.events.append(ForeignEvent(stepper.t, cause))
        self._last_event = stepper.t
        return True

    def conclude(self) -> list[str]:
        """Note whether it ended early, and return all notes."""
        if self.stepper.ended and self.stepper.t < self._stepping.stop:
            self.run.notes.append(f"the FMU asked to end at t = {self.stepper.t:.9g} s, and so the run did")
        return [f"FMU '{self.fmu.name}': {note}" for note in self.run.notes]


def jumped(before: Values, now: Values) -> bool:
    """Tell whether values are others than before, by more than rounding."""
    size = np.abs([*before, *now]).max(initial=0.0)
    return bool(np.abs(np.subtract(now, before)).max(initial=0.0) > SAME_VALUE * size)
