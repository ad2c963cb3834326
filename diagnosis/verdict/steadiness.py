"""Whether effects are as strong throughout each record, as laws are that do not change with time."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ..criteria import UNSTEADY_SHARE
from ..effects.hypothesis import Hypothesis
from ..models.study import Study
from ..search.joint_fit import JointFit
from ..search.model_comparison import Refit
from ..search.record_start import projected


@dataclass(frozen=True)
class Unsteady:
    """An effect that would have to change by a share of itself from the beginning of each record to its end.

    Attributes:
        takes: share of the square of what is left that this would take away.
    """

    placed: Hypothesis
    change: float
    takes: float

    def __str__(self) -> str:
        way = "grow" if self.change > 0 else "fade"
        return (
            f"{self.placed.label} would have to {way} by {abs(self.change):.0%} from the beginning to the "
            f"end of each record, which takes {self.takes:.0%} off the square of what is left: what is "
            "missing may change with time, or be no such effect"
        )


def unsteady(study: Study, model: Refit) -> Iterator[Unsteady]:
    """Yield the effects of a model that its training records want to be weaker or stronger as time goes on.

    What changes with time by its own law, as friction that drifts, may do so in another way than it says.

    With r what a model misses in units of noise, J its slopes and g = sum(size * dr/dsize) of an effect, b of
    r = J*x + b*t*g is fitted by least squares, t going from -1 to 1 in each record: the change is 2*b.
    """
    joint = JointFit(study, model.parameters, model.effects, model)
    training = joint.campaign.training
    vector, begin = joint.start, len(joint.names)
    rows = [joint.linearise(vector, experiment, True) for experiment in training]
    counts = [len(study.campaign.outputs) * len(e.compared.time) for e in training]
    missed = np.concatenate([left[:count] for (left, _), count in zip(rows, counts, strict=True)])
    slopes = np.vstack([columns[:count] for (_, columns), count in zip(rows, counts, strict=True)])
    elapsed = np.concatenate(
        [
            np.tile(
                np.interp(e.compared.time, e.compared.time[[0, -1]], [-1.0, 1.0]), len(study.campaign.outputs)
            )
            for e in training
        ]
    )
    left = projected(missed, slopes)
    for placed in model.effects:
        sizes = np.array([not quantity.shape for quantity in placed.quantities])
        own = slice(begin, begin + len(sizes))
        begin = own.stop
        changing = projected(elapsed * (slopes[:, own] @ (vector[own] * sizes)), slopes)
        length = float(changing @ changing)
        if placed.effect.ages or not length:
            continue
        share = float(changing @ left) ** 2 / (length * float(left @ left))
        if share > UNSTEADY_SHARE:
            yield Unsteady(placed, 2 * float(changing @ left) / length, share)
