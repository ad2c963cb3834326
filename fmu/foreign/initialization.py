"""Initialization: an FMU is given its values before a run, and what it did not take is told."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ..errors import FMUError
from .communication_steps import CoSimulation
from .description import FMUDescription
from .instance import Group, Instance, Values
from .me_integrator import ModelExchange
from .time_stepping import Stepping, TimeStepper
from .values import checked

STEPPERS: dict[str, type[TimeStepper]] = {"ME": ModelExchange, "CS": CoSimulation}


def enter_initialization(
    instance: Instance, fmu: FMUDescription, stepping: Stepping, parameters: Mapping[str, Any],
    start: Mapping[str, Any],
) -> list[str]:  # fmt: skip
    """Set values and enter initialization mode; return notes on values that were not taken.

    Raises:
        FMUError: for unknown names, what cannot be set, and values out of range.
    """
    values = _chosen_values(fmu, parameters, start)
    references = [fmu.variables[name].reference for name in stepping.inputs]
    instance.start(stepping.begin, stepping.stop, stepping.rtol, list(values.values()), references)
    return _untaken(fmu, instance, values)


def _chosen_values(
    fmu: FMUDescription, parameters: Mapping[str, Any], start: Mapping[str, Any]
) -> dict[str, tuple[Group, Values]]:
    """Return values to set before the start, by name.

    Raises:
        FMUError: for unknown names, what cannot be set, and values out of range.
    """
    chosen = []
    for name, value in parameters.items():
        chosen.append((fmu.variable(name, fmu.parameters), value))
    for name, value in start.items():
        variable = fmu.variable(name)
        if not variable.settable or variable.causality in ("parameter", "input"):
            told = variable.initial or variable.variability
            raise FMUError(f"FMU '{fmu.name}': '{name}' ({variable.causality}, {told}) takes no start value")
        chosen.append((variable, value))
    return {v.name: ((v.type, [v.reference], v.size), checked(fmu, v, value)) for v, value in chosen}


def _untaken(fmu: FMUDescription, instance: Instance, chosen: dict[str, tuple[Any, Values]]) -> list[str]:
    """Return notes on values that an FMU was given before its start and did not take."""
    notes = []
    for name, (group, values) in chosen.items():
        v = fmu.variables[name]
        if v.initial != "exact" or v.type == "String":
            continue
        found = instance.get([group])
        close = 1e-6 if v.type == "Float32" else 1e-9
        if not np.allclose(found, np.array(values, dtype=float), rtol=close, atol=0.0):
            took, wanted = (x[0] if v.size == 1 else x for x in (found, values))
            notes.append(f"'{name}' was set to {wanted}, but the FMU says that it is {took}")
    return notes
