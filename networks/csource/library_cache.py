"""Library cache: what was compiled is kept in a folder of the user's, for whoever needs the same C again."""

from __future__ import annotations

import json
import os
import platform
import shutil
import sys
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from hashlib import sha256
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TypeVar

from .toolchain import compile_shared, toolchain

MOST_KEPT = 1000  # libraries, of some 60 kB each; the least lately used go first
OTHERS_MAY_WRITE = 0o022
Loaded = TypeVar("Loaded")


def library(texts: Mapping[str, str], flags: Sequence[str], load: Callable[[Path], Loaded]) -> Loaded:
    """Return what is loaded of C files, compiled unless that was done before, by this process or another.

    A library is known by all that it is made of: every file, the compiler, its flags, the machine. It is kept
    in `inertance` in XDG_CACHE_HOME (or ~/.cache; on Windows LOCALAPPDATA), and only there if nobody else can
    write to that folder.

    Args:
        texts: C files and headers by name.
        flags: for the compiler, see `compile_shared`.
        load: of the path of a library, which may be gone afterwards.

    Raises:
        ToolchainError: if there is no compiler, or it fails.
    """
    folder = _private_folder()
    kept = None if folder is None else folder / f"{_digest(texts, flags)}.so"
    if kept is not None and kept.exists():
        with suppress(OSError):  # it was removed meanwhile, or is damaged
            found = load(kept)
            os.utime(kept)
            return found
    with TemporaryDirectory(prefix="inertance-", ignore_cleanup_errors=True) as scratch:
        for name, text in texts.items():
            Path(scratch, name).write_text(text, encoding="utf-8")
        listed = [Path(scratch, name) for name in texts if name.endswith(".c")]
        made = compile_shared(listed, Path(scratch, "network.so"), flags=flags)
        found = load(made)
        if kept is not None:
            _keep(made, kept)
    return found


def _digest(texts: Mapping[str, str], flags: Sequence[str]) -> str:
    machine = sys.platform, platform.machine(), platform.node()
    told = [*machine, *toolchain(flags), sorted(texts.items())]
    return sha256(json.dumps(told).encode()).hexdigest()


def _private_folder() -> Path | None:
    """Return the folder of kept libraries; None if there is none, or others may write to it."""
    given = os.environ.get("LOCALAPPDATA" if sys.platform == "win32" else "XDG_CACHE_HOME", "")
    try:
        folder = (Path(given) if os.path.isabs(given) else Path.home() / ".cache") / "inertance"
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        told = folder.stat()
    except (OSError, RuntimeError):  # not writable; no home
        return None
    if sys.platform != "win32" and (told.st_uid != os.getuid() or told.st_mode & OTHERS_MAY_WRITE):
        return None
    return folder


def _keep(made: Path, kept: Path) -> None:
    """Keep a library, whole or not at all (on a full disk), and remove what was used longest ago."""
    with suppress(OSError), TemporaryDirectory(dir=kept.parent) as folder:
        os.replace(shutil.copy(made, folder), kept)
        latest = sorted(kept.parent.glob("*.so"), key=lambda path: path.stat().st_mtime, reverse=True)
        for path in latest[MOST_KEPT:]:
            path.unlink(missing_ok=True)
