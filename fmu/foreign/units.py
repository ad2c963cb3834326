"""Units of foreign FMUs: what they declare."""

from __future__ import annotations

from dataclasses import replace
from math import isclose
from typing import Any
from xml.etree import ElementTree

from ...base import BASES, ModelError, Unit, unit_of

SAME_FACTOR = 1e-6
XML_TRUE = "true", "1"


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
        unit = Unit(definition.name, exponents, base.factor, base.offset)
        if named := _named(unit):  # which has the radians that some tools do not declare
            unit = replace(unit, exponents=named.exponents)
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
        and not isclose(named.factor, 1.0, rel_tol=SAME_FACTOR)
    )


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
    return {display.get("name", "") for display in displays if display.get("inverse") in XML_TRUE}


def relative_names(description: ElementTree.Element) -> set[str]:
    """Return the names of variables that say of themselves that they are relative quantities."""
    told = ((v.get("name", ""), e) for v in description.iterfind("ModelVariables/*") for e in (v, *v))
    return {name for name, element in told if element.get("relativeQuantity") in XML_TRUE}
