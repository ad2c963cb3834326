"""Validation of foreign descriptions: what harms nothing is mended and told, what harms is refused."""

from __future__ import annotations

import re
from collections import Counter
from functools import cache
from pathlib import Path
from typing import Any

from ..errors import FMUError
from .archive import DESCRIPTION

ANNOTATIONS = "Annotations", "Annotation", "VendorAnnotations"
IGNORED_ELEMENTS = (*ANNOTATIONS, "LogCategories", "SourceFiles")
_LISTS = "UnitDefinitions", "TypeDefinitions", "Outputs", "Derivatives", "InitialUnknowns"
OPTIONAL_LISTS = *IGNORED_ELEMENTS, *_LISTS
ORIGIN = "version", "generationTool", "generationDateAndTime"
HEADLINES = "author", "copyright", "license", "description", *ORIGIN
_KINDS = "ModelExchange", "CoSimulation", "ScheduledExecution"
_TOP = *_KINDS, "UnitDefinitions", "TypeDefinitions", "LogCategories", "DefaultExperiment"
_VARIABLES = "ModelVariables", "ModelStructure"
CHILD_ORDER: dict[str, dict[str, tuple[str, ...]]] = {
    "2": {
        "fmiModelDescription": (*_TOP, "VendorAnnotations", *_VARIABLES),
        "ModelStructure": ("Outputs", "Derivatives", "InitialUnknowns"),
        "Unit": ("BaseUnit", "DisplayUnit"),
    },
    "3": {
        "fmiModelDescription": (*_TOP, *_VARIABLES, "Annotations"),
        "ModelStructure": (
            "Output", "ContinuousStateDerivative", "ClockedState", "InitialUnknown", "EventIndicator",
            "Annotations",
        ),
        "Unit": ("BaseUnit", "DisplayUnit", "Annotations"),
    },
}  # fmt: skip
VARIABLE_CHILD_ORDER = "Annotations", "Dimension", "Start", "Alias"
TOLD_PROBLEMS = 5


def checked(path: Path, root: Any, validate: bool) -> tuple[bytes, list[str]]:
    """Return a description that its schema allows, mended where that changes nothing, and what was amiss.

    Mended are: elements in another order; annotations, categories of logs and lists of source files, which
    nothing reads; empty lists; attributes that the schema does not know; texts about the author, the tool
    and the date that have a wrong form. Whatever else the schema does not allow is refused, if that is asked.
    """
    major, mended = root.get("fmiVersion")[0], Counter[str]()
    schema = _schema(major)
    if not schema.validate(root):
        _sort(root, major, mended)
    while not schema.validate(root) and any([_mend(root, error, mended) for error in schema.error_log]):
        pass
    notes = [f"{what}{f' ({n} times)' if n > 1 else ''}" for what, n in mended.items()]
    problems = [f"line {e.line}: {e.message}" for e in schema.error_log]
    if problems and validate:
        more = [f"and {len(problems) - TOLD_PROBLEMS} more"] if len(problems) > TOLD_PROBLEMS else []
        title = f"'{path}': {DESCRIPTION} is invalid (validate=False, or --no-validate, tries it):"
        raise FMUError("\n  - ".join([title, *problems[:TOLD_PROBLEMS], *more, *notes]))
    return plain(root), [*problems, *notes]


def _etree() -> Any:
    """Return lxml's etree, which is imported only where an FMU is."""
    from lxml import etree  # type: ignore[import-untyped]

    return etree


def parsed(path: Path, text: bytes) -> Any:
    """Return the root of a description; refuse entities, which could lead elsewhere."""
    etree = _etree()
    reader = etree.XMLParser(resolve_entities=False, no_network=True, remove_comments=True, remove_pis=True)
    try:
        root = etree.fromstring(text, reader)
    except etree.XMLSyntaxError as error:
        raise FMUError(f"'{path}': {DESCRIPTION} is no XML: {error}") from error
    for entity in root.iter(etree.Entity):
        raise FMUError(f"'{path}': {DESCRIPTION} is no plain XML: it refers to the entity {entity.text}")
    return root


def plain(root: Any) -> bytes:
    """Return XML without a document type."""
    return bytes(_etree().tostring(root, encoding="utf-8", xml_declaration=True))


@cache
def _schema(major: str) -> Any:
    import fmpy

    return _etree().XMLSchema(
        file=str(Path(fmpy.__file__).parent / "schema" / f"fmi{major}" / f"fmi{major}ModelDescription.xsd")
    )


def _sort(root: Any, major: str, mended: Counter[str]) -> None:
    """Bring children into the order of the schema, where it fixes one and nothing depends on it."""
    places = [(e, CHILD_ORDER[major][e.tag]) for e in root.iter() if e.tag in CHILD_ORDER[major]]
    if major == "3":
        places += [(variable, VARIABLE_CHILD_ORDER) for variable in root.iterfind("ModelVariables/*")]
    for element, order in places:
        if any(child.tag not in order for child in element):
            continue
        ranks = [order.index(child.tag) for child in element]
        if ranks != sorted(ranks):
            odd = next(c for c, a, b in zip(element[1:], ranks, ranks[1:], strict=False) if b < a)
            what = f"'{odd.tag}' in '{element.tag}' comes too late; its place was taken as if it were right"
            mended[what] += 1
            element[:] = [child for tag in order for child in element.findall(tag)]


def _mend(root: Any, error: Any, mended: Counter[str]) -> bool:
    """Take out what an error of the schema is about, if nothing is lost by that; tell whether it was."""
    found = root.xpath(error.path) if error.path else []
    if not found:
        return False
    element = found[0]
    unread = next((e for e in (element, *element.iterancestors()) if e.tag in IGNORED_ELEMENTS), None)
    if unread is not None:
        mended[f"'{unread.tag}' is not as the schema wants it; it was ignored, nothing depends on it"] += 1
        unread.getparent().remove(unread)
        return True
    if "Missing child element" in error.message and element.tag in OPTIONAL_LISTS and not len(element):
        mended[f"'{element.tag}' is empty; it was ignored"] += 1
        element.getparent().remove(element)
        return True
    named = re.search(r"attribute '([^']*)'", error.message)
    if named is None or named[1] not in element.attrib:
        return False
    if "is not allowed" not in error.message and not (element is root and named[1] in HEADLINES):
        return False
    mended[f"the attribute {named[1]}='{element.get(named[1])}' of '{element.tag}' was ignored"] += 1
    del element.attrib[named[1]]
    return True
