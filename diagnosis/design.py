"""`design`: the next experiment, to tell hypotheses apart or to identify parameters."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import Executor
from dataclasses import replace
from pathlib import Path

import numpy as np

from ..base import boolean, computing, demand, function, instance, one_of, optional
from ..components import ModelError
from ..identification import Accuracy, Campaign
from ..networks import RTOL, SOLVERS
from . import criteria
from .diagnose import check_keys, diagnose, relative_tolerance
from .experiments.designed import Design, InseparableError, Known, played
from .experiments.envelope import sampling_rate, seconds
from .experiments.forecast import Forecast, Planned, known_after
from .experiments.refits import refitted
from .experiments.rivals import question_of, read_question, rivals
from .experiments.selection import Rated, selected
from .experiments.sensors import telling_sensor
from .experiments.separation import Odds, all_odds, merit
from .models.fmu_network import read_model
from .models.study import Report, Study, study_of, thinned
from .search.joint_fit import JointFit
from .search.model_comparison import Refit
from .verdict.verdict import Verdict

NO_RECORDS = (
    "to tell hypotheses apart, [[train]] records are needed that leave them open; before there are any, "
    "design to identify parameters (--parameters; in Python, parameters=True)"
)


@computing("the design of an experiment")
def design(
    campaign: Campaign | str | Path,
    verdict: Verdict | str | Path | None = None,
    *,
    parameters: bool = False,
    executor: Executor | None = None,
    solver: str = "auto",
    report: Report | None = None,
) -> Design:
    """Return the experiment that tells most, within the `limits` of a campaign or what was measured.

    To tell hypotheses apart, the input that parts their predictions most, weighed by the noise and by what
    their parameters may still be (see `inertance.diagnosis.Odds`); each is then refitted to what the other
    would show, and a separation that this absorbs is none. For parameters, the input with the largest mean
    logarithm of the determinant of their information, D-optimal over what they may be.

    Args:
        campaign: records, channels, priors, limits and model, or the path of the TOML file that tells them.
        verdict: of a diagnosis, or the path of its JSON file: its class of equivalents is to be told apart,
            or else the two that lead its ranking; the campaign is diagnosed first if it is not given.
        parameters: whether the uncertain parameters are to be identified instead; then no records are needed.
        executor: fits models; any `concurrent.futures.Executor`.
        solver: as for `simulate`.
        report: called with a line of progress.

    Raises:
        InseparableError: if no input within the limits parts the hypotheses, with what else to measure.
        ModelError: for a verdict that leaves nothing open, and for limits that are missing or nothing meets.

    Source: W. G. Hunter, A. M. Reiner, Technometrics 7 (1965) 307-323; K. Chaloner, I. Verdinelli,
    Statistical Science 10 (1995) 273-304.
    """
    demand(
        "design()",
        verdict=(verdict, optional(instance(Verdict, str, Path))),
        parameters=(parameters, boolean),
        executor=(executor, optional(instance(Executor))),
        solver=(solver, one_of(SOLVERS)),
        report=(report, optional(function)),
    )
    if parameters and verdict is not None:
        raise ModelError("design(): give a verdict, or parameters=True, not both")
    campaign = Campaign.of(campaign, read_model, planned=True)
    check_keys(campaign)
    if not (parameters or campaign.training):
        raise ModelError(f"{campaign.source}: {NO_RECORDS}")
    if parameters:
        return _for_parameters(_study(campaign, solver, executor, report))
    if isinstance(verdict, str | Path):
        question, study = read_question(verdict), _study(campaign, solver, executor, report)
    else:
        given = verdict or diagnose(campaign, executor=executor, solver=solver, report=report)
        question = question_of(given.to_dict(), campaign.source)
        study = replace(given.evidence.study, executor=executor, report=report)
    return _for_hypotheses(study, rivals(study, question))


def _study(campaign: Campaign, solver: str, executor: Executor | None, report: Report | None) -> Study:
    """Return the study of a campaign, with or without records."""
    campaign = thinned(campaign)
    samples = sum(len(e.record.time) for e in campaign.training) + seconds(campaign) * sampling_rate(campaign)
    rtol = relative_tolerance(campaign) if campaign.training else RTOL
    accuracy = Accuracy(solver, rtol, foreseen=round(samples * criteria.RUNS_PER_MODEL))
    study = study_of(campaign, accuracy, executor, report)
    return study.granting_steps() if campaign.training else study


def _for_hypotheses(study: Study, models: Sequence[Refit]) -> Design:
    """Return the experiment that parts models; of the likeliest ones, the first that stands the refits."""
    forecasts = [Forecast(study, model) for model in models]
    found = selected(study, forecasts, lambda made: merit(all_odds(forecasts, made.seen)))
    foreseen = ((one.made, all_odds(forecasts, one.made.seen)) for one in found)
    checked = [(made, refitted(study, forecasts, made, odds)) for made, odds in foreseen]
    made, odds = max(checked, key=lambda pair: merit(pair[1]))
    if not any(pair.is_decisive for pair in odds):
        raise InseparableError(_inseparable(study, forecasts, made, odds))
    notes = [f"{_told(pair)}: {why}" for pair in odds if (why := _doubt(pair))]
    inputs = played(study.campaign, made)
    time = made.experiment.record.time
    return Design(
        "hypotheses", made.candidate.told, time, inputs, tuple(odds), (), tuple(notes),
        campaign=study.campaign, made=made, models=tuple(forecasts),
    )  # fmt: skip


def _told(pair: Odds) -> str:
    return f"{pair.one} and {pair.other}"


def _doubt(pair: Odds) -> str:
    """Say why an experiment may not part a pair, nothing if it will."""
    if not pair.is_decisive:
        return "it will hardly part them"
    told = "what parts them is far below the noise, where a small error of either model undoes it"
    return told if pair.is_faint else ""


def _inseparable(study: Study, models: Sequence[Forecast], made: Planned, odds: Sequence[Odds]) -> str:
    """Say that no input parts models, and what else to measure."""
    most = max(pair.distance for pair in odds)
    *first, last = (model.told for model in models)
    return (
        f"{', '.join(first)} and {last} cannot be told apart by any input within the limits: where they part "
        f"most, by a {made.candidate.told}, {most:.2g} standard deviations are left once either is fitted "
        "again; "
        f"{telling_sensor(study, models, made)}"
    )


def _for_parameters(study: Study) -> Design:
    """Return the experiment that tells most of the parameters."""
    campaign = study.campaign
    if not campaign.priors:
        raise ModelError(f"{campaign.source}: [parameters] names nothing that all records share")
    joint = JointFit(study, campaign.start)
    study.tell("what is known of the parameters")
    model = joint.fitted() if campaign.training else joint.seen(joint.start)
    known = Forecast(study, model)
    models = [known, *_drawn(study, known)]

    def information(made: Planned) -> float:
        after = (known_after(one, seen) for one, seen in zip(models, made.seen, strict=True))
        return float(np.mean([np.linalg.slogdet(matrix)[1] for matrix in after]))

    found: Rated = selected(study, models, information)[0]
    made = found.made
    before, after = (
        np.sqrt(np.diag(np.linalg.inv(matrix))) * joint.scale
        for matrix in (known.information, known_after(known, made.seen[0]))
    )
    learnt = [
        Known(name, model.parameters[name], campaign.machine.unit(name), float(b), float(a))
        for name, b, a in zip(joint.names, before, after, strict=True)
    ]
    notes = [
        f"{one.parameter}: it will tell next to nothing of it"
        for one in learnt
        if one.after > criteria.UNTOLD_SHARE * one.before
    ]
    return Design(
        "parameters", made.candidate.told, made.experiment.record.time, played(campaign, made), (),
        tuple(learnt), tuple(notes), campaign=campaign, made=made, models=tuple(models),
    )  # fmt: skip


def _drawn(study: Study, known: Forecast) -> list[Forecast]:
    """Return the model with other parameters, drawn from what is known of them."""
    joint, chance = known.joint, np.random.default_rng(0)
    spread = np.linalg.cholesky(np.linalg.inv(known.information))
    low, high = joint.shapes.bounds(joint.start)
    found = []
    for _ in range(criteria.DESIGN_DRAWS):
        vector = np.clip(joint.start + spread @ chance.standard_normal(len(spread)), low, high)
        parameters, _ = joint.unpacked(vector)
        found.append(Forecast(study, replace(known.model, parameters=parameters)))
    return found
