"""Elements between turning and sliding, and the flywheels they drive."""

from .conversions import CompliantNutScrew as CompliantNutScrew
from .conversions import NutScrew as NutScrew
from .conversions import RackPinion as RackPinion
from .conversions import RollingWheel as RollingWheel
from .conversions import Transmission as Transmission
from .cranks import Cam as Cam
from .cranks import SliderCrank as SliderCrank
from .flywheels import DiskFlywheel as DiskFlywheel
from .flywheels import Flywheel as Flywheel
from .flywheels import IdealPlanetaryFlywheel as IdealPlanetaryFlywheel
from .flywheels import Planet as Planet
from .flywheels import PlanetaryFlywheel as PlanetaryFlywheel
from .gyroscopes import Gyroscope as Gyroscope
from .screws import LeadScrew as LeadScrew
from .tyres import Tyre as Tyre
from .vehicle import Vehicle as Vehicle
