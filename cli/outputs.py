"""What a command writes: refused before the work where it cannot be, and written whole."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Any

from ..base import OutputError, check_output, writing
from .failure import WRONG_USE, fail

PAGES, JSON, PICTURES, TABLES = (".html", ".htm"), (".json",), (".png", ".pdf", ".svg"), (".csv",)


def expect(option: str, path: Path | None, endings: Iterable[str]) -> None:
    """End the command if a file that an option names cannot be written."""
    if path is None:
        return
    try:
        check_output(path, tuple(endings))
    except OutputError as error:
        fail(f"{option}: {error}", WRONG_USE)


def draw(figure: Any, path: Path, dpi: int = 120) -> Path:
    """Write a figure and return the path."""
    with writing(path) as part:
        figure.savefig(part, dpi=dpi)
    return path
