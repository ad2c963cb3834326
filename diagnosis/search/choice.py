"""Which of the models of a round is taken: the best, the simplest of equals, where it says most."""

from __future__ import annotations

from collections.abc import Sequence

from .. import criteria
from .model_comparison import Refit, are_alike, best_of, is_clear
from .round import Round


def taken(done: Round, base: Refit) -> Refit | None:
    """Return the best model of a round among those clearly better than the first, the simplest of equals.

    How much it must take away is counted in what the model without effects misses.
    """
    clear = [found for found in done.fitted if is_clear(done.base, found)]
    if not clear:
        return None
    best = _sited(simplest(best_of(clear), clear), clear)
    for other in clear:
        if best.effects[-1].generalises(other.effects[-1]) and not is_worth_it(other, best):
            best = other
    drop, all_of_it = done.base.blocks.sum() - best.blocks.sum(), base.blocks.sum()
    if not done.base.effects:
        return best if drop > criteria.FIRST_EFFECT_SHARE * all_of_it else None
    of_what_is_left = drop > criteria.LEFT_EFFECT_SHARE * (done.base.blocks.sum() - base.independent)
    return best if of_what_is_left or drop > criteria.FURTHER_EFFECT_SHARE * all_of_it else None


def simplest(best: Refit, clear: Sequence[Refit]) -> Refit:
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


def is_worth_it(plain: Refit, richer: Refit) -> bool:
    """Tell whether a generalisation does clearly better, and not only mends what no law has quite right.

    One that leaves nothing but noise does, where its special case clearly leaves more, or where training and
    test records tell one from the other.
    """
    left = plain.misfit**2 - 1.0
    taken = plain.misfit**2 - richer.misfit**2
    nothing_left = richer.misfit <= criteria.NOISE_MISFIT and plain.misfit > criteria.COLOURED_MISFIT
    something_left = plain.misfit > criteria.NOISE_MISFIT
    nearly_all = something_left and taken > criteria.SURE_GENERALISATION_SHARE * left
    clear = nothing_left or nearly_all or is_told(plain, richer) or is_clear(plain, richer)
    return taken > criteria.GENERALISATION_SHARE * left and clear


def is_told(worse: Refit, better: Refit) -> bool:
    """Tell whether one leaves nothing but noise, and training and test records tell it from the other."""
    won = worse.cost - better.cost, float(worse.blocks.sum() - better.blocks.sum())
    return better.misfit <= criteria.NOISE_MISFIT and min(won) > criteria.LEAST_CHI_SQUARED_GAIN


def is_worth_exchanging(model: Refit, other: Refit) -> bool:
    """Tell whether another model is clearly better, or as good for clearly less."""
    won = _price(model, other) - _price(other, other)
    return other is not model and (won > criteria.PART_CHI_SQUARED or not are_alike(model, other))
