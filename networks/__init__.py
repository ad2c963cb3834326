"""How elements join, and what is done with the equations."""

from typing import TYPE_CHECKING, Any

from ..base import Later
from .dae import DAE as DAE
from .dae import Input as Input
from .given import dae_of as dae_of
from .given import element_of as element_of
from .given import network_of as network_of
from .machines import TMD as TMD
from .machines import TMDI as TMDI
from .machines import BallScrewInerter as BallScrewInerter
from .machines import BilinearDamper as BilinearDamper
from .machines import BumpStop as BumpStop
from .machines import DigressiveDamper as DigressiveDamper
from .machines import PitchingBody as PitchingBody
from .machines import PlanetaryFlywheelInerter as PlanetaryFlywheelInerter
from .machines import PlanetaryGeometry as PlanetaryGeometry
from .machines import RackPinionInerter as RackPinionInerter
from .machines import RandomDisplacement as RandomDisplacement
from .machines import RigidBody as RigidBody
from .machines import Sinusoid as Sinusoid
from .machines import disk_mass as disk_mass
from .machines import equivalent_inertia as equivalent_inertia
from .machines import full_car as full_car
from .machines import ge_wang as ge_wang
from .machines import half_car as half_car
from .machines import inerter_rig as inerter_rig
from .machines import isolated_machine as isolated_machine
from .machines import quarter_car as quarter_car
from .machines import rig_response as rig_response
from .machines import run_on_rig as run_on_rig
from .machines import screw_inertance as screw_inertance
from .machines import seat_in_cab as seat_in_cab
from .machines import shear_frame as shear_frame
from .machines import suspension as suspension
from .machines import taut_cable as taut_cable
from .machines import tid as tid
from .machines import tvmd as tvmd
from .model_file import UserCodeError as UserCodeError
from .model_file import load_model as load_model
from .network import Network as Network
from .results.network_drawing import svg_sketch as svg_sketch
from .results.over_time import OverTime as OverTime
from .results.pieces import Pieces as Pieces
from .results.plotting import pretty_unit as pretty_unit
from .results.recorded import Recorded as Recorded
from .results.result import Result as Result
from .results.signals import chosen_signals as chosen_signals
from .results.storage import check_table_path as check_table_path
from .results.storage import load_table as load_table
from .simulation.coverage import between_samples as between_samples
from .simulation.coverage import check_covered as check_covered
from .simulation.coverage import jump_remedy as jump_remedy
from .simulation.events.switcher import Event as Event
from .simulation.integrator import SOLVERS as SOLVERS
from .simulation.polynomial import Polynomial as Polynomial
from .simulation.run import COARSEST as COARSEST
from .simulation.run import FINEST as FINEST
from .simulation.splines import piecewise as piecewise
from .simulation.splines import sampled_at as sampled_at
from .simulation.starting import Start as Start
from .simulation.starting import starting_point as starting_point
from .simulation.stepwise import Stepwise as Stepwise
from .simulation.tolerance import ATOL as ATOL
from .simulation.tolerance import RTOL as RTOL
from .two_terminal import TwoTerminal as TwoTerminal
from .two_terminal import bridge as bridge
from .two_terminal import parallel as parallel
from .two_terminal import series as series
from .variational.variations import Variations as Variations

if TYPE_CHECKING:
    from .analysis import Linearisation as Linearisation
    from .analysis import Mode as Mode
    from .analysis import Norm as Norm
    from .analysis import OperatingPoint as OperatingPoint
    from .analysis import Orbit as Orbit
    from .analysis import ResponseCurve as ResponseCurve
    from .analysis import Scatter as Scatter
    from .analysis import StateSpace as StateSpace
    from .analysis import SteppedSine as SteppedSine
    from .analysis import Tuned as Tuned
    from .analysis import Tuning as Tuning
    from .analysis import Varied as Varied
    from .analysis import admittance as admittance
    from .analysis import animate_modes as animate_modes
    from .analysis import base_shear as base_shear
    from .analysis import body_positions as body_positions
    from .analysis import bump as bump
    from .analysis import comfort_filter as comfort_filter
    from .analysis import den_hartog as den_hartog
    from .analysis import describing_function as describing_function
    from .analysis import drift as drift
    from .analysis import equilibria as equilibria
    from .analysis import front as front
    from .analysis import harmonic_orbit as harmonic_orbit
    from .analysis import harmonic_response as harmonic_response
    from .analysis import impedance as impedance
    from .analysis import linearise as linearise
    from .analysis import load_j5 as load_j5
    from .analysis import operating_point as operating_point
    from .analysis import plot_modes as plot_modes
    from .analysis import quarter_car_damping as quarter_car_damping
    from .analysis import quarter_car_j1 as quarter_car_j1
    from .analysis import record as record
    from .analysis import response_psd as response_psd
    from .analysis import response_rms as response_rms
    from .analysis import ride_comfort as ride_comfort
    from .analysis import ride_j1 as ride_j1
    from .analysis import road_profile as road_profile
    from .analysis import road_spectrum as road_spectrum
    from .analysis import roughness as roughness
    from .analysis import scatter as scatter
    from .analysis import stepped_sine as stepped_sine
    from .analysis import suspension_travel as suspension_travel
    from .analysis import tmdi_white_base as tmdi_white_base
    from .analysis import tune as tune
    from .analysis import tvmd_fixed_points as tvmd_fixed_points
    from .analysis import tyre_j3 as tyre_j3
    from .analysis import weighted as weighted
    from .analysis import weighted_rms as weighted_rms
    from .csource import CProgram as CProgram
    from .csource import ToolchainError as ToolchainError
    from .csource import c_program as c_program
    from .csource import compile_shared as compile_shared
    from .csource import compiler as compiler
    from .csource import corners_as_modes as corners_as_modes
    from .csource import is_corner as is_corner
    from .sweeps.design import Design as Design
    from .sweeps.design import grid as grid
    from .sweeps.design import latin_hypercube as latin_hypercube
    from .sweeps.design import monte_carlo as monte_carlo
    from .sweeps.design import saltelli as saltelli
    from .sweeps.design import sobol_sequence as sobol_sequence
    from .sweeps.sobol_indices import sobol_indices as sobol_indices
    from .sweeps.sweep import Sweep as Sweep
    from .sweeps.sweep import SweepInterruptedError as SweepInterruptedError
    from .sweeps.sweep import sweep as sweep
    from .synthesis import NotPositiveRealError as NotPositiveRealError
    from .synthesis import PositiveReal as PositiveReal
    from .synthesis import RationalFunction as RationalFunction
    from .synthesis import foster as foster
    from .synthesis import positive_real as positive_real
    from .synthesis import synthesise as synthesise

_later = Later(__name__, "analysis", "csource", "sweep_design", "sweep_indices", "sweeps", "synthesis")


def __getattr__(name: str) -> Any:
    """Import what a run does without when one of its names is first asked for."""
    return _later.find(name)


def __dir__() -> list[str]:
    return sorted({*globals(), *_later.names()})
