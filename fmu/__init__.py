"""Every network a block for any tool, every tool's FMU a part of a network."""

from .check.check import check_fmu as check_fmu
from .check.report import CheckReport as CheckReport
from .check.report import Finding as Finding
from .cosimulation.components import FMUBlock as FMUBlock
from .cosimulation.components import FMUForce as FMUForce
from .cosimulation.components import FMUMotion as FMUMotion
from .cosimulation.components import FMURotation as FMURotation
from .cosimulation.components import FMUTorque as FMUTorque
from .cosimulation.cosimulate import cosimulate as cosimulate
from .cosimulation.coupling import CoupledRun as CoupledRun
from .errors import FMUError as FMUError
from .export.export import VERSIONS as VERSIONS
from .export.export import export_fmu as export_fmu
from .export.terminals import Terminal as Terminal
from .export.terminals import publish as publish
from .fmu import FMU as FMU
from .foreign.port_force import Law as Law
from .foreign.port_force import Load as Load
from .foreign.replay import Replay as Replay
from .foreign.run import ForeignEvent as ForeignEvent
from .foreign.run import ForeignRun as ForeignRun
from .ssp.read import read_ssp as read_ssp
from .ssp.run import SystemRun as SystemRun
from .ssp.split import Split as Split
from .ssp.split import split as split
from .ssp.system import Connection as Connection
from .ssp.system import SystemStructure as SystemStructure

__all__ = [
    "FMU",
    "CheckReport",
    "Connection",
    "CoupledRun",
    "FMUBlock",
    "FMUError",
    "FMUForce",
    "FMUMotion",
    "FMURotation",
    "FMUTorque",
    "Finding",
    "ForeignEvent",
    "ForeignRun",
    "Split",
    "SystemRun",
    "SystemStructure",
    "check_fmu",
    "cosimulate",
    "export_fmu",
    "publish",
    "read_ssp",
    "split",
]
