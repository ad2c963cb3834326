"""Kept files: what was costly to make, for other processes; of too much the least lately used goes first."""

from __future__ import annotations

import os
import shutil
import sys
import tempfile
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path
from tempfile import TemporaryDirectory

MOST_BYTES = 128 * 2**20  # of all files; a compiled network has some 60 kB
KINDS = (".so", ".o")
OTHERS_MAY_WRITE = 0o022


@dataclass(frozen=True)
class KeptFiles:
    """Files called `name-sum.so`: the name tells what they are made of, the sum is that of their bytes.

    Attributes:
        path: the folder; None if nothing can be kept.
    """

    path: Path | None

    def files(self) -> list[Path]:
        """Return the files, the lately used ones first."""
        return [Path(path) for _, _, path in self._told()]

    def holds(self, beginning: str) -> bool:
        """Tell whether there is a file whose name begins so."""
        return any(True for _ in self._named(beginning))

    def find(self, name: str) -> Path | None:
        """Return a file by its name, which from now on is lately used; what is not whole is removed."""
        for path in map(Path, self._named(f"{name}-")):
            with suppress(OSError):
                if path.stem == f"{name}-{_sum(path)}":
                    os.utime(path)
                    return path
                path.unlink()
        return None

    def keep(self, made: Path, name: str) -> Path | None:
        """Keep a file, whole or not at all (on a full disk), and remove what was used longest ago."""
        if self.path is None:
            return None
        kept = self.path / f"{name}-{_sum(made)}{made.suffix}"
        try:
            with TemporaryDirectory(dir=self.path, prefix=".") as folder:
                os.replace(shutil.copy(made, folder), kept)
        except OSError:
            return None
        self._remove(MOST_BYTES)
        return kept

    def clear(self) -> int:
        """Remove all files; return how many there were."""
        return self._remove(0)

    def _remove(self, most: int) -> int:
        """Remove files until they are no larger than that [bytes], the lately used ones last."""
        total = removed = 0
        for _, size, path in self._told():
            total += size
            if total > most:
                with suppress(OSError):
                    os.unlink(path)
                    removed += 1
        return removed

    def _told(self) -> list[tuple[float, int, str]]:
        """Return when each file was used last, its size and its path, the lately used ones first."""
        found = []
        for entry in self._named(""):
            with suppress(OSError):  # it was removed meanwhile
                told = entry.stat()
                found.append((told.st_mtime, told.st_size, entry.path))
        return sorted(found, reverse=True)

    def _named(self, beginning: str) -> Iterator[os.DirEntry[str]]:
        if self.path is None:
            return
        with suppress(OSError), os.scandir(self.path) as entries:
            yield from (e for e in entries if e.name.startswith(beginning) and e.name.endswith(KINDS))


def _sum(path: Path) -> str:
    return sha256(path.read_bytes()).hexdigest()[:32]


def kept_files() -> KeptFiles:
    """Return what is kept in the user's cache, else among temporary files; nobody else can write there."""
    return KeptFiles(next(filter(_is_private, _candidates()), None))


def _candidates() -> Iterator[Path]:
    given = os.environ.get("LOCALAPPDATA" if sys.platform == "win32" else "XDG_CACHE_HOME", "")
    with suppress(RuntimeError):  # no home
        yield (Path(given) if os.path.isabs(given) else Path.home() / ".cache") / "inertance"
    own = "" if sys.platform == "win32" else f"-{os.getuid()}"
    with suppress(OSError):  # no folder for temporary files
        yield Path(tempfile.gettempdir()) / f"inertance{own}"


def _is_private(folder: Path) -> bool:
    """Tell whether there is such a folder, or can be, and only its owner can write to it."""
    try:
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        told = folder.lstat() if sys.platform != "win32" else folder.stat()
    except OSError:
        return False
    if not os.access(folder, os.W_OK):
        return False
    return sys.platform == "win32" or not (
        folder.is_symlink() or told.st_uid != os.getuid() or told.st_mode & OTHERS_MAY_WRITE
    )
