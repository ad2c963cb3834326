"""How elements join, and what is done with the equations."""

from .algebra import TwoTerminal as TwoTerminal
from .algebra import parallel as parallel
from .algebra import series as series
from .dae import DAE as DAE
from .events import Event as Event
from .machines import BallScrewInerter as BallScrewInerter
from .machines import PlanetaryFlywheelInerter as PlanetaryFlywheelInerter
from .machines import PlanetaryGeometry as PlanetaryGeometry
from .machines import RackPinionInerter as RackPinionInerter
from .machines import RandomDisplacement as RandomDisplacement
from .machines import Sinusoid as Sinusoid
from .machines import disk_mass as disk_mass
from .machines import equivalent_inertia as equivalent_inertia
from .machines import ge_wang as ge_wang
from .machines import inerter_rig as inerter_rig
from .machines import rig_response as rig_response
from .machines import run_on_rig as run_on_rig
from .machines import screw_inertance as screw_inertance
from .network import Network as Network
from .result import Result as Result
from .signals import chosen_signals as chosen_signals
from .storage import check_table_path as check_table_path
from .storage import load_table as load_table
