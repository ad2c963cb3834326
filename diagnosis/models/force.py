"""A force at a site that a run of the model has, as one more input."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from ...base import Array
from ...identification import Experiment
from ...identification.records.record import Channel

FORCE = "missing force"  # the channel by which it acts


@dataclass(frozen=True, eq=False)
class Force:
    """A force at instants of a run, straight between them."""

    t: Array
    values: Array

    def at(self, t: Array) -> Array:
        """Return it at instants."""
        return np.interp(t, self.t, self.values)


def pushed(
    experiment: Experiment, channels: Mapping[str, Channel], number: int, force: Force
) -> tuple[Experiment, dict[str, Channel]]:
    """Return an experiment and its channels with a force at one of the sites that are probed."""
    record = experiment.record
    record = replace(record, values={**record.values, FORCE: force.at(record.time)})
    channel = Channel(push_of(number), True, "", "", "linear")
    return replace(experiment, record=record), {**channels, FORCE: channel}


def push_of(number: int) -> str:
    """Return the input of the force at a site that is probed."""
    return f"push_{number}.u"
