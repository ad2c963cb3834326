"""Values given to an FMU: converted to the unit and checked against type, range and names of a variable."""

from __future__ import annotations

from numbers import Real
from typing import Any

import numpy as np

from ...components import nearest
from ..errors import FMUError
from .description import FMUDescription
from .instance import Values
from .variable import ForeignVariable

WHOLE = {"Integer": (-(2**31), 2**31 - 1), "Enumeration": (-(2**63), 2**63 - 1)} | {
    f"{sign}Int{bits}": ((0, 2**bits - 1) if sign else (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1))
    for sign in ("", "U")
    for bits in (8, 16, 32, 64)
}
REFUSED = "Binary", "Clock"


def checked(fmu: FMUDescription, variable: ForeignVariable, value: Any) -> Values:
    """Return the elements of a value in the unit and the type of its variable.

    Raises:
        FMUError: if type, number or range is wrong, or an enumeration has no such choice.
    """
    value = fmu.converted(variable, value)
    values = [value] if np.ndim(value) == 0 else np.ravel(value).tolist()
    where = f"FMU '{fmu.name}': '{variable.name}'"
    if len(values) != variable.size:
        raise FMUError(f"{where} takes {variable.size} value(s), got {len(values)}")
    return [_element(where, variable, element) for element in values]


def _element(where: str, variable: ForeignVariable, element: Any) -> Any:
    if variable.type in REFUSED:
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
    return _whole(where, variable, element) if variable.type in WHOLE else float(element)


def _whole(where: str, variable: ForeignVariable, element: Any) -> int:
    least, most = WHOLE[variable.type]
    if int(element) != element or not least <= element <= most:
        raise FMUError(f"{where} is {variable.type}, a whole number from {least} to {most}, got {element!r}")
    if variable.choices and element not in variable.choices.values():
        told = ", ".join(f"{name} ({number})" for name, number in variable.choices.items())
        raise FMUError(f"{where} takes one of {told}, got {element!r}")
    return int(element)
