"""Every network a block for any tool, every tool's FMU a part of a network."""

from .check import check as check
from .check_report import CheckReport as CheckReport
from .check_report import Finding as Finding
from .errors import FMUError as FMUError
from .export import VERSIONS as VERSIONS
from .export import export as export
from .import_blocks import FMUBlock as FMUBlock
from .import_blocks import FMUForce as FMUForce
from .import_blocks import FMUMotion as FMUMotion
from .import_blocks import FMURotation as FMURotation
from .import_blocks import FMUTorque as FMUTorque
from .import_cosimulate import cosimulate as cosimulate
from .import_coupling import CoupledRun as CoupledRun
from .import_load import Law as Law
from .import_load import Load as Load
from .import_replay import Replay as Replay
from .import_run import ForeignEvent as ForeignEvent
from .import_run import ForeignRun as ForeignRun
from .imported import FMU as FMU
from .ssp import Connection as Connection
from .ssp import SystemStructure as SystemStructure
from .ssp_read import read_ssp as read_ssp
from .ssp_run import SystemRun as SystemRun
from .ssp_split import Split as Split
from .ssp_split import split as split
from .terminals import Terminal as Terminal
from .terminals import publish as publish

check_fmu = check
export_fmu = export
