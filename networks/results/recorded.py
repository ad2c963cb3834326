"""`Recorded`: signals that were saved or measured, with averages over time."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ...base import Array, ModelError, UnknownNameError, nearest
from .over_time import OverTime

if TYPE_CHECKING:
    import pandas as pd


class Recorded(OverTime):
    """Signals in a table over time, straight lines between its rows; two rows at one instant are a jump.

    Args:
        table: numbers, indexed by time [s], as `load_table` and `to_dataframe` return it.
        name: what it is called in errors.

    Raises:
        ModelError: for a table without rows, or whose time goes back or is not finite.

    Example:
        >>> import pandas as pd
        >>> from inertance import Recorded
        >>> table = pd.DataFrame({"push.f": [0.0, 0.0, 6.0, 6.0]}, index=[0.0, 1.0, 1.0, 4.0])
        >>> Recorded(table).mean("push.f")
        4.5
    """

    def __init__(self, table: pd.DataFrame, name: str = "table") -> None:
        self._name, self._table = name, table
        try:
            self._time: Array = np.asarray(table.index, dtype=float)
        except (TypeError, ValueError):
            told = table.index[:3].tolist()
            raise ModelError(f"'{name}' is not indexed by time [s], but by {told}") from None
        back = np.flatnonzero(~(np.diff(self.time) >= 0))
        if not len(self.time) or not np.isfinite(self.time).all():
            raise ModelError(f"'{name}' needs at least one row, and finite instants [s] in its index")
        if len(back):
            raise ModelError(f"the time of '{name}' goes back after {self.time[back[0]]:g} s; sort its rows")

    @property
    def name(self) -> str:
        """What it is called in errors."""
        return self._name

    @property
    def time(self) -> Array:
        """The index [s]."""
        return self._time

    def __getitem__(self, name: str) -> Array:
        """Return a column, or the time.

        Raises:
            UnknownNameError: for an unknown name, with the nearest one.
        """
        if name == "time":
            return self.time
        if name not in self._table.columns:
            raise UnknownNameError(f"'{self.name}' has no column '{name}'{nearest(name, self.names()[1:])}")
        return np.asarray(self._table[name], dtype=float)

    def names(self) -> list[str]:
        """Return the names of the columns, and time."""
        return ["time", *map(str, self._table.columns)]

    def unit(self, name: str) -> str:
        """Return the unit of a column, "" if the table does not tell it."""
        return "s" if name == "time" else str(self._table.attrs.get("units", {}).get(name, ""))

    def to_dataframe(self) -> pd.DataFrame:
        """Return the table."""
        return self._table
