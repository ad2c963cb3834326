"""What every run of several participants tells, and what its communication step costs."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ...networks import Event, OverTime
from ..errors import FMUError
from ..foreign.run import ForeignEvent, ForeignRun

NOTED_RANGE_SHARE, ROUNDING_SHARE = 0.05, 1e-6


@dataclass(eq=False)
class ExchangeRun(OverTime):
    """What participants did together that exchange at communication points.

    Attributes:
        fmus: the run of every FMU by name, in the units that it declares.
        communication_step: as asked [s].
        order: of the extrapolation.
        step_error: for everything exchanged, by name, in its unit: the largest difference to the run with
            half the communication step; empty if that was not asked for.
        notes: what is to be known, such as a communication step that is too long.
        stats: communication steps, seconds.
    """

    fmus: dict[str, ForeignRun]
    communication_step: float
    order: int
    step_error: dict[str, float] = field(default_factory=dict, kw_only=True)
    notes: list[str] = field(default_factory=list, kw_only=True)
    stats: dict[str, Any] = field(default_factory=dict, kw_only=True)

    @property
    def events(self) -> list[Event | ForeignEvent]:
        """Events of all, in order."""
        every = [event for run in self.fmus.values() for event in run.events]
        return sorted([*self._own_events(), *every], key=lambda event: event.time)

    def _own_events(self) -> list[Event]:
        return []


def compare(run: ExchangeRun, finer: ExchangeRun, exchanged: Iterable[str]) -> None:
    """Tell what the communication step costs; refuse a run in which it changes more than all that moves."""
    begin, end = run.time[[0, -1]]
    points = np.linspace(begin, end, round((end - begin) / run.communication_step) + 1)
    for name in dict.fromkeys(exchanged):
        values, better = (np.interp(points, each.time, each[name]) for each in (run, finer))
        error = float(np.abs(values - better).max())
        size = float(min(np.ptp(values), np.ptp(better)))
        most = float(min(np.abs(values).max(), np.abs(better).max()))
        change = f"half the communication step changes '{name}' by {error:.3g} {run.unit(name)}"
        run.step_error[name] = error
        if not error <= size + ROUNDING_SHARE * most:
            raise FMUError(
                f"'{run.name}': {change}, more than all that it does ({size:.3g}): the coupling is "
                "unstable; give a much smaller step, or cut the model where the side that extrapolates has "
                "more mass or less stiffness"
            )
        if error > NOTED_RANGE_SHARE * size:
            run.notes.append(f"{change}, {error / size:.0%} of its range; give a smaller step")
