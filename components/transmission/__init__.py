"""Elements between turning and sliding, and the flywheels they drive."""

from .flywheels import DiskFlywheel as DiskFlywheel
from .flywheels import Flywheel as Flywheel
from .flywheels import IdealPlanetaryFlywheel as IdealPlanetaryFlywheel
from .ideal import NutScrew as NutScrew
from .ideal import RackPinion as RackPinion
from .ideal import RollingWheel as RollingWheel
from .ideal import Transmission as Transmission
from .planets import Planet as Planet
from .planets import PlanetaryFlywheel as PlanetaryFlywheel
from .planets import PlanetGear as PlanetGear
from .screw import CompliantNutScrew as CompliantNutScrew
