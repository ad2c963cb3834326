"""Validation: the files that describe an FMU, against schemas and FMPy's rules."""

from __future__ import annotations

import zipfile
from collections.abc import Iterator
from pathlib import Path

from .report import Finding

SCHEMAS = {
    "sources/buildDescription.xml": "fmi3BuildDescription.xsd",
    "terminalsAndIcons/terminalsAndIcons.xml": "fmi3TerminalsAndIcons.xsd",
}
PROBLEMS_SHOWN = 3


def xml_findings(subject: str, path: Path) -> Iterator[Finding]:
    """Yield what is found about modelDescription.xml, and the other descriptions that are there."""
    from fmpy.validation import validate_fmu

    yield _finding(subject, "modelDescription.xml", validate_fmu(str(path)))
    with zipfile.ZipFile(path) as archive:
        for name, schema in SCHEMAS.items():
            if name in archive.namelist():
                yield _finding(subject, name.rpartition("/")[2], _problems(archive.read(name), schema))


def _problems(text: bytes, schema: str) -> list[str]:
    import fmpy
    from lxml import etree  # type: ignore[import-untyped]

    folder = Path(fmpy.__file__).parent / "schema" / "fmi3"
    checked = etree.XMLSchema(etree.parse(str(folder / schema)))
    try:
        checked.validate(etree.fromstring(text, etree.XMLParser(resolve_entities=False)))
    except etree.XMLSyntaxError as error:
        return [str(error)]
    return [f"line {e.line}: {e.message}" for e in checked.error_log]


def _finding(subject: str, check: str, problems: list[str]) -> Finding:
    texts = [" ".join(str(problem).split()) for problem in problems]
    more = [f"and {len(texts) - PROBLEMS_SHOWN} more"] if len(texts) > PROBLEMS_SHOWN else []
    return Finding(subject, check, not texts, told="; ".join([*texts[:PROBLEMS_SHOWN], *more]))
