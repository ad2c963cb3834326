"""A fit stage after stage, from one start or from several; in other processes, if there are any."""

from __future__ import annotations

import pickle
from collections.abc import Callable, Sequence
from concurrent.futures import Executor, Future, as_completed
from functools import lru_cache

import numpy as np

from ...components import InertanceError
from ..campaign.campaign import Campaign
from ..campaign.stages import Stage
from .campaign_model import Accuracy, CampaignModel
from .least_squares import Iterate
from .outcome import Fit, FittedStage, FittedStart
from .problem import FitProblem
from .residual_block import ResidualBlock
from .uncertainty import uncertainty

Tell = Callable[[str], None]
_unpickled = lru_cache(maxsize=1)(pickle.loads)  # the campaign, once a process


def fit_stages(found: Fit, accuracy: Accuracy, tell: Tell = lambda line: None) -> CampaignModel:
    """Fit stage after stage, each kept in `found` as soon as it is done; return the model on the records."""
    campaign = found.campaign
    bench = CampaignModel(campaign.dae, campaign.measured, campaign.training, list(campaign.priors))
    for number, stage in enumerate(campaign.stages, start=1):
        label = f"stage {number} of {len(campaign.stages)}, " if len(campaign.stages) > 1 else ""

        def progress(at: Iterate, label: str = label) -> None:
            tell(f"{label}iteration {at.number}, misfit {at.cost:.4g}")

        done = _fit_stage(found, bench, stage, accuracy, progress)
        found.stages.append(done)
        found.values.update(done.optimum.values)
        if done.optimum.ended == "interrupted":
            raise KeyboardInterrupt
    return bench


def _fit_stage(
    found: Fit, bench: CampaignModel, stage: Stage, accuracy: Accuracy, report: Callable[[Iterate], None]
) -> FittedStage:
    """Fit some parameters to some channels of some records, starting from the values in `found`."""
    campaign = found.campaign
    sigma = campaign.sigma
    blocks = [ResidualBlock(bench.stands[n], stage.channels, sigma, stage.filter) for n in stage.train]
    priors = {name: campaign.priors[name] for name in stage.parameters}
    problem = FitProblem(blocks, priors, found.values, accuracy)
    optimum = problem.minimise(report, interruptible=True)
    return FittedStage(stage, problem, optimum, uncertainty(optimum, blocks, priors))


def fit_starts(
    found: Fit, count: int, seed: int, executor: Executor | None, accuracy: Accuracy, tell: Tell
) -> None:
    """Fit from several starts, each kept in `found` as it comes, and take the values of the best."""
    campaign = found.campaign
    drawn = _drawn(campaign, count, seed)
    jobs: list[Future[FittedStart]] = []
    fitted = (_fitted(campaign, values, accuracy) for values in drawn)
    if executor is not None:
        payload = campaign.pickled()
        jobs = [executor.submit(_job, payload, values, accuracy) for values in drawn]
        fitted = (job.result() for job in as_completed(jobs))
    try:
        for number, start in enumerate(fitted, start=1):
            found.starts.append(start)
            tell(f"start {number} of {count}, misfit {start.cost:.4g}")
    finally:
        for job in jobs:
            job.cancel()
    found.values.update(best_of(found.starts))


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
