"""modelDescription.xml: what an FMU tells of itself, for FMI 2.0 and 3.0."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import asdict, dataclass
from xml.etree import ElementTree as ET

from .units import QUANTITY, base_units, display_units
from .variables import Interface, Scalar

CATEGORIES = {
    "logStatusError": "refused calls and failed computations",
    "logStatusDiscard": "computations that are not possible where the model stands",
}
PART = r"[A-Za-z_][A-Za-z0-9_]*(\[\d+\])?"
STRUCTURED = re.compile(rf"{PART}(\.{PART})*|der\({PART}(\.{PART})*(,\d+)?\)")


@dataclass(frozen=True)
class Rights:
    """Whose model it is and on which terms; what is empty is not told."""

    author: str = ""
    version: str = ""
    copyright: str = ""
    license: str = ""


@dataclass(frozen=True)
class Model:
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


def model_description(model: Model, fmi_version: str) -> bytes:
    """Return modelDescription.xml."""
    return text(_fmi2(model) if fmi_version == "2.0" else _fmi3(model))


def text(root: ET.Element) -> bytes:
    """Return an indented document."""
    ET.indent(root)
    written: bytes = ET.tostring(root, encoding="utf-8", xml_declaration=True)
    return written + b"\n"


def _fmi2(model: Model) -> ET.Element:
    face = model.interface
    root = ET.Element("fmiModelDescription", {"fmiVersion": "2.0", "guid": model.token} | _told(model))
    root.set("numberOfEventIndicators", str(len(face.indicators)))
    common = {
        "modelIdentifier": model.identifier,
        "canGetAndSetFMUstate": "true",
        "canSerializeFMUstate": "true",
        "providesDirectionalDerivative": "true",
    }
    exchange = ET.SubElement(root, "ModelExchange", common)
    steps = ET.SubElement(
        root,
        "CoSimulation",
        common,
        canHandleVariableCommunicationStepSize="true",
        canInterpolateInputs="true",
    )
    for kind in (exchange, steps) if model.sources else ():
        listed = ET.SubElement(kind, "SourceFiles")
        for name in model.sources:
            ET.SubElement(listed, "File", name=name)
    _units(root, face.scalars)
    types = ET.SubElement(root, "TypeDefinitions")
    for name, used in _types(face.scalars).items():
        kind = ET.SubElement(types, "SimpleType", name=name)
        _typed(kind, "Enumeration" if used.choices else "Real", used)
    _categories(root)
    _experiment(root, model)
    variables = ET.SubElement(root, "ModelVariables")
    for scalar in face.scalars:
        attributes, facts = _attributes(scalar), _facts(scalar, face)
        declared = ET.SubElement(variables, "ScalarVariable", attributes)
        if scalar.derivative_of is not None:
            facts["derivative"] = str(scalar.derivative_of + 1)
        ET.SubElement(declared, "Enumeration" if scalar.choices else "Real", facts)
    _structure2(root, face)
    return root


def _fmi3(model: Model) -> ET.Element:
    face = model.interface
    root = ET.Element(
        "fmiModelDescription", {"fmiVersion": "3.0", "instantiationToken": model.token} | _told(model)
    )
    common = {
        "modelIdentifier": model.identifier,
        "canGetAndSetFMUState": "true",
        "canSerializeFMUState": "true",
        "providesDirectionalDerivatives": "true",
        "providesAdjointDerivatives": "true",
    }
    ET.SubElement(root, "ModelExchange", common, needsCompletedIntegratorStep="true")
    steps = ET.SubElement(
        root, "CoSimulation", common, canHandleVariableCommunicationStepSize="true", hasEventMode="true",
        mightReturnEarlyFromDoStep="true",
    )  # fmt: skip
    if model.fixed_step:
        steps.set("fixedInternalStepSize", repr(model.fixed_step))
    _units(root, face.scalars)
    types = ET.SubElement(root, "TypeDefinitions")
    for name, used in _types(face.scalars).items():
        _typed(types, "EnumerationType" if used.choices else "Float64Type", used).set("name", name)
    _categories(root)
    _experiment(root, model)
    variables = ET.SubElement(root, "ModelVariables")
    for scalar in face.scalars:
        attributes = _attributes(scalar) | _facts(scalar, face)
        if scalar.derivative_of is not None:
            attributes["derivative"] = str(scalar.derivative_of)
        ET.SubElement(variables, "Enumeration" if scalar.choices else "Float64", attributes)
    _structure3(root, face)
    return root


def _told(model: Model) -> dict[str, str]:
    return {
        "modelName": model.name,
        "description": f"{model.name}: a network of 1-D mechanics",
        **{name: told for name, told in asdict(model.rights).items() if told},
        "generationTool": f"inertance {model.version}",
        "variableNamingConvention": _convention(model.interface.scalars),
    }


def _convention(scalars: Iterable[Scalar]) -> str:
    """Return "structured" if all names are of ASCII letters, digits and underscores, else "flat"."""
    return "structured" if all(STRUCTURED.fullmatch(scalar.name) for scalar in scalars) else "flat"


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
    return QUANTITY.get(scalar.unit, "")


def _types(scalars: Iterable[Scalar]) -> dict[str, Scalar]:
    found: dict[str, Scalar] = {}
    for scalar in scalars:
        name = _type_name(scalar)
        if name:
            found.setdefault(name, scalar)
    return found


def _typed(parent: ET.Element, tag: str, scalar: Scalar) -> ET.Element:
    if not scalar.choices:
        return ET.SubElement(parent, tag, quantity=QUANTITY[scalar.unit], unit=scalar.unit)
    listed = ET.SubElement(parent, tag)
    for value, name in enumerate(scalar.choices):
        ET.SubElement(listed, "Item", name=name, value=str(value))
    return listed


def _categories(root: ET.Element) -> None:
    listed = ET.SubElement(root, "LogCategories")
    for name, told in CATEGORIES.items():
        ET.SubElement(listed, "Category", name=name, description=told)


def _experiment(root: ET.Element, model: Model) -> None:
    numbers = {"startTime": 0.0, "stopTime": model.stop, "tolerance": model.tolerance, "stepSize": model.step}
    ET.SubElement(root, "DefaultExperiment", {k: repr(v) for k, v in numbers.items()})


def _attributes(scalar: Scalar) -> dict[str, str]:
    attributes = {"name": scalar.name, "valueReference": str(scalar.reference)}
    if scalar.doc:
        attributes["description"] = scalar.doc
    attributes |= {"causality": scalar.causality, "variability": scalar.variability}
    if scalar.initial:
        attributes["initial"] = scalar.initial
    return attributes


def _facts(scalar: Scalar, face: Interface) -> dict[str, str]:
    facts = {}
    if _type_name(scalar):
        facts["declaredType"] = _type_name(scalar)
    if scalar.unit:
        facts["unit"] = scalar.unit
    numbers = {"start": scalar.start, "nominal": scalar.nominal, "min": scalar.least, "max": scalar.most}
    facts |= {name: repr(float(value)) for name, value in numbers.items() if value is not None}
    if face.jumps and scalar.reference in face.states:
        facts["reinit"] = "true"
    return facts


def _structure2(root: ET.Element, face: Interface) -> None:
    structure = ET.SubElement(root, "ModelStructure")
    groups = {
        "Outputs": [s.reference for s in face.outputs],
        "Derivatives": list(face.rates),
        "InitialUnknowns": face.initial_unknowns,
    }
    for group, references in groups.items():
        if not references:
            continue
        listed = ET.SubElement(structure, group)
        for reference in references:
            known = _starting(face, reference) if group == "InitialUnknowns" else _running(face, reference)
            told = {} if known is None else _listed({k + 1: kind for k, kind in known.items()})
            ET.SubElement(listed, "Unknown", {"index": str(reference + 1)} | told)


def _structure3(root: ET.Element, face: Interface) -> None:
    structure = ET.SubElement(root, "ModelStructure")
    groups = {
        "Output": [s.reference for s in face.outputs],
        "ContinuousStateDerivative": list(face.rates),
        "InitialUnknown": face.initial_unknowns,
        "EventIndicator": list(face.indicators),
    }
    for group, references in groups.items():
        for reference in references:
            known = _starting(face, reference) if group == "InitialUnknown" else _running(face, reference)
            told = {} if known is None else _listed(known)
            ET.SubElement(structure, group, {"valueReference": str(reference)} | told)


def _running(face: Interface, reference: int) -> dict[int, str] | None:
    """Return what an unknown depends on; None for a mode or an indicator: on anything."""
    if reference in face.states:
        return {reference: "constant"}
    return face.dependencies.running.get(reference)


def _starting(face: Interface, reference: int) -> dict[int, str] | None:
    known = face.dependencies.starting.get(reference)
    return None if known is None else dict.fromkeys(known, "dependent")


def _listed(known: dict[int, str]) -> dict[str, str]:
    references = " ".join(map(str, known))
    return {"dependencies": references, "dependenciesKind": " ".join(known.values())}
