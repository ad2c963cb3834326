"""Small changes of states and inputs, from point to point along a run."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...base import Array
from ..evaluation.transition_matrices import carried


@dataclass(frozen=True, eq=False)
class Forced:
    """Changes dx of the states and du of inputs, from point to point along a run, and signals there.

        dx' = map dx + here du + there du',   dy = to_x dx + to_u du

    Attributes:
        map: (intervals, states, states).
        here, there: by the inputs where an interval begins and ends, (intervals, states, inputs).
        to_x, to_u: of the signals at the points, (points, signals, states or inputs).
    """

    map: Array
    here: Array
    there: Array
    to_x: Array
    to_u: Array

    def pushed(self, number: int, changes: Array) -> Array:
        """Return what changes of an input, (points, columns), change in the signals there.

        Args:
            number: of the input.
            changes: straight from point to point.
        """
        du = changes[:, None, :]
        at = slice(number, number + 1)
        added = self.here[:, :, at] * du[:-1] + self.there[:, :, at] * du[1:]
        states = carried(self.map, np.zeros((self.map.shape[1], changes.shape[1])), added)
        return np.asarray(self.to_x @ states + self.to_u[:, :, at] * du)
