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
    from there, within the extremes of what is screened. The quantities of effects, in units of their sizes,
    are the vector's last entries.
    """

    def __init__(self, bounds: Bounds, effects: Sequence[Hypothesis], sizes: Sequence[Array]) -> None:
        self._bounds = bounds
        entries = [(placed, quantity) for placed in effects for quantity in placed.quantities]
        places = [i for i, (_, quantity) in enumerate(entries) if quantity.shape]
        self._shapes = [len(bounds[0]) - len(entries) + i for i in places]
        units = np.concatenate([np.zeros(0), *sizes])[places]
        ranges = np.array([_range(entries[i][0], entries[i][1].name) for i in places]).reshape(-1, 2)
        self._least, self._most = ranges.T / units

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


def _range(placed: Hypothesis, name: str) -> tuple[float, float]:
    """Return least and largest value of a shape that screening comes near, and that it may have."""
    values = [shape[name] for shape in placed.effect.shaped(placed.site.domain, placed.site)]
    low = next(quantity.low for quantity in placed.quantities if quantity.name == name)
    return max(low, min(values) / SHAPE_FACTOR), max(values) * SHAPE_FACTOR
