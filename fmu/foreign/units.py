"""Units of foreign FMUs: what they declare."""

from __future__ import annotations

from dataclasses import replace
from math import isclose
from typing import Any
from xml.etree import ElementTree

from ...base import BASES, ModelError, Unit, unit_of

SAME = 1e-6
TRUE = "true", "1"


def declared_units(definitions: list[Any], inverse: set[str]) -> dict[str, Unit]:
    """Return the units that an FMU defines, its display units included (under the unit they display).

    Display units that are `inverse` show the reciprocal of a value, which is no unit of it.
    """
    units: dict[str, Unit] = {}
    for definition in definitions:
        base = definition.baseUnit
        if base is None:
            continue
        exponents = tuple(getattr(base, name) for name in BASES)
        unit = _with_angle(Unit(definition.name, exponents, base.factor, base.offset))
        units[unit.name] = unit
        for display in definition.displayUnits:
            if display.name in inverse:
                continue
            factor = unit.factor / display.factor
            offset = unit.offset - factor * display.offset
            units.setdefault(display.name, Unit(display.name, unit.exponents, factor, offset))
    return units


def is_bare(unit: Unit) -> bool:
    """Tell whether a unit is declared as SI, though its name has another factor: `mm` as if it were m."""
    named = _named(unit)
    return (
        (unit.factor, unit.offset) == (1.0, 0.0)
        and named is not None
        and not isclose(named.factor, 1.0, rel_tol=SAME)
    )


def _with_angle(unit: Unit) -> Unit:
    """Return a unit with the radians that its name has, as some tools declare none."""
    named = _named(unit)
    return unit if named is None else replace(unit, exponents=named.exponents)


def _named(unit: Unit) -> Unit | None:
    """Return what the name of a unit says, if it measures what is declared."""
    try:
        named = unit_of(unit.name, unit)
    except ModelError:
        return None
    return named if named.fits(unit) else None


def inverse_units(description: ElementTree.Element) -> set[str]:
    """Return the names of display units that show the reciprocal of a value."""
    displays = description.iterfind("UnitDefinitions/Unit/DisplayUnit")
    return {display.get("name", "") for display in displays if display.get("inverse") in TRUE}


def relative_names(description: ElementTree.Element) -> set[str]:
    """Return the names of variables that say of themselves that they are relative quantities."""
    variables = description.iterfind("ModelVariables/*")
    return {v.get("name", "") for v in variables if any(e.get("relativeQuantity") in TRUE for e in (v, *v))}
