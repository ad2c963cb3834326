"""`Design`: an experiment to make, and what it is expected to tell."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ...base import Array, InertanceError, check_output, unit_for, write_text
from ...identification import Campaign
from .forecast import Forecast, Planned
from .separation import Odds

if TYPE_CHECKING:
    from matplotlib.figure import Figure


class InseparableError(InertanceError):
    """No experiment within the limits tells models apart; the message says what else to measure."""


@dataclass(frozen=True)
class Known:
    """How well a parameter is known, as standard deviations in SI units, before and after the experiment."""

    parameter: str
    value: float
    unit: str
    before: float
    after: float

    def to_dict(self) -> dict[str, str | float]:
        """Return it as plain values, as in the JSON file."""
        return asdict(self)


@dataclass(frozen=True, eq=False)
class Design:
    """An experiment to make: it begins and ends at rest, and keeps the limits of the campaign.

    Attributes:
        purpose: "hypotheses" to tell apart, or "parameters" to identify.
        told: what is played, in words.
        time: its instants [s].
        inputs: by channel what is played, in SI units.
        odds: for hypotheses, what is expected of each pair.
        parameters: for parameters, how well each will be known.
        notes: what it will not tell.
        campaign: that it was designed for.
        made, models: the experiment, and what foresees it.
    """

    purpose: str
    told: str
    time: Array
    inputs: Mapping[str, Array]
    odds: tuple[Odds, ...] = ()
    parameters: tuple[Known, ...] = ()
    notes: tuple[str, ...] = ()
    campaign: Campaign = field(kw_only=True, repr=False)
    made: Planned = field(kw_only=True, repr=False)
    models: tuple[Forecast, ...] = field(kw_only=True, repr=False)

    @property
    def rate(self) -> float:
        """Samples a second [Hz]."""
        return self.made.experiment.record.rate

    def save(self, path: str | Path) -> Path:
        """Write what is to be played as a table (.csv), in the units of the campaign."""
        check_output(path, [".csv"])
        channels = self.campaign.measured
        units = {name: unit_for(channels[name].unit, channels[name].si) for name in self.inputs}
        columns = [self.time, *(units[name].from_si(values) for name, values in self.inputs.items())]
        header = ["time [s]", *(f"{name} [{channels[name].unit or '1'}]" for name in self.inputs)]
        rows = (",".join(f"{value:.9g}" for value in row) for row in np.column_stack(columns))
        return write_text(path, "\n".join([",".join(header), *rows]) + "\n")

    def to_dict(self) -> dict[str, Any]:
        """Return it as plain values, as in the JSON file."""
        return {
            "purpose": self.purpose,
            "experiment": self.told,
            "duration": float(self.time[-1]),
            "rate": self.rate,
            "inputs": list(self.inputs),
            "odds": [pair.to_dict() for pair in self.odds],
            "parameters": [known.to_dict() for known in self.parameters],
            "notes": list(self.notes),
        }

    def to_json(self, path: str | Path) -> Path:
        """Write what is expected of it."""
        check_output(path, [".json"])
        return write_text(path, json.dumps(self.to_dict(), indent=1) + "\n")

    def plot(self, path: str | Path | None = None) -> Figure:
        """Draw what is played, what each model foresees, and how far apart they are in units of noise."""
        from .pictures import drawn

        return drawn(self, path)


def played(campaign: Campaign, made: Planned) -> dict[str, Array]:
    """Return what is played on each input that moves, in SI units."""
    return {
        name: made.experiment.record.values[name] for name in campaign.inputs if name in made.candidate.drives
    }
