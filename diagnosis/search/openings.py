"""Starts of fits: openings of records, fitted before longer ones."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace

import numpy as np

from ...components import InertanceError
from ...identification import Experiment
from .. import criteria
from ..effects.hypothesis import Hypothesis
from ..models.prescribed import standing
from ..models.study import Study
from .joint_fit import FitStart, JointFit
from .model_comparison import Refit, rms


def led_by_openings(
    study: Study, effects: Sequence[Hypothesis], base: Refit, starts: Sequence[FitStart]
) -> Refit | None:
    """Return the model to which openings of the training records lead that grow; None if nothing meets them.

    Where parts hit one another, or may come to rest in one of several places, an error of a value shifts all
    that follows: what is missed of a whole record is as rough as a comb. Of its opening it is smooth, and
    what meets that comes near enough for one that is longer.

    Source: H. U. Voss, J. Timmer, J. Kurths, Nonlinear dynamical system identification from uncertain and
    indirect measurements, International Journal of Bifurcation and Chaos 14 (2004) 1905-1933.
    """
    led: Refit | None = None
    for opening in _openings(study, base):
        if study.late():
            break
        try:
            joint = JointFit(opening, base.parameters, effects, base)
            found = joint.fitted(_nearest(joint, starts) if led is None else [led.values])
        except InertanceError:
            break
        if found.misfit > criteria.LOST_MISFIT:
            break
        led = found
    return led


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


def _openings(study: Study, base: Refit) -> Iterator[Study]:
    """Yield studies of openings of the training records alone, from where a model without the effect is lost.

    They are counted from where an input or an output first moves: what rests tells of no effect.
    """
    training, length = study.campaign.training, criteria.PIECE_SAMPLES
    begins = [_rests(experiment, study.campaign.inputs) for experiment in training]
    lasts = [len(experiment.compared.time) - 1 for experiment in training]
    while length <= max(last - begin for last, begin in zip(lasts, begins, strict=True)):
        ends = [min(begin + length, last) for begin, last in zip(begins, lasts, strict=True)]
        spans = zip(base.train, begins, ends, strict=True)
        if rms([r[begin:end] for left, begin, end in spans for r in left.values()]) > criteria.LOST_MISFIT:
            openings = [experiment.until(end) for experiment, end in zip(training, ends, strict=True)]
            yield replace(study, campaign=study.campaign.with_records(openings, []))
        length = round(criteria.OPENING_GROWTH * length)


def _rests(experiment: Experiment, inputs: Iterable[str]) -> int:
    """Return how long a record begins with nothing that moves but by its noise [samples]; 0 if nothing does.

    A machine under a force that stands still may be on its way to where it rests.
    """
    values = experiment.compared.values
    still = standing([values[name] for name in inputs], experiment.rate)
    for name, sigma in experiment.sigma.items() if still.size else ():
        most = criteria.NOISE_PEAK_STANDARD_DEVIATIONS * np.sqrt(2.0) * sigma
        still &= np.abs(values[name] - values[name][0]) <= most
    return int(np.argmin(still)) if still.size else 0
