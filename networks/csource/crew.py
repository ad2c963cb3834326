"""Crew: many runs of one network by its own C program, as many side by side as a processor's vectors hold."""

from __future__ import annotations

import ctypes
import platform
import time as clock
from collections.abc import Mapping
from contextlib import suppress
from ctypes import POINTER, Structure, byref, c_char, c_double, c_int, c_longlong, c_void_p
from dataclasses import dataclass, field
from functools import cache
from hashlib import sha256
from pathlib import Path
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from ...base import Array, heed
from ..dae import DAE
from ..simulation.events.constants import FIRING_ROUNDS
from ..simulation.starting import Start
from .library_cache import library
from .model import CModel
from .native import MOST_BETWEEN, LegTable, Record
from .program import SOURCES, sources
from .toolchain import ToolchainError
from .wide_text import can_be_wide, wide_text

WAITING, ARRIVED, UNSTARTED, STUCK, FAILED = range(5)
PLAIN = ("start.h", "ensemble.h", *SOURCES, "start.c", "record.c", "member.c", "crew.c")
WIDE = ("wide.h", "wide_core.h", "wide_linear.c", "wide_step.c", "wide_watch.c")
WIDE_FUNCTIONS = ("model_inputs", "model_motion", "model_slope", "model_watch", "model_variables")
FLAGS = ("-DCORE_RECORDS", "-O2", "-ffp-contract=fast")
EVENT_ROOM, MESSAGE_ROOM = 4096, 64
ALIGNMENT = 128  # bytes, of the widest vectors, and more
FIRST_ROUNDS, PATIENCE = 64, 0.05  # rounds and seconds [s] until the C program looks up from its work
DOUBLES, INTEGERS = POINTER(c_double), POINTER(c_longlong)
Integers = NDArray[np.int64]


class _Block(Structure):
    """`Block` in ensemble.h."""

    _fields_ = (
        [(name, c_double) for name in ("begin", "stop", "interval", "rtol", "atol")]
        + [(name, DOUBLES) for name in ("outputs", "parameters", "guesses", "aims", "points", "constants")]
        + [("free", DOUBLES), ("records", POINTER(Record)), ("legs", POINTER(LegTable))]
        + [(name, INTEGERS) for name in ("signals", "legs_of")]
        + [(name, DOUBLES) for name in ("values", "ended")]
        + [(name, INTEGERS) for name in ("status", "steps", "rejected")]
        + [("messages", POINTER(c_char))]
        + [(name, DOUBLES) for name in ("event_times", "impulses")]
        + [(name, INTEGERS) for name in ("event_members", "changes", "stays")]
        + [(name, c_longlong) for name in ("output_count", "member_count", "entered", "event_count")]
        + [(name, c_longlong) for name in ("event_room", "most_between", "budget", "rounds", "tried")]
        + [(name, c_longlong) for name in ("messages_room", "message_count")]
        + [("message_members", INTEGERS)]
    )  # fmt: skip


@dataclass(eq=False)
class Members:
    """What differs between members, one row each, and what they share.

    Attributes:
        parameters: (members, NP); guesses: (members, NX) and aims: (members, NAIM), where starts are sought.
        found: points (members, NY) and constants (members, NQ) where members start, if that is known.
        free: constant inputs (signal sets, NU); tables: instants and powers of those that are data, by set.
        signals: the set of each member; legs_of: the legs of each member, a place among `legs`.
    """

    parameters: Array
    guesses: Array
    aims: Array
    free: Array
    tables: list[list[tuple[Array, Array] | None]]
    legs: list[LegTable]
    signals: Integers
    legs_of: Integers
    found: tuple[Array, Array] | None = None

    def __len__(self) -> int:
        return len(self.parameters)

    def some(self, places: Integers, found: tuple[Array, Array]) -> Members:
        """Return some of the members, whose starts were found otherwise."""
        rows = (self.parameters[places], self.guesses[places], self.aims[places])
        return Members(
            *rows, self.free, self.tables, self.legs, self.signals[places], self.legs_of[places], found
        )


@dataclass(eq=False)
class Told:
    """What came of members: values (members, outputs, signals), NaN beyond where each has ended.

    Attributes:
        events: columns member, instant, change, whether it stays, impulse, in the order they happened.
        rounds: how often lanes stepped together; tried: their steps, at most `lanes` a round.
    """

    values: Array
    ended: Array
    status: Integers
    steps: Integers
    rejected: Integers
    lanes: int
    messages: dict[int, str] = field(default_factory=dict)
    events: list[tuple[int, float, int, bool, float]] = field(default_factory=list)
    rounds: int = 0
    tried: int = 0

    def drain(self, arrays: Mapping[str, Any], block: _Block, messages: bytes, length: int) -> None:
        """Take over what happened while a block ran, and make room for more."""
        columns = ("event_members", "event_times", "changes", "stays", "impulses")
        happened = (arrays[name][: block.event_count].tolist() for name in columns)
        self.events += zip(*happened, strict=True)
        for k, member in enumerate(arrays["message_members"][: block.message_count].tolist()):
            text = messages[k * length : (k + 1) * length].partition(b"\0")[0]
            self.messages[member] = text.decode(errors="replace")
        block.event_count = block.message_count = 0


class Crew:
    """The compiled program of a network, some inputs built in, that computes given signals of many members."""

    def __init__(self, dae: DAE, functions: dict[str, Any], signals: tuple[str, ...], start: Start) -> None:
        model = CModel(dae, functions, signals, (), standalone=False, start=start)
        by_name = {f.name(): f for f in model.functions()}
        wide = [by_name[name] for name in WIDE_FUNCTIONS]
        texts, files, flags = model.texts(), [*PLAIN], [*FLAGS]
        self.free = model.free
        if model.dense and all(map(can_be_wide, wide)):
            texts["wide_model.c"] = '#include "wide_core.h"\n\n' + wide_text(wide)
            files = [*WIDE, *PLAIN]
            follow = any(ca.depends_on(dae.expression(name), dae.u) for name in signals)
            flags += ["-DMODEL_WIDE=1", f"-DVARIABLES_FOLLOW_INPUTS={int(follow)}"]
        self._library = _compiled(texts | sources(files), flags)
        self.dae, self.signals = dae, signals
        self.lanes = int(self._library.ensemble_size(4))
        modes = len(dae.switching.mode_names) + (len(dae.jumps.motions) if dae.jumps else 0)
        self._event_room = EVENT_ROOM + self.lanes * (FIRING_ROUNDS * modes + 1)

    def run(self, members: Members, outputs: Array, rtol: float, atol: float) -> Told:
        """Run all members, from the first output to the last."""
        count, lanes = len(members), self.lanes
        told = Told(
            np.full((count, len(outputs), len(self.signals)), np.nan), np.full(count, outputs[0]),
            *np.zeros((3, count), dtype=np.int64), lanes,
        )  # fmt: skip
        room, event_room = MESSAGE_ROOM + lanes, self._event_room
        length = int(self._library.ensemble_size(5))
        arrays: dict[str, Any] = {
            "outputs": np.ascontiguousarray(outputs),
            "parameters": members.parameters, "guesses": members.guesses, "aims": members.aims,
            "free": members.free, "signals": members.signals, "legs_of": members.legs_of,
            "values": told.values, "ended": told.ended, "status": told.status, "steps": told.steps,
            "rejected": told.rejected,
            "event_times": np.empty(event_room), "impulses": np.empty(event_room),
            "event_members": np.empty(event_room, np.int64), "changes": np.empty(event_room, np.int64),
            "stays": np.empty(event_room, np.int64), "message_members": np.empty(room, np.int64),
        }  # fmt: skip
        if members.found:
            arrays |= dict(zip(("points", "constants"), members.found, strict=True))
        arrays = {name: np.ascontiguousarray(array) for name, array in arrays.items()}
        messages = ctypes.create_string_buffer(room * length)
        records = (Record * max(1, len(members.tables) * len(self.free)))()
        flat = [table for tables in members.tables for table in tables]
        for record, table in zip(records, flat, strict=False):
            if table is not None:
                record.times, record.powers, record.count = _pointer(table[0]), _pointer(table[1]), len(table[0])
        legs = (LegTable * len(members.legs))(*members.legs)
        block = _Block(
            begin=outputs[0], stop=outputs[-1], interval=outputs[1] - outputs[0], rtol=rtol, atol=atol,
            records=records, legs=legs, messages=ctypes.cast(messages, POINTER(c_char)),
            output_count=len(outputs), member_count=count, event_room=EVENT_ROOM, messages_room=MESSAGE_ROOM,
            most_between=MOST_BETWEEN, **{name: _pointer(array) for name, array in arrays.items()},
        )  # fmt: skip
        crew, kept = _aligned(self._library.ensemble_size(0))
        budget, left = FIRST_ROUNDS, 1
        while left:
            heed()
            block.budget = budget
            began = clock.perf_counter()
            left = self._library.ensemble_run(crew, byref(block))
            told.drain(arrays, block, messages.raw, length)
            share = PATIENCE / max(clock.perf_counter() - began, 1e-9)
            budget = max(1, int(budget * min(share, 2.0)))
        told.rounds, told.tried = block.rounds, block.tried
        del kept
        return told


def _pointer(array: NDArray[Any]) -> Any:
    return array.ctypes.data_as(INTEGERS if array.dtype == np.int64 else DOUBLES)


def _aligned(size: int) -> tuple[c_void_p, Any]:
    """Return the address of zeros that vectors may stand at, and what owns them."""
    owner = np.zeros(size + ALIGNMENT, dtype=np.uint8)
    return c_void_p(owner.ctypes.data + -owner.ctypes.data % ALIGNMENT), owner


def _compiled(texts: dict[str, str], flags: list[str]) -> Any:
    """Return a library for the very processor it runs on, or, where a compiler knows none, for its kind."""
    try:
        return library(texts, [*flags, "-march=native", f"-DPROCESSOR={_processor()}"], _loaded)
    except ToolchainError:
        return library(texts, flags, _loaded)


@cache
def _processor() -> str:
    """Return a word for what this processor can do, by which the cache of libraries tells it from others."""
    told = platform.processor()
    with suppress(OSError):
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
        told = next((line for line in lines if line.startswith(("flags", "Features"))), told)
    return f"p{sha256(told.encode()).hexdigest()[:16]}"


def _loaded(path: Path) -> Any:
    library = ctypes.CDLL(str(path))
    library.ensemble_size.restype, library.ensemble_size.argtypes = ctypes.c_size_t, [c_int]
    for kind, mirror in enumerate((_Block, Record, LegTable), 1):
        size = library.ensemble_size(kind)
        if size != ctypes.sizeof(mirror):
            raise ToolchainError(
                f"the compiled network takes {size} bytes for {mirror.__name__.strip('_')}, this Python "
                f"{ctypes.sizeof(mirror)}; CC and CFLAGS must build for the machine that runs it"
            )
    library.ensemble_run.restype, library.ensemble_run.argtypes = c_int, [c_void_p, POINTER(_Block)]
    return library
