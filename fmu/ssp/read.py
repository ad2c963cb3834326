"""Reading an .ssp file of any tool."""

from __future__ import annotations

from functools import partial
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
from .bindings import bound
from .nested import Levels
from .system import SystemStructure
from .write import DESCRIPTION, NAMESPACES

UNSUPPORTED_ELEMENTS = {
    ".//ssd:Elements/ssd:SignalDictionaryReference": "a signal dictionary",
    ".//ssc:BooleanMappingTransformation": "a mapping of Booleans",
    ".//ssc:IntegerMappingTransformation": "a mapping of integers",
    ".//ssc:EnumerationMappingTransformation": "a mapping of enumerations",
}


def read_ssp(path: str | Path) -> SystemStructure:
    """Read a system from an .ssp file (SSP 1.0) of any tool.

    Connectors of the system itself are dropped: what they lead to is a free input. Components of systems
    inside the system become components of the whole, `wheel` of `axle` as `axle_wheel`.

    Args:
        path: of the file; each FMU inside is unpacked to a temporary folder, which lives as long as it.

    Raises:
        FMUError: if the archive is broken or unsafe, a description invalid, a part missing; for signal
            dictionaries and mappings of what is no real number, which are not supported; if the system
            cannot be.

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

    def document(name: str, schema: str) -> Any:
        return _validated(file, name, schema)

    experiment = root.find("ssd:DefaultExperiment", NAMESPACES)
    told = {} if experiment is None else experiment.attrib
    begin = float(told.get("startTime", 0.0))
    stop = float(told.get("stopTime", begin + 1.0))
    system = SystemStructure(root.get("name"), {}, begin=begin, stop=stop)
    levels = Levels(whole)
    for place, entry in levels.components.items():
        fmu = system.components[levels.name(place)] = _fmu(file, entry)
        values = {n: v for n, v in bound(entry, document).items() if n in fmu.variables}
        if values:  # of a set that may name more than the component has
            given = {n: v.given(partial(fmu.converted, fmu.variables[n])) for n, v in values.items()}
            system.parameters[levels.name(place)] = given
    for place, entry in reversed(levels.systems.items()):  # what is given outside goes first
        for path, value in bound(entry, document).items():
            component, variable = system.variable(levels.variable(place, path))
            converted = partial(system.components[component].converted, variable)
            system.parameters.setdefault(component, {})[variable.name] = value.given(converted)
    system.connections += levels.connections()
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
