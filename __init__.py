"""inertance: acausal 1-D mechanics. Join elements at flanges, run the machine."""

from inertance.components import Accelerate as Accelerate
from inertance.components import BoucWen as BoucWen
from inertance.components import Compliant as Compliant
from inertance.components import CompliantWithSpeed as CompliantWithSpeed
from inertance.components import Component as Component
from inertance.components import ConstantForce as ConstantForce
from inertance.components import CoulombFriction as CoulombFriction
from inertance.components import CubicSpring as CubicSpring
from inertance.components import Damper as Damper
from inertance.components import Fixed as Fixed
from inertance.components import Force as Force
from inertance.components import Friction as Friction
from inertance.components import HardStop as HardStop
from inertance.components import InertanceError as InertanceError
from inertance.components import Inerter as Inerter
from inertance.components import InitialConditionError as InitialConditionError
from inertance.components import Mass as Mass
from inertance.components import MassWithStopAndFriction as MassWithStopAndFriction
from inertance.components import ModelError as ModelError
from inertance.components import Position as Position
from inertance.components import QuadraticDamper as QuadraticDamper
from inertance.components import RealInput as RealInput
from inertance.components import RealOutput as RealOutput
from inertance.components import Rod as Rod
from inertance.components import RotationalFlange as RotationalFlange
from inertance.components import Sampled as Sampled
from inertance.components import Shock as Shock
from inertance.components import SimulationError as SimulationError
from inertance.components import Speed as Speed
from inertance.components import Spring as Spring
from inertance.components import SpringDamper as SpringDamper
from inertance.components import StribeckFriction as StribeckFriction
from inertance.components import SupportFriction as SupportFriction
from inertance.components import TabulatedFriction as TabulatedFriction
from inertance.components import TranslationalFlange as TranslationalFlange
from inertance.components import TwoFlanges as TwoFlanges
from inertance.components import der as der
from inertance.components import impulse as impulse
from inertance.components import mode as mode
from inertance.components import option as option
from inertance.components import parameter as parameter
from inertance.components import variable as variable
from inertance.networks import DAE as DAE
from inertance.networks import Event as Event
from inertance.networks import Network as Network
from inertance.networks import Result as Result
from inertance.networks import TwoTerminal as TwoTerminal
from inertance.networks import parallel as parallel
from inertance.networks import series as series


def __getattr__(name: str) -> str:
    if name == "__version__":
        from importlib.metadata import version

        return version("inertance")
    raise AttributeError(f"module 'inertance' has no attribute '{name}'")
