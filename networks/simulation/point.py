"""Where a run stands."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ...base import Array
from .events.constants import NEWTON_CLOSE, NEWTON_ROUNDS

if TYPE_CHECKING:
    from .bound_dae import BoundDAE


@dataclass(eq=False)
class Point:
    """Where a run stands: time, states, algebraic unknowns and what is constant in the segment."""

    t: float
    x: Array
    z: Array
    q: Array

    def copy(self, t: float | None = None) -> Point:
        """Return a point that goes on by itself, maybe from another time."""
        return Point(self.t if t is None else t, self.x.copy(), self.z.copy(), self.q.copy())


def solve_algebraic(closed: BoundDAE, point: Point) -> None:
    """Let the algebraic unknowns of a point follow its states."""
    if not closed.dae.z.numel():
        return
    for _ in range(NEWTON_ROUNDS):
        value, slope = closed.switch_functions.algebraic(point.x, point.z, point.q, point.t)
        slope = slope.reshape(len(value), -1).T
        step = np.linalg.lstsq(slope, -value, rcond=1e-12)[0]
        point.z = point.z + step
        if np.abs(step).max() <= NEWTON_CLOSE * (1 + np.abs(point.z).max()):
            return
