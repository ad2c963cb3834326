"""`EnergyBook`: what a run stores, dissipates and is supplied with, element by element, and its balance."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ...base import Array, aligned

if TYPE_CHECKING:
    import pandas as pd

NEGLIGIBLE_SHARE = 1e-9  # of the turnover: work on an element that declares nothing is rounding below it
HEADERS = ("element", "kinetic [J]", "potential [J]", "dissipated [J]", "supplied [J]", "not declared [J]")


@dataclass(frozen=True, eq=False)
class EnergyBook:
    """The energy of a run over its points, by the full names of elements.

    Attributes:
        time: the points of the run [s].
        kinetic, potential: what elements store at each point [J].
        dissipated: what they have turned into heat since the first point, shocks included [J].
        supplied: what sources, prescribed motions and each `supplyPower` have put in since then [J].
        undeclared: work on elements that declare neither what they store nor what they lose [J].
    """

    name: str
    time: Array
    kinetic: Mapping[str, Array]
    potential: Mapping[str, Array]
    dissipated: Mapping[str, Array]
    supplied: Mapping[str, Array]
    undeclared: Mapping[str, Array]

    @property
    def stored(self) -> Array:
        """All that is stored, at each point [J]."""
        return self._total(self.kinetic) + self._total(self.potential)

    @property
    def residual(self) -> Array:
        """By how much the book does not close, at each point [J].

        That is what is stored beyond the start, less what was supplied, plus what was dissipated and what
        went into elements that declare nothing.
        """
        spent = self._total(self.dissipated) + self._total(self.undeclared) - self._total(self.supplied)
        return np.asarray(self.stored - self.stored[0] + spent)

    @property
    def turnover(self) -> float:
        """The largest entry of the book: stored, dissipated, supplied or taken by one element [J]."""
        entries = (self.kinetic, self.potential, self.dissipated, self.supplied, self.undeclared)
        return max((float(np.abs(e).max()) for column in entries for e in column.values()), default=0.0)

    @property
    def closes(self) -> float:
        """The largest residual over the turnover."""
        return float(np.abs(self.residual).max()) / (self.turnover or 1.0)

    def to_dataframe(self) -> pd.DataFrame:
        """Return the totals and the residual as a pandas DataFrame indexed by time."""
        import pandas as pd

        columns = {
            name: self._total(getattr(self, name))
            for name in ("kinetic", "potential", "dissipated", "supplied", "undeclared")
        }
        return pd.DataFrame({**columns, "residual": self.residual}, index=pd.Index(self.time, name="time"))

    def _total(self, column: Mapping[str, Array]) -> Array:
        return np.asarray(sum(column.values(), np.zeros(len(self.time))))

    def _rows(self) -> list[tuple[str, ...]]:
        columns = (self.kinetic, self.potential, self.dissipated, self.supplied, self.undeclared)
        names = dict.fromkeys(name for column in columns for name in column)
        rows = [(name, *(f"{c[name][-1]:.5g}" if name in c else "" for c in columns)) for name in names]
        return [*rows, ("all", *(f"{self._total(c)[-1]:.5g}" for c in columns))]

    def __str__(self) -> str:
        begin, end = self.time[0], self.time[-1]
        told = [f"energy of '{self.name}', {begin:g} to {end:g} s"]
        told += aligned([HEADERS, *self._rows()], right={1, 2, 3, 4, 5})
        told.append(f"stored at the start: {self.stored[0]:.5g} J")
        told.append(
            f"closes to {np.abs(self.residual).max():.2g} J, {self.closes:.1g} of the largest entry, "
            f"{self.turnover:.5g} J"
        )
        if self.undeclared:
            told.append(
                f"{', '.join(self.undeclared)}: no energy declared; give kinetic, potential or lossPower"
            )
        return "\n".join(told)
