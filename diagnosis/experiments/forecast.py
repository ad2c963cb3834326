"""`Forecast`: what a fitted model foresees of excitations, and how sure that is."""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy
from dataclasses import dataclass, replace

import numpy as np

from ...base import Array
from ...components import SimulationError
from ...identification import Campaign, Experiment
from .. import criteria
from ..effects.hypothesis import told
from ..models.study import Study
from ..search.joint_fit import JointFit
from ..search.model_comparison import Refit
from ..search.record_run import RecordRun
from ..search.record_start import nuisance_slopes, projected
from .candidates import Candidate
from .envelope import watched
from .trial import taken, trial


@dataclass(frozen=True, eq=False)
class Seen:
    """What a model foresees of an experiment: its run, its outputs and their slopes, in units of noise.

    Offsets, where outputs have any, are taken off.
    """

    run: RecordRun
    values: Array
    slopes: Array


class Forecast:
    """A model with what is known of it: the information of its parameters, effects and priors.

    In units of what each may be: the information that the training records give, with the priors, where what
    is `missed` of them counts as noise. What they leave open is taken to be known within ten times that.
    """

    def __init__(self, study: Study, model: Refit) -> None:
        self.study, self.model = study, model
        self.missed = max(1.0, model.misfit) if study.campaign.training else 1.0
        self.joint = JointFit(study, model.parameters, model.effects, model)
        count = len(self.joint.start)
        self.weakest = np.full(count, criteria.FOUND_EFFECT_DEVIATIONS**-2.0)
        self.weakest[: len(self.joint.names)] = 1.0 - self.joint.pull
        information = np.diag(np.pad(self.joint.pull, (0, count - len(self.joint.pull))))
        if study.campaign.training:
            _, slopes = self.joint.stacked(self.joint.start, True)
            assert slopes is not None
            information = slopes.T @ slopes / self.missed**2
        self.information: Array = information + np.diag(self.weakest)

    @property
    def told(self) -> str:
        """Its effects, in words."""
        return " with ".join(told(*p.key) for p in self.model.effects) or "the model as given"

    def watching(self, campaign: Campaign) -> Forecast:
        """Return it for a campaign with further outputs, of which it knows no more than before."""
        other = copy(self)
        empty = campaign.with_records([], [])
        model = replace(self.model, starts=())
        other.joint = JointFit(replace(self.study, campaign=empty), model.parameters, model.effects, model)
        return other

    def seen(self, experiment: Experiment, slopes: bool = True) -> Seen:
        """Return what it foresees of an experiment."""
        run, rows = self.joint.foreseen(experiment, slopes)
        weights = experiment.weights
        values = np.concatenate([weights[name](run.seen[name]) for name in run.seen])
        if not (np.isfinite(values).all() and np.isfinite(rows).all()):
            raise SimulationError("what is foreseen grows beyond bounds")
        if slopes:
            offsets = nuisance_slopes(experiment, run.found)
            left = projected(np.column_stack([values, rows]), offsets)
            values, rows = left[:, 0], left[:, 1:]
        return Seen(run, values, rows)


@dataclass(frozen=True, eq=False)
class Planned:
    """An excitation that the rig bears, as an experiment, and what each model foresees of it."""

    candidate: Candidate
    experiment: Experiment
    seen: Sequence[Seen]


def planned(
    campaign: Campaign, candidate: Candidate, models: Sequence[Forecast], rate: float
) -> Planned | None:
    """Return an excitation, made smaller until no model sees a limit exceeded; None if that does not help."""
    limits = watched(campaign)
    for _ in range(criteria.DESIGN_SHRINKINGS):
        experiment = trial(campaign, candidate.drives, rate)
        try:
            if limits:
                share = max(taken(limits, model.seen(experiment, False).run) for model in models)
                if share > 1:
                    candidate = candidate.scaled(criteria.DESIGN_SHRINKING / share)
                    continue
            return Planned(candidate, experiment, [model.seen(experiment) for model in models])
        except SimulationError:
            return None
    return None


def known_after(model: Forecast, seen: Seen) -> Array:
    """Return the information of a model's parameters and effects once an experiment has been made."""
    return np.asarray(model.information + seen.slopes.T @ seen.slopes / model.missed**2)
