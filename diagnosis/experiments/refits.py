"""What is left of a separation once each rival has been fitted to the experiment that another one made."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import combinations

import numpy as np

from ...components import InertanceError
from .. import criteria
from ..models.study import Study
from ..search.joint_fit import FitStart, JointFit
from ..search.model_comparison import Refit
from .forecast import Forecast, Planned, Seen
from .separation import Odds


def refitted(study: Study, models: Sequence[Forecast], made: Planned, odds: Sequence[Odds]) -> list[Odds]:
    """Return the odds of each pair that a refit leaves, with nothing taken as linear.

    The experiment as either model foresees it joins the training records, and the other one is fitted to all
    of them: what its cost rises by is the squared distance. The less of both counts.
    """
    pairs, left = combinations(zip(models, made.seen, strict=True), 2), []
    for pair, ((one, mine), (other, theirs)) in zip(odds, pairs, strict=True):
        if not pair.is_decisive:
            left.append(pair)
            continue
        study.tell(f"fitting {other.told} to what {one.told} would show, and the other way round")
        found = _distance(study, other, made, mine), _distance(study, one, made, theirs)
        distances = [distance / min(one.missed, other.missed) for distance in found]
        left.append(replace(pair, distance=min(pair.distance, *distances)))
    return left


def _distance(study: Study, rival: Forecast, made: Planned, truth: Seen) -> float:
    """Return how far a rival stays, in standard deviations of the noise, from what another model shows."""
    record, count = made.experiment.record, len(study.campaign.training)
    compared = made.experiment.compared.time
    shown = {name: np.interp(record.time, compared, v) for name, v in truth.run.seen.items()}
    experiment = replace(made.experiment, record=replace(record, values={**record.values, **shown}))
    campaign = study.campaign.with_records([*study.campaign.training, experiment], [])
    model = rival.model
    near = replace(model, starts=[*model.starts[:count], {}])
    try:
        joint = JointFit(replace(study, campaign=campaign), model.parameters, model.effects, near)
        cost = joint.fitted(_starts(model)).cost
    except InertanceError:
        return float("inf")
    return float(np.sqrt(max(0.0, cost - model.cost)))


def _starts(model: Refit) -> list[FitStart]:
    """Return values to fit a model from: as they are, and with other shapes of its last effect."""
    if not model.effects:
        return []
    last = model.effects[-1]
    shapes = [shape for shape in last.effect.shaped(last.site.domain, last.site) if shape]
    chosen = np.linspace(0, len(shapes) - 1, min(len(shapes), criteria.DESIGN_REFIT_SHAPES)).round()
    others = [{**last.values, **shapes[int(number)]} for number in chosen]
    return [(model.parameters, values) for values in (dict(last.values), *others)]
