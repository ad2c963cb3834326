"""Signals: sources over time and the blocks that close a loop."""

from .blocks import Add as Add
from .blocks import Delay as Delay
from .blocks import Derivative as Derivative
from .blocks import FirstOrder as FirstOrder
from .blocks import Gain as Gain
from .blocks import Integrator as Integrator
from .blocks import Limiter as Limiter
from .blocks import Product as Product
from .controllers import PI as PI
from .controllers import PID as PID
from .controllers import LimPI as LimPI
from .controllers import LimPID as LimPID
from .digital import DeadZone as DeadZone
from .digital import SampleHold as SampleHold
from .periodic import Pulse as Pulse
from .periodic import Trapezoid as Trapezoid
from .sources import Clock as Clock
from .sources import Constant as Constant
from .sources import Ramp as Ramp
from .sources import Sine as Sine
from .sources import Step as Step
from .sources import TimeTable as TimeTable
