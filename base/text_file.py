"""Text files as people have them: UTF-8, or UTF-16 where a byte order mark says so."""

import codecs
from pathlib import Path

from .errors import MissingFileError, ModelError, nearest

_UTF_16 = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)


def text_of(path: Path) -> str:
    """Return the text of a file; raise a ModelError, with the line, for bytes that are no text."""
    there_is_file(path)
    content = path.read_bytes()
    encoding = "utf-16" if is_utf_16(path) else "utf-8-sig"
    try:
        return content.decode(encoding)
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        raise ModelError(
            f"{path}: not a text file in UTF-8 (line {line}, byte 0x{content[error.start]:02x}: "
            f"{error.reason}); save it as UTF-8"
        ) from error


def is_utf_16(path: Path) -> bool:
    """Return whether a file begins with the mark of UTF-16."""
    with path.open("rb") as file:
        return file.read(2) in _UTF_16


def there_is_file(path: Path) -> None:
    """Raise a MissingFileError if there is no such file, with the nearest one."""
    if not path.is_file():
        folder = path.parent
        others = [p.name for p in folder.iterdir() if p.is_file()] if folder.is_dir() else []
        raise MissingFileError(f"there is no file '{path}'{nearest(path.name, others)}")


def path_of(value: object, what: str) -> Path:
    """Return a path that was given as text or as a path; raise a ModelError for anything else."""
    if isinstance(value, str | Path) and str(value).strip():
        return Path(value)
    raise ModelError(f"{what} is the path of a file, got {value!r}")
