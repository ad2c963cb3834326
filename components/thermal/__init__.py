"""Elements that conduct and store heat."""

from .elements import FixedHeatFlow as FixedHeatFlow
from .elements import FixedTemperature as FixedTemperature
from .elements import HeatCapacitor as HeatCapacitor
from .elements import TemperatureSensor as TemperatureSensor
from .elements import ThermalConductor as ThermalConductor
