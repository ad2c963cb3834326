"""How far the shapes of effects may change in a fit."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...base import Array
from ..criteria import BOUND_TOLERANCE, SHAPE_FACTOR
from .hypothesis import Hypothesis

Bounds = tuple[Array, Array]


class Shapes:
    """Bounds of a vector of parameters and effects whose shapes keep near where a descent starts.

    A long step could lead a shape to where it means something else. One that ends at such a bound may go on
    from there, within the extremes of what is screened.

    Args:
        bounds: least and largest values of all, to be narrowed for shapes.
        effects: whose quantities are the vector's last entries.
        sizes: the units of these, effect by effect.
    """

    def __init__(self, bounds: Bounds, effects: Sequence[Hypothesis], sizes: Sequence[Array]) -> None:
        self._bounds = bounds
        quantities = [
            (p, q, s)
            for p, size in zip(effects, sizes, strict=True)
            for q, s in zip(p.quantities, size, strict=True)
        ]
        first = len(bounds[0]) - len(quantities)
        self._shapes = [first + i for i, (_, q, _) in enumerate(quantities) if q.shape]
        ranges = [_range(p, q.name, s) for p, q, s in quantities if q.shape]
        self._least, self._most = np.array(ranges).reshape(-1, 2).T

    def bounds(self, start: Array) -> Bounds:
        """Return least and largest values for a descent from a start."""
        low, high = (bound.copy() for bound in self._bounds)
        shapes = start[self._shapes]
        low[self._shapes] = np.clip(shapes / SHAPE_FACTOR, self._least, self._most)
        high[self._shapes] = np.clip(shapes * SHAPE_FACTOR, self._least, self._most)
        return low, high

    def are_held(self, vector: Array, bounds: Bounds) -> bool:
        """Tell whether a shape is at a bound beyond which more was screened."""
        at, low, high = vector[self._shapes], bounds[0][self._shapes], bounds[1][self._shapes]
        below = (at <= low * (1 + BOUND_TOLERANCE)) & (low > self._least)
        above = (at >= high * (1 - BOUND_TOLERANCE)) & (high < self._most)
        return bool((below | above).any())


def _range(placed: Hypothesis, name: str, size: float) -> tuple[float, float]:
    """Return least and largest value of a shape that screening comes near, in units of its size."""
    values = [shape[name] for shape in placed.effect.shaped(placed.site.domain, placed.site)]
    return min(values) / SHAPE_FACTOR / size, max(values) * SHAPE_FACTOR / size
