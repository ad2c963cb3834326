"""`diagnose`: find what parts the records of a campaign and its model."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import replace
from math import inf
from pathlib import Path
from time import monotonic

import numpy as np

from ..base import above, between, computing, demand, function, instance, one_of, optional
from ..components import InertanceError, ModelError
from ..identification import Accuracy, Campaign
from ..networks import COARSEST, FINEST, SOLVERS
from . import criteria
from .law.forced import screened_along
from .models.fmu_network import read_model
from .models.study import FMUStudy, Report, Study, study_of, thinned
from .search.ahead import gone_ahead
from .search.choice import taken
from .search.crew import LATE
from .search.hearing import heard_beside
from .search.horizon import fitted_to_loudest, foreseen
from .search.joint_fit import JointFit
from .search.model_comparison import Refit, gap_taken, is_clear, unexplained
from .search.recast import Recast
from .search.revision import Rivals, plainer, pruned, revised
from .search.reweighed import is_slight, reweighed
from .search.ringing import behind_low_pass
from .search.round import Round, follow, go_on, run_round
from .search.tried import Tried, without
from .verdict.beyond import beyond_the_list
from .verdict.decide import certain_part, decided, explains
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
    study = replace(study, accuracy=replace(accuracy, steps=granted(study.steps_per_sample())))
    study, start, base = refitted_as_heard(study)
    rounds: list[Round] = []
    before: list[Round] = []
    notes = study.limits()
    best, rivals, tried = base, Rivals(), Tried(study)
    known: tuple[Study, Refit, Refit, Refit, list[Round]] | None = None
    try:
        looked_at: Refit | None = None
        ahead = False
        while True:
            chosen = None
            if _may_go_on(best, base, study):
                done = run_round(study, best, rounds, before)
                other = None if before else _recast(study, start, done)
                if other is not None:
                    study, start, base, tried = other.study, other.start, other.base, Tried(other.study)
                    notes.append(other.told)
                    best, rivals, before, rounds = base, Rivals(), rounds, []
                    done = run_round(study, best, rounds, before, other.model)
                follow(study, done)
                chosen = taken(done, base) or _chosen_along(study, done, base)
            if chosen is None and not ahead and rounds and not explains(best, base, study):
                ahead = True
                best, chosen = _gone_ahead(study, rounds, best, base)
            if chosen is None:
                if best is looked_at or not _is_worth_a_look(best, base, study):
                    break
                last = best
                best, rivals = revised(pruned(best, tried), rounds, tried, anew=True)
                looked_at = best
                if best is last:
                    break
                continue
            tried.begin(chosen, chosen.effects[:-1])
            less = without(study, chosen.effects[-1], chosen, criteria.EARLY_END_COST_RATIO * best.cost)
            if less is not None and less.cost < criteria.EARLY_END_COST_RATIO * best.cost:
                study.tell("the fit before had ended early: once more from where this one led")
                best, base = less, base if best.effects else less
                rounds.pop()
                continue
            known = study, start, base, chosen, rounds
            heard = study if study.late() else _heard(study, chosen)
            if heard is not study:
                stays = bool(before) or is_slight(study.campaign, heard.campaign)
                again = reweighed(study, heard, start, base, chosen, rounds) if stays else None
                if again is not None:
                    study, tried = heard, Tried(heard)
                    start, base, chosen, rounds = again
                elif not before:
                    study, tried = heard, Tried(heard)
                    start, base = _refitted(study, chosen.parameters)
                    best, rivals, before, rounds, ahead = base, Rivals(), rounds, [], False
                    continue
            best, rivals = revised(pruned(chosen, tried), rounds, tried)
        best = plainer(best, tried)
        notes = [*notes, *_left_out(study, budget, rounds), *_unscreened(rounds)]
        if known and study.late() and not best.effects:
            study, start, base, best, rounds = known
        return beyond_the_list(study, decided(study, start, base, best, rounds, notes, rivals))
    except KeyboardInterrupt:
        if known and not best.effects:
            study, start, base, best, rounds = known
        verdict = decided(replace(study, deadline=-inf), start, base, best, rounds, notes, rivals)
        told = "interrupted; what is known so far is the error's `verdict`"
        raise DiagnosisInterruptedError(told, verdict) from None


def _recast(study: Study, start: Refit, done: Round) -> Recast | None:
    """Return what an effect in series comes to in records compared otherwise, if it explains them there.

    It is asked in a first round that leaves much: behind a low pass, as impacts ring; and, fitted to the
    loudest record before, which may do, in records as far as it foresees them. There must be something left
    to explain.
    """
    base = done.base
    if base.effects or study.late() or explains(taken(done, base) or base, base, study):
        return None
    slow = behind_low_pass(study, start, done)
    if slow is not None and _explains_there(slow):
        return slow
    loudest = fitted_to_loudest(study, done)
    if loudest is None:
        return None
    done.keep(loudest)
    found = None if explains(loudest, base, study) else foreseen(study, start, base, loudest)
    return found if found is not None and _explains_there(found) else None


def _explains_there(found: Recast) -> bool:
    """Tell whether an effect explains a gap that is clear in records compared otherwise."""
    return is_clear(found.base, found.model) and explains(found.model, found.base, found.study)


def _chosen_along(study: Study, done: Round, base: Refit) -> Refit | None:
    """Return the best model of a first round that came to nothing, gone on with along the missing force.

    It is sought only of a network of which nothing is found otherwise.
    """
    model = done.base
    if model.effects or study.late() or isinstance(study, FMUStudy) or explains(model, base, study):
        return None
    study.tell("screening effects along the motion that the missing force makes")
    try:
        candidates, near = screened_along(study, model)
    except InertanceError:
        return None
    go_on(study, done, candidates, near)
    return taken(done, base)


def _gone_ahead(study: Study, rounds: list[Round], best: Refit, base: Refit) -> tuple[Refit, Refit | None]:
    """Return the model to go on from, and that of two effects which say nothing alone, if there are such.

    What would be named of the best so far gives way only to what explains the gap.
    """
    named = certain_part(best, base, rounds, study).effects
    found = gone_ahead(study, rounds, best, base, lambda model: not named or explains(model, base, study))
    return found or (best, None)


def refitted_as_heard(study: Study) -> tuple[Study, Refit, Refit]:
    """Return the model as it was given and fitted, and the study with the noise that shows beside it."""
    start, base = _refitted(study, study.campaign.start)
    heard = _heard(study, base)
    if heard is not study:
        start, base = _refitted(heard, base.parameters, base)
    return heard, start, base


def _refitted(
    study: Study, parameters: Mapping[str, float], near: Refit | None = None
) -> tuple[Refit, Refit]:
    """Return the model as it was given, and with its parameters fitted from a start."""
    joint = JointFit(study, parameters, near=near)
    given = joint.vector(study.campaign.start, [])
    return joint.seen(given), joint.fitted()


def _heard(study: Study, model: Refit) -> Study:
    """Return the study with the noise that shows beside a model; itself if no other noise shows."""
    heard = heard_beside(study, model)
    if heard is not study:
        study.tell("refitting with the noise that a filter has left")
    return heard


def granted(given: float) -> int:
    """Return how many steps of the integrator a sample may take, by how many the model as given takes."""
    return max(criteria.SOLVER_STEPS_PER_SAMPLE, round(criteria.SOLVER_STEPS_RATIO * given))


def _left_out(study: Study, budget: float | None, rounds: Sequence[Round]) -> list[str]:
    """Say what the time that was granted did not suffice for."""
    if budget is None or not study.late():
        return []
    count = sum(why == LATE for done in rounds for why in done.failed.values())
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


def _may_go_on(best: Refit, base: Refit, study: Study) -> bool:
    """Tell whether there is time for another effect, and one could take away enough to be believed."""
    if study.late() or len(best.effects) >= criteria.MOST_EFFECTS:
        return False
    if not best.effects:
        return best.misfit > criteria.NOISE_MISFIT or not study.noise_is_sure
    if best.misfit <= criteria.COLOURED_MISFIT or best.is_noise(study.judged):
        return False
    return unexplained(best, base) > criteria.HIDDEN_RESIDUAL_SHARE


def _is_worth_a_look(best: Refit, base: Refit, study: Study) -> bool:
    """Tell whether several effects would be named, so that each is to be held against all others."""
    return len(best.effects) > 1 and not study.late() and gap_taken(best, base) >= criteria.CERTAIN_GAP_SHARE
