"""The model description of an FMU: its XML read through FMPy, and checked."""

from __future__ import annotations

import io
import re
import zipfile
from pathlib import Path
from typing import Any

from ..errors import FMUError
from .archive import DESCRIPTION, MOST_DESCRIPTION_BYTES, doubled, read_entry
from .validation import checked, parsed, plain

KINDS = {"ME": "ModelExchange", "CS": "CoSimulation"}
FACES = {"ME": "modelExchange", "CS": "coSimulation"}  # FMPy's names
PLAIN_NAME = re.compile(r"\w[\w.+-]*")


def read_model_description(path: Path, validate: bool) -> tuple[Any, bytes, list[str]]:
    """Return FMPy's model description, its text, and what breaks the standard but harms nothing.

    Refused is what cannot be read, names a file outside of its folder, or is invalid, if that is asked.
    """
    import fmpy

    root = parsed(path, read_entry(path, DESCRIPTION, "FMU", MOST_DESCRIPTION_BYTES))
    _check_version(path, root)
    text = plain(root)
    mended, notes = checked(path, root, validate)
    alone = io.BytesIO()
    with zipfile.ZipFile(alone, "w") as archive:
        archive.writestr(DESCRIPTION, mended)
    try:
        description = fmpy.read_model_description(alone, validate=False)
    except Exception as error:
        raise FMUError(f"'{path}': {DESCRIPTION} is invalid: {error}") from error
    _check_names(path, description)
    return description, text, [*doubled(path), *notes, *_breaches(description)]


def _check_names(path: Path, description: Any) -> None:
    """Refuse names that lead to other files, or to two variables."""
    for name in _identifiers(description):
        if not PLAIN_NAME.fullmatch(name) or ".." in name:
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
    faces = (getattr(description, name) for name in (*FACES.values(), "scheduledExecution"))
    return list(dict.fromkeys(str(face.modelIdentifier) for face in faces if face is not None))


def _check_version(path: Path, root: Any) -> None:
    version = root.get("fmiVersion")
    if root.tag != "fmiModelDescription" or version is None:
        raise FMUError(f"'{path}': {DESCRIPTION} describes no FMU (no fmiVersion)")
    if version != "2.0" and not version.startswith("3.0"):
        raise FMUError(f"'{path}' is FMI {version}; only FMI 2.0 and 3.0 can be imported, export it anew")
