"""Toolchain: compile C for this machine, or, with zig, for another."""

from __future__ import annotations

import importlib.util
import os
import shlex
import shutil
import subprocess
import sys
from collections.abc import Iterable
from pathlib import Path

from ...base import ModelError, nearest

PLATFORMS = {
    "x86_64-linux": "x86_64-linux-gnu.2.17",
    "aarch64-linux": "aarch64-linux-gnu.2.17",
    "x86_64-windows": "x86_64-windows-gnu",
    "x86_64-darwin": "x86_64-macos",
    "aarch64-darwin": "aarch64-macos",
}
FLAGS = ("-std=c99", "-O2", "-fvisibility=hidden", "-shared")
REMEDY = "install a C compiler (gcc or clang), or `pip install ziglang`"


class ToolchainError(ModelError):
    """There is no C compiler, or it refused."""


def compile_shared(
    sources: Iterable[str | Path],
    out: str | Path,
    platform: str | None = None,
    include: Iterable[str | Path] = (),
    flags: Iterable[str] = (),
) -> Path:
    """Compile C sources as one translation unit into a shared library and return its path.

    Headers are so read once, which is a third of the time, and small functions inlined across files.

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
    command = [
        *toolchain(flags, platform),
        *(f"-I{folder}" for folder in include),
        "-x",
        "c",
        "-",
        "-o",
        str(out),
    ]
    if not (platform or sys.platform).endswith(("windows", "win32")):
        command += ["-fPIC", "-lm"]
    unit = "".join(f'#include "{Path(source).resolve().as_posix()}"\n' for source in sources)
    done = subprocess.run(
        command, input=unit, capture_output=True, check=False, encoding="utf-8", errors="surrogateescape"
    )
    if done.returncode:
        told = "\n".join(done.stderr.strip().splitlines()[:20])
        raise ToolchainError(f"'{command[0]}' could not compile the network:\n{told}")
    return Path(out)


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
