"""Library cache: C files as a library, compiled unless that was done before, by this process or another."""

from __future__ import annotations

import json
import os
import platform
import shutil
import sys
import weakref
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from hashlib import sha256
from pathlib import Path
from tempfile import mkdtemp
from typing import TypeVar

from ...base.kept_files import kept_files
from .toolchain import Compilation, ToolchainError, toolchain

Loaded = TypeVar("Loaded")


class Library:
    """C files on their way to a library, which a compiler makes beside what goes on.

    It is known by all that it is made of: every file, the compiler, its flags, the machine.

    Args:
        texts: C files and headers by name.
        flags: for the compiler, see `compile_shared`.
        mark: beginning of the name under which it is kept.

    Raises:
        ToolchainError: if there is no compiler.
    """

    def __init__(self, texts: Mapping[str, str], flags: Sequence[str], mark: str = "c") -> None:
        self._texts, self._flags = texts, flags
        self.name = f"{mark}-{_digest(texts, flags)}"
        self._making: _Making | None = None

    def begin(self) -> None:
        """Let it be compiled, unless it is kept, or this has begun."""
        if not self.is_ready() and not self._is_made_here():
            self._making = _Making(self.name, self._texts, self._flags)

    def is_ready(self) -> bool:
        """Tell whether it is kept, or the compiler has ended."""
        if self._making is not None and self._is_made_here():
            return self._making.is_over()
        return kept_files().find(self.name) is not None

    def load(self, load: Callable[[Path], Loaded]) -> Loaded:
        """Wait until it is compiled, and return what is loaded of its path, which may be gone afterwards.

        Raises:
            ToolchainError: if the compiler fails.
        """
        folder = kept_files()
        kept = folder.find(self.name)
        if kept is not None:
            with suppress(OSError):  # it was removed meanwhile, or is for another machine
                return load(kept)
        making = self._making if self._is_made_here() else None
        making = making or _Making(self.name, self._texts, self._flags)
        try:
            return load(making.result())
        finally:
            self._making = None
            making.end()

    def _is_made_here(self) -> bool:
        """Tell whether this process, and not one that it was forked from, has it compiled."""
        return self._making is not None and self._making.process == os.getpid()


class _Making:
    """A compiler at work in a folder of its own, which goes at the end, at the latest of this process.

    What is compiled by then is kept.
    """

    def __init__(self, name: str, texts: Mapping[str, str], flags: Sequence[str]) -> None:
        self.process = os.getpid()
        scratch = Path(mkdtemp(prefix="inertance-"))
        for file, text in texts.items():
            (scratch / file).write_text(text, encoding="utf-8")
        listed = [scratch / file for file in texts if file.endswith(".c")]
        self._compilation = Compilation(listed, scratch / "network.so", flags=flags)
        self.end = weakref.finalize(self, _ended, self._compilation, name, scratch, self.process)

    def is_over(self) -> bool:
        return self._compilation.is_over()

    def result(self) -> Path:
        return self._compilation.result()


def _ended(compilation: Compilation, name: str, scratch: Path, process: int) -> None:
    if process != os.getpid():
        return
    if compilation.is_over():
        with suppress(ToolchainError):
            kept_files().keep(compilation.result(), name)
    compilation.abandon()
    shutil.rmtree(scratch, ignore_errors=True)


def _digest(texts: Mapping[str, str], flags: Sequence[str]) -> str:
    machine = sys.platform, platform.machine(), platform.node()
    told = [*machine, *toolchain(flags), sorted(texts.items())]
    return sha256(json.dumps(told).encode()).hexdigest()
