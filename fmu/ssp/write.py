"""Writing a system as an .ssp file: SystemStructure.ssd, and the FMUs in resources/."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any
from xml.etree import ElementTree as ET

from ...base import BASES, Unit, check_output
from ...components import ModelError
from ..export.model_description import text
from ..export.package import write_archive
from ..fmu import FMU
from ..foreign.model_description import KINDS
from ..foreign.variable import ForeignVariable
from .walls import Walls, walls

if TYPE_CHECKING:
    from .system import SystemStructure

NAMESPACES = {
    "ssd": "http://ssp-standard.org/SSP1/SystemStructureDescription",
    "ssc": "http://ssp-standard.org/SSP1/SystemStructureCommon",
    "ssm": "http://ssp-standard.org/SSP1/SystemStructureParameterMapping",
    "ssv": "http://ssp-standard.org/SSP1/SystemStructureParameterValues",
}
DESCRIPTION = "SystemStructure.ssd"
TYPES = {"Real": "Real", "Float64": "Real", "Float32": "Real", "Boolean": "Boolean", "String": "String"}


def write_ssp(system: SystemStructure, path: Path, groups: Mapping[str, Iterable[str]]) -> Path:
    """Write a system; see `SystemStructure.write`."""
    if path.suffix != ".ssp":
        raise ModelError(f"a system is written to a file that ends in '.ssp', got '{path}'")
    check_output(path)
    files = {DESCRIPTION: description(system, groups)}
    files |= {_resource(name): fmu.path.read_bytes() for name, fmu in system.components.items()}
    write_archive(path, files)
    return path


def _resource(component: str) -> str:
    return f"resources/{component}.fmu"


def description(system: SystemStructure, groups: Mapping[str, Iterable[str]]) -> bytes:
    """Return SystemStructure.ssd."""
    for prefix, uri in NAMESPACES.items():
        ET.register_namespace(prefix, uri)
    root = _element(None, "ssd:SystemStructureDescription", version="1.0", name=system.name)
    units = dict[str, Unit]()
    whole = _element(root, "ssd:System", name="system", description=system.name)
    _system(whole, system, walls(system, groups), units)
    if units:
        listed = _element(root, "ssd:Units")
        for unit in units.values():
            _unit(listed, unit)
    _element(root, "ssd:DefaultExperiment", startTime=repr(system.begin), stopTime=repr(system.stop))
    return text(root)


def _system(entry: ET.Element, system: SystemStructure, inside: Walls, units: dict[str, Unit]) -> None:
    """Write what is inside of a system; `units` collects those that are used."""
    if inside.connectors:
        listed = _element(entry, "ssd:Connectors")
        for name, (kind, variable) in inside.connectors.items():
            _connector(listed, name, kind, variable)
    elements = _element(entry, "ssd:Elements")
    for short, name in inside.components.items():
        fmu, values = system.components[name], system.parameters.get(name, {})
        parameters = {n: fmu.variables[n] for n in values if n in fmu.parameters}
        connected = {**fmu.inputs, **fmu.outputs, **parameters}.values()
        _component(elements, short, _resource(name), fmu, connected, values)
        for variable in connected:
            if variable.unit:
                units.setdefault(variable.unit, fmu.measure(variable))
    for name, deeper in inside.systems.items():
        _system(_element(elements, "ssd:System", name=name), system, deeper, units)
    _connections(entry, inside)


def _element(parent: ET.Element | None, tag: str, **attributes: str) -> ET.Element:
    prefix, _, name = tag.partition(":")
    full = f"{{{NAMESPACES[prefix]}}}{name}"
    return ET.Element(full, attributes) if parent is None else ET.SubElement(parent, full, attributes)


def _component(
    elements: ET.Element,
    name: str,
    source: str,
    fmu: FMU,
    connected: Collection[ForeignVariable],
    values: dict[str, Any],
) -> None:
    implementation = "any" if len(fmu.kinds) > 1 else KINDS[fmu.kind()]
    component = _element(
        elements, "ssd:Component", name=name, type="application/x-fmu-sharedlibrary",
        source=source, implementation=implementation,
    )  # fmt: skip
    if connected:
        connectors = _element(component, "ssd:Connectors")
        for variable in connected:
            _connector(connectors, variable.name, variable.causality, variable)
    if values:
        binding = _element(_element(component, "ssd:ParameterBindings"), "ssd:ParameterBinding")
        given = _element(binding, "ssd:ParameterValues")
        listed = _element(_element(given, "ssv:ParameterSet", version="1.0", name=name), "ssv:Parameters")
        for parameter, value in values.items():
            _parameter(listed, fmu, fmu.variables[parameter], value)


def _connector(listed: ET.Element, name: str, kind: str, variable: ForeignVariable) -> None:
    connector = _element(listed, "ssd:Connector", name=name, kind=kind)
    _element(connector, f"ssc:{TYPES.get(variable.type, 'Integer')}", **_measured(variable))


def _measured(variable: ForeignVariable) -> dict[str, str]:
    return {"unit": variable.unit} if variable.unit and TYPES.get(variable.type) == "Real" else {}


def _parameter(listed: ET.Element, fmu: FMU, variable: ForeignVariable, value: Any) -> None:
    kind, number = TYPES.get(variable.type, "Integer"), fmu.converted(variable, value)
    written = {"Real": lambda: repr(float(number)), "Boolean": lambda: str(bool(number)).lower()}
    entry = _element(listed, "ssv:Parameter", name=variable.name)
    _element(entry, f"ssv:{kind}", value=written.get(kind, lambda: str(number))(), **_measured(variable))


def _connections(whole: ET.Element, inside: Walls) -> None:
    if not inside.links:
        return
    listed = _element(whole, "ssd:Connections")
    for ends, connection in inside.links.items():
        attributes = dict[str, str]()
        for side, (element, connector) in zip(("start", "end"), ends, strict=True):
            attributes |= {f"{side}Element": element} if element is not None else {}
            attributes[f"{side}Connector"] = connector
        if connection is not None and not connection.convert:
            attributes["suppressUnitConversion"] = "true"
        entry = _element(listed, "ssd:Connection", **attributes)
        if connection is not None and (connection.factor, connection.offset) != (1.0, 0.0):
            factor, offset = repr(connection.factor), repr(connection.offset)
            _element(entry, "ssc:LinearTransformation", factor=factor, offset=offset)


def _unit(listed: ET.Element, unit: Unit) -> None:
    base = {name: str(power) for name, power in zip(BASES, unit.exponents, strict=True) if power}
    if unit.factor != 1.0:
        base["factor"] = repr(unit.factor)
    if unit.offset:
        base["offset"] = repr(unit.offset)
    _element(_element(listed, "ssc:Unit", name=unit.name), "ssc:BaseUnit", **base)
