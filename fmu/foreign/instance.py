"""Instances of an FMU, wherever its binary runs, and what passes between them and a run."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

import numpy as np

from ..errors import FMUError

if TYPE_CHECKING:
    from .in_process import LocalInstance
    from .subprocess_instance import IsolatedInstance

Instance: TypeAlias = "LocalInstance | IsolatedInstance"
Values = list[Any]
Group = tuple[str, list[int], int]


class Update(NamedTuple):
    """What an FMU says after its events were iterated."""

    terminate: bool
    next_event: float | None


class Stepped(NamedTuple):
    """How a Co-Simulation step ended."""

    reached: float
    event: bool
    terminate: bool

    def landed(self, name: str, t: float, target: float) -> tuple[float, bool]:
        """Return where a step from `t` led, and whether that is its target; refuse one that led nowhere."""
        if self.reached >= target - 4 * np.spacing(abs(target)):
            return target, True
        if self.reached <= t and not (self.event or self.terminate):
            raise FMUError(f"FMU '{name}' does not advance beyond t = {t:.9g} s")
        return self.reached, False


def finite(name: str, what: str, t: float, values: Values) -> Any:
    """Return values as an array; refuse what is no finite number."""
    array = np.asarray(values, dtype=float)
    if not np.isfinite(array).all():
        bad = float(array[~np.isfinite(array)][0])
        raise FMUError(f"FMU '{name}' returned {bad} as {what} at t = {t:.9g} s")
    return array
