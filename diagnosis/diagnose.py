"""`diagnose`: find what parts the records of a campaign and its model."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import Executor
from pathlib import Path

import numpy as np

from ..base import between, demand, function, instance, one_of, optional
from ..components import InertanceError
from ..identification import Accuracy, Campaign
from ..networks import COARSEST, FINEST, SOLVERS, chosen_solver
from .criteria import (
    CLEAR_STANDARD_ERRORS,
    COLOURED_MISFIT,
    EARLY_END_COST_RATIO,
    FIRST_EFFECT_SHARE,
    FURTHER_EFFECT_SHARE,
    GENERALISATION_SHARE,
    MOST_EFFECTS,
    NOISE_MISFIT,
    PART_CHI_SQUARED,
    RELATIVE_TOLERANCES,
    RUNS_PER_MODEL,
    SOLVER_STEPS_PER_SAMPLE,
    TOLERANCE_OVER_NOISE,
)
from .effects.hypothesis import Hypothesis
from .models.predictor import subject
from .models.read import read_model
from .search.decimation import thinned
from .search.joint_fit import JointFit, Refit, refit
from .search.model_comparison import are_alike, blocks, clearness, is_simpler, misfit, unexplained
from .search.round import Report, Round, run_round
from .verdict.decide import decided
from .verdict.verdict import DiagnosisInterruptedError, Verdict


def diagnose(
    campaign: Campaign | str | Path,
    *,
    executor: Executor | None = None,
    solver: str = "auto",
    rtol: float | None = None,
    report: Report | None = None,
) -> Verdict:
    """Say what parts measured data and model: where, why, and how much of it goes away.

    The parameters are refitted; every effect at every site is screened by a one-sided score test; the
    leading ones are fitted together with the parameters and ranked by the test records, which are never
    fitted; what cannot be told apart forms a class.

    Args:
        campaign: records, channels, priors and model, or the path of the TOML file that tells them.
        executor: fits candidates; any `concurrent.futures.Executor`.
        solver: as for `simulate`; "auto" compiles models where there is a C compiler and 200 runs of the
            training records come to 40 000 samples, as of 200 and more in all.
        rtol: relative tolerance of the runs; small beside the noise if not given.
        report: called with a line of progress.

    Raises:
        DiagnosisInterruptedError: on Ctrl-C, once the parameters are refitted; its `verdict`, "interrupted",
            tells what is known so far.
    """
    demand(
        "diagnose()",
        solver=(solver, one_of(SOLVERS)),
        rtol=(rtol, optional(between(FINEST, COARSEST))),
        report=(report, optional(function)),
        executor=(executor, optional(instance(Executor))),
    )
    tell = report or (lambda line: None)
    campaign = thinned(Campaign.of(campaign, read_model))
    rtol = rtol or relative_tolerance(campaign)
    samples = sum(len(experiment.record.time) for experiment in campaign.training)
    accuracy = Accuracy(chosen_solver(solver, samples, RUNS_PER_MODEL), rtol, steps=SOLVER_STEPS_PER_SAMPLE)
    tell("refitting the parameters")
    nominal = JointFit(campaign, campaign.network, campaign.start, (), accuracy)
    start = nominal.seen(nominal.start)
    base = nominal.fitted()
    rounds: list[Round] = []
    notes = subject(campaign).limits()
    best = base
    try:
        while len(best.effects) < MOST_EFFECTS and _misses_much(best, base):
            done = run_round(campaign, best, accuracy, executor, tell, rounds)
            chosen = _chosen(done, base, campaign)
            if chosen is None:
                break
            without = _without(chosen.effects[-1], chosen, campaign, accuracy)
            if without is not None and without.cost < EARLY_END_COST_RATIO * best.cost:
                tell("the fit before had ended early: once more from where this one led")
                best, base = without, base if best.effects else without
                rounds.pop()
                continue
            best = _pruned(chosen, campaign, accuracy)
        return decided(campaign, accuracy, start, base, best, rounds, notes)
    except KeyboardInterrupt:
        verdict = decided(campaign, accuracy, start, base, best, rounds, notes, interrupted=True)
        raise DiagnosisInterruptedError(
            "interrupted; what is known so far is the error's `verdict`", verdict
        ) from None


def relative_tolerance(campaign: Campaign) -> float:
    """Return a relative tolerance at which errors of runs, friction and all, do not show in the noise."""
    moved = {n: max(float(np.std(e.record.values[n])) for e in campaign.training) for n in campaign.outputs}
    share = min(sigma / (moved[name] or sigma) for name, sigma in campaign.sigma.items())
    return float(np.clip(TOLERANCE_OVER_NOISE * share, *RELATIVE_TOLERANCES))


def _misses_much(best: Refit, base: Refit) -> bool:
    """Tell whether another effect could take away enough to be believed."""
    if not best.effects:
        return misfit(best) > NOISE_MISFIT
    return misfit(best) > COLOURED_MISFIT and unexplained(best, base) > FURTHER_EFFECT_SHARE


def _chosen(done: Round, base: Refit, campaign: Campaign) -> Refit | None:
    """Return the best model of a round among those clearly better than the first, the simplest of equals.

    How much it must take away is counted in what the model without effects misses.
    """
    clear = [found for found in done.fitted if clearness(done.base, found, campaign) > CLEAR_STANDARD_ERRORS]
    if not clear:
        return None
    best = _sited(min(clear, key=lambda f: blocks(f, campaign).sum()), clear, campaign)
    for other in clear:
        if is_simpler(other, best) and not _worth_it(other, best, campaign):
            best = other
    drop = blocks(done.base, campaign).sum() - blocks(best, campaign).sum()
    least = FURTHER_EFFECT_SHARE if done.base.effects else FIRST_EFFECT_SHARE
    return best if drop > least * blocks(base, campaign).sum() else None


def _sited(best: Refit, clear: Sequence[Refit], campaign: Campaign) -> Refit:
    """Return a model or its like with the same effect elsewhere, if test records cannot tell them apart.

    Those have equally many parameters, so that what was fitted tells more; what it does not tell of a part
    is told of the whole.
    """
    kind = best.effects[-1].effect.kind
    alike = [f for f in clear if f.effects[-1].effect.kind == kind and are_alike(f, best, campaign)]
    best = min(alike, key=lambda f: f.cost)
    for other in alike:
        if other.effects[-1].site.holds(best.effects[-1].site) and other.cost < best.cost + PART_CHI_SQUARED:
            best = other
    return best


def _worth_it(plain: Refit, richer: Refit, campaign: Campaign) -> bool:
    """Tell whether a generalisation does clearly better, and not only mends what no law has quite right.

    One that leaves nothing but noise, where its special case leaves more, does clearly better.
    """
    left = misfit(plain) ** 2 - 1.0
    taken = misfit(plain) ** 2 - misfit(richer) ** 2
    clear = (
        misfit(richer) <= NOISE_MISFIT < misfit(plain)
        or clearness(plain, richer, campaign) >= CLEAR_STANDARD_ERRORS
    )
    return taken > GENERALISATION_SHARE * left and clear


def _pruned(best: Refit, campaign: Campaign, accuracy: Accuracy) -> Refit:
    """Return the model without those effects that a later one has made needless."""
    for placed in best.effects[:-1]:
        less = _without(placed, best, campaign, accuracy)
        if less is not None and clearness(less, best, campaign) < CLEAR_STANDARD_ERRORS:
            best = less
    return best


def _without(placed: Hypothesis, model: Refit, campaign: Campaign, accuracy: Accuracy) -> Refit | None:
    """Return a model without one of its effects, fitted again from where it is; None if it cannot be run."""
    others = [p for p in model.effects if p is not placed]
    try:
        return refit(campaign, campaign.network, model.parameters, others, accuracy)
    except InertanceError:
        return None
