"""`diagnose`: find what parts the records of a campaign and its model."""

from __future__ import annotations

from concurrent.futures import Executor

from ..components import InertanceError
from ..identification import Accuracy, Campaign
from ..networks import ToolchainError, compiler
from .comparing import COLOURED, blocks, clearness, is_simpler, misfit
from .contest import Report, Round, held
from .deciding import decided
from .predicting import limits
from .refit import Joint, Refit, refit
from .thinning import thinned
from .verdict import Verdict

MOST_EFFECTS = 2
CLEAR = 3.0  # standard errors by which an effect must beat the model without it
WORTH = 0.25  # share of what a special case leaves that its generalisation must take away
LEAST_DROP = 0.01  # share of the squared test residual that an effect must take away
LEAST_FURTHER = 0.05  # the same for a second effect: less but mends the shape of the first
STEPS = 50  # granted to a run for each sample; a model that needs more is none to be fitted
NOISE = 1.03  # misfit over noise at which there is nothing left to find


def diagnose(
    campaign: Campaign,
    *,
    executor: Executor | None = None,
    solver: str = "auto",
    rtol: float = 1e-5,
    report: Report | None = None,
) -> Verdict:
    """Say what parts measured data and model: where, why, and how much of it goes away.

    The parameters are refitted; every effect at every site is screened by a one-sided score test; the
    leading ones are fitted together with the parameters and ranked by the test records, which are never
    fitted; what cannot be told apart forms a class.

    Args:
        campaign: records, channels, priors and model.
        executor: fits candidates; any `concurrent.futures.Executor`.
        solver: as for `DAE.simulate`; "auto" compiles models where there is a C compiler.
        rtol: relative tolerance of the runs.
        report: called with a line of progress.

    Returns:
        The verdict; after Ctrl-C, that of what was done until then, which says so.
    """
    tell = report or (lambda line: None)
    campaign = thinned(campaign)
    accuracy = Accuracy(_fastest() if solver == "auto" else solver, rtol, 1e-2 * rtol, STEPS)
    tell("refitting the parameters")
    nominal = Joint(campaign, campaign.network, campaign.start, (), accuracy)
    start = nominal.seen(nominal.start)
    base = nominal.fitted()
    rounds: list[Round] = []
    notes = limits(campaign)
    best = base
    try:
        while len(best.effects) < MOST_EFFECTS and misfit(best) > (COLOURED if rounds else NOISE):
            done = held(campaign, best, accuracy, executor, tell)
            rounds.append(done)
            chosen = _chosen(done, base, campaign)
            if chosen is None:
                break
            best = _pruned(chosen, campaign, accuracy)
    except KeyboardInterrupt:
        notes.append("interrupted; this is what was known until then")
        tell(notes[-1])
    return decided(campaign, accuracy, start, base, best, rounds, notes)


def _fastest() -> str:
    """Return the solver for thousands of runs: the compiled one, if there is a compiler."""
    try:
        compiler()
    except ToolchainError:
        return "auto"
    return "compiled"


def _chosen(done: Round, base: Refit, campaign: Campaign) -> Refit | None:
    """Return the best model of a round among those clearly better than the first, the simplest of equals.

    How much it must take away is counted in what the model without effects misses.
    """
    clear = [found for found in done.fitted if clearness(done.base, found, campaign) > CLEAR]
    if not clear:
        return None
    best = min(clear, key=lambda f: blocks(f, campaign).sum())
    for other in clear:
        if is_simpler(other, best) and not _worth_it(other, best, campaign):
            best = other
    drop = blocks(done.base, campaign).sum() - blocks(best, campaign).sum()
    least = LEAST_FURTHER if done.base.effects else LEAST_DROP
    return best if drop > least * blocks(base, campaign).sum() else None


def _worth_it(plain: Refit, richer: Refit, campaign: Campaign) -> bool:
    """Tell whether a generalisation does clearly better, and not only mends what no law has quite right.

    One that leaves nothing but noise, where its special case leaves more, does clearly better.
    """
    left = misfit(plain) ** 2 - 1.0
    taken = misfit(plain) ** 2 - misfit(richer) ** 2
    clear = misfit(richer) <= NOISE < misfit(plain) or clearness(plain, richer, campaign) >= CLEAR
    return taken > WORTH * left and clear


def _pruned(best: Refit, campaign: Campaign, accuracy: Accuracy) -> Refit:
    """Return the model without those effects that a later one has made needless."""
    for placed in best.effects[:-1]:
        others = [p for p in best.effects if p is not placed]
        try:
            less = refit(campaign, campaign.network, best.parameters, others, accuracy)
        except InertanceError:
            continue
        if clearness(less, best, campaign) < CLEAR:
            best = less
    return best
