"""Where measured data and a model part, and which missing effect parts them."""

from .design import design as design
from .diagnose import diagnose as diagnose
from .effects import across as across
from .effects import dry_friction as dry_friction
from .effects import in_series as in_series
from .effects import on_channels as on_channels
from .effects import ripples as ripples
from .effects import with_memory as with_memory
from .effects.edits import between as between
from .effects.effect import Effect as Effect
from .effects.effect import Quantity as Quantity
from .effects.effect import register as register
from .experiments.designed import Design as Design
from .experiments.designed import InseparableError as InseparableError
from .experiments.designed import Known as Known
from .experiments.separation import Odds as Odds
from .law.law import Law as Law
from .law.missing_force import MissingForce as MissingForce
from .missing_force import missing_force as missing_force
from .models.fmu_network import read_model as read_model
from .report.report import write_report as write_report
from .verdict.verdict import DiagnosisInterruptedError as DiagnosisInterruptedError
from .verdict.verdict import Gap as Gap
from .verdict.verdict import Ranked as Ranked
from .verdict.verdict import Verdict as Verdict

__all__ = [
    "Design",
    "DiagnosisInterruptedError",
    "Effect",
    "Gap",
    "InseparableError",
    "Known",
    "Law",
    "MissingForce",
    "Odds",
    "Quantity",
    "Ranked",
    "Verdict",
    "across",
    "between",
    "design",
    "diagnose",
    "dry_friction",
    "in_series",
    "missing_force",
    "on_channels",
    "read_model",
    "register",
    "ripples",
    "with_memory",
    "write_report",
]
