"""The components among the machines, in one place: what type checkers know of them stands in its stub."""

from .absorbers import NES as NES
from .absorbers import TMD as TMD
from .absorbers import TMDI as TMDI
from .dampers import BilinearDamper as BilinearDamper
from .dampers import BumpStop as BumpStop
from .dampers import DigressiveDamper as DigressiveDamper
from .electric import Servo as Servo
from .electric import Shaker as Shaker
from .inerters import BallScrewInerter as BallScrewInerter
from .inerters import CrankInerter as CrankInerter
from .inerters import GyroInerter as GyroInerter
from .inerters import MechatronicInerter as MechatronicInerter
from .inerters import PlanetaryFlywheelInerter as PlanetaryFlywheelInerter
from .inerters import RackPinionInerter as RackPinionInerter
from .interconnected import InterconnectedStruts as InterconnectedStruts
from .landing_gears import OleoStrut as OleoStrut
from .shaken import Unbalance as Unbalance
from .torsional import DualMassFlywheel as DualMassFlywheel
from .torsional import TorsionalDamper as TorsionalDamper
from .tyres import RigidRingTyre as RigidRingTyre
from .vehicles import PitchingBody as PitchingBody
from .vehicles import RigidBody as RigidBody
