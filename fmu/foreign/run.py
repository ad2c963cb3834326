"""What an FMU gave along a run."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from ...base import Array, text
from ...components import UnknownNameError, nearest
from ...networks import OverTime
from .description import FMUDescription
from .inputs import groups
from .instance import Group, Values

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True)
class ForeignEvent:
    """An event of an FMU: "state", "time", "step" (asked for by the FMU) or "input"."""

    time: float
    cause: str


class RecordedVariables(OverTime):
    """What was recorded along a run, every variable at the same points."""

    units: dict[str, str]
    _remedy = ""

    def names(self) -> list[str]:
        """Return the names of what was recorded."""
        return ["time", *self.units]

    def __contains__(self, name: str) -> bool:
        return name == "time" or name in self.units

    def unit(self, name: str) -> str:
        """Return the unit of a variable; errors as for its values."""
        return "s" if name == "time" else self.units[self.known(name)]

    def known(self, name: str) -> str:
        """Return a name that was recorded; for another raise an UnknownNameError with the nearest."""
        if not text(name) and name in self.units:
            return name
        told = f"'{name}' of '{self.name}' was not recorded{self._remedy}"
        raise UnknownNameError(f"{told}{nearest(name, self.units)}")

    def to_dataframe(self) -> pd.DataFrame:
        """Return everything as a pandas DataFrame indexed by time."""
        import pandas as pd

        columns = {name: self[name] for name in self.units}
        table = pd.DataFrame(columns, index=pd.Index(self.time, name="time"))
        table.attrs["units"] = dict(self.units)
        return table


@dataclass(eq=False)
class ForeignRun(RecordedVariables):
    """What an FMU gave along a run, in the units it declares.

    At an event two points share one time: before and after.

    Attributes:
        fmu: its name.
        events: its events, in order.
        stats: solver, steps, evaluations, seconds.
        notes: what is to be known, such as an end that the FMU asked for.
    """

    _remedy = " (record=[...])"

    fmu: str
    units: dict[str, str]
    events: list[ForeignEvent] = field(default_factory=list)
    stats: dict[str, Any] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)
    _times: list[float] = field(default_factory=list)
    _rows: list[Values] = field(default_factory=list)

    @property
    def name(self) -> str:
        """Name of the FMU."""
        return self.fmu

    def record(self, t: float, values: Values) -> None:
        """Append a point."""
        self._times.append(t)
        self._rows.append(values)

    @property
    def last(self) -> float:
        """Instant of the last point [s]."""
        return self._times[-1]

    @property
    def time(self) -> Array:
        """Instants of the points [s]."""
        return np.array(self._times)

    def __getitem__(self, name: str) -> Array:
        """Return a variable along the run.

        Raises:
            UnknownNameError: if it was not recorded, with the nearest name.
        """
        if name == "time":
            return self.time
        place = list(self.units).index(self.known(name))
        return np.array([row[place] for row in self._rows])


def empty_run(fmu: FMUDescription, extra: Iterable[str]) -> tuple[ForeignRun, list[Group]]:
    """Return a run of outputs, states and what is asked for besides, and the groups that its points are."""
    named = [fmu.variable(name) for name in dict.fromkeys([*fmu.outputs, *fmu.states, *extra])]
    variables = [v for v in named if v.type not in ("String", "Binary", "Clock")]
    return ForeignRun(fmu.name, {c: v.unit for v in variables for c in v.columns}), groups(variables)
