"""Files: texts that are read, and what is written, whole or not at all and refused before the work for it."""

import codecs
import errno
import os
import re
import secrets
import shutil
import stat
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path

from .errors import MissingFileError, ModelError, nearest

STREAMS = re.compile(r"/dev/(stdout|stderr|fd/\d+)|/proc/(self|\d+)/fd/\d+")
LONGEST_ENDING = 20


class OutputError(ModelError, OSError):
    """A file that cannot be written; says which and why. What stood there before is untouched."""


class MissingFolderError(OutputError, FileNotFoundError):
    """A file in a folder that there is not."""


@contextmanager
def writing(path: str | Path) -> Iterator[Path]:
    """Give a file to write to, which takes the place of `path` once all went well.

    A file that was there keeps its permissions, a link goes on to point to its file. What cannot be replaced,
    such as a pipe or `/dev/stdout`, or a file in a folder that cannot be written to, is filled at the end.
    Raises an OutputError if it cannot be written, as on a full disk, or a BrokenPipeError if nobody reads it.
    """
    path = Path(path)
    _check_place(path)
    try:
        part, beside = _begun(path)
        try:
            yield part
            _finish(part, path, beside)
        finally:
            part.unlink(missing_ok=True)
    except (OutputError, BrokenPipeError):
        raise
    except OSError as error:
        raise refusal(path, error) from error


def write_text(path: str | Path, text: str) -> Path:
    """Write a text in UTF-8, whole or not at all, and return the path; see `writing`."""
    with writing(path) as part:
        part.write_text(text, encoding="utf-8")
    return Path(path)


def check_output(path: str | Path, endings: Sequence[str] = ()) -> str:
    """Return the ending of a file to be written, in small letters; raise an OutputError if it must not be."""
    path = Path(path)
    ending = path.suffix.lower()
    if endings and ending not in endings and not _is_stream(path):
        told = f"'{path}' ends in '{path.suffix}'" if path.suffix else f"'{path}' has no ending"
        wanted = " or ".join(filter(None, (", ".join(endings[:-1]), endings[-1])))
        raise OutputError(f"{told}; it must end in {wanted}{nearest(ending, endings)}")
    _check_place(path)
    try:
        _begun(path)[0].unlink(missing_ok=True)
    except OSError as error:
        raise refusal(path, error) from error
    return ending


def _check_place(path: Path) -> None:
    try:
        is_folder = stat.S_ISDIR(path.stat().st_mode)
    except FileNotFoundError:
        if _target(path).parent.is_dir():
            return
        told = f"there is no folder '{path.parent}' to write '{path.name}' into; create it first"
        raise MissingFolderError(told) from None
    except OSError as error:
        raise refusal(path, error) from error
    if is_folder:
        raise OutputError(f"'{path}' cannot be written: it is a folder; name a file in it")
    if not os.access(path, os.W_OK):
        raise OutputError(f"'{path}' cannot be written: it is protected; choose another name")


def _is_stream(path: Path) -> bool:
    """Return whether a path is none of a file that may be replaced."""
    irregular = os.path.exists(path) and not os.path.isfile(path)  # not of Path, which may raise
    return irregular or STREAMS.fullmatch(os.path.abspath(path)) is not None


def _target(path: Path) -> Path:
    return Path(os.path.realpath(path))


def _begun(path: Path) -> tuple[Path, bool]:
    """Return a new empty file, and whether it lies where it can take the place of `path`."""
    if not _is_stream(path):
        try:
            return _empty(_target(path).parent, path.suffix), True
        except OSError:
            if not path.exists():
                raise
    return _empty(Path(tempfile.gettempdir()), path.suffix), False


def _empty(folder: Path, ending: str) -> Path:
    part = folder / f".{secrets.token_hex(8)}{ending[-LONGEST_ENDING:]}"
    os.close(os.open(part, os.O_CREAT | os.O_EXCL | os.O_WRONLY, 0o666))
    return part


def _finish(part: Path, path: Path, beside: bool) -> None:
    """Put a file in the place of another, or into what cannot be replaced."""
    if beside:
        target = _target(path)
        with suppress(FileNotFoundError):
            _like(part, target.stat())
        with part.open("r+b") as file:
            os.fsync(file.fileno())
        try:
            os.replace(part, target)
        except OSError as error:
            if error.errno not in (errno.EBUSY, errno.EXDEV):
                raise
        else:
            return
    with part.open("rb") as source, path.open("ab" if _is_stream(path) else "wb") as sink:
        shutil.copyfileobj(source, sink)


def _like(part: Path, before: os.stat_result) -> None:
    """Give a file the owner and the permissions of the one it replaces."""
    now = part.stat()
    if hasattr(os, "chown") and (now.st_uid, now.st_gid) != (before.st_uid, before.st_gid):
        with suppress(OSError):
            os.chown(part, before.st_uid, before.st_gid)
    part.chmod(stat.S_IMODE(before.st_mode))


def refusal(path: Path, error: OSError) -> OutputError:
    """Return what tells, by name, that a file cannot be written."""
    why = (error.strerror or str(error)).lower()
    remedy = {errno.ENOSPC: "; make room", errno.ENAMETOOLONG: "; choose a shorter name"}
    told = remedy.get(error.errno or 0, "; choose another place")
    return OutputError(f"'{path}' cannot be written: {why}{told}")


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
        return file.read(2) in (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)


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
