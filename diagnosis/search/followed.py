"""Models that follow records but for stretches in which they are lost: fitted to what they follow."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...base import Array, Flags
from ...components import InertanceError
from ...identification import Experiment
from .. import criteria
from ..effects.plausibility import refused
from ..models.study import Study
from .joint_fit import JointFit
from .model_comparison import Refit, rms, stretches


def fitted_to_followed(study: Study, model: Refit) -> Refit:
    """Return a model fitted to what it follows of the training records; itself if it follows no more so.

    Where a part may come to rest in one of several places, a run falls to another side than the machine did
    at some instant. What it misses until it comes back pulls all values from where they are right, and no
    slope tells of the instant. Values that follow the other stretches are right: those are fitted in which
    least is missed, half of all at least, until no more are followed. One that leaves more than noise of
    these is taken if it misses less of all.

    Source: P. J. Rousseeuw, Least Median of Squares Regression, Journal of the American Statistical
    Association 79 (1984) 871-880, whose trimmed squares are here those of stretches.
    """
    best, missed = model, _by_stretches(study, model)
    while not study.late():
        most = max(criteria.LOST_MISFIT, float(np.median(np.concatenate(missed))))
        if max(map(np.max, missed)) <= most:
            break
        study.tell(f"fitting {model.labels[-1]} to what it follows")
        found = _fitted(study, best, [stretch <= most for stretch in missed])
        now = _by_stretches(study, found) if found else missed
        if found is None or _squares(now, most) > criteria.FOLLOWED_DROP_RATIO * _squares(missed, most):
            break
        best, missed = found, now
    follows = float(np.median(np.concatenate(missed))) <= criteria.COLOURED_MISFIT
    return best if follows or best.cost < model.cost else model


def _by_stretches(study: Study, model: Refit) -> list[Array]:
    """Return what a model misses of stretches of each training record, where that is most [noise]."""
    counts = stretches(study.campaign.training)
    return [
        np.max([[rms([part]) for part in np.array_split(r, count)] for r in left.values()], axis=0)
        for left, count in zip(model.train, counts, strict=True)
    ]


def _squares(missed: list[Array], most: float) -> float:
    """Return the sum of squares that is missed, where a model is lost as if it missed just so much."""
    return float(np.sum(np.minimum(np.concatenate(missed), most) ** 2))


def _fitted(study: Study, model: Refit, followed: list[Flags]) -> Refit | None:
    """Return a model fitted to some stretches; None if it cannot be, or if no machine is so."""
    records = zip(study.campaign.training, followed, strict=True)
    known = [n for n, stretch in enumerate(followed) if stretch.any()]
    omitting = [_without(experiment, stretch) for experiment, stretch in records if stretch.any()]
    part = replace(study, campaign=study.campaign.with_records(omitting))
    after = range(len(followed), len(model.starts))
    near = replace(model, starts=[model.starts[n] for n in (*known, *after)])
    try:
        alone = JointFit(part, model.parameters, model.effects, near).fitted()
        joint = JointFit(study, alone.parameters, alone.effects, model)
        found = joint.seen(joint.start)
    except InertanceError:
        return None
    return None if refused(found.effects[-1], study.campaign) else found


def _without(experiment: Experiment, followed: Flags) -> Experiment:
    """Return a record of which only some stretches are compared."""
    parts = np.array_split(np.zeros(len(experiment.compared.time), dtype=bool), len(followed))
    lost = np.concatenate([part | (not kept) for part, kept in zip(parts, followed, strict=True)])
    return experiment.omitting(lost)
