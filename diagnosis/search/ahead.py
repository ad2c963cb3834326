"""Two effects that say nothing alone: the first told by the records that were fitted, both by the others."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from .. import criteria
from ..models.study import Study
from .choice import taken
from .model_comparison import Refit, is_clear
from .round import Round, run_round


def gone_ahead(
    study: Study, rounds: list[Round], best: Refit, base: Refit, suffices: Callable[[Refit], bool]
) -> tuple[Refit, Refit] | None:
    """Return a model of one effect and one of two, which suffices and is clearly better than the best so far.

    While much else is missing, parameters make up for it in the training records as they cannot elsewhere:
    the effect that is there hardly shows in the test records, though it halves the cost. So the search goes
    on from those that come nearest to the training records, and only the second is judged by the others.
    """
    first = rounds[0]
    for begun in _beginnings(first, best):
        if study.late():
            break
        study.tell(f"going on from {begun.labels[0]}, which comes near the training records")
        done = run_round(study, begun, rounds)
        chosen = taken(Round(base, done.candidates, done.fitted), base)
        if chosen is not None and is_clear(best, chosen) and suffices(chosen):
            return begun, chosen
        rounds.remove(done)
    return None


def _beginnings(first: Round, best: Refit) -> Iterator[Refit]:
    """Yield models of a first round that were not gone on from, the nearest to the training records first."""
    known = [best.cost] if best.effects else []
    most = len(known) + criteria.BEGINNINGS
    for model in sorted(first.fitted, key=lambda model: model.cost):
        if len(known) == most or model.cost > criteria.BEGINNING_COST_RATIO * first.base.cost:
            return
        if all(abs(model.cost / other - 1) > criteria.ALIKE_COST_SHARE for other in known):
            known.append(model.cost)
            yield model
