"""Validation: the files that describe an FMU, against schemas and FMPy's rules."""

from __future__ import annotations

import re
import zipfile
from collections.abc import Iterator
from pathlib import Path

from .report import Finding

SCHEMAS = {
    "sources/buildDescription.xml": "fmi3BuildDescription.xsd",
    "terminalsAndIcons/terminalsAndIcons.xml": "fmi3TerminalsAndIcons.xsd",
}
PROBLEMS_SHOWN = 3
NAME = r"(?:[A-Za-z_]\w*|'[\w!#$%&()*+,./:;<=>?@\[\]^{|}~ -]+')(?:\[\d+(?:,\d+)*\])?"
PLAIN = re.compile(rf"{NAME}(?:\.{NAME})*|der\({NAME}(?:\.{NAME})*(?:,\d+)?\)", re.ASCII)


def xml_findings(subject: str, path: Path) -> Iterator[Finding]:
    """Yield what is found about modelDescription.xml, and the other descriptions that are there."""
    from fmpy.validation import validate_fmu

    problems = [] if _is_plainly_valid(path) else validate_fmu(str(path))
    yield _finding(subject, "modelDescription.xml", problems)
    with zipfile.ZipFile(path) as archive:
        for name, schema in SCHEMAS.items():
            if name in archive.namelist():
                yield _finding(subject, name.rpartition("/")[2], _problems(archive.read(name), schema))


def _is_plainly_valid(path: Path) -> bool:
    """Tell whether FMPy has no complaint, without its parser, which takes hundredths of a second a name.

    Where the answer is no, `validate_fmu` decides: its parser knows some names that are not plain.
    """
    from fmpy import read_model_description

    try:
        with zipfile.ZipFile(path) as archive:
            slashed = not any("\\" in entry.orig_filename for entry in archive.filelist)
        described = read_model_description(str(path), validate=True, validate_model_structure=True)
    except Exception:
        return False
    structured = described.variableNamingConvention == "structured"
    return slashed and structured and all(PLAIN.fullmatch(v.name) for v in described.modelVariables)


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
