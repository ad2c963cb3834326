"""How well records tell the values of effects, by the slopes of the fit."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ..criteria import KNOWN_STANDARD_DEVIATIONS
from ..models.study import Study
from ..search.joint_fit import JointFit
from ..search.model_comparison import Refit
from ..search.record_start import projected


def unresolved(study: Study, best: Refit) -> Iterator[str]:
    """Yield quantities of effects whose value the training records do not tell.

    The standard deviation of one is sigma/|g|, g what its slope has that no other quantity or parameter does,
    in units of noise, and sigma the misfit over the noise, as errors of the model count as well.
    """
    if not best.effects:
        return
    joint = JointFit(study, best.parameters, best.effects, best)
    _, slopes = joint.stacked(joint.start, True)
    assert slopes is not None
    column = len(joint.names)
    for placed, sizes in zip(best.effects, joint.sizes, strict=True):
        units = placed.units(study.campaign)
        for (name, value), size in zip(placed.values.items(), sizes, strict=True):
            own = projected(slopes[:, column], np.delete(slopes, column, axis=1))
            known = float(np.linalg.norm(own)) / max(1.0, best.misfit)
            column += 1
            if known < KNOWN_STANDARD_DEVIATIONS:
                told, sd = f"{placed.name}.{name} = {value:.4g} {units[name]}", size / max(known, 1e-300)
                yield f"{told} has a standard deviation of {sd:.2g}: these records do not tell its value"
