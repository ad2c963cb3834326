"""`fit`: estimate the uncertain parameters of a campaign, stage after stage."""

from __future__ import annotations

import pickle
from collections.abc import Callable, Sequence
from concurrent.futures import Executor, as_completed
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path

import numpy as np

from ...base import between, demand, function, instance, one_of, optional, whole
from ...components import InertanceError, ModelError
from ...networks import COARSEST, FINEST, SOLVERS, chosen_solver
from ..campaign.campaign import Campaign
from ..campaign.stages import Stage
from .campaign_model import Accuracy, CampaignModel
from .doubts import is_doubtful
from .outcome import Comparison, Fit, FitInterruptedError, FittedStage, compared
from .problem import Iteration, Optimum, Problem
from .residual_block import Block
from .suspects import suspects
from .uncertainty import uncertainty

Report = Callable[[str], None]
RUNS = 20  # usual of a fit


@dataclass(frozen=True)
class Start:
    """One start of a multi-start: its values, and where it led or why it failed."""

    values: dict[str, float]
    fitted: dict[str, float]
    cost: float
    problem: str = ""


def fit(
    campaign: Campaign | str | Path,
    *,
    starts: int = 1,
    executor: Executor | None = None,
    seed: int = 0,
    solver: str = "auto",
    rtol: float = 1e-7,
    report: Report | None = None,
) -> Fit:
    """Fit the parameters of a campaign to its training records: maximum a posteriori.

        minimise  sum ((F measured - F predicted)/sigma)^2 + sum ((p - p_0)/(rel p_0))^2,   min <= p <= max,

    with F the stage's filter and sigma the noise floor, over the parameters p and each record's own start
    and offsets. Stages follow each other; what one has fitted is fixed or further fitted in the next.

    Args:
        campaign: records, model and priors, or the path of the TOML file that tells them.
        starts: number of starts; further ones are drawn from the priors (bounds) by a Sobol sequence.
        executor: runs the starts; the campaign goes to its workers by pickle.
        seed: of the draw.
        solver: as for `simulate`; "auto" compiles the model where there is a C compiler and 20 runs of
            the training records come to 40 000 samples, as of 2000 and more in all.
        rtol: relative tolerance of the runs.
        report: called with a line of progress.

    Raises:
        FitInterruptedError: on Ctrl-C; its `fit` is the best found until then, if anything was.
        ModelError: if the campaign has no uncertain parameters, or the network cannot be fitted.
        SimulationError: if the model cannot be run with its own parameters.
    """
    demand(
        "fit()",
        starts=(starts, whole(1)),
        seed=(seed, whole(0)),
        rtol=(rtol, between(FINEST, COARSEST)),
        solver=(solver, one_of(SOLVERS)),
        report=(report, optional(function)),
        executor=(executor, optional(instance(Executor))),
    )
    campaign = Campaign.of(campaign)
    if not campaign.priors:
        raise ModelError(
            f"{campaign.source}: no parameter is uncertain, so there is nothing to fit; name some under "
            '[parameters], such as "spring.k" = { rel = 0.1 }'
        )
    samples = sum(len(experiment.record.time) for experiment in campaign.training)
    accuracy = Accuracy(chosen_solver(solver, samples, RUNS), rtol)
    tell = report or (lambda line: None)
    values = dict(campaign.start)
    tried: list[Start] = []
    stages: list[FittedStage] = []
    comparisons: list[Comparison] = []
    try:
        if starts > 1:
            _multistart(campaign, tried, starts, executor, seed, accuracy, tell)
            values |= _best(tried)
        bench = _staged(campaign, values, accuracy, tell, stages)
        tell("predicting the test records")
        comparisons = compared(campaign, bench, values, stages, accuracy)
        found = Fit(campaign, values, stages, comparisons, tried)
        if is_doubtful(found):
            found = replace(found, suspects=suspects(campaign, values, accuracy, tell))
        return found
    except KeyboardInterrupt:
        known = bool(stages) or bool(_best(tried))
        values |= {} if stages else _best(tried)
        if not known:
            raise
        found = Fit(campaign, values, stages, comparisons, tried, interrupted=True)
        raise FitInterruptedError("interrupted; the best until then is the error's `fit`", found) from None


def _best(tried: Sequence[Start]) -> dict[str, float]:
    good = [one for one in tried if not one.problem]
    return min(good, key=lambda one: one.cost).fitted if good else {}


def _staged(
    campaign: Campaign,
    values: dict[str, float],
    accuracy: Accuracy,
    tell: Report,
    stages: list[FittedStage],
) -> CampaignModel:
    """Fit stage after stage, each kept in `stages` and `values` as soon as it is done."""
    bench = CampaignModel(campaign.dae, campaign.measured, campaign.training, list(campaign.priors))
    for number, stage in enumerate(campaign.stages, start=1):
        label = f"stage {number} of {len(campaign.stages)}, " if len(campaign.stages) > 1 else ""

        def progress(i: Iteration, label: str = label) -> None:
            tell(f"{label}iteration {i.number}, misfit {i.cost:.5g}")

        done = fit_stage(campaign, bench, stage, values, accuracy, progress)
        stages.append(done)
        values |= done.optimum.values
        if done.optimum.ended == "interrupted":
            raise KeyboardInterrupt
    return bench


def fit_stage(
    campaign: Campaign,
    bench: CampaignModel,
    stage: Stage,
    values: dict[str, float],
    accuracy: Accuracy | None = None,
    report: Callable[[Iteration], None] | None = None,
) -> FittedStage:
    """Fit some parameters to some channels of some records, starting from `values`."""
    accuracy = accuracy or Accuracy()
    sigma = campaign.sigma
    blocks = [Block(bench.stands[n], stage.channels, sigma, stage.filter) for n in stage.train]
    for block in blocks:
        block.prepare(values, accuracy)
    priors = {name: campaign.priors[name] for name in stage.parameters}
    columns = [bench.parameters.index(name) for name in priors]
    problem = Problem(blocks, priors, columns, values, accuracy)
    optimum = problem.minimise(values, report=report)
    return FittedStage(stage, optimum, uncertainty(optimum, blocks, priors), blocks)


def _multistart(
    campaign: Campaign,
    done: list[Start],
    starts: int,
    executor: Executor | None,
    seed: int,
    accuracy: Accuracy,
    tell: Report,
) -> None:
    """Fit from several starts, each kept in `done` as it comes."""
    drawn = _drawn(campaign, starts, seed)
    if executor is None:
        for values in drawn:
            done.append(_from(campaign, values, accuracy))
            tell(f"start {len(done)} of {starts}, misfit {done[-1].cost:.5g}")
        return
    payload = campaign.pickled()
    jobs = [executor.submit(_job, payload, values, accuracy) for values in drawn]
    try:
        for job in as_completed(jobs):
            done.append(job.result())
            tell(f"start {len(done)} of {starts}, misfit {done[-1].cost:.5g}")
    except KeyboardInterrupt:
        for job in jobs:
            job.cancel()
        raise


def _drawn(campaign: Campaign, count: int, seed: int) -> list[dict[str, float]]:
    """Return starts: the model's own values, then points of a Sobol sequence over two standard deviations."""
    from scipy.stats import qmc

    own = campaign.start
    sobol = qmc.Sobol(len(own), rng=seed).random(1 << (count - 1).bit_length())[: count - 1]
    drawn = [own]
    for point in sobol:
        values = {}
        for share, (name, prior) in zip(point, campaign.priors.items(), strict=True):
            low = max(prior.min, prior.center - 2 * prior.scale)
            high = min(prior.max, prior.center + 2 * prior.scale)
            values[name] = float(low + share * (high - low))
        drawn.append(values)
    return drawn


def _from(campaign: Campaign, values: dict[str, float], accuracy: Accuracy) -> Start:
    """Fit all stages from a start."""
    bench = CampaignModel(campaign.dae, campaign.measured, campaign.training, list(campaign.priors))
    fitted, cost = dict(values), np.inf
    try:
        for stage in campaign.stages:
            optimum: Optimum = fit_stage(campaign, bench, stage, fitted, accuracy).optimum
            fitted |= optimum.values
            cost = optimum.cost
            if optimum.ended == "interrupted":
                raise KeyboardInterrupt
    except InertanceError as error:
        return Start(values, fitted, np.inf, str(error))
    return Start(values, fitted, cost)


def _job(payload: bytes, values: dict[str, float], accuracy: Accuracy) -> Start:
    return _from(_unpickled(payload), values, accuracy)


@lru_cache(maxsize=1)
def _unpickled(payload: bytes) -> Campaign:
    campaign: Campaign = pickle.loads(payload)
    return campaign
