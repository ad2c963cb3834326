"""`Steps`: where a prediction jumps, and how the filter of a logger rounds that."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf

import numpy as np
from numpy.typing import NDArray

from ...base import Array

CUTOFFS = 0.1, 0.15, 0.22, 0.33, 0.5, 0.75, 1.1, 1.7  # that are tried [rate]; lower ones show in the spectrum
FINER = 1.5  # over the best of them, and under it, the filter's own is looked for
REACH = 1.6  # [1/cut-off] after which nothing is left of the rounding, by a thousandth
ROUNDED_SHARE = 0.8  # of the squares of what is missed, below which it must come to be believed
KNOWN_SHARE = 0.9  # the same where another channel of the logger has such a filter


@dataclass(frozen=True, eq=False)
class Steps:
    """Where the channels of a prediction jump between samples.

    A logger's filter rounds such a step as it comes from a model, whereas all that is linear is as if the
    input had not been filtered either. Without phase, a Butterworth filter of order 2, run forward and back,
    makes of a unit step at t = 0, with a = sqrt(2) pi f |t| and its cut-off f,

        (1 + sign(t) (1 - exp(-a) cos(a))) / 2.

    Attributes:
        time: instants of the samples [s].
        at: of the steps [s].
        after: number of the first sample after each step.
        sizes: of the steps in each channel, SI units.
    """

    time: Array
    at: Array
    after: NDArray[np.intp]
    sizes: dict[str, Array]

    def rounding(self, name: str, cutoff: float) -> Array:
        """Return what a filter with a cut-off [Hz] adds to the samples of a channel, SI units."""
        added = np.zeros(len(self.time))
        sizes = self.sizes[name]
        struck = np.flatnonzero(sizes)
        if cutoff == inf or not len(struck):
            return added
        reach = REACH / cutoff
        first = np.searchsorted(self.time, self.at[struck] - reach)
        last = np.searchsorted(self.time, self.at[struck] + reach)
        width = int((last - first).max(initial=0))
        rows = first[:, None] + np.arange(width)
        inside = rows < last[:, None]
        rows = np.minimum(rows, len(self.time) - 1)
        a = np.sqrt(2) * np.pi * cutoff * np.abs(self.time[rows] - self.at[struck, None])
        sides = np.where(rows >= self.after[struck, None], -0.5, 0.5)
        np.add.at(added, rows, np.where(inside, sides * np.exp(-a) * np.cos(a) * sizes[struck, None], 0.0))
        return added


def cutoff_of(
    name: str,
    missed: Sequence[Array],
    steps: Sequence[Steps],
    rate: float,
    beside: Sequence[float] = (),
) -> float:
    """Return the cut-off [Hz] of the filter that has rounded a channel's steps; infinite if none shows.

    Args:
        name: of the channel.
        missed: by record, what a model leaves that does not know of a filter, in units of noise; NaN where
            nothing is compared.
        steps: by record, where it jumps, sizes in these units, too.
        rate: of samples [Hz].
        beside: cut-offs of other channels of the logger [Hz]. One about there is believed for less.
    """
    from scipy.optimize import minimize_scalar

    def squares(cutoff: float) -> float:
        left = (r - s.rounding(name, cutoff) for r, s in zip(missed, steps, strict=True))
        return sum(float(np.nansum(r**2)) for r in left)

    best = min((share * rate for share in CUTOFFS), key=squares)
    near = minimize_scalar(squares, bounds=(best / FINER, best * FINER), method="bounded")
    alike = any(1 / FINER < near.x / other < FINER for other in beside)
    return float(near.x) if near.fun < (KNOWN_SHARE if alike else ROUNDED_SHARE) * squares(inf) else inf
