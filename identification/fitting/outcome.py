"""`Fit`: what was estimated, how well it is known, and how far model and measurement still part."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ...base import Array, check_output, write_text
from ...components import Component, SimulationError
from ...networks import Network
from ..campaign.campaign import Campaign
from ..campaign.experiment import Experiment
from ..campaign.stages import Stage
from .campaign_model import Accuracy, CampaignModel
from .doubts import doubts, over_noise
from .problem import Optimum, Problem
from .residual_block import Block
from .suspects import Suspect
from .uncertainty import Uncertainty

if TYPE_CHECKING:
    from .fit import Start

STARTS = 4


@dataclass(frozen=True, eq=False)
class FittedStage:
    """One stage of a fit and where it ended."""

    stage: Stage
    optimum: Optimum
    uncertainty: Uncertainty
    blocks: list[Block]


@dataclass(frozen=True, eq=False)
class Comparison:
    """Measured and predicted channels of one record, in SI units.

    Attributes:
        experiment: the record.
        tested: whether it was left out of the fit.
        before: what the model predicts with its own parameters.
        after: what it predicts with the fitted ones.
        problem: why it could not be simulated.
    """

    experiment: Experiment
    tested: bool
    before: dict[str, Array]
    after: dict[str, Array]
    problem: str = ""

    def rms(self, channel: str, predicted: Mapping[str, Array]) -> float:
        """Return the root mean square of measured less predicted."""
        if channel not in predicted:
            return np.nan
        difference = self.experiment.record.values[channel] - predicted[channel]
        return float(np.sqrt(np.mean(difference**2)))

    def size(self, channel: str) -> float:
        """Return the standard deviation of what was measured."""
        return float(self.experiment.record.values[channel].std())


class FitInterruptedError(KeyboardInterrupt):
    """Ctrl-C during a fit; `fit` holds the best until then."""

    def __init__(self, message: str, fit: Fit) -> None:
        self.fit = fit
        super().__init__(message)


@dataclass(frozen=True, eq=False)
class Fit:
    """The outcome of `fit`.

    Attributes:
        campaign: what was fitted.
        values: parameters by name.
        stages: the stages and where each ended.
        comparisons: measured and predicted, for every record.
        starts: where each start of a multi-start led.
        suspects: channels that would explain a misfit in another unit, with another sign or exchanged.
        interrupted: whether Ctrl-C ended it before its end; `values` are the best until then.
    """

    campaign: Campaign
    values: dict[str, float]
    stages: list[FittedStage]
    comparisons: list[Comparison]
    starts: list[Start] = field(default_factory=list)
    suspects: list[Suspect] = field(default_factory=list)
    interrupted: bool = False

    @property
    def network(self) -> Network:
        """A copy of the network with the fitted parameters in it."""
        network = self.campaign.network.clone()
        for path, value in self.values.items():
            owner, _, name = path.rpartition(".")
            component: Component = network
            for part in owner.split(".") if owner else ():
                component = component._parts[part]
            component._set(name, value)
        return network

    @property
    def errors(self) -> dict[str, float]:
        """Standard errors by name, of the stage that fitted the parameter last, given the others' values."""
        return {name: e for done in self.stages for name, e in done.uncertainty.errors.items()}

    @property
    def warnings(self) -> list[str]:
        """What one should know before using the values."""
        told = list(doubts(self))
        told += [warning for done in self.stages for warning in done.uncertainty.warnings]
        if self.interrupted:
            told.insert(0, "the fit was interrupted before its end; these are the best values until then")
        for number, done in enumerate(self.stages, start=1):
            if done.optimum.ended == "interrupted":
                told.append(f"stage {number} was interrupted; the best values until then are kept")
            elif done.optimum.ended != "converged":
                told.append(f"stage {number} did not converge ({done.optimum.ended})")
        told += [f"{c.experiment.name}: {c.problem}" for c in self.comparisons if c.problem]
        failed = [start for start in self.starts if start.problem]
        if failed:
            told.append(
                f"{len(failed)} of {len(self.starts)} starts failed, the first with: {failed[0].problem}"
            )
        return told

    def table(self) -> str:
        """Return parameters with standard errors, fits per channel and warnings as text."""
        from .fit_report import table

        return table(self)

    def to_dict(self) -> dict[str, Any]:
        """Return everything but the signals as plain numbers and texts."""
        priors, units = self.campaign.priors, self.campaign.dae.unit
        return {
            "parameters": {
                name: {
                    "value": value, "error": self.errors.get(name), "start": priors[name].center,
                    "unit": units(name), "prior_deviations": priors[name].moved(value),
                }
                for name, value in self.values.items()
            },
            "correlation": [
                {"parameters": list(done.optimum.values), "matrix": done.uncertainty.correlation.tolist()}
                for done in self.stages
            ],
            "noise": {
                name: {"sigma": floor.sigma, "source": floor.source}
                for name, floor in self.campaign.floors.items()
            },
            "records": [
                {
                    "record": c.experiment.name, "tested": c.tested, "channel": name,
                    "before": c.rms(name, c.before), "after": c.rms(name, c.after), "size": c.size(name),
                    "over_noise": over_noise(self, c, name),
                }
                for c in self.comparisons
                for name in self.campaign.outputs
            ],
            "suspects": [
                {"channels": list(s.channels), "factor": s.factor, "told": s.told} for s in self.suspects
            ],
            "notes": self.campaign.notes,
            "interrupted": self.interrupted,
            "warnings": self.warnings,
        }  # fmt: skip

    def to_json(self, path: str | Path) -> Path:
        """Write `to_dict` to a file and return its path."""
        check_output(path, [".json"])
        told = json.dumps(self.to_dict(), indent=2, default=float, allow_nan=True)
        return write_text(path, told.replace("NaN", "null"))

    def plot(self, channel: str | None = None) -> Any:
        """Return a matplotlib figure: measured and predicted, and what is left, for every record."""
        from .fit_report import plot

        return plot(self, channel or self.campaign.outputs[0])


def compared(
    campaign: Campaign,
    bench: CampaignModel,
    values: Mapping[str, float],
    stages: Sequence[FittedStage],
    accuracy: Accuracy,
) -> list[Comparison]:
    """Predict every record with the model's own and with the fitted parameters.

    Starts and offsets are those of the fit; for test records they are estimated, nothing else.
    """
    fitted = {
        block.stand.experiment: (block, nuisances)
        for done in stages
        for block, nuisances in zip(done.blocks, done.optimum.nuisances, strict=True)
    }
    testing = CampaignModel(campaign.dae, campaign.measured, campaign.testing)
    sigma = campaign.sigma
    found = []
    for number, stand in enumerate([*bench.stands, *testing.stands]):
        block = Block(stand, campaign.outputs, sigma, None)
        known = fitted.get(stand.experiment)
        found.append(_compared(campaign, block, values, known, accuracy, number >= len(campaign.training)))
    return found


def _compared(
    campaign: Campaign,
    block: Block,
    values: Mapping[str, float],
    known: tuple[Block, Array] | None,
    accuracy: Accuracy,
    tested: bool,
) -> Comparison:
    predicted: list[dict[str, Array]] = [{}, {}]
    problem = ""
    try:
        if known is not None and known[0].offsets == block.offsets:
            block.center, block.width, nuisances = known[0].center, known[0].width, known[1]
        else:
            block.prepare(values, accuracy)
            best = Problem([block], {}, [], values, accuracy).minimise({}, most=STARTS)
            if best.ended == "interrupted":
                raise KeyboardInterrupt
            nuisances = best.nuisances[0]
        for place, parameters in ((1, values), (0, campaign.start)):
            predicted[place] = _predicted(block, parameters, nuisances, accuracy)
    except SimulationError as error:
        problem = str(error)
    return Comparison(block.stand.experiment, tested, predicted[0], predicted[1], problem)


def _predicted(
    block: Block, parameters: Mapping[str, float], nuisances: Array, accuracy: Accuracy
) -> dict[str, Array]:
    predictions = block.linearise(parameters, nuisances, accuracy, slopes=False).predictions
    measured = block.record.values
    return {name: measured[name] - block.residual(name, predictions, nuisances) for name in block.channels}
