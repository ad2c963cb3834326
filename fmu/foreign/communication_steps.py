"""Communication steps: which sizes an FMU takes, and what it is given for one."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from ..errors import FMUError
from .description import FMUDescription
from .instance import Values

Course = Callable[[float], Values]
ROUNDING = 1e-6


class StepSizes:
    """Holds communication steps to the sizes that a Co-Simulation FMU takes.

    Attributes:
        flexible: whether it takes any size.
    """

    def __init__(self, fmu: FMUDescription) -> None:
        self._name = fmu.name
        self.flexible = fmu.capable("CS", "canHandleVariableCommunicationStepSize")
        self._inner = float(fmu.declared("CS", "fixedInternalStepSize") or 0.0)
        self._only: float | None = None

    def check(self, t: float, duration: float) -> None:
        """Refuse a step that an FMU of one size does not take.

        Raises:
            FMUError: if it has another size than those before, or is no multiple of the FMU's own step.
        """
        if self.flexible:
            return
        self._only = self._only or duration
        if abs(duration - self._only) > ROUNDING * self._only:
            raise FMUError(
                f"FMU '{self._name}' takes communication steps of one size only ({self._only:g} s) and "
                f"cannot stop at t = {t + duration:g} s, where another has an event or an input jumps"
            )
        count = duration / self._inner if self._inner else 1.0
        if round(count) < 1 or abs(count - round(count)) > ROUNDING * count:
            raise FMUError(
                f"FMU '{self._name}' takes communication steps that are multiples of its own step of "
                f"{self._inner:g} s, got {duration:g} s"
            )


def step_inputs(
    course: Course, t: float, duration: float, interpolates: bool, rated: dict[int, int]
) -> tuple[Values, Values]:
    """Return inputs for a communication step, and their rates for an FMU that interpolates.

    What it holds over the step is the mean of the course. An input x beside an input der(x) is given where
    the step begins, as it follows der(x).
    """
    first, middle, last = (np.array(course(t + share * duration)) for share in (0.0, 0.5, 1.0))
    if interpolates:
        inputs, rates = first, (last - first) / duration
    else:
        inputs, rates = (first + 4 * middle + last) / 6, 0 * first
    for place, rate in rated.items():
        inputs[place], rates[place] = first[place], inputs[rate]
    return inputs.tolist(), rates.tolist()


def rated_inputs(inputs: Sequence[str]) -> dict[int, int]:
    """Return the places of inputs whose derivative is an input, too, and of that: x and der(x), der(x,2)."""
    found = {}
    for place, name in enumerate(inputs):
        inner, _, order = name.removeprefix("der(").removesuffix(")").partition(",")
        rate = f"der({name})" if inner == name else f"der({inner},{int(order or 1) + 1})"
        if rate in inputs:
            found[place] = inputs.index(rate)
    return found
