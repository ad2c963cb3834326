"""Reading an .ssp file of any tool."""

from __future__ import annotations

from io import BytesIO
from pathlib import Path
from shutil import rmtree
from tempfile import mkdtemp
from typing import Any
from urllib.parse import unquote
from weakref import finalize

from ...base import path_of
from ..errors import FMUError
from ..fmu import FMU
from ..foreign.archive import read_entry
from .system import Connection, SystemStructure
from .write import DESCRIPTION, NAMESPACES

UNSUPPORTED_ELEMENTS = {
    "ssd:Elements/ssd:System": "a system inside the system",
    "ssd:Elements/ssd:SignalDictionaryReference": "a signal dictionary",
    ".//ssd:ParameterMapping": "a parameter mapping",
    ".//ssc:BooleanMappingTransformation": "a mapping of Booleans on a connection",
    ".//ssc:IntegerMappingTransformation": "a mapping of integers on a connection",
    ".//ssc:EnumerationMappingTransformation": "a mapping of enumerations on a connection",
}


def read_ssp(path: str | Path) -> SystemStructure:
    """Read a system from an .ssp file (SSP 1.0) of any tool.

    Connectors of the system itself are dropped: what they lead to is a free input.

    Args:
        path: of the file; each FMU inside is unpacked to a temporary folder, which lives as long as it.

    Raises:
        FMUError: if the archive is broken or unsafe, a description invalid, a part missing; for nested
            systems, signal dictionaries and mappings, which are not supported; if the system cannot be.

    Example:
        >>> from inertance.fmu import read_ssp
        >>> system = read_ssp("quarter_car.ssp")       # doctest: +SKIP
        >>> list(system.components)                    # doctest: +SKIP
        ['body', 'wheel']
    """
    file = path_of(path, "an SSP")
    root = _validated(file, DESCRIPTION, "SystemStructureDescription.xsd")
    whole = root.find("ssd:System", NAMESPACES)
    for pattern, what in UNSUPPORTED_ELEMENTS.items():
        if whole.find(pattern, NAMESPACES) is not None:
            raise FMUError(
                f"'{file}' has {what}, which is not supported; flatten it in the tool that wrote it"
            )
    experiment = root.find("ssd:DefaultExperiment", NAMESPACES)
    told = {} if experiment is None else experiment.attrib
    begin = float(told.get("startTime", 0.0))
    stop = float(told.get("stopTime", begin + 1.0))
    system = SystemStructure(root.get("name"), {}, begin=begin, stop=stop)
    for entry in whole.findall("ssd:Elements/ssd:Component", NAMESPACES):
        name = entry.get("name")
        fmu = system.components[name] = _fmu(file, entry)
        values = {n: v for n, v in _bound(file, entry).items() if n in fmu.variables}
        if values:  # of a set that may name more than the component has
            system.parameters[name] = values
    for place, value in _bound(file, whole).items():
        component, variable = system.variable(place)
        system.parameters.setdefault(component, {})[variable.name] = value
    system.connections += _connections(whole)
    system.check()
    return system


def _validated(file: Path, name: str, schema: str) -> Any:
    """Return the root of a document that its schema allows; entities are not resolved."""
    from fmpy.ssp.ssd import validate_tree
    from lxml import etree  # type: ignore[import-untyped]

    content = BytesIO(read_entry(file, name, "SSP"))
    try:
        root = etree.parse(content, etree.XMLParser(resolve_entities=False, no_network=True)).getroot()
        validate_tree(root, schema)
    except Exception as error:
        told = str(error).removeprefix("Failed to validate SystemStructure.ssd:").strip()
        raise FMUError(f"'{file}': {name} is invalid: {told}") from error
    return root


def _fmu(file: Path, entry: Any) -> FMU:
    """Return the FMU of a component; its file lives as long as it."""
    source, kind = entry.get("source"), entry.get("type", "application/x-fmu-sharedlibrary")
    if kind != "application/x-fmu-sharedlibrary" or "//" in source:
        raise FMUError(f"'{file}': component '{entry.get('name')}' ({source}) is no FMU inside of it")
    content = read_entry(file, unquote(source).removeprefix("./"), "SSP")
    folder = mkdtemp(prefix="inertance-ssp-")
    target = Path(folder) / "component.fmu"
    try:
        target.write_bytes(content)
        fmu = FMU(target)
    except BaseException:
        rmtree(folder, ignore_errors=True)
        raise
    finalize(fmu, rmtree, folder, ignore_errors=True)
    return fmu


def _bound(file: Path, element: Any) -> dict[str, Any]:
    """Return the values bound to a component, or to the system, by the names of their sets with prefix."""
    found: dict[str, Any] = {}
    for binding in element.findall("ssd:ParameterBindings/ssd:ParameterBinding", NAMESPACES):
        source, prefix = binding.get("source"), binding.get("prefix", "")
        if source is not None:
            parameters = _validated(file, unquote(source), "SystemStructureParameterValues.xsd")
        else:
            parameters = binding.find("ssd:ParameterValues/ssv:ParameterSet", NAMESPACES)
        listed = parameters.findall("ssv:Parameters/ssv:Parameter", NAMESPACES)
        found |= {f"{prefix}{one.get('name')}": _value(one) for one in listed}
    return found


def _value(parameter: Any) -> Any:
    """Return a number, (number, unit), truth or text."""
    entry = parameter[0]
    kind, value = entry.tag.rpartition("}")[2], entry.get("value")
    if kind == "Real":
        return (float(value), entry.get("unit")) if entry.get("unit") else float(value)
    if kind == "Boolean":
        return value in ("true", "1")
    return int(value) if kind == "Integer" else value


def _connections(whole: Any) -> list[Connection]:
    """Return the connections between components; SSP lets them be written either way round."""
    inputs = {
        (component.get("name"), connector.get("name"))
        for component in whole.findall("ssd:Elements/ssd:Component", NAMESPACES)
        for connector in component.findall("ssd:Connectors/ssd:Connector", NAMESPACES)
        if connector.get("kind") == "input"
    }
    found = []
    for entry in whole.findall("ssd:Connections/ssd:Connection", NAMESPACES):
        start, end = ((entry.get(f"{s}Element"), entry.get(f"{s}Connector")) for s in ("start", "end"))
        if None in (start[0], end[0]):
            continue
        if start in inputs and end not in inputs:
            start, end = end, start
        linear = entry.find("ssc:LinearTransformation", NAMESPACES)
        told = {} if linear is None else linear.attrib
        factor, offset = float(told.get("factor", 1.0)), float(told.get("offset", 0.0))
        convert = entry.get("suppressUnitConversion") not in ("true", "1")
        found.append(Connection(".".join(start), ".".join(end), factor, offset, convert))
    return found
