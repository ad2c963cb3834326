"""`Channel`: a column of the data and the quantity of the network that it measures."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True)
class Channel:
    """A column of the data and the quantity of the network that it measures.

    Args:
        path: full name of the quantity.
        driven: whether it is an input of the network; an output otherwise.
        unit: of the column.
        si: unit of the quantity in the network.
        interpolation: of an input between its samples, as of `Sampled`.
    """

    path: str
    driven: bool
    unit: str
    si: str
    interpolation: str = "cubic"


def outputs_of(channels: Mapping[str, Channel]) -> list[str]:
    """Return the channels that the network predicts."""
    return [name for name, channel in channels.items() if not channel.driven]
