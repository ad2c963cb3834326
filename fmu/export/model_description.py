"""modelDescription.xml: what an FMU tells of itself, for FMI 2.0 and 3.0."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import asdict, dataclass
from xml.etree import ElementTree as ET

from .units import base_units, display_units, quantity
from .variables import Interface, Scalar

CATEGORIES = {
    "logStatusError": "refused calls and failed computations",
    "logStatusDiscard": "computations that are not possible where the model stands",
}
TYPES3 = {"Real": "Float64", "Boolean": "Boolean", "Integer": "Int32", "Enumeration": "Enumeration"}
PART = r"[A-Za-z_][A-Za-z0-9_]*(\[\d+\])?"
# Names of ASCII letters, digits and underscores.
STRUCTURED = re.compile(rf"{PART}(\.{PART})*|der\({PART}(\.{PART})*(,\d+)?\)")


@dataclass(frozen=True)
class Rights:
    """Whose model it is and on which terms; what is empty is not told."""

    author: str = ""
    version: str = ""
    copyright: str = ""
    license: str = ""


@dataclass(frozen=True)
class ExportedModel:
    """What is told of an FMU besides its variables.

    Attributes:
        name: of the network; identifier: the same as a C identifier.
        token: GUID or instantiation token.
        version: of inertance.
        step: communication step that suits it [s]; fixed_step: of its own stepper [s], 0 if it is free.
        sources: names of the C files to compile, empty without sources.
    """

    name: str
    identifier: str
    token: str
    version: str
    tolerance: float
    step: float
    stop: float
    fixed_step: float
    sources: tuple[str, ...]
    interface: Interface
    rights: Rights


def model_description(model: ExportedModel, fmi_version: str) -> bytes:
    """Return modelDescription.xml."""
    scalars, two = model.interface.scalars, fmi_version == "2.0"
    token = {"guid" if two else "instantiationToken": model.token}
    root = ET.Element("fmiModelDescription", {"fmiVersion": fmi_version} | token | _told(model))
    if two:
        root.set("numberOfEventIndicators", str(len(model.interface.indicators)))
    (_kinds2 if two else _kinds3)(root, model)
    _units(root, scalars)
    types = ET.SubElement(root, "TypeDefinitions")
    for name, used in _types(scalars).items():
        if two:
            _typed(ET.SubElement(types, "SimpleType", name=name), used.type, used)
        else:
            _typed(types, f"{TYPES3[used.type]}Type", used).set("name", name)
    listed = ET.SubElement(root, "LogCategories")
    for name, told in CATEGORIES.items():
        ET.SubElement(listed, "Category", name=name, description=told)
    numbers = {"startTime": 0.0, "stopTime": model.stop, "tolerance": model.tolerance, "stepSize": model.step}
    ET.SubElement(root, "DefaultExperiment", {name: repr(value) for name, value in numbers.items()})
    _variables(root, model.interface, two)
    (_structure2 if two else _structure3)(ET.SubElement(root, "ModelStructure"), model.interface)
    return text(root)


def text(root: ET.Element) -> bytes:
    """Return an indented document."""
    ET.indent(root)
    written: bytes = ET.tostring(root, encoding="utf-8", xml_declaration=True)
    return written + b"\n"


def _kinds2(root: ET.Element, model: ExportedModel) -> None:
    able = ("canGetAndSetFMUstate", "canSerializeFMUstate", "providesDirectionalDerivative")
    exchange = _kind(root, "ModelExchange", model, *able)
    stepping = ("canHandleVariableCommunicationStepSize", "canInterpolateInputs")
    steps = _kind(root, "CoSimulation", model, *able, *stepping)
    steps.set("maxOutputDerivativeOrder", "1")
    for kind in (exchange, steps) if model.sources else ():
        listed = ET.SubElement(kind, "SourceFiles")
        for name in model.sources:
            ET.SubElement(listed, "File", name=name)


def _kinds3(root: ET.Element, model: ExportedModel) -> None:
    able = ["canGetAndSetFMUState", "canSerializeFMUState"]
    able += ["providesDirectionalDerivatives", "providesAdjointDerivatives"]
    _kind(root, "ModelExchange", model, *able, "needsCompletedIntegratorStep")
    stepping = ("canHandleVariableCommunicationStepSize", "hasEventMode", "mightReturnEarlyFromDoStep")
    steps = _kind(root, "CoSimulation", model, *able, *stepping, "providesIntermediateUpdate")
    steps.set("maxOutputDerivativeOrder", "1")
    if model.fixed_step:
        steps.set("fixedInternalStepSize", repr(model.fixed_step))


def _kind(root: ET.Element, name: str, model: ExportedModel, *able: str) -> ET.Element:
    return ET.SubElement(root, name, {"modelIdentifier": model.identifier} | dict.fromkeys(able, "true"))


def _told(model: ExportedModel) -> dict[str, str]:
    structured = all(STRUCTURED.fullmatch(scalar.name) for scalar in model.interface.scalars)
    return {
        "modelName": model.name,
        "description": f"{model.name}: a network of 1-D mechanics",
        **{name: told for name, told in asdict(model.rights).items() if told},
        "generationTool": f"inertance {model.version}",
        "variableNamingConvention": "structured" if structured else "flat",
    }


def _units(root: ET.Element, scalars: Iterable[Scalar]) -> None:
    defined = ET.SubElement(root, "UnitDefinitions")
    for name in dict.fromkeys(s.unit for s in scalars if s.unit):
        entry, powers = ET.SubElement(defined, "Unit", name=name), base_units(name)
        if powers is not None:
            ET.SubElement(entry, "BaseUnit", {base: str(power) for base, power in powers.items()})
        for shown, factor in display_units(name).items():
            ET.SubElement(entry, "DisplayUnit", name=shown, factor=repr(factor))


def _type_name(scalar: Scalar) -> str:
    """Return the type of a variable: its quantity, or the choice it is; empty if it has none."""
    if scalar.choices:
        return "Mode: " + " | ".join(scalar.choices)
    return quantity(scalar.unit)


def _types(scalars: Iterable[Scalar]) -> dict[str, Scalar]:
    found: dict[str, Scalar] = {}
    for scalar in scalars:
        found.setdefault(_type_name(scalar), scalar)
    return {name: scalar for name, scalar in found.items() if name}


def _typed(parent: ET.Element, tag: str, scalar: Scalar) -> ET.Element:
    if not scalar.choices:
        return ET.SubElement(parent, tag, quantity=quantity(scalar.unit), unit=scalar.unit)
    listed = ET.SubElement(parent, tag)
    for value, name in enumerate(scalar.choices):
        ET.SubElement(listed, "Item", name=name, value=str(value))
    return listed


def _variables(root: ET.Element, face: Interface, two: bool) -> None:
    variables = ET.SubElement(root, "ModelVariables")
    for scalar in face.scalars:
        attributes, facts = _attributes(scalar), _facts(scalar, face)
        if scalar.derivative_of is not None:
            facts["derivative"] = str(scalar.derivative_of + 1 if two else scalar.derivative_of)
        if two:
            declared = ET.SubElement(variables, "ScalarVariable", attributes)
            ET.SubElement(declared, scalar.type, facts)
        else:
            ET.SubElement(variables, TYPES3[scalar.type], attributes | facts)


def _attributes(scalar: Scalar) -> dict[str, str]:
    told = {
        "name": scalar.name,
        "valueReference": str(scalar.reference),
        "description": scalar.doc,
        "causality": scalar.causality,
        "variability": scalar.variability,
        "initial": scalar.initial,
    }
    return {name: value for name, value in told.items() if value}


def _facts(scalar: Scalar, face: Interface) -> dict[str, str]:
    numbers = {"start": scalar.start, "nominal": scalar.nominal, "min": scalar.least, "max": scalar.most}
    told = {"declaredType": _type_name(scalar), "unit": scalar.unit}
    told |= {name: _written(scalar, value) for name, value in numbers.items() if value is not None}
    if face.jumps and scalar.reference in face.states:
        told["reinit"] = "true"
    return {name: value for name, value in told.items() if value}


def _written(scalar: Scalar, value: float) -> str:
    return {"Boolean": str(bool(value)).lower(), "Integer": f"{value:.0f}"}.get(
        scalar.type, repr(float(value))
    )


Unknown = tuple[int, dict[int, str] | None]


def _unknowns(face: Interface) -> dict[str, list[Unknown]]:
    """Return references of what is computed, each with what it depends on; None: on anything."""
    running: dict[int, dict[int, str]] = {k: {k: "constant"} for k in face.states}
    running |= face.dependencies.running
    discrete = {s.reference for s in face.scalars if s.type != "Real"}
    for unknown, known in running.items():  # other kinds are those of slopes
        dependent = dict.fromkeys(known if unknown in discrete else discrete.intersection(known), "dependent")
        running[unknown] = known | dependent
    starting = face.dependencies.starting
    return {
        "Output": [(s.reference, running.get(s.reference)) for s in face.outputs],
        "ContinuousStateDerivative": [(k, running.get(k)) for k in face.rates],
        "InitialUnknown": [
            (k, dict.fromkeys(starting[k], "dependent") if k in starting else None)
            for k in face.initial_unknowns
        ],
        "EventIndicator": [(k, None) for k in face.indicators],
    }


def _structure2(structure: ET.Element, face: Interface) -> None:
    groups = ("Outputs", "Derivatives", "InitialUnknowns")  # FMI 2 knows no event indicators here
    for group, unknowns in zip(groups, _unknowns(face).values(), strict=False):
        if unknowns:
            listed = ET.SubElement(structure, group)
            for reference, known in unknowns:
                told = None if known is None else {k + 1: way for k, way in known.items()}
                ET.SubElement(listed, "Unknown", {"index": str(reference + 1)} | _dependencies(told))


def _structure3(structure: ET.Element, face: Interface) -> None:
    for kind, unknowns in _unknowns(face).items():
        for reference, known in unknowns:
            ET.SubElement(structure, kind, {"valueReference": str(reference)} | _dependencies(known))


def _dependencies(known: dict[int, str] | None) -> dict[str, str]:
    if known is None:
        return {}
    return {"dependencies": " ".join(map(str, known)), "dependenciesKind": " ".join(known.values())}
