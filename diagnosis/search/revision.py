"""Effects that were found first, held once more against their rivals, beside what was found since."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import count

from ...components import InertanceError
from .. import criteria
from ..effects.hypothesis import Hypothesis
from ..models.study import Study
from .choice import is_worth_exchanging, is_worth_it, simplest
from .crew import Crew, Fit
from .joint_fit import JointFit
from .model_comparison import Refit, best_of, clearness
from .round import Round, leading
from .score_test import screen

Rivals = dict[str, list[Refit]]  # by label of an effect, the models in which another one stands for it
Tried = dict[frozenset[str], Refit | str]  # by labels of effects, the model with them, or why there is none


def revised(
    best: Refit, rounds: Sequence[Round], study: Study, tried: Tried, anew: bool = False
) -> tuple[Refit, Rivals]:
    """Return the model with effects exchanged for what does better beside the others, and the rivals.

    Models that were `tried` are not fitted again; those that are fitted are added to them.
    """
    for _ in range(criteria.MOST_EFFECTS):
        rivals: Rivals = {}
        for placed, others in exchanged(study, best, rounds, tried, anew):
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


def pruned(best: Refit, study: Study) -> Refit:
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


def exchanged(
    study: Study, model: Refit, rounds: Sequence[Round], tried: Tried, anew: bool
) -> Iterator[tuple[Hypothesis, list[Refit]]]:
    """Yield each effect but the last, with the models in which its rivals stand for it.

    What was found first was found beside a gap that the others made, where another effect may have come close
    to it or have passed it. If asked for, what explains most beside the others is screened `anew`.
    """
    for position, placed in enumerate(model.effects[:-1]):
        if study.late():
            return
        study.tell(f"trying rivals of {placed.label} beside what was found since")
        fits = [_again(rival, placed, model) for rival in _rivals(placed, model, rounds)]
        if anew:
            again = {fit.placed.label for fit in fits}
            fits += [fit for fit in _anew(study, placed, model) if fit.placed.label not in again]
        found = zip(fits, _made(study, fits, tried), strict=True)
        yield placed, [_ordered(o, f.placed.label, position) for f, o in found if isinstance(o, Refit)]


def _made(study: Study, fits: Sequence[Fit], tried: Tried) -> list[Refit | str]:
    """Return what comes of fits, which are made unless they were tried."""
    keys = [frozenset((*fit.base.labels, fit.placed.label)) for fit in fits]
    crew = Crew(study)
    begun = {key: crew.begin(fit) for key, fit in zip(keys, fits, strict=True) if key not in tried}
    tried.update({key: outcome() for key, outcome in begun.items()})
    return [tried[key] for key in keys]


def without(placed: Hypothesis, model: Refit, study: Study) -> Refit | None:
    """Return a model without one of its effects, fitted again from where it is; None if it cannot be run."""
    others = [p for p in model.effects if p is not placed]
    sites = study.sites
    others = [p.beside([other for other in others if other is not p], sites) for p in others]
    starts = [(model.parameters, p.values) for p in others[-1:]]
    starts += [(model.parameters, p.joined(placed)) for p in others[-1:] if p.generalises(placed)]
    try:
        return JointFit(study, model.parameters, others, model).fitted(starts)
    except InertanceError:
        return None


def _again(rival: Refit, placed: Hypothesis, model: Refit) -> Fit:
    """Return the fit of what came close to an effect, in its place."""
    last, others = rival.effects[-1], _others(placed, model)
    renamed = replace(last, name=_free_name(last, others.effects))
    return Fit(renamed, others, [(model.parameters, dict(last.values))], model.cost)


def _anew(study: Study, placed: Hypothesis, model: Refit) -> list[Fit]:
    """Return fits of what explains most beside the other effects of a model, in the place of one.

    Where nothing but noise is left, those are enough that explain about as much.
    """
    less = without(placed, model, study)
    if less is None:
        return []
    try:
        candidates = screen(study, less.parameters, less.effects, near=less)
    except InertanceError:
        return []
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
