"""A force at a site that a run of the model has, as one more input."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...base import Array
from ...components import Sampled

SAME_INSTANT = 1e-3  # [sample] between the points of a run before and after an event, at most


@dataclass(frozen=True, eq=False)
class Force:
    """A force at instants of a run, straight between them."""

    t: Array
    values: Array

    def at(self, t: Array) -> Array:
        """Return it at instants."""
        return np.interp(t, self.t, self.values)

    def signal(self, t: Array) -> Sampled:
        """Return it as an input signal of a run with such instants, straight between these and its own."""
        own = self.t[(self.t > t[0]) & (self.t < t[-1])]
        points = np.union1d(t, own)
        apart = np.diff(points, prepend=-np.inf) > SAME_INSTANT * (t[1] - t[0])
        return Sampled(points[apart], self.at(points[apart]), interpolation="linear")


def push_of(number: int) -> str:
    """Return the input of the force at a site that is probed."""
    return f"push_{number}.u"
