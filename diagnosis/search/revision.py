"""Effects that were found first, held once more against their rivals, beside what was found since."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import count

from ...components import InertanceError
from .. import criteria
from ..effects.hypothesis import Hypothesis
from ..models.study import Study
from .crew import Crew, Fit
from .joint_fit import JointFit
from .model_comparison import Refit, clearness
from .round import Round, leading
from .score_test import screen

Rivals = dict[str, list[Refit]]  # by label of an effect, the models in which another one stands for it


def exchanged(
    study: Study, model: Refit, rounds: Sequence[Round], known: Rivals, anew: bool
) -> Iterator[tuple[Hypothesis, list[Refit]]]:
    """Yield each effect but the last, with the models in which its rivals stand for it.

    What was found first was found beside a gap that the others made, where another effect may have come close
    to it or have passed it. If asked for, what explains most beside the others is screened `anew`. What is
    `known` is not fitted again.
    """
    for position, placed in enumerate(model.effects[:-1]):
        if study.late():
            return
        study.tell(f"trying rivals of {placed.label} beside what was found since")
        before, fits = known.get(placed.label, []), list[Fit]()
        if placed.label not in known:
            fits = [_again(rival, placed, model) for rival in _rivals(placed, model, rounds)]
        if anew:
            tried = {other.effects[position].label for other in before} | {fit.placed.label for fit in fits}
            fits += [fit for fit in _anew(study, placed, model) if fit.placed.label not in tried]
        crew = Crew(study)
        begun = [crew.begin(fit) for fit in fits]
        found = [outcome for outcome in (fit() for fit in begun) if isinstance(outcome, Refit)]
        yield placed, [*before, *(_ordered(other, position) for other in found)]


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


def _ordered(model: Refit, position: int) -> Refit:
    """Return a model with its last effect at a position among the others."""
    *others, last = model.effects
    return replace(model, effects=(*others[:position], last, *others[position:]))
