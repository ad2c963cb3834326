"""The noise that shows beside a model, and the band that filters of the channels pass."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from math import inf

import numpy as np

from ...base import Array
from ...identification import Campaign, Heard, Prediction, Steps, cutoff_of, floors_beside
from ..models.network_predictor import NetworkPredictor
from ..models.study import Study
from .joint_fit import JointFit
from .model_comparison import Refit
from .record_run import RecordRun


def heard_beside(study: Study, model: Refit) -> Study:
    """Return the study with the noise that shows beside a model; itself if no other noise shows."""
    rounded = _rounded(study, model)
    campaign = rounded.campaign
    floors = [dict(experiment.floors) for experiment in campaign.experiments]
    whole = _whole(rounded, model, rounded is not study)
    for name in campaign.outputs:
        for floor, own in zip(floors, floors_beside([*_heard(campaign, whole, name)]), strict=True):
            floor[name] = replace(own, cutoff=floor[name].cutoff)
    if floors == [e.floors for e in study.campaign.experiments]:
        return study
    return replace(study, campaign=campaign.with_floors(floors))


def _rounded(study: Study, model: Refit) -> Study:
    """Return the study with the filters that have rounded the steps of a model; itself if no other show."""
    joint, campaign = JointFit(study, model.parameters, model.effects, model), study.campaign
    if not isinstance(joint.predictor, NetworkPredictor) or not joint.predictor.dae.hybrid:
        return study
    runs = [joint.run_on(experiment) for experiment in campaign.training]
    alone = {name: _cutoff(runs, name) for name in campaign.outputs}
    heard = [cutoff for cutoff in alone.values() if cutoff < inf]
    cutoffs = {name: own if own < inf else _cutoff(runs, name, heard) for name, own in alone.items()}
    if all(cutoff == campaign.floors[name].cutoff for name, cutoff in cutoffs.items()):
        return study
    floors = [
        {name: floor.behind(cutoffs[name]) for name, floor in experiment.floors.items()}
        for experiment in campaign.experiments
    ]
    return replace(study, campaign=campaign.with_floors(floors))


def _cutoff(runs: Sequence[RecordRun], name: str, beside: Sequence[float] = ()) -> float:
    """Return the cut-off of the filter that has rounded the steps of a channel [Hz], or that is known.

    Other channels have such ones `beside`.
    """
    missed, steps = list[Array](), list[Steps]()
    for run in runs:
        assert isinstance(run.found, Prediction)
        experiment, found = run.experiment, run.found.steps
        weight = 1 / experiment.sigma[name]
        sharp = run.seen[name] - found.rounding(name, experiment.floors[name].cutoff)
        left = weight * (experiment.compared.values[name] - sharp)
        counted = experiment.weights[name].counted
        if name in experiment.offset and counted.any():
            left -= left[counted].mean()
        missed.append(np.where(counted, left, np.nan))
        steps.append(replace(found, sizes={name: weight * found.sizes[name]}))
    if not any(found.sizes[name].any() for found in steps):
        return runs[0].experiment.floors[name].cutoff
    return cutoff_of(name, missed, steps, max(run.experiment.rate for run in runs), beside)


def _whole(study: Study, model: Refit, anew: bool) -> Refit:
    """Return a model as it leaves all of what was measured, what filters have changed, too.

    It is run `anew` where its steps are rounded otherwise.
    """
    experiments = study.campaign.experiments
    if not anew and all(experiment.whole is experiment for experiment in experiments):
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
