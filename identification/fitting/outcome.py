"""`Fit`: what was estimated, how well it is known, and how far model and measurement still part."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from operator import attrgetter
from pathlib import Path
from typing import Any

import numpy as np

from ...base import Array, check_output, write_text
from ...networks import Network
from ..campaign.campaign import Campaign
from ..campaign.experiment import Experiment
from ..campaign.stages import Stage
from .intervals import Interval
from .problem import FitProblem, Optimum
from .suspects import Suspect
from .uncertainty import Uncertainty


@dataclass(frozen=True)
class FittedStart:
    """One start of a multi-start: its values, and where it led or why it failed."""

    values: dict[str, float]
    fitted: dict[str, float]
    cost: float
    problem: str = ""


@dataclass(frozen=True, eq=False)
class FittedStage:
    """One stage of a fit and where it ended."""

    stage: Stage
    problem: FitProblem
    optimum: Optimum
    uncertainty: Uncertainty


@dataclass(frozen=True, eq=False)
class Comparison:
    """Measured and predicted channels of one record, in SI units.

    Attributes:
        experiment: the record.
        tested: whether it was left out of the fit.
        before: what the model predicts with its own parameters.
        after: what it predicts with the fitted ones.
        own, own_errors: values of parameters that the record has of its own, and their standard errors.
        problem: why it could not be simulated.
    """

    experiment: Experiment
    tested: bool
    before: dict[str, Array]
    after: dict[str, Array]
    problem: str = ""
    own: Mapping[str, float] = field(default_factory=dict)
    own_errors: Mapping[str, float] = field(default_factory=dict)

    @property
    def kind(self) -> str:
        """Whether it was fitted, a test, or of the machine after a change: train, test or counterfactual."""
        if self.experiment.change is not None:
            return "counterfactual"
        return "test" if self.tested else "train"

    def residual(self, channel: str, predicted: Mapping[str, Array]) -> Array:
        """Return measured less predicted."""
        return self.experiment.record.values[channel] - predicted[channel]

    def rms(self, channel: str, predicted: Mapping[str, Array]) -> float:
        """Return the root mean square of measured less predicted; NaN where nothing could be predicted."""
        if channel not in predicted:
            return np.nan
        return float(np.sqrt(np.mean(self.residual(channel, predicted) ** 2)))

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
        intervals: by parameter, how far it may go while the others make up for it, if that was asked for.
        interrupted: whether Ctrl-C ended it before its end; `values` are the best until then.
    """

    campaign: Campaign
    values: dict[str, float]
    stages: list[FittedStage]
    comparisons: list[Comparison] = field(default_factory=list)
    starts: list[FittedStart] = field(default_factory=list)
    suspects: list[Suspect] = field(default_factory=list)
    intervals: dict[str, Interval] = field(default_factory=dict)
    interrupted: bool = False

    @property
    def network(self) -> Network:
        """A copy of the network with the fitted parameters in it."""
        network = self.campaign.network.clone()
        for path, value in self.values.items():
            owner, _, name = path.rpartition(".")
            setattr(attrgetter(owner)(network) if owner else network, name, value)
        return network

    @property
    def errors(self) -> dict[str, float]:
        """Standard errors by name, of the stage that fitted the parameter last, given the others' values."""
        return {name: e for done in self.stages for name, e in done.uncertainty.errors.items()}

    @property
    def warnings(self) -> list[str]:
        """What one should know before using the values."""
        from .doubts import warnings

        return list(warnings(self))

    def table(self) -> str:
        """Return parameters with standard errors, fits per channel and warnings as text."""
        from .fit_report import table

        return table(self)

    def _repr_html_(self) -> str:
        from .fit_report import html

        return html(self)

    def to_dict(self) -> dict[str, Any]:
        """Return everything but the signals as plain numbers and texts."""
        from .fit_report import as_dict

        return as_dict(self)

    def to_json(self, path: str | Path) -> Path:
        """Write `to_dict` to a file and return its path."""
        check_output(path, [".json"])
        told = json.dumps(self.to_dict(), indent=2, default=float, allow_nan=True)
        return write_text(path, told.replace("NaN", "null"))

    def plot(self, channel: str | None = None) -> Any:
        """Return a matplotlib figure: measured and predicted, and what is left, for every record."""
        from .fit_report import plot

        return plot(self, channel or self.campaign.outputs[0])
