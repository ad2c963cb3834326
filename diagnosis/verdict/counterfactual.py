"""Counterfactuals: how well models predict the machine after a change, and which ones that tells apart."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from typing import Any

import numpy as np

from ...base import Array
from ...components import InertanceError
from ...identification import Experiment
from ..effects.hypothesis import Hypothesis, told
from ..models.study import Study
from ..search.joint_fit import JointFit
from ..search.model_comparison import Refit, are_alike, clearness, is_clear, rms, stretches
from .gap import titled

Left = dict[str, Array] | str  # weighted residuals of a record by channel, or why it was not predicted


@dataclass(frozen=True)
class Counterfactual:
    """How well a channel of a record is predicted that was measured after a change of the machine.

    Attributes:
        record, channel: which.
        change: what had been changed, in words.
        refit, after: what the refitted model and the verdict's network miss, as NRMSE; None if not predicted.
        floor: noise, likewise.
        unit, size: of the signal about its mean, root mean square, in SI units.
        problem: why it was not predicted.
    """

    record: str
    channel: str
    change: str
    refit: float | None
    after: float | None
    floor: float
    unit: str
    size: float
    problem: str = ""

    @property
    def over_noise(self) -> float | None:
        """What the verdict's network misses, over the noise."""
        return None if self.after is None else self.after / self.floor

    def to_dict(self) -> dict[str, Any]:
        """Return it as plain values, as in the JSON file."""
        return {**asdict(self), "over_noise": self.over_noise}


@dataclass(frozen=True)
class Parted:
    """An effect that test runs cannot tell from the verdict's, and a counterfactual can.

    Attributes:
        kind, site: the effect.
        record: the record that tells it most.
        misses, verdict_misses: what both models miss of that record, in units of noise.
        standard_errors: by how many the verdict's network predicts better; see `clearness`.
    """

    kind: str
    site: str
    record: str
    misses: float
    verdict_misses: float
    standard_errors: float

    @property
    def told(self) -> str:
        """It in words."""
        return (
            f"{self.record} tells it from {told(self.kind, self.site)}, which misses {self.misses:.3g} times "
            f"the noise there, against {self.verdict_misses:.3g}"
        )

    def to_dict(self) -> dict[str, Any]:
        """Return it as plain values, as in the JSON file."""
        return asdict(self)


@dataclass(frozen=True, eq=False)
class Foretold:
    """The records of a changed machine as some models predict them.

    Attributes:
        study: the campaign that has the records.
        left: by model, what it leaves of each record.
    """

    study: Study
    left: dict[int, list[Left]] = field(default_factory=dict)

    def of(self, model: Refit) -> list[Left]:
        """Return what a model leaves of each record."""
        if id(model) not in self.left:
            self.left[id(model)] = _left(self.study, model)
        return self.left[id(model)]

    def compared(self, one: Refit, other: Refit) -> tuple[Refit, Refit] | None:
        """Return two models as the records judge them that both predict; None if there are none."""
        both = [
            n
            for n, pair in enumerate(zip(self.of(one), self.of(other), strict=True))
            if str not in map(type, pair)
        ]
        if not both:
            return None
        return self._judged(one, both), self._judged(other, both)

    def _judged(self, model: Refit, numbers: Sequence[int]) -> Refit:
        records = [self.study.campaign.changed[n] for n in numbers]
        left = [found for n in numbers if isinstance(found := self.of(model)[n], dict)]
        independent = sum(record.independent for record in records)
        blocks = stretches(records)
        return Refit(model.parameters, model.effects, [], left, 0.0, blocks, independent)


def _left(study: Study, model: Refit) -> list[Left]:
    """Return what a model leaves of each record of the machine after a change."""
    joint = JointFit(study, model.parameters, model.effects)
    found = list[Left]()
    for experiment in joint.campaign.changed:
        try:
            found.append(joint.predicted(experiment))
        except InertanceError as error:
            found.append(error.headline)
    return found


def told_apart(foretold: Foretold, alike: Sequence[Refit]) -> tuple[Refit, list[Refit], dict[int, float]]:
    """Return the best of models that test runs cannot tell apart, those as good, and how others are not.

    Another model than the first is best only where it is as clearly better as an effect must be. The
    clearness is that by which the best is better, by identity of the other model.
    """
    leader, *others = alike
    for other in others if foretold.study.campaign.changed else ():
        pair = foretold.compared(leader, other)
        if pair is not None and is_clear(*pair):
            leader = other
    left, parted = list[Refit](), dict[int, float]()
    for other in (model for model in alike if model is not leader):
        pair = foretold.compared(leader, other)
        clear = 0.0 if pair is None or are_alike(*pair) else clearness(pair[1], pair[0])
        if clear > 0:
            parted[id(other)] = clear
        else:
            left.append(other)
    return leader, left, parted


def parting(foretold: Foretold, best: Refit, other: Refit, placed: Hypothesis, clear: float) -> Parted:
    """Return how a model with another effect, `placed`, was told from the best one."""
    misfits = [
        (record, _misfit(record, one), _misfit(record, two))
        for record, one, two in zip(
            foretold.study.campaign.changed, foretold.of(best), foretold.of(other), strict=True
        )
        if isinstance(one, dict) and isinstance(two, dict)
    ]
    record, mine, its = max(misfits, key=lambda found: found[2] - found[1])
    return Parted(*placed.key, titled(record), its, mine, clear)


def _misfit(record: Experiment, left: Mapping[str, Array]) -> float:
    """Return what is left of a record over noise, of all its channels."""
    return float(np.sqrt(sum(float(r @ r) for r in left.values()) / record.independent))


def counterfactuals(foretold: Foretold, refit: Refit, after: Refit) -> Iterator[Counterfactual]:
    """Yield how well two models predict each channel of each record of the machine after a change."""
    campaign = foretold.study.campaign
    found = zip(campaign.changed, foretold.of(refit), foretold.of(after), strict=True)
    for record, *lefts in found:
        assert record.change is not None
        for name in campaign.outputs:
            values = record.counted(record.compared.values[name])
            size = float(values.std())
            missed = [
                None if isinstance(left, str) else rms([record.counted(record.sigma[name] * left[name])])
                for left in lefts
            ]
            shares = [None if one is None else one / (size or 1.0) for one in missed]
            yield Counterfactual(
                record=titled(record),
                channel=name,
                change=record.change.told(campaign.machine),
                refit=shares[0],
                after=shares[1],
                floor=record.weights[name].noise / (size or 1.0),
                unit=f"{campaign.measured[name].si}, NRMSE",
                size=size,
                problem="; ".join(dict.fromkeys(left for left in lefts if isinstance(left, str))),
            )
