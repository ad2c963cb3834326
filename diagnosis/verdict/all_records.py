"""Models that test records tell apart though all records, or what they mean, do not."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from ...components import InertanceError
from ...identification import Campaign
from ..criteria import ALIKE_CHI_SQUARED, NEARLY_ALIKE_MODELS, NEARLY_ALIKE_SHARE
from ..models.study import Study
from ..search.joint_fit import JointFit
from ..search.model_comparison import Refit


def alike_by_all(study: Study, best: Refit, others: Sequence[Refit]) -> Iterator[Refit]:
    """Yield models that are about as good as the best, and as likely once both are fitted to all records.

    Test records part them by what their parameters owe to the training records alone: there parameters err in
    all stretches at once, by what noise made of them in the training, which no test on stretches knows.
    """
    squares = float(best.blocks.sum())
    away = {id(f): abs(float(f.blocks.sum()) - squares) for f in others}
    near = [f for f in others if away[id(f)] < NEARLY_ALIKE_SHARE * squares]
    near = sorted(near, key=lambda f: away[id(f)])[:NEARLY_ALIKE_MODELS]
    if not near or not study.campaign.testing or study.late():
        return
    campaign = study.campaign
    study = replace(study, campaign=campaign.with_records(campaign.experiments, []))
    allowed = ALIKE_CHI_SQUARED * max(1.0, best.misfit**2)
    least = _cost(study, best)
    for other in near:
        if abs(_cost(study, other) - least) < allowed:
            yield other


def _cost(study: Study, model: Refit) -> float:
    """Return what a model costs that is fitted to all records of a study."""
    try:
        return JointFit(study, model.parameters, model.effects, model).fitted().cost
    except InertanceError:
        return float("nan")


def are_one_delay(campaign: Campaign, one: Refit, other: Refit) -> bool:
    """Tell whether models differ in a late command and a late sensor, where there is one of each.

    They shift the same time, however well either is computed.
    """
    parted = {placed.key for placed in one.effects} ^ {placed.key for placed in other.effects}
    kinds = sorted(kind for kind, _ in parted)
    alone = len(campaign.inputs) == len(campaign.outputs) == 1
    return alone and kinds == ["actuator_delay", "sensor_delay"]
