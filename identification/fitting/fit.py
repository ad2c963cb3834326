"""`fit`: estimate the uncertain parameters of a campaign, stage after stage."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Executor
from dataclasses import replace
from math import nan
from pathlib import Path

from ...base import Array, between, computing, demand, function, instance, one_of, optional, whole
from ...components import ModelError, SimulationError
from ...networks import COARSEST, DAE, FINEST, SOLVERS
from ..campaign.campaign import Campaign
from ..campaign.experiment import Experiment
from .campaign_model import Accuracy, CampaignModel, Values
from .doubts import is_doubtful
from .intervals import EndedEarlyError, Interval, profiled
from .outcome import Comparison, Fit, FitInterruptedError
from .problem import MOST_ITERATIONS, FitProblem
from .residual_block import ResidualBlock
from .staged_fit import best_of, fit_stages, fit_starts
from .suspects import suspects
from .uncertainty import uncertainty

USUAL_RUNS = 20  # of a fit
MOST_FITS_AGAIN = 5  # after profiles that led to a lower misfit
STEPS_TO_A_START = 4  # of the least squares that find start and offsets of a test record
Fitted = tuple[ResidualBlock, Array, dict[str, float]]  # a record in a stage: nuisances, standard errors


@computing("the fit")
def fit(
    campaign: Campaign | str | Path,
    *,
    starts: int = 1,
    executor: Executor | None = None,
    seed: int = 0,
    solver: str = "auto",
    rtol: float = 1e-7,
    intervals: float | None = None,
    report: Callable[[str], None] | None = None,
) -> Fit:
    """Fit the parameters of a campaign to its training records: maximum a posteriori.

        minimise  sum ((F measured - F predicted)/sigma)^2 + sum ((p - p_0)/(rel p_0))^2,   min <= p <= max,

    with F the stage's filter and sigma the noise floor, over the parameters p and of each record its start,
    its offsets and its own values of parameters that differ by record. Stages follow each other; what one
    has fitted is fixed or further fitted in the next.

    Args:
        campaign: records, model and priors, or the path of the TOML file that tells them.
        starts: number of starts; further ones are drawn from the priors (bounds) by a Sobol sequence.
        executor: runs the starts; the campaign goes to its workers by pickle.
        seed: of the draw.
        solver: as for `simulate`; "auto" foresees 20 runs of the training records.
        rtol: relative tolerance of the runs.
        intervals: level of confidence, such as 0.95, of profile-likelihood intervals of all parameters, which
            take some ten fits each; none if not given.
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
        intervals=(intervals, optional(between(0.01, 0.9999))),
        report=(report, optional(function)),
        executor=(executor, optional(instance(Executor))),
    )
    campaign = Campaign.of(campaign)
    if not campaign.priors and not campaign.per_record:
        raise ModelError(
            f"{campaign.source}: no parameter is uncertain, so there is nothing to fit; name some under "
            '[parameters], such as "spring.k" = { rel = 0.1 }'
        )
    samples = sum(len(experiment.record.time) for experiment in campaign.training)
    accuracy = Accuracy(solver, rtol, foreseen=samples * USUAL_RUNS)
    tell = report or (lambda line: None)
    found = Fit(campaign, dict(campaign.start), [], [])
    try:
        if starts > 1 and campaign.priors:
            fit_starts(found, starts, seed, executor, accuracy, tell)
        bench = fit_stages(found, accuracy, tell)
        if intervals is not None:
            bench = _profile(found, bench, intervals, accuracy, tell)
        tell("predicting the test records")
        found.comparisons.extend(_compared(found, bench, accuracy))
        if is_doubtful(found):
            found.suspects.extend(suspects(campaign, found.values, accuracy, tell))
    except KeyboardInterrupt:
        best = {} if found.stages else best_of(found.starts)
        if not (found.stages or best):
            raise
        found.values.update(best)
        told = "interrupted; the best until then is the error's `fit`"
        raise FitInterruptedError(told, replace(found, interrupted=True)) from None
    return found


def _profile(
    found: Fit, bench: CampaignModel, level: float, accuracy: Accuracy, tell: Callable[[str], None]
) -> CampaignModel:
    """Find intervals; where a profile leads to something better, fit again from there. Return the model."""
    for _ in range(MOST_FITS_AGAIN):
        try:
            _find_intervals(found, level, tell)
            return bench
        except EndedEarlyError as better:
            tell("a profile has led to a lower misfit: fitting again from there")
            found.values.update(better.values)
            found.stages.clear()
            found.intervals.clear()
            bench = fit_stages(found, accuracy, tell)
    unknown = Interval(level, nan, nan, "profiles lead to ever lower misfits: fit from more starts")
    found.intervals.update(dict.fromkeys(found.values, unknown))
    return bench


def _find_intervals(found: Fit, level: float, tell: Callable[[str], None]) -> None:
    """Keep intervals as soon as each is known, in the stage that has fitted the parameter last."""
    last = {name: done for done in found.stages for name in done.uncertainty.errors}
    for done in found.stages:
        errors = {name: e for name, e in done.uncertainty.errors.items() if last[name] is done}
        freedom = done.uncertainty.freedom
        for name, interval in profiled(done.problem, done.optimum, errors, level, freedom, tell):
            found.intervals[name] = interval


def _compared(found: Fit, bench: CampaignModel, accuracy: Accuracy) -> list[Comparison]:
    """Predict every record with the model's own and with the fitted parameters.

    Nuisances are those of the fit; for test records they are estimated, nothing else.
    """
    campaign = found.campaign
    fitted = {
        block.stand.experiment: (block, nuisances, errors)
        for done in found.stages
        for block, nuisances, errors in zip(
            done.problem.blocks, done.optimum.nuisances, done.uncertainty.own, strict=True
        )
    }
    testing = CampaignModel(campaign.dae, campaign.measured, campaign.testing)
    changed = [CampaignModel(_machine_of(campaign, e), campaign.measured, [e]) for e in campaign.changed]
    comparisons = []
    for tested, model in ((False, bench), *((True, model) for model in (testing, *changed))):
        for stand in model.stands:
            block = ResidualBlock(stand, campaign.outputs, campaign.sigma, None)
            before: dict[str, Array] = {}
            after: dict[str, Array] = {}
            own: dict[str, float] = {}
            errors: dict[str, float] = {}
            problem = ""
            try:
                nuisances, errors = _nuisances(block, fitted.get(stand.experiment), found.values, accuracy)
                own = block.own_values(nuisances)
                after = _predicted(block, found.values, nuisances, accuracy)
                before = _predicted(block, campaign.start, nuisances, accuracy)
            except SimulationError as error:
                problem = str(error)
            comparisons.append(Comparison(stand.experiment, tested, before, after, problem, own, errors))
    return comparisons


def _machine_of(campaign: Campaign, experiment: Experiment) -> DAE:
    """Return the machine of a record, after the change that it names."""
    change = experiment.change
    return change.applied(campaign.network).dae() if change and change.rebuilds else campaign.dae


def _nuisances(
    block: ResidualBlock, fitted: Fitted | None, values: Values, accuracy: Accuracy
) -> tuple[Array, dict[str, float]]:
    """Return the nuisances of a record, those of the fit or those that suit the fitted parameters.

    With them come the standard errors of the values that it has of its own.
    """
    if fitted is None or fitted[0].offsets != block.offsets:
        most = MOST_ITERATIONS if block.unknown else STEPS_TO_A_START
        optimum = FitProblem([block], {}, values, accuracy).minimise(most=most)
        return optimum.nuisances[0], uncertainty(optimum, [block], {}).own[0] if block.unknown else {}
    found, nuisances, errors = fitted
    block.center, block.width = found.center, found.width
    return nuisances, errors


def _predicted(
    block: ResidualBlock, parameters: Values, nuisances: Array, accuracy: Accuracy
) -> dict[str, Array]:
    predictions = block.linearise(parameters, nuisances, accuracy, slopes=False).predictions
    measured = block.record.values
    return {name: measured[name] - block.residual(name, predictions, nuisances) for name in block.channels}
