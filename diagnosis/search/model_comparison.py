"""`Refit`: a fitted model, compared with others by its residuals on the test records."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ...base import Array
from ...identification import Experiment, is_noise
from ..criteria import (
    ALIKE_RESIDUAL_SHARE,
    ALIKE_STANDARD_ERRORS,
    CLEAR_RESIDUAL_RATIO,
    CLEAR_STANDARD_ERRORS,
    LEAST_STRETCHES,
    STRETCH_SECONDS,
)
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
        independent: number of independent samples that it is judged by.
        starts: by state, where each record begins, those of the training first.
        own: by parameter, the values that each record has of its own, likewise.
    """

    parameters: dict[str, float]
    effects: tuple[Hypothesis, ...]
    train: list[dict[str, Array]]
    test: list[dict[str, Array]]
    cost: float
    stretches: Sequence[int] = ()
    independent: float = 1.0
    starts: Sequence[Mapping[str, float]] = ()
    own: Sequence[Mapping[str, float]] = ()

    def starts_of(self, experiments: Sequence[Experiment]) -> dict[int, Mapping[str, float]]:
        """Return by record, as `id` tells them, where each begins."""
        return dict(zip(map(id, experiments), self.starts, strict=False))

    @property
    def labels(self) -> list[str]:
        """Kind and site of its effects."""
        return [placed.label for placed in self.effects]

    @property
    def values(self) -> tuple[Mapping[str, float], Mapping[str, float]]:
        """Its parameters and the values of its last effect, for a fit to start from."""
        return self.parameters, self.effects[-1].values

    @property
    def left(self) -> list[dict[str, Array]]:
        """The weighted residuals of all records, those of the training first."""
        return [*self.train, *self.test]

    @property
    def judged(self) -> list[dict[str, Array]]:
        """The residuals it is judged by: those of the test records, or without any those of the training."""
        return self.test or self.train

    @cached_property
    def trained(self) -> list[float]:
        """What it misses of each training record, in the channel where that is most [noise]."""
        return [max(rms([r]) for r in left.values()) for left in self.train]

    @cached_property
    def blocks(self) -> Array:
        """The squared residual by stretches."""
        sums = []
        for residuals, count in zip(self.judged, self.stretches, strict=True):
            squares = np.sum([r**2 for r in residuals.values()], axis=0)
            sums += [float(part.sum()) for part in np.array_split(squares, count)]
        return np.array(sums)

    def missed(self, experiments: Sequence[Experiment], channel: str) -> list[Array]:
        """Return what it misses of a channel in each of the records that it is judged by, in SI units.

        It is nothing at instants that are omitted; see `counted`.
        """
        pairs = zip(experiments, self.judged, strict=True)
        return [experiment.sigma[channel] * residuals[channel] for experiment, residuals in pairs]

    def counted(self, experiments: Sequence[Experiment], channel: str) -> list[Array]:
        """Return what it misses without the instants that are omitted."""
        pairs = zip(experiments, self.missed(experiments, channel), strict=True)
        return [experiment.counted(missed) for experiment, missed in pairs]

    def is_noise(self, experiments: Sequence[Experiment]) -> bool:
        """Tell whether what it misses of the records that it is judged by looks like noise."""
        return all(
            is_noise(
                missed,
                experiment.counted(experiment.passed(name)),
                experiment.rate,
                count,
                experiment.sigma[name],
            )
            for name in self.judged[0]
            for experiment, missed, count in zip(
                experiments, self.counted(experiments, name), self.stretches, strict=True
            )
        )

    @cached_property
    def strain(self) -> float:
        """The sum of squares by which parameters miss what was assumed, in standard deviations of that."""
        return self.cost - sum(float(r @ r) for record in self.train for r in record.values())

    @cached_property
    def misfit(self) -> float:
        """The root mean square of the residual, in units of noise."""
        return float(np.sqrt(self.blocks.sum() / self.independent))


def rms(parts: Sequence[Array]) -> float:
    """Return the root mean square of all values of some arrays."""
    return float(np.sqrt(np.mean(np.concatenate(parts) ** 2)))


def stretches(experiments: Sequence[Experiment]) -> list[int]:
    """Return into how many stretches each record is divided to compare models."""
    lasting = [float(np.ptp(experiment.compared.time)) for experiment in experiments]
    length = float(np.clip(sum(lasting) / LEAST_STRETCHES, *STRETCH_SECONDS))
    return [max(2, round(seconds / length)) for seconds in lasting]


def clearness(worse: Refit, better: Refit) -> float:
    """Return by how many standard errors a model's test residual is below another's.

    Those of a normal distribution that are as likely as what Wilcoxon's signed-rank test finds in the squared
    residuals of stretches. A mean of their drops hangs on the few stretches where most is missed, a mean of
    logarithms on the many where nothing is.

    Source: F. Wilcoxon, Individual Comparisons by Ranking Methods, Biometrics Bulletin 1 (1945) 80-83.
    """
    from scipy.stats import norm, wilcoxon

    drop = worse.blocks - better.blocks
    if not drop.any():
        return 0.0
    chance = {way: np.asarray(wilcoxon(drop, alternative=way))[1] for way in ("greater", "less")}
    clear = {way: float(norm.isf(p)) for way, p in chance.items()}
    return clear["greater"] if clear["greater"] > clear["less"] else -clear["less"]


def is_clear(worse: Refit, better: Refit) -> bool:
    """Tell whether a model does better beyond chance, and on most stretches unless it leaves half as much."""
    halves = better.blocks.sum() < CLEAR_RESIDUAL_RATIO * worse.blocks.sum()
    return clearness(worse, better) > (ALIKE_STANDARD_ERRORS if halves else CLEAR_STANDARD_ERRORS)


def best_of(models: Sequence[Refit]) -> Refit:
    """Return the model that misses the test records least, for what its parameters must be."""
    noise = max(1.0, min(model.misfit for model in models) ** 2)
    return min(models, key=lambda model: float(model.blocks.sum()) / noise + model.strain)


def are_alike(one: Refit, other: Refit) -> bool:
    """Tell whether the test records cannot tell two models apart."""
    left = one.blocks.sum(), other.blocks.sum()
    close = abs(left[1] - left[0]) < ALIKE_RESIDUAL_SHARE * min(left)
    return bool(close) or abs(clearness(one, other)) < ALIKE_STANDARD_ERRORS


def unexplained(fitted: Refit, base: Refit) -> float:
    """Return what a model misses beyond noise, as a share of the squared test residual of another one."""
    return (fitted.misfit**2 - 1.0) / base.misfit**2


def gap_taken(fitted: Refit, base: Refit) -> float:
    """Return the share of the square of what another model misses beyond noise that a model takes away."""
    return 1 - (fitted.misfit**2 - 1.0) / max(base.misfit**2 - 1.0, 1e-9)
