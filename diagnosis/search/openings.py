"""Starts of fits: openings of records, fitted before longer ones."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from ...components import InertanceError
from .. import criteria
from ..effects.hypothesis import Hypothesis
from ..models.study import Study
from .joint_fit import FitStart, JointFit
from .model_comparison import Refit, rms


def led_by_openings(
    study: Study, effects: Sequence[Hypothesis], base: Refit, starts: Sequence[FitStart]
) -> Sequence[FitStart]:
    """Return where openings of the training records lead that grow, as a start; none if nothing meets them.

    Where parts hit one another, or may come to rest in one of several places, an error of a value shifts all
    that follows: what is missed of a whole record is as rough as a comb. Of its opening it is smooth, and
    what meets that comes near enough for one that is longer.

    Source: H. U. Voss, J. Timmer, J. Kurths, Nonlinear dynamical system identification from uncertain and
    indirect measurements, International Journal of Bifurcation and Chaos 14 (2004) 1905-1933.
    """
    led: Sequence[FitStart] = ()
    for length in _lengths(study, base):
        if study.late():
            break
        try:
            joint = JointFit(_opening(study, length), base.parameters, effects, base)
            found = joint.fitted(led or _nearest(joint, starts))
        except InertanceError:
            break
        if found.misfit > criteria.LOST_MISFIT:
            break
        led = [(found.parameters, found.effects[-1].values)]
    return led


def _opening(study: Study, length: int) -> Study:
    """Return a study of the first samples of its training records alone."""
    openings = [e.until(min(length, len(e.compared.time) - 1)) for e in study.campaign.training]
    return replace(study, campaign=study.campaign.with_records(openings, []))


def _nearest(joint: JointFit, starts: Sequence[FitStart]) -> list[FitStart]:
    """Return those starts that miss an opening least, of some and of the same in larger sizes."""
    placed = joint.effects[-1]
    shapes = {quantity.name for quantity in placed.quantities if quantity.shape}
    tried: list[FitStart] = [
        (parameters, {n: v if n in shapes else size * v for n, v in values.items()})
        for parameters, values in starts
        for size in criteria.OPENING_SIZES
    ]
    return sorted(tried, key=lambda start: joint.missed(*start))[: criteria.OPENING_STARTS]


def _lengths(study: Study, base: Refit) -> Iterator[int]:
    """Yield how long openings are, from where the model without the effect is lost [samples]."""
    longest = max(len(experiment.compared.time) for experiment in study.campaign.training)
    length = criteria.PIECE_SAMPLES
    while length < longest:
        if rms([r[:length] for left in base.train for r in left.values()]) > criteria.LOST_MISFIT:
            yield length
        length = round(criteria.OPENING_GROWTH * length)
