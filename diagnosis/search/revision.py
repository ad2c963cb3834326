"""Effects that were found first, held once more against their rivals, beside what was found since."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from itertools import count

from ...components import InertanceError
from .. import criteria
from ..effects.hypothesis import Hypothesis
from ..models.study import Study
from .choice import is_worth_exchanging, is_worth_it, simplest
from .contenders import leading
from .fit import Fit
from .model_comparison import Refit, best_of, clearness
from .round import Round
from .score_test import Candidate, screen
from .tried import Tried

Rivals = dict[str, list[Refit]]  # by label of an effect, the models in which another one stands for it


def revised(best: Refit, rounds: Sequence[Round], tried: Tried, anew: bool = False) -> tuple[Refit, Rivals]:
    """Return the model with effects exchanged for what does better beside the others, and the rivals."""
    for _ in range(criteria.MOST_EFFECTS):
        rivals: Rivals = {}
        for placed, others in exchanged(tried, best, rounds, anew):
            at = best.effects.index(placed)
            richer = [other for other in others if other.effects[at].generalises(placed)]
            rivals[placed.label] = [other for other in others if other not in richer]
            models = (best, *rivals[placed.label], *(o for o in richer if is_worth_it(best, o)))
            better = simplest(best_of(models), models)
            if is_worth_exchanging(best, better):
                best = better
                break
        else:
            return best, rivals
    return best, {}


def plainer(best: Refit, tried: Tried) -> Refit:
    """Return the model with special cases of its effects that do as well, fitted from where those are.

    Fitted from elsewhere, they may have ended in another minimum. None is tried that stands there already.
    """
    for position, placed in enumerate(best.effects):
        there = {other.label for other in _others(placed, best).effects}
        for special in placed.specials:
            if special.label in there:
                continue
            if tried.study.late():
                return best
            tried.study.tell(f"trying {special.label}, a special case, from where {placed.effect.kind} led")
            others = _others(placed, best)
            renamed = replace(special, name=_free_name(special, others.effects))
            fit = Fit(renamed, others, [(best.parameters, special.values)], best.cost)
            found = tried.crew.begin(fit)()
            if isinstance(found, Refit) and not is_worth_it(found, best):
                best = _ordered(found, special.label, position)
                break
    return best


def pruned(best: Refit, tried: Tried) -> Refit:
    """Return the model without those effects that a later one has made needless, as its special cases are."""
    *earlier, last = best.effects
    tried.begin(best, earlier)
    for placed in earlier:
        less = tried.without(placed, best)
        if less is not None and not _is_needed(placed, last, best, less):
            best = less
    return best


def _is_needed(placed: Hypothesis, last: Hypothesis, model: Refit, less: Refit) -> bool:
    """Tell whether a model is clearly worse without an effect; by far, without a special case of another."""
    halves = model.blocks.sum() < criteria.CLEAR_RESIDUAL_RATIO * less.blocks.sum()
    clear = clearness(less, model) >= criteria.CLEAR_STANDARD_ERRORS
    return bool(clear and (halves or not last.generalises(placed)))


def exchanged(
    tried: Tried, model: Refit, rounds: Sequence[Round], anew: bool
) -> Iterator[tuple[Hypothesis, list[Refit]]]:
    """Yield each effect but the last, with the models in which its rivals stand for it.

    What was found first was found beside a gap that the others made, where another effect may have come close
    to it or have passed it. If asked for, what explains most beside the others is screened `anew`.
    """
    *earlier, _ = model.effects
    screened = _screened_beside(tried, model, earlier) if anew else {}
    for position, placed in enumerate(earlier):
        if tried.study.late():
            return
        tried.study.tell(f"trying rivals of {placed.label} beside what was found since")
        fits = [_again(rival, placed, model) for rival in _rivals(placed, model, rounds)]
        if placed.label in screened:
            again = {fit.placed.label for fit in fits}
            less, candidates = screened[placed.label]
            new = _anew(tried.study, placed, model, less, candidates())
            fits += [fit for fit in new if fit.placed.label not in again]
        found = zip(fits, tried.made(fits), strict=True)
        yield placed, [_ordered(o, f.placed.label, position) for f, o in found if isinstance(o, Refit)]


def _screened_beside(
    tried: Tried, model: Refit, effects: Sequence[Hypothesis]
) -> dict[str, tuple[Refit, Callable[[], list[Candidate]]]]:
    """Return, by label of an effect, the model without it and what gives the candidates beside that."""
    tried.begin(model, effects)
    others = {placed.label: tried.without(placed, model) for placed in effects}
    return {
        label: (less, tried.crew.ask(_screened, less)) for label, less in others.items() if less is not None
    }


def _screened(study: Study, model: Refit) -> list[Candidate]:
    """Return what is screened beside a model; nothing if it cannot be run beside probes."""
    try:
        return screen(study, model.parameters, model.effects, near=model)
    except InertanceError:
        return []


def _again(rival: Refit, placed: Hypothesis, model: Refit) -> Fit:
    """Return the fit of what came close to an effect, in its place."""
    last, others = rival.effects[-1], _others(placed, model)
    renamed = replace(last, name=_free_name(last, others.effects))
    return Fit(renamed, others, [(model.parameters, dict(last.values))], model.cost)


def _anew(
    study: Study, placed: Hypothesis, model: Refit, less: Refit, candidates: Sequence[Candidate]
) -> list[Fit]:
    """Return fits of what explains most beside the other effects of a model, in the place of one.

    Where nothing but noise is left, those are enough that explain about as much.
    """
    last = replace(model, effects=(*less.effects, placed))
    noise_is_left = model.misfit <= criteria.COLOURED_MISFIT or model.is_noise(study.judged)
    most = max((candidate.gain for candidate in candidates), default=0.0)
    least = criteria.RIVAL_DROP_RATIO * most if noise_is_left else 0.0
    promising = [c for c in leading(candidates, model.labels) if c.gain > least]
    fits = [Fit.of(candidate, less, [last]) for candidate in promising]
    return [
        replace(fit, placed=replace(fit.placed, name=_free_name(fit.placed, less.effects)), known=model.cost)
        for fit in fits[: criteria.RIVALS_SCREENED]
    ]


def _others(placed: Hypothesis, model: Refit) -> Refit:
    return replace(model, effects=tuple(p for p in model.effects if p is not placed))


def _rivals(placed: Hypothesis, model: Refit, rounds: Sequence[Round]) -> list[Refit]:
    """Return what explained about as much as an effect when that was found, the best first."""
    done = next((r for r in rounds if any(f.effects[-1].label == placed.label for f in r.fitted)), None)
    if done is None:
        return []
    most = max(_drop(f, done) for f in done.fitted)
    rivals = [
        f
        for f in done.fitted
        if f.effects[-1].label not in model.labels
        and not any(f.effects[-1].generalises(p) or p.generalises(f.effects[-1]) for p in model.effects)
        and _drop(f, done) > criteria.RIVAL_DROP_RATIO * most
        and clearness(done.base, f) > criteria.CLEAR_STANDARD_ERRORS
    ]
    return sorted(rivals, key=lambda f: f.blocks.sum())[: criteria.RIVALS_PER_EFFECT]


def _drop(model: Refit, done: Round) -> float:
    return float(done.base.blocks.sum() - model.blocks.sum())


def _free_name(placed: Hypothesis, others: Sequence[Hypothesis]) -> str:
    names = (f"{placed.effect.kind}_{number}" for number in count(1))
    return next(name for name in names if all(name != other.name for other in others))


def _ordered(model: Refit, label: str, position: int) -> Refit:
    """Return a model with one of its effects at a position among the others."""
    (one,) = (placed for placed in model.effects if placed.label == label)
    others = [placed for placed in model.effects if placed is not one]
    return replace(model, effects=(*others[:position], one, *others[position:]))
