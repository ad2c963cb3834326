"""The benchmark's own integrator: a C program, compiled where it is first used, stepping at 20 kHz."""

from __future__ import annotations

import ctypes
import hashlib
import importlib.util
import os
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
SOURCE = Path(__file__).with_name("stepper.c")
# What -ffast-math allows, without what it links: that would round small numbers to zero in the whole process.
FAST = (
    "-O3", "-fno-math-errno", "-fno-trapping-math", "-fno-signed-zeros", "-fassociative-math",
    "-freciprocal-math", "-ffinite-math-only",
)  # fmt: skip
NMAX = 6
LAWS = (
    "FRICTION",
    "BRISTLES",
    "POWER_OF_SPEED",
    "POWER_OF_TRAVEL",
    "BILINEAR",
    "RIPPLE",
    "IWAN",
    "CONTACT",
    "MAXWELL",
    "WARPED",
    "CLEARANCE",
    "LUGRE",
    "CONSTANT",
    "LIMITED",
    "JENKINS",
)


@dataclass
class Element:
    """A force between coordinates: its law, how its elongation e = b.q + cw w is made, its numbers."""

    law: str
    b: Array
    cw: float = 0.0
    p: tuple[float, ...] = ()
    warp: Array | None = None
    load: Row | None = None

    def packed(self) -> Array:
        """Return the numbers in the order of the C structure."""
        load = self.load or Row()
        parts = [
            [LAWS.index(self.law), self.cw],
            _padded(self.b),
            _padded(self.warp),
            load.q,
            load.v,
            [load.w, load.wd],
            np.pad(np.asarray(self.p, float), (0, 16 - len(self.p))),
        ]
        return np.concatenate([np.asarray(part, float) for part in parts])


@dataclass
class Row:
    """A quantity linear in the motion: q.q + v.v + a.a + u u + w w + wd w' + wdd w'' + reaction sum(cw f)."""

    q: Array = field(default_factory=lambda: np.zeros(NMAX))
    v: Array = field(default_factory=lambda: np.zeros(NMAX))
    a: Array = field(default_factory=lambda: np.zeros(NMAX))
    u: float = 0.0
    w: float = 0.0
    wd: float = 0.0
    wdd: float = 0.0
    reaction: float = 0.0

    def packed(self) -> Array:
        """Return the numbers in the order of the C program."""
        return np.concatenate([self.q, self.v, self.a, [self.u, self.w, self.wd, self.wdd, self.reaction]])


@dataclass
class System:
    """M a + C v + K q = gu u + gw w + gd w' - sum b f(element)."""

    M: Array
    C: Array
    K: Array
    gu: Array
    gw: Array
    gd: Array
    elements: list[Element] = field(default_factory=list)


@dataclass(frozen=True)
class Drive:
    """What drives a rig, at the middle of steps: a force u, or a motion w with its two derivatives."""

    u: Array
    w: Array
    wd: Array
    wdd: Array


def simulate(system: System, drive: Drive, rows: list[Row], step: float) -> Array:
    """Return the wanted quantities at the middle of all steps, (steps, rows), starting from rest."""
    n, steps = len(system.M), len(drive.u)
    inverse = np.linalg.inv(system.M + step / 2 * system.C + step**2 / 4 * system.K)
    library = _library()
    elements = np.array([element.packed() for element in system.elements]).reshape(-1)
    states = np.zeros(max(1, len(system.elements)) * library.state_size())
    wanted = np.concatenate([row.packed() for row in rows])
    out = np.empty((steps, len(rows)))
    arrays = (
        inverse,
        system.C,
        system.K,
        system.gu,
        system.gw,
        system.gd,
        drive.u,
        drive.w,
        drive.wd,
        drive.wdd,
    )
    held = [np.ascontiguousarray(a, float) for a in arrays]
    library.run(
        n,
        steps,
        ctypes.c_double(step),
        *(_pointer(a) for a in held),
        len(system.elements),
        _pointer(elements),
        _pointer(states),
        len(rows),
        _pointer(wanted),
        _pointer(out),
    )
    return out


def _padded(vector: Array | None) -> Array:
    return np.zeros(NMAX) if vector is None else np.pad(vector, (0, NMAX - len(vector)))


def _pointer(array: Array) -> Any:
    return array.ctypes.data_as(ctypes.POINTER(ctypes.c_double))


@cache
def _library() -> ctypes.CDLL:
    """Compile the program unless it was before, and load it."""
    digest = hashlib.sha256(SOURCE.read_bytes() + " ".join(FAST).encode()).hexdigest()[:16]
    target = Path(tempfile.gettempdir()) / f"inertance-blind-{os.getuid()}-{digest}.so"
    if not target.exists():
        made = target.with_suffix(f".{os.getpid()}")
        subprocess.run(
            [*_compiler(), *FAST, "-shared", "-fPIC", "-o", str(made), str(SOURCE), "-lm"], check=True
        )
        made.rename(target)
    return ctypes.CDLL(str(target))


def _compiler() -> list[str]:
    """Return the command of a C compiler: CC, cc, or that of the package ziglang."""
    named = os.environ.get("CC") or shutil.which("cc") or shutil.which("gcc") or shutil.which("clang")
    if named:
        return named.split()
    if importlib.util.find_spec("ziglang"):
        return [sys.executable, "-m", "ziglang", "cc"]
    raise SystemExit("the blind benchmark needs a C compiler: install one, set CC, or pip install ziglang")
