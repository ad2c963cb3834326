"""Initialization: an FMU is given values, in the unit, type and range of each variable, and begins."""

from __future__ import annotations

from collections.abc import Mapping
from numbers import Real
from typing import Any

import numpy as np

from ...components import nearest
from ..errors import FMUError
from .communication_steps import CoSimulation
from .description import FMUDescription
from .instance import Group, Instance, Values
from .me_integrator import ModelExchange
from .time_stepping import Stepping, TimeStepper
from .variable import ForeignVariable

INTEGER_RANGES = {"Integer": (-(2**31), 2**31 - 1), "Enumeration": (-(2**63), 2**63 - 1)} | {
    f"{sign}Int{bits}": ((0, 2**bits - 1) if sign else (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1))
    for sign in ("", "U")
    for bits in (8, 16, 32, 64)
}
UNSUPPORTED_TYPES = "Binary", "Clock"
STEPPERS: dict[str, type[TimeStepper]] = {"ME": ModelExchange, "CS": CoSimulation}


def enter_initialization(
    instance: Instance, fmu: FMUDescription, stepping: Stepping, parameters: Mapping[str, Any],
    start: Mapping[str, Any],
) -> list[str]:  # fmt: skip
    """Set values, if they can be, and enter initialization mode; return notes on values not taken."""
    values = _chosen_values(fmu, parameters, start)
    references = [fmu.variables[name].reference for name in stepping.inputs]
    instance.start(stepping.begin, stepping.stop, stepping.rtol, list(values.values()), references)
    return _untaken(fmu, instance, values)


def _chosen_values(
    fmu: FMUDescription, parameters: Mapping[str, Any], start: Mapping[str, Any]
) -> dict[str, tuple[Group, Values]]:
    """Return values to set before the start, by name."""
    chosen = [(fmu.variable(name, fmu.parameters), value) for name, value in parameters.items()]
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


def checked(fmu: FMUDescription, variable: ForeignVariable, value: Any) -> Values:
    """Return the elements of a value in the unit of its variable; refuse a wrong type, number or range."""
    value = fmu.converted(variable, value)
    values = [value] if np.ndim(value) == 0 else np.ravel(value).tolist()
    where = f"FMU '{fmu.name}': '{variable.name}'"
    if len(values) != variable.size:
        raise FMUError(f"{where} takes {variable.size} value(s), got {len(values)}")
    return [_element(where, variable, element) for element in values]


def _element(where: str, variable: ForeignVariable, element: Any) -> Any:
    if variable.type in UNSUPPORTED_TYPES:
        raise FMUError(f"{where} is {variable.type}, which is not supported")
    if variable.type == "String":
        if not isinstance(element, str):
            raise FMUError(f"{where} takes a text, got {element!r}")
        return element
    unit = f" {variable.unit}" if variable.unit else ""
    if isinstance(element, str) and element in variable.choices:
        return variable.choices[element]
    if isinstance(element, str) and variable.choices:
        raise FMUError(f"{where} has no choice {element!r}{nearest(element, variable.choices)}")
    if not isinstance(element, Real | np.bool_):
        raise FMUError(f"{where} takes a number{unit and f' [{variable.unit}]'}, got {element!r}")
    if not variable.minimum <= float(element) <= variable.maximum:
        raise FMUError(
            f"{where} must be between {variable.minimum:g} and {variable.maximum:g}{unit}, got {element}"
        )
    if variable.type == "Boolean":
        if element not in (0, 1):
            raise FMUError(f"{where} is true or false, got {element!r}")
        return bool(element)
    return _whole(where, variable, element) if variable.type in INTEGER_RANGES else float(element)


def _whole(where: str, variable: ForeignVariable, element: Any) -> int:
    least, most = INTEGER_RANGES[variable.type]
    if int(element) != element or not least <= element <= most:
        raise FMUError(f"{where} is {variable.type}, a whole number from {least} to {most}, got {element!r}")
    if variable.choices and element not in variable.choices.values():
        told = ", ".join(f"{name} ({number})" for name, number in variable.choices.items())
        raise FMUError(f"{where} takes one of {told}, got {element!r}")
    return int(element)
