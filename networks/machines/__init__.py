"""Ready-made machines."""

from . import ge_wang as ge_wang
from .inerters import BallScrewInerter as BallScrewInerter
from .inerters import PlanetaryFlywheelInerter as PlanetaryFlywheelInerter
from .inerters import RackPinionInerter as RackPinionInerter
from .planetary_design import PlanetaryGeometry as PlanetaryGeometry
from .planetary_design import disk_mass as disk_mass
from .planetary_design import equivalent_inertia as equivalent_inertia
from .planetary_design import screw_inertance as screw_inertance
from .rig import RandomDisplacement as RandomDisplacement
from .rig import Sinusoid as Sinusoid
from .rig import inerter_rig as inerter_rig
from .rig import rig_response as rig_response
from .rig import run_on_rig as run_on_rig
