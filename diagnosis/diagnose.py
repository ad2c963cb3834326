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
from .effects.hypothesis import Hypothesis
from .law.forced import screened_along
from .models.fmu_network import read_model
from .models.study import FMUStudy, Report, Study, study_of, thinned
from .search.crew import LATE
from .search.joint_fit import JointFit
from .search.model_comparison import (
    Refit,
    are_alike,
    best_of,
    clearness,
    gap_taken,
    is_clear,
    unexplained,
    with_residual_floors,
)
from .search.revision import Rivals, exchanged, without
from .search.round import Round, go_on, run_round
from .verdict.beyond import beyond_the_list
from .verdict.decide import decided, explains
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
    start, base = _refitted(study, campaign.start)
    study, start, base = _reheard(study, base) or (study, start, base)
    rounds: list[Round] = []
    before: list[Round] = []
    notes = study.limits()
    best, rivals = base, Rivals()
    known: tuple[Study, Refit, Refit, Refit, list[Round]] | None = None
    try:
        looked_at: Refit | None = None
        while True:
            chosen = None
            if _may_go_on(best, base, study):
                done = run_round(study, best, rounds, before)
                chosen = _chosen(done, base) or _chosen_along(study, done, base)
            if chosen is None:
                if best is looked_at or not _is_worth_a_look(best, base, study):
                    break
                last = best
                needed = _pruned(best, study)
                tried = rivals if needed is best else {}
                best, rivals = _revised(needed, rounds, study, tried, anew=True)
                looked_at = best
                if best is last:
                    break
                continue
            less = without(chosen.effects[-1], chosen, study)
            if less is not None and less.cost < criteria.EARLY_END_COST_RATIO * best.cost:
                study.tell("the fit before had ended early: once more from where this one led")
                best, base = less, base if best.effects else less
                rounds.pop()
                continue
            known = study, start, base, chosen, rounds
            if not study.late() and (again := _reheard(study, chosen)):
                study, start, base = again
                best, rivals, before, rounds = base, Rivals(), rounds, []
                continue
            best, rivals = _revised(_pruned(chosen, study), rounds, study)
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
    return _chosen(done, base)


def _refitted(
    study: Study, parameters: Mapping[str, float], near: Refit | None = None
) -> tuple[Refit, Refit]:
    """Return the model as it was given, and with its parameters fitted from a start."""
    joint = JointFit(study, parameters, near=near)
    given = joint.vector(study.campaign.start, [])
    return joint.seen(given), joint.fitted()


def _reheard(study: Study, model: Refit) -> tuple[Study, Refit, Refit] | None:
    """Return the study with the noise that shows beside a model, and what `_refitted` then does.

    It is None if no other noise shows.
    """
    heard = with_residual_floors(study.campaign, model)
    if heard is study.campaign:
        return None
    study.tell("refitting with the noise that a filter has left")
    study = replace(study, campaign=heard)
    return study, *_refitted(study, model.parameters, None if model.effects else model)


def granted(taken: float) -> int:
    """Return how many steps of the integrator a sample may take, by how many the model as given takes."""
    return max(criteria.SOLVER_STEPS_PER_SAMPLE, round(criteria.SOLVER_STEPS_RATIO * taken))


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


def _chosen(done: Round, base: Refit) -> Refit | None:
    """Return the best model of a round among those clearly better than the first, the simplest of equals.

    How much it must take away is counted in what the model without effects misses.
    """
    clear = [found for found in done.fitted if is_clear(done.base, found)]
    if not clear:
        return None
    best = _sited(_simplest(best_of(clear), clear), clear)
    for other in clear:
        if best.effects[-1].generalises(other.effects[-1]) and not _worth_it(other, best):
            best = other
    drop, all_of_it = done.base.blocks.sum() - best.blocks.sum(), base.blocks.sum()
    if not done.base.effects:
        return best if drop > criteria.FIRST_EFFECT_SHARE * all_of_it else None
    of_what_is_left = drop > criteria.LEFT_EFFECT_SHARE * (done.base.blocks.sum() - base.independent)
    return best if of_what_is_left or drop > criteria.FURTHER_EFFECT_SHARE * all_of_it else None


def _simplest(best: Refit, clear: Sequence[Refit]) -> Refit:
    """Return of the models that test records cannot tell from the best the one whose quantities pay."""
    return min((f for f in clear if f is best or are_alike(f, best)), key=lambda f: _price(f, best))


def _price(model: Refit, best: Refit) -> float:
    """Return what a model misses of all records, in what the best leaves, and what its quantities cost."""
    missed = (model.cost + float(model.blocks.sum())) / max(1.0, best.misfit**2)
    return missed + criteria.PART_CHI_SQUARED * sum(len(p.quantities) for p in model.effects)


def _sited(best: Refit, clear: Sequence[Refit]) -> Refit:
    """Return a model or its like with the same effect elsewhere, if test records cannot tell them apart.

    With equally many parameters the lower training cost decides; an assembly is preferred unless a part is
    better by PART_CHI_SQUARED.
    """
    kind = best.effects[-1].effect.kind
    alike = [f for f in clear if f.effects[-1].effect.kind == kind and are_alike(f, best)]
    best = min(alike, key=lambda f: f.cost)
    for other in alike:
        near = other.cost < best.cost + criteria.PART_CHI_SQUARED
        if near and other.effects[-1].site.holds(best.effects[-1].site):
            best = other
    return best


def _worth_it(plain: Refit, richer: Refit) -> bool:
    """Tell whether a generalisation does clearly better, and not only mends what no law has quite right.

    One that leaves nothing but noise, where its special case clearly leaves more, does clearly better.
    """
    left = plain.misfit**2 - 1.0
    taken = plain.misfit**2 - richer.misfit**2
    nothing_left = richer.misfit <= criteria.NOISE_MISFIT and plain.misfit > criteria.COLOURED_MISFIT
    nearly_all = taken > criteria.SURE_GENERALISATION_SHARE * left
    clear = nothing_left or nearly_all or is_clear(plain, richer)
    return taken > criteria.GENERALISATION_SHARE * left and clear


def _pruned(best: Refit, study: Study) -> Refit:
    """Return the model without those effects that a later one has made needless, as its special cases are."""
    *earlier, last = best.effects
    for placed in earlier:
        less = without(placed, best, study)
        if less is not None and not _is_needed(placed, last, best, less):
            best = less
    return best


def _is_needed(placed: Hypothesis, last: Hypothesis, model: Refit, less: Refit) -> bool:
    """Tell whether a model is clearly worse without an effect; by far, without a special case of another."""
    halves = model.blocks.sum() < criteria.CLEAR_RESIDUAL_RATIO * less.blocks.sum()
    clear = clearness(less, model) >= criteria.CLEAR_STANDARD_ERRORS
    return bool(clear and (halves or not last.generalises(placed)))


def _is_worth_a_look(best: Refit, base: Refit, study: Study) -> bool:
    """Tell whether several effects would be named, so that each is to be held against all others."""
    return len(best.effects) > 1 and not study.late() and gap_taken(best, base) >= criteria.CERTAIN_GAP_SHARE


def _revised(
    best: Refit, rounds: Sequence[Round], study: Study, known: Rivals | None = None, anew: bool = False
) -> tuple[Refit, Rivals]:
    """Return the model with effects exchanged for what does better beside the others, and the rivals.

    Those that are `known` stand beside the model as it is given.
    """
    known = known or {}
    for _ in range(criteria.MOST_EFFECTS):
        rivals: Rivals = {}
        for placed, others in exchanged(study, best, rounds, known, anew):
            at = best.effects.index(placed)
            richer = [other for other in others if other.effects[at].generalises(placed)]
            rivals[placed.label] = [other for other in others if other not in richer]
            models = (best, *rivals[placed.label], *(o for o in richer if _worth_it(best, o)))
            better = _simplest(best_of(models), models)
            if _is_worth_exchanging(best, better):
                best, known = better, {}
                break
        else:
            return best, rivals
    return best, {}


def _is_worth_exchanging(model: Refit, other: Refit) -> bool:
    """Tell whether another model is clearly better, or as good for clearly less."""
    won = _price(model, other) - _price(other, other)
    return other is not model and (won > criteria.PART_CHI_SQUARED or not are_alike(model, other))
