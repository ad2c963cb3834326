"""inertance: acausal 1-D mechanics. Join elements at flanges, run the machine."""

from inertance.components import Accelerate as Accelerate
from inertance.components import AccelerationSensor as AccelerationSensor
from inertance.components import Backlash as Backlash
from inertance.components import BoucWen as BoucWen
from inertance.components import Brake as Brake
from inertance.components import Compliant as Compliant
from inertance.components import CompliantNutScrew as CompliantNutScrew
from inertance.components import CompliantWithSpeed as CompliantWithSpeed
from inertance.components import Component as Component
from inertance.components import ConstantForce as ConstantForce
from inertance.components import CoulombFriction as CoulombFriction
from inertance.components import CubicSpring as CubicSpring
from inertance.components import Damper as Damper
from inertance.components import DiskFlywheel as DiskFlywheel
from inertance.components import ElastoGap as ElastoGap
from inertance.components import Fixed as Fixed
from inertance.components import Flywheel as Flywheel
from inertance.components import Force as Force
from inertance.components import ForceSensor as ForceSensor
from inertance.components import Friction as Friction
from inertance.components import HardStop as HardStop
from inertance.components import IdealPlanetaryFlywheel as IdealPlanetaryFlywheel
from inertance.components import InertanceError as InertanceError
from inertance.components import Inerter as Inerter
from inertance.components import InitialConditionError as InitialConditionError
from inertance.components import LargeAngleLever as LargeAngleLever
from inertance.components import Lever as Lever
from inertance.components import Mass as Mass
from inertance.components import MassWithStopAndFriction as MassWithStopAndFriction
from inertance.components import ModelError as ModelError
from inertance.components import NutScrew as NutScrew
from inertance.components import Planet as Planet
from inertance.components import PlanetaryFlywheel as PlanetaryFlywheel
from inertance.components import Position as Position
from inertance.components import PositionSensor as PositionSensor
from inertance.components import QuadraticDamper as QuadraticDamper
from inertance.components import RackPinion as RackPinion
from inertance.components import RealInput as RealInput
from inertance.components import RealOutput as RealOutput
from inertance.components import RelativeAccelerationSensor as RelativeAccelerationSensor
from inertance.components import RelativePositionSensor as RelativePositionSensor
from inertance.components import RelativeSpeedSensor as RelativeSpeedSensor
from inertance.components import Rod as Rod
from inertance.components import RollingWheel as RollingWheel
from inertance.components import RotationalFlange as RotationalFlange
from inertance.components import Sampled as Sampled
from inertance.components import Shock as Shock
from inertance.components import SimulationError as SimulationError
from inertance.components import Speed as Speed
from inertance.components import SpeedSensor as SpeedSensor
from inertance.components import Spring as Spring
from inertance.components import SpringDamper as SpringDamper
from inertance.components import StribeckFriction as StribeckFriction
from inertance.components import SupportFriction as SupportFriction
from inertance.components import TabulatedFriction as TabulatedFriction
from inertance.components import TranslationalFlange as TranslationalFlange
from inertance.components import Transmission as Transmission
from inertance.components import TwoFlanges as TwoFlanges
from inertance.components import der as der
from inertance.components import impulse as impulse
from inertance.components import mode as mode
from inertance.components import option as option
from inertance.components import parameter as parameter
from inertance.components import rotational as rotational
from inertance.components import signals as signals
from inertance.components import variable as variable
from inertance.networks import DAE as DAE
from inertance.networks import BallScrewInerter as BallScrewInerter
from inertance.networks import Event as Event
from inertance.networks import Network as Network
from inertance.networks import PlanetaryFlywheelInerter as PlanetaryFlywheelInerter
from inertance.networks import PlanetaryGeometry as PlanetaryGeometry
from inertance.networks import RackPinionInerter as RackPinionInerter
from inertance.networks import RandomDisplacement as RandomDisplacement
from inertance.networks import Result as Result
from inertance.networks import Sinusoid as Sinusoid
from inertance.networks import TwoTerminal as TwoTerminal
from inertance.networks import disk_mass as disk_mass
from inertance.networks import equivalent_inertia as equivalent_inertia
from inertance.networks import ge_wang as ge_wang
from inertance.networks import inerter_rig as inerter_rig
from inertance.networks import load_table as load_table
from inertance.networks import parallel as parallel
from inertance.networks import rig_response as rig_response
from inertance.networks import run_on_rig as run_on_rig
from inertance.networks import screw_inertance as screw_inertance
from inertance.networks import series as series


def __getattr__(name: str) -> str:
    if name == "__version__":
        from importlib.metadata import version

        return version("inertance")
    raise AttributeError(f"module 'inertance' has no attribute '{name}'")
