"""Instances: what a run asks of an FMU, wherever its binary runs."""

from __future__ import annotations

from typing import Any, NamedTuple, Protocol, Self

import numpy as np

from ..errors import FMUError

Values = list[Any]
Group = tuple[str, list[int], int]


class Update(NamedTuple):
    """What an FMU says after its events were iterated."""

    terminate: bool
    nominals_changed: bool
    states_changed: bool
    next_event: float | None


class Stepped(NamedTuple):
    """How a Co-Simulation step ended."""

    reached: float
    event: bool
    terminate: bool

    def landed(self, name: str, t: float, target: float) -> tuple[float, bool]:
        """Return where a step from `t` led, and whether that is its target, which rounding may hide.

        Raises:
            FMUError: if it led nowhere, neither to an event nor to the end.
        """
        if self.reached >= target - 4 * np.spacing(abs(target)):
            return target, True
        if self.reached <= t and not (self.event or self.terminate):
            raise FMUError(f"FMU '{name}' does not advance beyond t = {t:.9g} s")
        return self.reached, False


class Instance(Protocol):
    """What a run does with an instance; only plain numbers, texts and lists pass.

    A group is (FMI type, value references, number of values). The inputs chosen at the start are set
    with every evaluation.
    """

    def start(
        self, begin: float, stop: float, rtol: float, values: list[tuple[Group, Values]], inputs: list[int]
    ) -> None: ...

    def started(self) -> None: ...

    def set(self, group: Group, values: Values) -> None: ...

    def get(self, groups: list[Group]) -> Values: ...

    def drive(self, inputs: Values) -> None: ...

    def states(self) -> Values: ...

    def nominals(self) -> Values: ...

    def derivatives(self, t: float, x: Values, inputs: Values) -> Values: ...

    def indicators(self, t: float, x: Values, inputs: Values) -> Values: ...

    def look(self, t: float, x: Values, inputs: Values, groups: list[Group]) -> Values: ...

    def completed_step(self) -> tuple[bool, bool]: ...

    def enter_events(self) -> None: ...

    def update(self) -> Update: ...

    def step(self, t: float, duration: float, inputs: Values, rates: Values) -> Stepped: ...

    def save(self) -> None: ...

    def restore(self) -> None: ...

    event_mode: bool
    interpolates: bool

    def close(self) -> None: ...

    def __enter__(self) -> Self: ...

    def __exit__(self, *_: object) -> None: ...


def finite(name: str, what: str, t: float, values: Values) -> Any:
    """Return values as an array.

    Raises:
        FMUError: if one is no finite number.
    """
    array = np.asarray(values, dtype=float)
    if not np.isfinite(array).all():
        bad = float(array[~np.isfinite(array)][0])
        raise FMUError(f"FMU '{name}' returned {bad} as {what} at t = {t:.9g} s")
    return array
