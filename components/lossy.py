"""Lossy elements: what all that turn work into heat have in common."""

from .language import Component, dissipation


class Lossy(Component):
    """An element that turns work into heat: lossPower [W], which each one states.

    Source: MSL Thermal.HeatTransfer.Interfaces.PartialElementaryConditionalHeatPort.
    """

    lossPower = dissipation(lambda self: self.lost)

    @property
    def lost(self) -> object:
        """What it loses."""
        raise NotImplementedError(f"{type(self).__name__} states no lossPower")
