"""Elements that slide."""

from .bases import Compliant as Compliant
from .bases import CompliantWithSpeed as CompliantWithSpeed
from .bases import TwoFlanges as TwoFlanges
from .compliances import BoucWen as BoucWen
from .compliances import CubicSpring as CubicSpring
from .compliances import Damper as Damper
from .compliances import Inerter as Inerter
from .compliances import QuadraticDamper as QuadraticDamper
from .compliances import Spring as Spring
from .compliances import SpringDamper as SpringDamper
from .friction import CoulombFriction as CoulombFriction
from .friction import Friction as Friction
from .friction import StribeckFriction as StribeckFriction
from .friction import SupportFriction as SupportFriction
from .friction import TabulatedFriction as TabulatedFriction
from .masses import Fixed as Fixed
from .masses import Mass as Mass
from .masses import Rod as Rod
from .sources import Accelerate as Accelerate
from .sources import ConstantForce as ConstantForce
from .sources import Force as Force
from .sources import Position as Position
from .sources import Speed as Speed
from .stops import HardStop as HardStop
from .stops import MassWithStopAndFriction as MassWithStopAndFriction
