"""Communication points: when participants exchange, and how they extrapolate between."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class CommunicationPoints:
    """Points from `begin` to `stop`, every `step` [s], and the order of extrapolation between them."""

    begin: float
    stop: float
    step: float
    order: int

    @property
    def times(self) -> NDArray[np.float64]:
        """The points [s]."""
        count = max(1, round((self.stop - self.begin) / self.step))
        return np.linspace(self.begin, self.stop, count + 1)

    @property
    def halved(self) -> CommunicationPoints:
        """Points at half the step."""
        return replace(self, step=self.step / 2)
