"""inertance: acausal 1-D mechanics. Join elements at flanges, run the machine."""

from typing import TYPE_CHECKING, Any

from inertance.base import Later
from inertance.components import Accelerate as Accelerate
from inertance.components import AccelerationSensor as AccelerationSensor
from inertance.components import AsymmetricFriction as AsymmetricFriction
from inertance.components import Backlash as Backlash
from inertance.components import BilinearSpring as BilinearSpring
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
from inertance.components import DriftingFriction as DriftingFriction
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
from inertance.components import LoadedFriction as LoadedFriction
from inertance.components import Mass as Mass
from inertance.components import MassWithStopAndFriction as MassWithStopAndFriction
from inertance.components import MissingFileError as MissingFileError
from inertance.components import MissingPackageError as MissingPackageError
from inertance.components import ModelError as ModelError
from inertance.components import NutScrew as NutScrew
from inertance.components import OutputError as OutputError
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
from inertance.components import Ripple as Ripple
from inertance.components import Rod as Rod
from inertance.components import RollingWheel as RollingWheel
from inertance.components import RotationalFlange as RotationalFlange
from inertance.components import RunInterruptedError as RunInterruptedError
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
from inertance.components import UnknownNameError as UnknownNameError
from inertance.components import UnknownPartError as UnknownPartError
from inertance.components import der as der
from inertance.components import impulse as impulse
from inertance.components import mode as mode
from inertance.components import option as option
from inertance.components import parameter as parameter
from inertance.components import rotational as rotational
from inertance.components import signals as signals
from inertance.components import variable as variable
from inertance.networks import DAE as DAE
from inertance.networks import TMD as TMD
from inertance.networks import TMDI as TMDI
from inertance.networks import BallScrewInerter as BallScrewInerter
from inertance.networks import BilinearDamper as BilinearDamper
from inertance.networks import BumpStop as BumpStop
from inertance.networks import DigressiveDamper as DigressiveDamper
from inertance.networks import Event as Event
from inertance.networks import Network as Network
from inertance.networks import OverTime as OverTime
from inertance.networks import PitchingBody as PitchingBody
from inertance.networks import PlanetaryFlywheelInerter as PlanetaryFlywheelInerter
from inertance.networks import PlanetaryGeometry as PlanetaryGeometry
from inertance.networks import Polynomial as Polynomial
from inertance.networks import RackPinionInerter as RackPinionInerter
from inertance.networks import RandomDisplacement as RandomDisplacement
from inertance.networks import Recorded as Recorded
from inertance.networks import Result as Result
from inertance.networks import RigidBody as RigidBody
from inertance.networks import Sinusoid as Sinusoid
from inertance.networks import Stepwise as Stepwise
from inertance.networks import TwoTerminal as TwoTerminal
from inertance.networks import Variations as Variations
from inertance.networks import bridge as bridge
from inertance.networks import disk_mass as disk_mass
from inertance.networks import equivalent_inertia as equivalent_inertia
from inertance.networks import full_car as full_car
from inertance.networks import ge_wang as ge_wang
from inertance.networks import half_car as half_car
from inertance.networks import inerter_rig as inerter_rig
from inertance.networks import isolated_machine as isolated_machine
from inertance.networks import load_table as load_table
from inertance.networks import parallel as parallel
from inertance.networks import quarter_car as quarter_car
from inertance.networks import rig_response as rig_response
from inertance.networks import run_on_rig as run_on_rig
from inertance.networks import screw_inertance as screw_inertance
from inertance.networks import seat_in_cab as seat_in_cab
from inertance.networks import series as series
from inertance.networks import shear_frame as shear_frame
from inertance.networks import suspension as suspension
from inertance.networks import taut_cable as taut_cable
from inertance.networks import tid as tid
from inertance.networks import tvmd as tvmd

if TYPE_CHECKING:
    from inertance.diagnosis import DiagnosisInterruptedError as DiagnosisInterruptedError
    from inertance.diagnosis import Verdict as Verdict
    from inertance.diagnosis import diagnose as diagnose
    from inertance.fmu import FMU as FMU
    from inertance.fmu import CheckReport as CheckReport
    from inertance.fmu import Connection as Connection
    from inertance.fmu import CoupledRun as CoupledRun
    from inertance.fmu import Finding as Finding
    from inertance.fmu import FMUBlock as FMUBlock
    from inertance.fmu import FMUError as FMUError
    from inertance.fmu import FMUForce as FMUForce
    from inertance.fmu import FMUMotion as FMUMotion
    from inertance.fmu import FMURotation as FMURotation
    from inertance.fmu import FMUTorque as FMUTorque
    from inertance.fmu import ForeignEvent as ForeignEvent
    from inertance.fmu import ForeignRun as ForeignRun
    from inertance.fmu import Split as Split
    from inertance.fmu import SystemRun as SystemRun
    from inertance.fmu import SystemStructure as SystemStructure
    from inertance.fmu import check_fmu as check_fmu
    from inertance.fmu import cosimulate as cosimulate
    from inertance.fmu import export_fmu as export_fmu
    from inertance.fmu import read_ssp as read_ssp
    from inertance.fmu import split as split
    from inertance.identification import Bench as Bench
    from inertance.identification import Campaign as Campaign
    from inertance.identification import Channel as Channel
    from inertance.identification import Chirp as Chirp
    from inertance.identification import Experiment as Experiment
    from inertance.identification import Filter as Filter
    from inertance.identification import Fit as Fit
    from inertance.identification import FitInterruptedError as FitInterruptedError
    from inertance.identification import Floor as Floor
    from inertance.identification import Multisine as Multisine
    from inertance.identification import Prediction as Prediction
    from inertance.identification import Record as Record
    from inertance.identification import SineDwells as SineDwells
    from inertance.identification import fit as fit
    from inertance.identification import read_record as read_record
    from inertance.identification import sampled as sampled
    from inertance.networks import Design as Design
    from inertance.networks import Mode as Mode
    from inertance.networks import Norm as Norm
    from inertance.networks import NotPositiveRealError as NotPositiveRealError
    from inertance.networks import OperatingPoint as OperatingPoint
    from inertance.networks import Orbit as Orbit
    from inertance.networks import PositiveReal as PositiveReal
    from inertance.networks import RationalFunction as RationalFunction
    from inertance.networks import ResponseCurve as ResponseCurve
    from inertance.networks import Scatter as Scatter
    from inertance.networks import StateSpace as StateSpace
    from inertance.networks import SteppedSine as SteppedSine
    from inertance.networks import Sweep as Sweep
    from inertance.networks import SweepInterruptedError as SweepInterruptedError
    from inertance.networks import Tuned as Tuned
    from inertance.networks import Tuning as Tuning
    from inertance.networks import Varied as Varied
    from inertance.networks import admittance as admittance
    from inertance.networks import animate_modes as animate_modes
    from inertance.networks import base_shear as base_shear
    from inertance.networks import body_positions as body_positions
    from inertance.networks import bump as bump
    from inertance.networks import comfort_filter as comfort_filter
    from inertance.networks import den_hartog as den_hartog
    from inertance.networks import describing_function as describing_function
    from inertance.networks import drift as drift
    from inertance.networks import equilibria as equilibria
    from inertance.networks import foster as foster
    from inertance.networks import front as front
    from inertance.networks import grid as grid
    from inertance.networks import harmonic_orbit as harmonic_orbit
    from inertance.networks import harmonic_response as harmonic_response
    from inertance.networks import impedance as impedance
    from inertance.networks import latin_hypercube as latin_hypercube
    from inertance.networks import linearise as linearise
    from inertance.networks import load_j5 as load_j5
    from inertance.networks import monte_carlo as monte_carlo
    from inertance.networks import operating_point as operating_point
    from inertance.networks import plot_modes as plot_modes
    from inertance.networks import positive_real as positive_real
    from inertance.networks import quarter_car_damping as quarter_car_damping
    from inertance.networks import quarter_car_j1 as quarter_car_j1
    from inertance.networks import record as record
    from inertance.networks import response_psd as response_psd
    from inertance.networks import response_rms as response_rms
    from inertance.networks import ride_comfort as ride_comfort
    from inertance.networks import ride_j1 as ride_j1
    from inertance.networks import road_profile as road_profile
    from inertance.networks import road_spectrum as road_spectrum
    from inertance.networks import roughness as roughness
    from inertance.networks import saltelli as saltelli
    from inertance.networks import scatter as scatter
    from inertance.networks import sobol_indices as sobol_indices
    from inertance.networks import sobol_sequence as sobol_sequence
    from inertance.networks import stepped_sine as stepped_sine
    from inertance.networks import suspension_travel as suspension_travel
    from inertance.networks import sweep as sweep
    from inertance.networks import synthesise as synthesise
    from inertance.networks import tmdi_white_base as tmdi_white_base
    from inertance.networks import tune as tune
    from inertance.networks import tvmd_fixed_points as tvmd_fixed_points
    from inertance.networks import tyre_j3 as tyre_j3
    from inertance.networks import weighted as weighted
    from inertance.networks import weighted_rms as weighted_rms

_later = Later(
    "inertance",
    "networks.analysis",
    "networks.synthesis",
    "networks.sweep_design",
    "networks.sweep_indices",
    "networks.sweeps",
    "fmu",
    "diagnosis",
    "identification",
)


def __getattr__(name: str) -> Any:
    """Import what simulation does without when one of its names is first asked for."""
    if name == "__version__":
        from importlib.metadata import version

        return version("inertance")
    return _later.find(name)


def __dir__() -> list[str]:
    return sorted({*globals(), *_later.names()})
