"""A fit from several starts, drawn from the priors; in other processes, if there are any."""

from __future__ import annotations

import pickle
from collections.abc import Generator, Sequence
from concurrent.futures import Executor, as_completed
from functools import lru_cache

import numpy as np

from ...components import InertanceError
from ..campaign.campaign import Campaign
from .campaign_model import Accuracy
from .outcome import Fit, FittedStart
from .stage_fit import fit_stages


def fits_from(
    campaign: Campaign, starts: int, seed: int, executor: Executor | None, accuracy: Accuracy
) -> Generator[FittedStart]:
    """Yield where starts lead, each as it comes: the model's own values, and others drawn from the priors."""
    drawn = _drawn(campaign, starts, seed)
    if executor is None:
        yield from (_fitted(campaign, values, accuracy) for values in drawn)
        return
    payload = campaign.pickled()
    jobs = [executor.submit(_job, payload, values, accuracy) for values in drawn]
    try:
        for job in as_completed(jobs):
            yield job.result()
    finally:
        for job in jobs:
            job.cancel()


def best_of(starts: Sequence[FittedStart]) -> dict[str, float]:
    """Return the values that the best start led to; none if all failed."""
    good = [start for start in starts if not start.problem]
    return min(good, key=lambda start: start.cost).fitted if good else {}


def _drawn(campaign: Campaign, count: int, seed: int) -> list[dict[str, float]]:
    """Return starts: the model's own values, then points of a Sobol sequence over two standard deviations."""
    from scipy.stats import qmc

    priors = campaign.priors.values()
    low = np.array([max(prior.min, prior.center - 2 * prior.scale) for prior in priors])
    high = np.array([min(prior.max, prior.center + 2 * prior.scale) for prior in priors])
    shares = qmc.Sobol(len(low), rng=seed).random(1 << (count - 1).bit_length())[: count - 1]
    points = low + shares * (high - low)
    return [campaign.start, *(dict(zip(campaign.priors, point, strict=True)) for point in points.tolist())]


def _fitted(campaign: Campaign, values: dict[str, float], accuracy: Accuracy) -> FittedStart:
    found = Fit(campaign, dict(values), [], [])
    try:
        fit_stages(found, accuracy)
    except InertanceError as error:
        return FittedStart(values, found.values, np.inf, str(error))
    return FittedStart(values, found.values, found.stages[-1].optimum.cost)


def _job(payload: bytes, values: dict[str, float], accuracy: Accuracy) -> FittedStart:
    return _fitted(_unpickled(payload), values, accuracy)


@lru_cache(maxsize=1)
def _unpickled(payload: bytes) -> Campaign:
    campaign: Campaign = pickle.loads(payload)
    return campaign
