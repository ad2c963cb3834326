"""Separation: how far an experiment parts two models, whatever their parameters may still be."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from ..criteria import DECISIVE_LOG_ODDS, NOISE_MISFIT
from .forecast import Forecast, Seen


@dataclass(frozen=True)
class Odds:
    """What an experiment is expected to tell of two models.

    Attributes:
        one, other: the models, in words.
        distance: between them, in standard deviations of the noise along what parts them.
        rms: of the difference of their predictions as they are, in units of noise.
        samples: of all outputs, that are compared.
    """

    one: str
    other: str
    distance: float
    rms: float
    samples: int

    @property
    def log_odds(self) -> float:
        """The expected logarithm of the odds of the right one over the other, with even odds before."""
        return 0.5 * self.distance**2

    @property
    def right(self) -> float:
        """The probability that the likelier one is the right one."""
        from scipy.stats import norm

        return float(norm.cdf(0.5 * self.distance))

    @property
    def is_decisive(self) -> bool:
        """Whether the odds will be strong."""
        return self.log_odds >= DECISIVE_LOG_ODDS

    @property
    def is_faint(self) -> bool:
        """Whether what parts them is so far below the noise that errors of a model may pass for it."""
        return self.distance**2 / self.samples < NOISE_MISFIT**2 - 1

    def to_dict(self) -> dict[str, str | float]:
        """Return it as plain values, as in the JSON file."""
        return {
            "one": self.one,
            "other": self.other,
            "distance": self.distance,
            "rms": self.rms,
            "log_odds": self.log_odds,
            "right": self.right,
        }


def apart(one: Forecast, other: Forecast, seen: tuple[Seen, Seen]) -> Odds:
    """Return how far an experiment parts two models.

    With the difference d of what is foreseen and its slopes J in what both models leave open, of covariance
    C, all in units of noise, or of what the better model misses if that is more, the squared distance is

        D^2 = d' (I + J C J')^-1 d

    what neither model can do by other parameters that suit the records before. Under the one model the
    logarithm of the odds is then normal, of mean D^2/2 and variance D^2.

    Source: W. G. Hunter, A. M. Reiner, Technometrics 7 (1965) 307-323, with the covariance of the predictions
    as of G. E. P. Box, W. J. Hill, Technometrics 9 (1967) 57-71.
    """
    noise = min(one.missed, other.missed)
    difference = (seen[0].values - seen[1].values) / noise
    slopes = np.hstack([seen[0].slopes, -seen[1].slopes]) / noise
    count = len(one.information)
    known = slopes.T @ slopes
    known[:count, :count] += one.information
    known[count:, count:] += other.information
    score = slopes.T @ difference
    scale = 1 / np.sqrt(np.diag(known))
    absorbed = score * scale @ np.linalg.solve(known * np.outer(scale, scale), score * scale)
    squared = float(difference @ difference)
    distance = float(np.sqrt(max(0.0, squared - float(absorbed))))
    return Odds(one.told, other.told, distance, float(np.sqrt(squared / len(difference))), len(difference))


def all_odds(models: Sequence[Forecast], seen: Sequence[Seen]) -> list[Odds]:
    """Return how far an experiment parts each pair of models."""
    pairs = combinations(zip(models, seen, strict=True), 2)
    return [apart(one, other, (mine, theirs)) for (one, mine), (other, theirs) in pairs]


def merit(odds: Sequence[Odds]) -> float:
    """Return what experiments are chosen by: a pair that is hardly parted counts more than one that is."""
    return float(sum(np.log1p(pair.log_odds) for pair in odds))
