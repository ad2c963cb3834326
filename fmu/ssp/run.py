"""What the FMUs of a system did together."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ...base import Array
from ...components import UnknownNameError, nearest
from ..cosimulation.step_error import ExchangeRun
from ..foreign.run import ForeignRun

if TYPE_CHECKING:
    import pandas as pd


@dataclass(eq=False)
class SystemRun(ExchangeRun):
    """What the FMUs of a system did together; `run["body.mass.s"]` is `mass.s` of the component `body`.

    At an event two points share one time: before and after. Of every FMU there are outputs and states.
    """

    system: str

    @property
    def name(self) -> str:
        """Name of the system."""
        return self.system

    @property
    def time(self) -> Array:
        """Instants of the points [s]."""
        return next(iter(self.fmus.values())).time

    def names(self) -> list[str]:
        """Return the names of what was recorded."""
        return ["time", *(f"{name}.{v}" for name, run in self.fmus.items() for v in run.units)]

    def __getitem__(self, name: str) -> Array:
        """Return a variable along the run.

        Raises:
            UnknownNameError: if it was not recorded, with the nearest name.
        """
        return self.time if name == "time" else np.array(self._of(name)[0][self._of(name)[1]])

    def unit(self, name: str) -> str:
        """Return the unit of a variable."""
        return "s" if name == "time" else self._of(name)[0].unit(self._of(name)[1])

    def _of(self, name: str) -> tuple[ForeignRun, str]:
        component, _, variable = name.partition(".")
        if component not in self.fmus or variable not in self.fmus[component]:
            raise UnknownNameError(f"'{name}' of '{self.name}' was not recorded{nearest(name, self.names())}")
        return self.fmus[component], variable

    def to_dataframe(self) -> pd.DataFrame:
        """Return everything as a pandas DataFrame indexed by time."""
        import pandas as pd

        names = self.names()[1:]
        table = pd.DataFrame({n: self[n] for n in names}, index=pd.Index(self.time, name="time"))
        table.attrs["units"] = {n: self.unit(n) for n in names}
        return table
