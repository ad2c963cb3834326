"""Ready-made machines."""

from .inerters import BallScrewInerter as BallScrewInerter
from .inerters import PlanetaryFlywheelInerter as PlanetaryFlywheelInerter
from .inerters import RackPinionInerter as RackPinionInerter
