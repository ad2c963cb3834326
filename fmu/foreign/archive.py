"""Archives: what is inside an .fmu, read and unpacked without trusting it."""

from __future__ import annotations

import lzma
import stat
import zipfile
import zlib
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path, PurePosixPath

from ..errors import FMUError

DESCRIPTION = "modelDescription.xml"
LIBRARY_ENDINGS = ".so", ".dll", ".dylib"
CHUNK_BYTES = 1 << 20
MOST_BYTES, MOST_DESCRIPTION_BYTES, UNSUSPECTED_BYTES = 4 << 30, 512 << 20, 64 << 20
MOST_RATIO, MOST_ENTRIES = 200, 100_000
BROKEN_ARCHIVE = (zipfile.BadZipFile, zlib.error, lzma.LZMAError, EOFError, OSError, RuntimeError)


def platform_folder(version: str) -> str:
    """Return the folder of `binaries/` that this machine runs, as FMI `version` names it."""
    import fmpy

    return str(fmpy.platform_tuple if version.startswith("3") else fmpy.platform)


def library_name(identifier: str) -> str:
    """Return the file name of a model's library on this machine."""
    import fmpy

    return f"{identifier}{fmpy.sharedLibraryExtension}"


def platforms(path: Path) -> list[str]:
    """Return the folders of `binaries/` that hold a library."""
    with _opened(path) as archive:
        files = [PurePosixPath(name) for name in archive.namelist() if name.endswith(LIBRARY_ENDINGS)]
    return sorted({file.parts[1] for file in files if len(file.parts) == 3 and file.parts[0] == "binaries"})


def read_entry(path: Path, name: str, kind: str, most: int = MOST_BYTES) -> bytes:
    """Return an entry that an archive of this kind must have; refuse one that is broken or unsafe."""
    with _opened(path) as archive:
        if name not in archive.namelist():
            raise FMUError(f"'{path}' has no {name}: it is no {kind}")
        _check_single(path, archive, {name})
        return b"".join(_chunks(path, archive, name, min(most, _most_bytes(path))))


def unpack(path: Path, folder: Path, binaries: str) -> None:
    """Unpack what a run needs into an empty folder: description, resources, one folder of `binaries/`."""
    wanted = f"binaries/{binaries}/", "resources/"
    (folder / "resources").mkdir()
    with _opened(path) as archive:
        left = _most_bytes(path)
        files = (name for name in archive.namelist() if not name.endswith("/"))
        needed = {name for name in files if name == DESCRIPTION or name.startswith(wanted)}
        _check_single(path, archive, needed)
        for name in sorted(needed):
            target = folder / name
            target.parent.mkdir(parents=True, exist_ok=True)
            with target.open("wb") as file:
                for chunk in _chunks(path, archive, name, left):
                    file.write(chunk)
                    left -= len(chunk)


@contextmanager
def _opened(path: Path) -> Iterator[zipfile.ZipFile]:
    if path.is_dir():
        raise FMUError(f"'{path}' is a folder, no file")
    if not path.is_file():
        raise FMUError(f"there is no file '{path}'")
    try:
        with zipfile.ZipFile(path) as archive:
            _check_names(path, archive)
            yield archive
    except BROKEN_ARCHIVE as error:
        if isinstance(error, FMUError):
            raise
        raise FMUError(f"'{path}' cannot be unpacked, it is no sound zip archive: {error}") from error


def _check_names(path: Path, archive: zipfile.ZipFile) -> None:
    """Refuse an archive that could write outside its folder, before anything is read from it."""
    entries = archive.infolist()
    if len(entries) > MOST_ENTRIES:
        raise FMUError(f"'{path}' has {len(entries)} entries, more than {MOST_ENTRIES}: nothing was unpacked")
    for entry in entries:
        name = entry.orig_filename
        if problem := _problem(name, entry):
            raise FMUError(f"'{path}': the entry '{name}' {problem}: nothing was unpacked")


def doubled(path: Path) -> list[str]:
    """Return notes on files that an archive has twice, of which one is taken if they are the same."""
    with _opened(path) as archive:
        count = Counter(entry.filename for entry in archive.infolist() if not entry.is_dir())
        return [f"the entry '{name}' comes {n} times" for name, n in count.items() if n > 1]


def _check_single(path: Path, archive: zipfile.ZipFile, names: set[str]) -> None:
    """Refuse files that come twice with other contents, as tools would not agree which of them counts."""
    seen: dict[str, tuple[int, int]] = {}
    for entry in archive.infolist():
        content = entry.CRC, entry.file_size
        if entry.filename in names and seen.setdefault(entry.filename, content) != content:
            raise FMUError(f"'{path}': the entry '{entry.filename}' comes twice, with other contents")


def _problem(name: str, entry: zipfile.ZipInfo) -> str:
    if "\\" in name or ":" in name or "\0" in name:
        return "has a character that no path of an FMU may have"
    if name.startswith("/"):
        return "is an absolute path"
    if ".." in name.split("/"):
        return "leads out of the archive"
    kind = stat.S_IFMT(entry.external_attr >> 16)
    if kind not in (0, stat.S_IFREG, stat.S_IFDIR):
        return "is a link or a device, no plain file"
    return "is encrypted" if entry.flag_bits & 1 else ""


def _most_bytes(path: Path) -> int:
    return min(MOST_BYTES, max(UNSUSPECTED_BYTES, MOST_RATIO * path.stat().st_size))


def _chunks(path: Path, archive: zipfile.ZipFile, name: str, most: int) -> Iterator[bytes]:
    """Yield an entry piece by piece; what counts is what comes out, not what the header promises."""
    with archive.open(name) as stream:
        while chunk := stream.read(CHUNK_BYTES):
            most -= len(chunk)
            if most < 0:
                raise FMUError(
                    f"'{path}' unpacks to more than {MOST_RATIO} times its size (at '{name}'): "
                    "it looks like a zip bomb and was not unpacked"
                )
            yield chunk
