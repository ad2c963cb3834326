"""Lossy elements: what all that turn work into heat have in common."""

from .language import Component, Expression, HeatPort, Stated, dissipation, option, parameter


class Lossy(Component):
    """An element that turns work into heat: lossPower [W], which each one states.

    With `useHeatPort` that leaves through `heatPort`, heatPort.Q_flow = -lossPower; else it is gone. What
    a shock takes, in no time, is in the energy book alone.

    Source: MSL Thermal.HeatTransfer.Interfaces.PartialElementaryConditionalHeatPort.
    """

    useHeatPort = option(
        "whether its losses leave as heat through heatPort", default=False, choices=(False, True)
    )
    heatPort = HeatPort("where its losses leave as heat", when="useHeatPort")
    lossPower = dissipation(lambda self: self.lost)

    @property
    def lost(self) -> Expression:
        """What it loses."""
        raise NotImplementedError(f"{type(self).__name__} states no lossPower")

    def equations(self) -> Stated:
        if self.useHeatPort:
            yield self.heatPort.Q_flow == -self.lossPower


class Rubbing(Lossy):
    """A lossy element between two flanges that slide or turn; a subclass gives their relative `speed`."""

    @property
    def speed(self) -> Expression:
        """The relative speed of the flanges."""
        raise NotImplementedError


class AtTemperature(Lossy):
    """A lossy element whose law depends on its temperature: that of `heatPort` if it is used, else T.

    Source: MSL Thermal.HeatTransfer.Interfaces.PartialElementaryConditionalHeatPort.
    """

    T = parameter("K", "temperature if heatPort is not used", above=0, default=293.15)

    @property
    def temperature(self) -> Expression:
        """Temperature [K]."""
        return self.heatPort.T if self.useHeatPort else self.T
