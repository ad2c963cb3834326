"""Co-Simulation: communication steps, which sizes an FMU takes, and what it is given for one."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from ..errors import FMUError
from .description import FMUDescription
from .instance import Group, Instance, Values
from .time_stepping import Course, Stepping, TimeStepper

SAME_SIZE = 1e-6


class CoSimulation(TimeStepper):
    """Steps are the FMU's own, from communication point to communication point or an event before."""

    dense = False
    _standing = "t", "_arrived", "ended"

    def __init__(self, instance: Instance, fmu: FMUDescription, course: Course, stepping: Stepping) -> None:
        super().__init__(instance, fmu, course, stepping)
        self.switches, self._rated = instance.event_mode, _rated(stepping.inputs)
        self.flexible = fmu.capable("CS", "canHandleVariableCommunicationStepSize")
        self._own_step = float(fmu.declared("CS", "fixedInternalStepSize") or 0.0)
        self._only_step = 0.0
        self.stats, self._arrived = {"solver": "the FMU's own", "steps": 0}, True
        if self.switches:
            self._update()

    def step(self, limit: float, look_back: Callable[[], None] = lambda: None) -> None:
        duration = limit - self.t
        if self._arrived and not self.flexible:
            self._check_size(duration)
        first, middle, last = (self.course(self.t + share * duration) for share in (0.0, 0.5, 1.0))
        mean = [(a + 4 * b + c) / 6 for a, b, c in zip(first, middle, last, strict=True)]
        inputs, rates = self.step_inputs(first, mean, last, duration)
        for place, rate in self._rated.items():
            rates[place] = inputs[rate]
        self.communicate(limit, inputs, rates)
        look_back()

    def step_inputs(
        self, first: Values, mean: Values, last: Values, duration: float
    ) -> tuple[Values, Values]:
        """Return inputs for a communication step, and their rates for an FMU that interpolates.

        What it holds over the step is their mean. An input x beside an input der(x) is given where the step
        begins, as it follows der(x).
        """
        if self.instance.interpolates:
            return first, [(b - a) / duration for a, b in zip(first, last, strict=True)]
        inputs = [first[place] if place in self._rated else value for place, value in enumerate(mean)]
        return inputs, [0.0] * len(inputs)

    def _check_size(self, duration: float) -> None:
        """Refuse a step of another size than those before, or that is no multiple of the FMU's own."""
        only = self._only_step = self._only_step or duration
        if abs(duration - only) > SAME_SIZE * only:
            raise FMUError(
                f"FMU '{self.name}' takes communication steps of one size only ({only:g} s) and cannot stop "
                f"at t = {self.t + duration:g} s, where another has an event or an input jumps"
            )
        count = duration / self._own_step if self._own_step else 1.0
        if round(count) < 1 or abs(count - round(count)) > SAME_SIZE * count:
            raise FMUError(
                f"FMU '{self.name}' takes communication steps that are multiples of its own step of "
                f"{self._own_step:g} s, got {duration:g} s"
            )

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

    def _update(self) -> None:
        self.ended = self.instance.update().terminate


def _rated(inputs: Sequence[str]) -> dict[int, int]:
    """Return the places of inputs whose derivative is an input, too, and of that: x and der(x), der(x,2)."""
    found = {}
    for place, name in enumerate(inputs):
        inner, _, order = name.removeprefix("der(").removesuffix(")").partition(",")
        rate = f"der({name})" if inner == name else f"der({inner},{int(order or 1) + 1})"
        if rate in inputs:
            found[place] = inputs.index(rate)
    return found
