"""A law in place of effects at its site, each of which may be but a part of it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from ...components import InertanceError
from ..criteria import FORCE_LAW_STIFFNESS
from ..effects.hypothesis import Hypothesis
from ..models.study import Study
from ..search.model_comparison import Refit
from .drawing import Drawing
from .law import STATIC, Law
from .missing_force import MissingForce, force_of
from .polish import first_trial
from .regression import through
from .sought import Sought, judged
from .without import forces_of, plainest


def in_place(study: Study, model: Refit, parts: Sequence[Hypothesis], less: Refit) -> Sought | None:
    """Return what comes of one law at the site of effects of a model, beside the model without them.

    It is tried in free runs whatever it foresees, as what they do is a law there. It begins as the records,
    the missing force or the effects themselves show it, from where runs come nearest to the records.
    """
    study = study.displaced(less.effects)
    try:
        missing = force_of(study, less, parts[0].site.path)
        laws = [*_begun(study, model, parts, missing)]
        law = max(laws, key=lambda one: _nearness(study, one))
    except InertanceError:
        return None
    return judged(study, less, missing, law, {missing.site.path: max(one.explained for one in laws)})


def _begun(study: Study, model: Refit, parts: Sequence[Hypothesis], missing: MissingForce) -> Iterator[Law]:
    """Yield laws to begin with."""
    drawing = Drawing(missing.site, missing.settled)
    drawn = drawing.law(among=STATIC)
    yield drawn
    if drawn.is_foreseen:
        return
    yield missing.shown()
    forces, motions = forces_of(study, model, parts, missing.settled.number)
    if forces:
        variable = plainest(("position", "speed"), motions, forces)
        there = [replace(motion, s=motion.s - drawing.origin) for motion in motions]
        law, away = drawing.law((variable,)), missing.search.bench.away(model.parameters)
        values = through(law.grid, there, forces, FORCE_LAW_STIFFNESS)
        fit = replace(law.fit, values=values, moved=away)
        yield replace(law, values=values, fit=fit, shown=True)


def _nearness(study: Study, law: Law) -> tuple[int, float]:
    """Return how many samples free runs with a law follow, and how little they miss."""
    try:
        trial = first_trial(study, law)
    except InertanceError:
        return 0, 0.0
    return sum(trial.followed), -trial.squares
