"""`Refit`: a fitted model, compared with others by its residuals on the test records."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ...base import Array
from ...identification import Experiment
from ..criteria import ALIKE_RESIDUAL_SHARE, ALIKE_STANDARD_ERRORS, LEAST_STRETCHES, STRETCH_SECONDS
from ..effects.hypothesis import Hypothesis


@dataclass(frozen=True, eq=False)
class Refit:
    """A model fitted to the training records.

    Attributes:
        parameters: the network's uncertain parameters, fitted.
        effects: the effects in it, fitted.
        train, test: weighted residuals of each record, each a dictionary by channel.
        cost: sum of squares of the training residuals and the priors.
        stretches: into how many each record that it is judged by is divided to be compared.
    """

    parameters: dict[str, float]
    effects: tuple[Hypothesis, ...]
    train: list[dict[str, Array]]
    test: list[dict[str, Array]]
    cost: float
    stretches: Sequence[int] = ()

    @property
    def judged(self) -> list[dict[str, Array]]:
        """The residuals it is judged by: those of the test records, or without any those of the training."""
        return self.test or self.train

    @cached_property
    def blocks(self) -> Array:
        """The squared residual by stretches."""
        sums = []
        for residuals, count in zip(self.judged, self.stretches, strict=True):
            squares = np.sum([r**2 for r in residuals.values()], axis=0)
            sums += [float(part.sum()) for part in np.array_split(squares, count)]
        return np.array(sums)

    @cached_property
    def misfit(self) -> float:
        """The root mean square of the residual, in units of noise."""
        return rms([r for record in self.judged for r in record.values()])


def rms(parts: Sequence[Array]) -> float:
    """Return the root mean square of all values of some arrays."""
    return float(np.sqrt(np.mean(np.concatenate(parts) ** 2)))


def stretches(experiments: Sequence[Experiment]) -> list[int]:
    """Return into how many stretches each record is divided to compare models."""
    lasting = [float(np.ptp(experiment.compared.time)) for experiment in experiments]
    length = float(np.clip(sum(lasting) / LEAST_STRETCHES, *STRETCH_SECONDS))
    return [max(2, round(seconds / length)) for seconds in lasting]


def clearness(worse: Refit, better: Refit) -> float:
    """Return by how many standard errors a model's test residual is below another's, in logarithms."""
    drop = np.log(worse.blocks / better.blocks)
    spread = float(drop.std(ddof=1) / np.sqrt(len(drop)))
    return float(drop.mean()) / spread if spread > 0 else 0.0


def are_alike(one: Refit, other: Refit) -> bool:
    """Tell whether the test records cannot tell two models apart."""
    left = one.blocks.sum(), other.blocks.sum()
    close = abs(left[1] - left[0]) < ALIKE_RESIDUAL_SHARE * min(left)
    return bool(close) or abs(clearness(one, other)) < ALIKE_STANDARD_ERRORS


def unexplained(fitted: Refit, base: Refit) -> float:
    """Return what a model misses beyond noise, as a share of the squared test residual of another one."""
    return (fitted.misfit**2 - 1.0) / base.misfit**2
