"""Effects that were found first, held once more against their rivals, beside what was found since."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import count

from .. import criteria
from ..effects.hypothesis import Hypothesis
from ..models.study import Study
from .crew import Crew, Fit
from .model_comparison import Refit, clearness
from .round import Round

Rivals = dict[str, list[Refit]]  # by label of an effect, the models in which another one stands for it


def exchanged(
    study: Study, model: Refit, rounds: Sequence[Round]
) -> Iterator[tuple[Hypothesis, list[Refit]]]:
    """Yield each effect but the last, with the models in which its rivals stand for it.

    What was found first was found beside a gap that the others made, where another effect may have come close
    to it or have passed it.
    """
    for position, placed in enumerate(model.effects[:-1]):
        if study.late():
            return
        study.tell(f"trying rivals of {placed.label} beside what was found since")
        others = replace(model, effects=tuple(p for p in model.effects if p is not placed))
        crew, fits = Crew(study), []
        for rival in _rivals(placed, model, rounds):
            last = rival.effects[-1]
            renamed = replace(last, name=_free_name(last, others.effects))
            start = model.parameters, dict(last.values)
            fits.append(crew.begin(Fit(renamed, others, [start], model.cost)))
        found = [outcome for outcome in (fit() for fit in fits) if isinstance(outcome, Refit)]
        yield placed, [_ordered(other, position) for other in found]


def _rivals(placed: Hypothesis, model: Refit, rounds: Sequence[Round]) -> list[Refit]:
    """Return what explained about as much as an effect when that was found, the best first."""
    done = next((r for r in rounds if any(f.effects[-1].label == placed.label for f in r.fitted)), None)
    if done is None:
        return []
    taken = {placed.label for placed in model.effects}
    most = max(_drop(f, done) for f in done.fitted)
    rivals = [
        f
        for f in done.fitted
        if f.effects[-1].label not in taken
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
