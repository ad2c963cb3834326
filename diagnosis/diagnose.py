"""`diagnose`: find what parts the records of a campaign and its model."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import Executor
from math import inf
from pathlib import Path
from time import monotonic

import numpy as np

from ..base import above, between, computing, demand, function, instance, one_of, optional
from ..components import ModelError
from ..identification import Accuracy, Campaign
from ..networks import COARSEST, FINEST, SOLVERS
from . import criteria
from .investigation import Investigation
from .models.fmu_network import read_model
from .models.study import Report, study_of, thinned
from .search.fit import LATE
from .search.round import Round
from .verdict.verdict import DiagnosisInterruptedError, Verdict


@computing("the diagnosis")
def diagnose(
    campaign: Campaign | str | Path,
    *,
    executor: Executor | None = None,
    solver: str = "auto",
    rtol: float | None = None,
    budget: float | None = None,
    report: Report | None = None,
) -> Verdict:
    """Say what parts measured data and model: where, why, and how much of it goes away.

    The parameters are refitted; every effect at every site is screened by a one-sided score test; the
    leading ones are fitted together with the parameters and ranked by the test records, which are never
    fitted; what cannot be told apart forms a class. Where nothing listed explains enough of what a network
    lacks, a static law of its own is looked for.

    Args:
        campaign: records, channels, priors and model, or the path of the TOML file that tells them.
        executor: fits candidates; any `concurrent.futures.Executor`.
        solver: as for `simulate`; "auto" foresees 200 runs of the training records with each model.
        rtol: relative tolerance of the runs; small beside the noise if not given.
        budget: seconds after which nothing new is begun, and the verdict tells what it left out [s].
        report: called with a line of progress.

    Raises:
        DiagnosisInterruptedError: on Ctrl-C, once the parameters are refitted; its `verdict`, "interrupted",
            tells what is known so far.
    """
    demand(
        "diagnose()",
        solver=(solver, one_of(SOLVERS)),
        rtol=(rtol, optional(between(FINEST, COARSEST))),
        budget=(budget, optional(above(0, "s"))),
        report=(report, optional(function)),
        executor=(executor, optional(instance(Executor))),
    )
    campaign = thinned(Campaign.of(campaign, read_model))
    check_keys(campaign)
    samples = sum(len(experiment.record.time) for experiment in campaign.training)
    foreseen = samples * criteria.RUNS_PER_MODEL
    accuracy = Accuracy(solver, rtol or relative_tolerance(campaign), foreseen=foreseen)
    study = study_of(campaign, accuracy, executor, report, inf if budget is None else monotonic() + budget)
    study.tell("refitting the parameters")
    found = Investigation.of(study.granting_steps())
    try:
        found.run()
        found.notes += [*_left_out(found, budget), *_unscreened(found.rounds)]
        return found.decided()
    except KeyboardInterrupt:
        told = "interrupted; what is known so far is the error's `verdict`"
        raise DiagnosisInterruptedError(told, found.broken_off()) from None


def _left_out(found: Investigation, budget: float | None) -> list[str]:
    """Say what the time that was granted did not suffice for."""
    if budget is None or not found.study.late():
        return []
    count = sum(why == LATE for done in found.rounds for why in done.failed.values())
    fits = f"{count} effects were not fitted" if count else "no further effect was looked for"
    return [f"the budget of {budget:g} s ended: {fits}; give more time for the full verdict"]


def _unscreened(rounds: Sequence[Round]) -> list[str]:
    """Say beside what nothing further could be looked for, and why."""
    beside = [" and ".join(done.base.labels) or "the model as given" for done in rounds]
    told = zip(beside, (done.unscreened for done in rounds), strict=True)
    return [f"beside {model} nothing was looked for: {why}" for model, why in told if why]


def check_keys(campaign: Campaign) -> None:
    """Raise for what a fit understands and a diagnosis would leave out."""
    problems = [
        f"{experiment.name}: shooting is for fits; a diagnosis runs records in one piece: shorten the window"
        for experiment in campaign.experiments
        if experiment.shooting is not None
    ]
    if campaign.stage:
        told = "is for fits; a diagnosis takes everything at once, unfiltered: fit first, and leave it out"
        problems.append(f"[[stage]] {told}")
    if problems:
        raise ModelError(f"{campaign.source}: this cannot be diagnosed:", problems)


def relative_tolerance(campaign: Campaign) -> float:
    """Return a relative tolerance at which errors of runs, friction and all, do not show in the noise."""
    moved = {n: max(float(np.std(e.record.values[n])) for e in campaign.training) for n in campaign.outputs}
    share = min(sigma / (moved[name] or sigma) for name, sigma in campaign.sigma.items())
    return float(np.clip(criteria.TOLERANCE_OVER_NOISE * share, *criteria.RELATIVE_TOLERANCES))
