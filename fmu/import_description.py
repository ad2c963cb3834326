"""The description of an FMU: its XML read and checked, its variables."""

from __future__ import annotations

import io
import zipfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

from .archive import DESCRIPTION, read_description
from .errors import FMUError

KINDS = {"ME": "modelExchange", "CS": "coSimulation"}
REAL = ("Real", "Float64", "Float32")


@dataclass(frozen=True)
class ForeignVariable:
    """One variable of an FMU, as its author declares it; `type` is FMI's name of it."""

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
    """Return FMPy's model description, and what in it breaks the standard though it can be read.

    Raises:
        FMUError: if it cannot be read, or its schema does not allow it and that is asked.
    """
    from fmpy import read_model_description
    from fmpy.model_description import ValidationError

    text = read_description(path)
    _check_version(path, text)
    alone = io.BytesIO()
    with zipfile.ZipFile(alone, "w") as archive:
        archive.writestr(DESCRIPTION, text)
    try:
        try:
            return read_model_description(alone), []
        except ValidationError as error:
            problems = [" ".join(str(problem).split()) for problem in error.problems]
            against_schema = any(problem.startswith(("ERROR", "FATAL")) for problem in problems)
            if validate and against_schema:
                told = [*problems[:5], *([f"and {len(problems) - 5} more"] if len(problems) > 5 else [])]
                raise FMUError(
                    "\n  - ".join([f"'{path}': {DESCRIPTION} is invalid (validate=False tries it):", *told])
                ) from error
            return read_model_description(alone, validate=False), problems
    except FMUError:
        raise
    except Exception as error:
        raise FMUError(f"'{path}': {DESCRIPTION} is invalid: {error}") from error


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


def foreign_variable(declared: Any) -> ForeignVariable:
    """Return a variable of FMPy's model description as ours."""
    kind = declared.declaredType
    size = 1
    for length in declared.shape or ():
        size *= int(length)
    return ForeignVariable(
        declared.name, declared.valueReference, declared.type, declared.causality, declared.variability,
        declared.initial or "", declared.unit or (kind.unit if kind else None) or "", declared.start,
        float(_given(declared.min, kind and kind.min, "-inf")),
        float(_given(declared.max, kind and kind.max, "inf")),
        size, declared.description or "",
    )  # fmt: skip


def _given(*values: Any) -> Any:
    return next(value for value in values if value is not None)
