"""Toolchain: compile C for this machine, or, with zig, for another."""

from __future__ import annotations

import importlib.util
import os
import shlex
import shutil
import signal
import subprocess
import sys
from collections.abc import Iterable
from pathlib import Path
from tempfile import TemporaryFile

from ...base import ModelError, nearest

PLATFORMS = {
    "x86_64-linux": "x86_64-linux-gnu.2.17",
    "aarch64-linux": "aarch64-linux-gnu.2.17",
    "x86_64-windows": "x86_64-windows-gnu",
    "x86_64-darwin": "x86_64-macos",
    "aarch64-darwin": "aarch64-macos",
}
FLAGS = ("-std=c99", "-O2", "-fvisibility=hidden")
REMEDY = "install a C compiler (gcc or clang), or `pip install ziglang`"


class ToolchainError(ModelError):
    """There is no C compiler, or it refused."""


class Compilation:
    """A compiler at work on C sources, as one translation unit, for a shared library or an object file.

    Headers are so read once, which is a third of the time, and small functions inlined across files. See
    `compile_shared` for the arguments; `objects` are linked to a library. Ctrl-C does not reach it.
    """

    def __init__(
        self,
        sources: Iterable[str | Path],
        out: str | Path,
        platform: str | None = None,
        include: Iterable[str | Path] = (),
        flags: Iterable[str] = (),
        objects: Iterable[str | Path] = (),
    ) -> None:
        folders = (f"-I{folder}" for folder in include)
        kind = "-c" if Path(out).suffix == ".o" else "-shared"
        command = [*toolchain(flags, platform), kind, *folders, "-x", "c", "-", "-o", str(out)]
        if objects:
            command += ["-x", "none", *map(str, objects)]
        if not (platform or sys.platform).endswith(("windows", "win32")):
            command += ["-fPIC"] if kind == "-c" else ["-fPIC", "-lm"]
        unit = "".join(f'#include "{Path(source).resolve().as_posix()}"\n' for source in sources)
        self._out, self._compiler = Path(out), command[0]
        with TemporaryFile() as given:
            given.write(os.fsencode(unit))
            given.seek(0)
            self._said = TemporaryFile()  # noqa: SIM115
            self._process = subprocess.Popen(
                command, stdin=given, stdout=self._said, stderr=self._said, start_new_session=True
            )

    def is_over(self) -> bool:
        """Tell whether the compiler has ended."""
        return self._process.poll() is not None

    def result(self) -> Path:
        """Wait for the library, and return its path.

        Raises:
            ToolchainError: if the compiler failed, with what it says.
        """
        if self._process.wait():
            self._said.seek(0)
            lines = self._said.read().decode(errors="replace").strip().splitlines()
            told = "\n".join(lines[:20])
            raise ToolchainError(f"'{self._compiler}' could not compile the network:\n{told}")
        return self._out

    def abandon(self) -> None:
        """End the compiler, if it is still at work."""
        if not self.is_over():
            if sys.platform == "win32":
                self._process.kill()
            else:  # and what it has begun, which then removes what it has written
                os.killpg(self._process.pid, signal.SIGTERM)
            self._process.wait()
        self._said.close()


def compile_shared(
    sources: Iterable[str | Path],
    out: str | Path,
    platform: str | None = None,
    include: Iterable[str | Path] = (),
    flags: Iterable[str] = (),
) -> Path:
    """Compile C sources as one translation unit into a shared library and return its path.

    Args:
        sources: C files, in whose static names none comes twice.
        out: the library to write.
        platform: "x86_64-linux", "aarch64-linux" (glibc 2.17), "x86_64-windows", "x86_64-darwin" or
            "aarch64-darwin", built by zig; this machine if not given.
        include: folders of headers.
        flags: further options for the compiler, before those of the environment variable CFLAGS.

    Raises:
        ToolchainError: if there is no compiler, with the remedies, or if it fails, with what it says.
    """
    compilation = Compilation(sources, out, platform, include, flags)
    try:
        return compilation.result()
    finally:
        compilation.abandon()


def toolchain(flags: Iterable[str] = (), platform: str | None = None) -> list[str]:
    """Return a compiler with all of its flags; see `compile_shared`."""
    return [*compiler(platform), *FLAGS, *flags, *shlex.split(os.environ.get("CFLAGS", ""))]


def compiler(platform: str | None = None) -> list[str]:
    """Return the command of a C compiler: CC, cc, gcc, clang, else zig; zig alone for a `platform`.

    Raises:
        ToolchainError: if there is none, with the remedies; or for an unknown platform.
    """
    if platform is not None:
        if platform not in PLATFORMS:
            raise ToolchainError(
                f"there is no platform '{platform}'{nearest(platform, PLATFORMS)}, only "
                f"{', '.join(PLATFORMS)}"
            )
        return [*_zig(f"to build for {platform}"), "-target", PLATFORMS[platform]]
    given = shlex.split(os.environ.get("CC", ""))
    if given and shutil.which(given[0]):
        return given
    found = next(filter(None, map(shutil.which, ("cc", "gcc", "clang"))), None)
    return [found] if found else _zig("")


def _zig(purpose: str) -> list[str]:
    if importlib.util.find_spec("ziglang") is None:
        if purpose:
            raise ToolchainError(f"{purpose}, zig is needed: `pip install ziglang`")
        raise ToolchainError(f"no C compiler was found; {REMEDY}")
    return [sys.executable, "-m", "ziglang", "cc"]
