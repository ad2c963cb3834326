"""The noise that shows beside a model, and the band that filters of the channels pass."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from ...identification import Campaign, Heard, floors_beside
from ..models.study import Study
from .joint_fit import JointFit
from .model_comparison import Refit


def heard_beside(study: Study, model: Refit) -> Study:
    """Return the study with the noise that shows beside a model; itself if no other noise shows."""
    campaign = study.campaign
    floors = [dict(experiment.floors) for experiment in campaign.experiments]
    whole = _whole(study, model)
    for name in campaign.outputs:
        for floor, own in zip(floors, floors_beside([*_heard(campaign, whole, name)]), strict=True):
            floor[name] = own
    if floors == [e.floors for e in campaign.experiments]:
        return study
    return replace(study, campaign=campaign.with_floors(floors))


def _whole(study: Study, model: Refit) -> Refit:
    """Return a model as it leaves all of what was measured, what filters have changed, too."""
    experiments = study.campaign.experiments
    if all(experiment.whole is experiment for experiment in experiments):
        return model
    campaign = study.campaign.with_floors([experiment.whole.floors for experiment in experiments])
    joint = JointFit(replace(study, campaign=campaign), model.parameters, model.effects, model)
    return joint.seen(joint.start)


def _heard(campaign: Campaign, model: Refit, name: str) -> Iterator[Heard]:
    """Yield a channel in each record, beside what a model misses of it."""
    for experiment, missed in zip(campaign.experiments, model.left, strict=True):
        yield Heard(
            experiment.counted(experiment.sigma[name] * missed[name]),
            experiment.counted(experiment.compared.values[name]),
            [experiment.counted(experiment.compared.values[drive]) for drive in campaign.inputs],
            experiment.floors[name],
            experiment.rate,
        )
