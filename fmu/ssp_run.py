"""What the FMUs of a system did together, and what the communication step cost."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ..components import nearest
from .errors import FMUError
from .import_run import ForeignEvent, ForeignRun

if TYPE_CHECKING:
    import pandas as pd

Array = NDArray[np.float64]
NOTABLE, TINY = 0.05, 1e-6


@dataclass(eq=False)
class SystemRun:
    """What the FMUs of a system did together; `run["body.mass.s"]` is `mass.s` of the component `body`.

    At an event two points share one time: before and after.

    Attributes:
        fmus: the run of every FMU by name, with outputs and states in the units it declares.
        communication_step: as asked [s].
        order: of the extrapolation.
        step_error: for every connected output, in its unit: the largest difference to the run with half
            the communication step; empty if that was not asked for.
        notes: what is to be known, such as a communication step that is too long.
        stats: communication steps, seconds.
    """

    name: str
    fmus: dict[str, ForeignRun]
    communication_step: float
    order: int
    step_error: dict[str, float] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)
    stats: dict[str, Any] = field(default_factory=dict)

    @property
    def time(self) -> Array:
        """Instants of the points [s]."""
        return next(iter(self.fmus.values())).time

    @property
    def events(self) -> list[ForeignEvent]:
        """Events of all FMUs, in order."""
        every = [event for run in self.fmus.values() for event in run.events]
        return sorted(every, key=lambda event: event.time)

    def names(self) -> list[str]:
        """Return the names of what was recorded."""
        return ["time", *(f"{name}.{v}" for name, run in self.fmus.items() for v in run.units)]

    def __getitem__(self, name: str) -> Array:
        """Return a variable along the run.

        Raises:
            KeyError: if it was not recorded, with the nearest name.
        """
        return self.time if name == "time" else np.array(self._of(name)[0][self._of(name)[1]])

    def unit(self, name: str) -> str:
        """Return the unit of a variable."""
        return "s" if name == "time" else self._of(name)[0].unit(self._of(name)[1])

    def _of(self, name: str) -> tuple[ForeignRun, str]:
        component, _, variable = name.partition(".")
        if component not in self.fmus or variable not in self.fmus[component]:
            raise KeyError(f"'{name}' of '{self.name}' was not recorded{nearest(name, self.names())}")
        return self.fmus[component], variable

    def to_dataframe(self) -> pd.DataFrame:
        """Return everything as a pandas DataFrame indexed by time."""
        import pandas as pd

        names = self.names()[1:]
        table = pd.DataFrame({n: self[n] for n in names}, index=pd.Index(self.time, name="time"))
        table.attrs["units"] = {n: self.unit(n) for n in names}
        return table


def compare(run: SystemRun, finer: SystemRun, exchanged: Iterable[str]) -> None:
    """Tell what the communication step costs, and refuse a run that it spoils.

    Raises:
        FMUError: if half the step changes something by more than all that it does.
    """
    begin, end = run.time[[0, -1]]
    points = np.linspace(begin, end, round((end - begin) / run.communication_step) + 1)
    for name in dict.fromkeys(exchanged):
        values, better = (np.interp(points, each.time, each[name]) for each in (run, finer))
        error, size = float(np.abs(values - better).max()), float(np.ptp(better))
        change = f"half the communication step changes '{name}' by {error:.3g} {run.unit(name)}"
        run.step_error[name] = error
        if not error <= size + TINY * float(np.abs(better).max()):
            raise FMUError(
                f"'{run.name}': {change}, more than all that it does ({size:.3g}): the coupling is unstable; "
                "give a smaller step, or cut the model elsewhere"
            )
        if error > NOTABLE * size:
            run.notes.append(f"{change}, {error / size:.0%} of its range; give a smaller step")
