"""The description of an FMU: its XML read and checked, its variables."""

from __future__ import annotations

import io
import re
import zipfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

from ..errors import FMUError
from .archive import DESCRIPTION, doubled, read_description
from .validation import checked

KINDS = {"ME": "modelExchange", "CS": "coSimulation"}
FACES = *KINDS.values(), "scheduledExecution"
PLAIN = re.compile(r"\w[\w.+-]*")
REAL = ("Real", "Float64", "Float32")


@dataclass(frozen=True)
class ForeignVariable:
    """One variable of an FMU, as its author declares it; `type` is FMI's name of it.

    A `relative` one is a difference, for which the offset of its unit does not count. `choices` are the
    values of an enumeration by name.
    """

    name: str
    reference: int
    type: str
    causality: str
    variability: str
    initial: str
    unit: str
    start: str | None
    minimum: float
    maximum: float
    size: int
    text: str
    relative: bool
    choices: dict[str, int]

    @property
    def real(self) -> bool:
        """Whether it is a floating-point number."""
        return self.type in REAL

    @property
    def settable(self) -> bool:
        """Whether a value can be given before the start."""
        chosen = self.causality == "input" or self.initial in ("exact", "approx")
        return chosen and self.variability != "constant"

    @property
    def columns(self) -> list[str]:
        """Names of its elements: its own, or `name[1]`, `name[2]`, ..., row by row."""
        return [self.name] if self.size == 1 else [f"{self.name}[{i + 1}]" for i in range(self.size)]


def described(path: Path, validate: bool) -> tuple[Any, list[str]]:
    """Return FMPy's model description, and what in it and its archive breaks the standard but harms nothing.

    Raises:
        FMUError: if it cannot be read, names a file outside of its folder, or is invalid and that is asked.
    """
    from fmpy import read_model_description

    text = read_description(path)
    _check_version(path, text)
    mended, notes = checked(path, text, validate)
    alone = io.BytesIO()
    with zipfile.ZipFile(alone, "w") as archive:
        archive.writestr(DESCRIPTION, mended)
    try:
        description = read_model_description(alone, validate=False)
    except Exception as error:
        raise FMUError(f"'{path}': {DESCRIPTION} is invalid: {error}") from error
    _check_names(path, description)
    return description, [*doubled(path), *notes, *_breaches(description)]


def _check_names(path: Path, description: Any) -> None:
    """Refuse names that lead to other files, or to two variables."""
    for name in _identifiers(description):
        if not PLAIN.fullmatch(name) or ".." in name:
            raise FMUError(
                f"'{path}': modelIdentifier={name!r} is no plain name of a file, so that its library could "
                "be anywhere: nothing was unpacked or run"
            )
    known: dict[str, tuple[int, str]] = {}
    for v in description.modelVariables:
        face = v.valueReference, v.type
        if known.setdefault(v.name, face) != face:
            raise FMUError(
                f"'{path}': {DESCRIPTION} has two variables called '{v.name}' that are not the same"
            )


def _breaches(description: Any) -> list[str]:
    """Return what breaks rules beyond the schema, though it can be read."""
    from fmpy.validation import validate_model_description

    odd = [
        f"modelIdentifier='{name}' is no C identifier"
        for name in _identifiers(description)
        if not re.fullmatch(r"[A-Za-z_]\w*", name, re.ASCII)
    ]
    try:
        found = validate_model_description(description)
    except KeyError as error:
        found = [f"the unit {error}, which has a display unit, is not defined"]
    return odd + [" ".join(str(problem).split()) for problem in found]


def _identifiers(description: Any) -> list[str]:
    faces = [face for name in FACES if (face := getattr(description, name)) is not None]
    return list(dict.fromkeys(str(face.modelIdentifier) for face in faces))


def _check_version(path: Path, text: bytes) -> None:
    try:
        root = ElementTree.fromstring(text)
    except ElementTree.ParseError as error:
        raise FMUError(f"'{path}': {DESCRIPTION} is no XML: {error}") from error
    version = root.get("fmiVersion")
    if root.tag != "fmiModelDescription" or version is None:
        raise FMUError(f"'{path}': {DESCRIPTION} describes no FMU (no fmiVersion)")
    if version != "2.0" and not version.startswith("3.0"):
        raise FMUError(f"'{path}' is FMI {version}; only FMI 2.0 and 3.0 can be imported, export it anew")


def foreign_variable(declared: Any, relative: bool) -> ForeignVariable:
    """Return a variable of FMPy's model description as ours; `relative` if it says so itself."""
    kind = declared.declaredType
    size = 1
    for length in declared.shape or ():
        size *= int(length)
    return ForeignVariable(
        declared.name, declared.valueReference, declared.type, declared.causality, declared.variability,
        declared.initial or "", declared.unit or (kind.unit if kind else None) or "", declared.start,
        float(_given(declared.min, kind and kind.min, "-inf")),
        float(_given(declared.max, kind and kind.max, "inf")),
        size, declared.description or "", relative or bool(kind and kind.relativeQuantity),
        {str(item.name): int(item.value) for item in (kind.items if kind else ())},
    )  # fmt: skip


def _given(*values: Any) -> Any:
    return next(value for value in values if value is not None)
