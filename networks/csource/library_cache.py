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


class CLibrary:
    """C files on their way to a library, which a compiler makes beside what goes on.

    It is known by all that it is made of: every file, the compiler, its flags, the machine, its parts.

    Args:
        texts: C files and headers by name.
        flags: for the compiler, see `compile_shared`.
        mark: beginning of the name under which it is kept.
        parts: object files that are linked to it.
        suffix: ".o" for such a part.

    Raises:
        ToolchainError: if there is no compiler.
    """

    def __init__(
        self,
        texts: Mapping[str, str],
        flags: Sequence[str],
        mark: str = "c",
        parts: Sequence[CLibrary] = (),
        suffix: str = ".so",
    ) -> None:
        self._texts, self._flags, self._parts, self._suffix = texts, flags, parts, suffix
        machine = sys.platform, platform.machine(), platform.node()
        told = [*machine, *toolchain(flags), sorted(texts.items()), suffix, [part.name for part in parts]]
        self.name: str = f"{mark}-{sha256(json.dumps(told).encode()).hexdigest()}"
        self._making: _Making | None = None

    def begin(self) -> None:
        """Let it be compiled, unless it is kept, or this has begun."""
        if not self.is_ready() and not self._is_made_here():
            self._made_here()

    def is_ready(self) -> bool:
        """Tell whether it is kept, or the compiler has ended."""
        if self._making is not None and self._is_made_here():
            return self._making.is_over()
        return kept_files().find(self.name) is not None

    def path(self) -> Path:
        """Wait until it is compiled, and return its path, which is good for as long as this is.

        Raises:
            ToolchainError: if the compiler fails.
        """
        folder = kept_files()
        kept = folder.find(self.name)
        if kept is None:
            made = self._made_here().result()
            kept = folder.keep(made, self.name)
            if kept is None:
                return made
        self._end()
        return kept

    def load(self, load: Callable[[Path], Loaded]) -> Loaded:
        """Wait until it is compiled, and return what is loaded of its path, which may be gone afterwards.

        Raises:
            ToolchainError: if the compiler fails.
        """
        kept = kept_files().find(self.name)
        if kept is not None:
            try:
                return load(kept)
            except OSError:  # it was removed meanwhile, or is for another machine
                with suppress(OSError):
                    kept.unlink()
        try:
            return load(self.path())
        finally:
            self._end()

    def _is_made_here(self) -> bool:
        """Tell whether this process, and not one that it was forked from, has it compiled."""
        return self._making is not None and self._making.process == os.getpid()

    def _made_here(self) -> _Making:
        if self._making is None or not self._is_made_here():
            self._making = _Making(self.name, self._texts, self._flags, self._parts, self._suffix)
        return self._making

    def _end(self) -> None:
        if self._making is not None:
            self._making.end()
            self._making = None


class _Making:
    """A compiler at work in a folder of its own, which goes at the end, at the latest of this process.

    What is compiled by then is kept.
    """

    def __init__(
        self,
        name: str,
        texts: Mapping[str, str],
        flags: Sequence[str],
        parts: Sequence[CLibrary],
        suffix: str,
    ) -> None:
        self.process, self._flags, self._parts = os.getpid(), flags, parts
        self._scratch = Path(mkdtemp(prefix="inertance-"))
        for file, text in texts.items():
            (self._scratch / file).write_text(text, encoding="utf-8")
        self._sources = [self._scratch / file for file in texts if file.endswith(".c")]
        self._out = self._scratch / f"network{suffix}"
        self._compilations: list[Compilation] = []
        self.end = weakref.finalize(self, _ended, self._compilations, name, self._scratch, self.process)
        for part in parts:
            part.begin()
        self.is_over()

    def is_over(self) -> bool:
        """Go on, once all parts are there, and tell whether the compiler has ended."""
        if not self._compilations and all(part.is_ready() for part in self._parts):
            self._compile()
        return bool(self._compilations) and self._compilations[0].is_over()

    def result(self) -> Path:
        if not self._compilations:
            self._compile()
        return self._compilations[0].result()

    def _compile(self) -> None:
        objects = [part.path() for part in self._parts]
        made = Compilation(self._sources, self._out, flags=self._flags, objects=objects)
        self._compilations.append(made)


def _ended(compilations: Sequence[Compilation], name: str, scratch: Path, process: int) -> None:
    if process != os.getpid():
        return
    for compilation in compilations:
        if compilation.is_over():
            with suppress(ToolchainError):
                kept_files().keep(compilation.result(), name)
        compilation.abandon()
    shutil.rmtree(scratch, ignore_errors=True)
