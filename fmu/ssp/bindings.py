"""Bindings: the values of parameters that a system or a component is given, also under other names."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any
from urllib.parse import unquote

from .write import NAMESPACES

Validated = Callable[[str, str], Any]  # name of a document in the archive, its schema: its root


@dataclass(frozen=True)
class Bound:
    """A value for a parameter, target = factor * value + offset, converted into the target's unit first."""

    value: Any
    factor: float = 1.0
    offset: float = 0.0
    convert: bool = True

    def given(self, converted: Callable[[Any], Any]) -> Any:
        """Return what the parameter is set to; `converted` turns (value, unit) into its own unit."""
        value = self.value if self.convert or not isinstance(self.value, tuple) else self.value[0]
        if (self.factor, self.offset) == (1.0, 0.0):
            return value
        return self.factor * float(converted(value)) + self.offset


def bound(element: Any, document: Validated) -> dict[str, Bound]:
    """Return the values bound to a component, or to a system, by the names that they have there."""
    found: dict[str, Bound] = {}
    for binding in element.findall("ssd:ParameterBindings/ssd:ParameterBinding", NAMESPACES):
        source, prefix = binding.get("source"), binding.get("prefix", "")
        if source is not None:
            parameters = document(unquote(source), "SystemStructureParameterValues.xsd")
        else:
            parameters = binding.find("ssd:ParameterValues/ssv:ParameterSet", NAMESPACES)
        listed = parameters.findall("ssv:Parameters/ssv:Parameter", NAMESPACES)
        values = {f"{prefix}{one.get('name')}": _value(one) for one in listed}
        mapping = binding.find("ssd:ParameterMapping", NAMESPACES)
        found |= {name: Bound(value) for name, value in values.items()} if mapping is None else {}
        for entry in _entries(mapping, document) if mapping is not None else ():
            if entry.get("source") in values:
                found[entry.get("target")] = _mapped(entry, values[entry.get("source")])
    return found


def _entries(mapping: Any, document: Validated) -> Any:
    source = mapping.get("source")
    if source is not None:
        root = document(unquote(source), "SystemStructureParameterMapping.xsd")
    else:
        root = mapping.find("ssm:ParameterMapping", NAMESPACES)
    return root.findall("ssm:MappingEntry", NAMESPACES)


def _mapped(entry: Any, value: Any) -> Bound:
    linear = entry.find("ssc:LinearTransformation", NAMESPACES)
    told = {} if linear is None else linear.attrib
    convert = entry.get("suppressUnitConversion") not in ("true", "1")
    return Bound(value, float(told.get("factor", 1.0)), float(told.get("offset", 0.0)), convert)


def _value(parameter: Any) -> Any:
    """Return a number, (number, unit), truth or text."""
    entry = parameter[0]
    kind, value = entry.tag.rpartition("}")[2], entry.get("value")
    if kind == "Real":
        return (float(value), entry.get("unit")) if entry.get("unit") else float(value)
    if kind == "Boolean":
        return value in ("true", "1")
    return int(value) if kind == "Integer" else value
