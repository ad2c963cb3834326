"""Fitted models compared by their residuals on the test records."""

from __future__ import annotations

import numpy as np

from ...base import Array
from ...identification import Campaign
from ..criteria import ALIKE_RESIDUAL_SHARE, ALIKE_STANDARD_ERRORS, LEAST_STRETCHES, STRETCH_SECONDS
from .joint_fit import Refit


def blocks(fitted: Refit, campaign: Campaign) -> Array:
    """Return the squared test residual by stretches."""
    sums = []
    experiments = campaign.testing or campaign.training
    total = sum(float(np.ptp(experiment.compared.time)) for experiment in experiments)
    length = float(np.clip(total / LEAST_STRETCHES, *STRETCH_SECONDS))
    for residuals, experiment in zip(fitted.test or fitted.train, experiments, strict=True):
        count = max(2, round(float(np.ptp(experiment.compared.time)) / length))
        squares = np.sum([r**2 for r in residuals.values()], axis=0)
        sums += [float(part.sum()) for part in np.array_split(squares, count)]
    return np.array(sums)


def clearness(worse: Refit, better: Refit, campaign: Campaign) -> float:
    """Return by how many standard errors a model's test residual is below another's, in logarithms."""
    drop = np.log(blocks(worse, campaign) / blocks(better, campaign))
    spread = float(drop.std(ddof=1) / np.sqrt(len(drop)))
    return float(drop.mean()) / spread if spread > 0 else 0.0


def are_alike(one: Refit, other: Refit, campaign: Campaign) -> bool:
    """Tell whether the test records cannot tell two models apart."""
    left = blocks(one, campaign).sum(), blocks(other, campaign).sum()
    close = abs(left[1] - left[0]) < ALIKE_RESIDUAL_SHARE * min(left)
    return bool(close) or abs(clearness(one, other, campaign)) < ALIKE_STANDARD_ERRORS


def misfit(fitted: Refit) -> float:
    """Return the root mean square of the test residual, in units of noise."""
    parts = [r for record in fitted.test or fitted.train for r in record.values()]
    return float(np.sqrt(np.mean(np.concatenate(parts) ** 2)))


def unexplained(fitted: Refit, base: Refit) -> float:
    """Return what a model misses beyond noise, as a share of the squared test residual of another one."""
    return (misfit(fitted) ** 2 - 1.0) / misfit(base) ** 2


def is_simpler(one: Refit, other: Refit) -> bool:
    """Tell whether the last effect of a model is a special case of the last one of another."""
    plain, richer = one.effects[-1], other.effects[-1]
    return richer.effect.generalises(plain.effect.kind) and plain.site.path == richer.site.path
