"""`Gap`: how far model and measurement part in a channel, over noise, over the signal, and over repeats."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ...base import Array
from ...identification import Campaign, Experiment
from ..models.study import Study
from ..search.model_comparison import Refit, rms


@dataclass(frozen=True)
class Gap:
    """Misfit of a channel on the test runs, as NRMSE: nominal, refitted, with the effect, and of noise.

    NRMSE is the root mean square of what is missed, as a share of that of the signal about its mean.

    Attributes:
        size: root mean square of the signal about its mean, in SI units.
        records: by name of a test run, the misfit with the effect as a share of its signal.
        repeatable: share of the square of what is left that comes back in a repeat of the run, as errors of
            the model do and noise does not; None where no run is a `repeat_of` another.
    """

    nominal: float
    refit: float
    after: float
    floor: float
    unit: str
    size: float
    records: Mapping[str, float] = field(default_factory=dict)
    repeatable: float | None = None

    @property
    def over_noise(self) -> float:
        """What is left, over the noise."""
        return self.after / self.floor

    @property
    def left(self) -> str:
        """What is left, in words."""
        spread = [*self.records.values()]
        told = f"{100 * self.after:.2g}% of the signal"
        if len(spread) > 1:
            told += f" ({100 * min(spread):.2g} to {100 * max(spread):.2g}% by record)"
        told += f", {self.over_noise:.2g} times the noise"
        if self.repeatable is not None:
            told += f"; {self.repeatable:.0%} of its square comes back in a repeat"
        return told

    def to_dict(self) -> dict[str, Any]:
        """Return it as plain values, as in the JSON file."""
        return {**vars(self), "records": dict(self.records), "over_noise": self.over_noise}


def gaps(study: Study, nominal: Refit, refit: Refit, after: Refit) -> dict[str, Gap]:
    """Return the gap of each output channel, of the model as given, refitted, and with effects."""
    campaign, found = study.campaign, {}
    judged = "test runs" if campaign.testing else "training runs"
    for name in campaign.outputs:
        size = rms([_moving(e, name) for e in study.judged])
        whole = size or 1.0
        missed = [rms(model.counted(study.judged, name)) / whole for model in (nominal, refit, after)]
        noise = rms([np.array([e.weights[name].noise for e in study.judged])])
        found[name] = Gap(
            nominal=missed[0],
            refit=missed[1],
            after=missed[2],
            floor=noise / whole,
            unit=f"{campaign.measured[name].si}, NRMSE of the {judged}",
            size=size,
            records=dict(_by_record(study.judged, after, name)),
            repeatable=_repeatable(campaign, after, name),
        )
    return found


def titled(experiment: Experiment) -> str:
    """Return the name of a record, with its window if it has one."""
    begin, end = experiment.window or (0.0, 0.0)
    return f"{experiment.name}, {begin:g} to {end:g} s" if experiment.window else experiment.name


def _moving(experiment: Experiment, channel: str) -> Array:
    values = experiment.counted(experiment.compared.values[channel])
    return np.asarray(values - values.mean())


def _by_record(experiments: Sequence[Experiment], model: Refit, channel: str) -> Iterator[tuple[str, float]]:
    for experiment, missed in zip(experiments, model.counted(experiments, channel), strict=True):
        size = rms([_moving(experiment, channel)])
        if size:
            yield titled(experiment), rms([missed]) / size


def _repeatable(campaign: Campaign, model: Refit, channel: str) -> float | None:
    """Return how alike residuals are in runs that repeat each other: their products over their squares."""
    missed = [record[channel] for record in (*model.train, *model.test)]
    numbers = {str(e.source): n for n, e in enumerate(campaign.experiments)}
    products = squares = 0.0
    for one, experiment in zip(missed, campaign.experiments, strict=True):
        if experiment.repeat_of in numbers:
            other = missed[numbers[experiment.repeat_of]]
            count = min(len(one), len(other))
            products += float(one[:count] @ other[:count])
            squares += 0.5 * float(one[:count] @ one[:count] + other[:count] @ other[:count])
    return float(np.clip(products / squares, 0.0, 1.0)) if squares else None
