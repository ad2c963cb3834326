"""Elements that conduct and store heat."""

# Made by docs/make_stubs.py from the classes; do not edit.

from typing import Any

from ..language import Component, Number, ParameterValue

class FixedHeatFlow(Component):
    """A constant heat flow into what it is joined to: port.Q_flow = -Q_flow.

    Source: MSL Thermal.HeatTransfer.Sources.FixedHeatFlow with alpha = 0.

    Args:
        Q_flow: heat flow [W].
    """

    port: Any
    """where heat flows out"""
    Q_flow: Any
    """heat flow [W]"""
    def __init__(
        self,
        *,
        Q_flow: ParameterValue,
    ) -> None: ...

class FixedTemperature(Component):
    """What keeps its temperature, such as the air around: port.T = T.

    Source: MSL Thermal.HeatTransfer.Sources.FixedTemperature.

    Args:
        T: temperature [K], above 0.
    """

    port: Any
    """where heat flows in"""
    T: Any
    """temperature [K], above 0"""
    def __init__(
        self,
        *,
        T: ParameterValue = 293.15,
    ) -> None: ...

class HeatCapacitor(Component):
    """A body of one temperature: C der(T) = port.Q_flow, from 293.15 K unless something fixes it.

    Source: MSL Thermal.HeatTransfer.Components.HeatCapacitor.

    Args:
        C: heat capacity [J/K], above 0.
        T: temperature [K], fixed start value.
    """

    port: Any
    """where heat flows in"""
    C: Any
    """heat capacity [J/K], above 0"""
    T: Any
    """temperature [K], fixed start value"""
    def __init__(
        self,
        *,
        C: ParameterValue,
        T: Number = ...,
    ) -> None: ...

class TemperatureSensor(Component):
    """Temperature as a signal: T = port.T.

    Source: MSL Thermal.HeatTransfer.Sensors.TemperatureSensor.
    """

    port: Any
    """where it is measured"""
    T: Any
    """temperature [K]"""
    def __init__(self) -> None: ...

class ThermalConductor(Component):
    """What conducts heat and stores none: Q_flow = G (port_a.T - port_b.T).

    Source: MSL Thermal.HeatTransfer.Components.ThermalConductor.

    Args:
        G: thermal conductance [W/K], at least 0.
        Q_flow: heat flow from port_a to port_b [W], fixed start value.
    """

    port_a: Any
    """one end"""
    port_b: Any
    """the other end"""
    G: Any
    """thermal conductance [W/K], at least 0"""
    Q_flow: Any
    """heat flow from port_a to port_b [W], fixed start value"""
    def __init__(
        self,
        *,
        G: ParameterValue,
        Q_flow: Number = ...,
    ) -> None: ...
