"""What stores, conducts, holds and measures heat."""

from ..language import Component, HeatPort, RealOutput, Stated, der, parameter, variable


class HeatCapacitor(Component):
    """A body of one temperature: C der(T) = port.Q_flow, from 293.15 K unless something fixes it.

    Source: MSL Thermal.HeatTransfer.Components.HeatCapacitor.
    """

    port = HeatPort("where heat flows in", free=True)
    C = parameter("J/K", "heat capacity", above=0)
    T = variable("K", "temperature", start=293.15, nominal=300.0)

    def equations(self) -> Stated:
        yield self.port.T == self.T
        yield self.C * der(self.T) == self.port.Q_flow


class ThermalConductor(Component):
    """What conducts heat and stores none: Q_flow = G (port_a.T - port_b.T).

    Source: MSL Thermal.HeatTransfer.Components.ThermalConductor.
    """

    port_a = HeatPort("one end")
    port_b = HeatPort("the other end")
    G = parameter("W/K", "thermal conductance", min=0)
    Q_flow = variable("W", "heat flow from port_a to port_b")

    def equations(self) -> Stated:
        yield self.Q_flow == self.G * (self.port_a.T - self.port_b.T)
        yield self.port_a.Q_flow == self.Q_flow
        yield self.port_b.Q_flow == -self.Q_flow


class FixedTemperature(Component):
    """What keeps its temperature, such as the air around: port.T = T.

    Source: MSL Thermal.HeatTransfer.Sources.FixedTemperature.
    """

    has_law = False
    port = HeatPort("where heat flows in")
    T = parameter("K", "temperature", above=0, default=293.15)

    def equations(self) -> Stated:
        yield self.port.T == self.T


class FixedHeatFlow(Component):
    """A constant heat flow into what it is joined to: port.Q_flow = -Q_flow.

    Source: MSL Thermal.HeatTransfer.Sources.FixedHeatFlow with alpha = 0.
    """

    has_law = False
    port = HeatPort("where heat flows out")
    Q_flow = parameter("W", "heat flow")

    def equations(self) -> Stated:
        yield self.port.Q_flow == -self.Q_flow


class TemperatureSensor(Component):
    """Temperature as a signal: T = port.T.

    Source: MSL Thermal.HeatTransfer.Sensors.TemperatureSensor.
    """

    has_law = False
    port = HeatPort("where it is measured")
    T = RealOutput("K", "temperature")

    def equations(self) -> Stated:
        yield self.T == self.port.T
        yield self.port.Q_flow == 0
