"""Crew: many runs of one network by its own C program, as many side by side as a processor's vectors hold."""

from __future__ import annotations

import ctypes
import platform
import sys
import time as clock
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from ctypes import POINTER, Structure, byref, c_char, c_double, c_int, c_longlong, c_void_p
from dataclasses import dataclass
from functools import cache, cached_property
from hashlib import sha256
from pathlib import Path
from typing import Any, ClassVar

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from ...base import Array, heed
from ..dae import DAE
from ..flattening.instructions import with_pieces_written
from ..simulation.events.constants import FIRING_ROUNDS
from ..simulation.starting import Start
from .library_cache import CLibrary
from .members import Members, Told
from .model import CModel
from .native import MOST_BETWEEN, LegTable, Record, check_sizes
from .program import SOURCES, sources
from .toolchain import ToolchainError
from .wide_text import can_be_wide, wide_text

PLAIN = ("start.h", "ensemble.h", *SOURCES, "start.c", "record.c", "member.c", "crew.c")
WIDE = ("wide.h", "wide_core.h", "wide_linear.c", "wide_step.c", "wide_watch.c")
WIDE_FUNCTIONS = ("model_inputs", "model_motion", "model_slope", "model_watch", "model_variables")
FLAGS = ("-DCORE_RECORDS", "-O2", "-ffp-contract=fast")
EVENT_ROOM, MESSAGE_ROOM = 4096, 64
CROSSING_ROOM, LANE_CROSSINGS = 1024, 64  # of all until a pause, and beyond that for each lane
ALIGNMENT = 128  # bytes, of the widest vectors or more
FIRST_ROUNDS, PATIENCE = 64, 0.05  # rounds and seconds [s] until the C program looks up from its work
DOUBLES, INTEGERS = POINTER(c_double), POINTER(c_longlong)
NUMBERS = ("outputs", "parameters", "guesses", "aims", "points", "constants", "free")
EVENT_COLUMNS = ("event_members", "event_times", "changes", "stays", "impulses")


class _Block(Structure):
    """`Block` in ensemble.h."""

    _fields_: ClassVar[Any] = (
        [(name, c_double) for name in ("begin", "stop", "interval", "rtol", "atol")]
        + [(name, DOUBLES) for name in NUMBERS]
        + [("records", POINTER(Record)), ("legs", POINTER(LegTable))]
        + [(name, INTEGERS) for name in ("signals_of", "legs_of")]
        + [(name, DOUBLES) for name in ("values", "ended")]
        + [(name, INTEGERS) for name in ("status", "steps", "rejected")]
        + [("messages", POINTER(c_char)), ("message_members", INTEGERS)]
        + [(name, DOUBLES) for name in ("event_times", "impulses")]
        + [(name, INTEGERS) for name in ("event_members", "changes", "stays")]
        + [("crossings", DOUBLES)]
        + [(name, c_longlong) for name in ("output_count", "member_count", "entered", "event_count")]
        + [(name, c_longlong) for name in ("event_room", "message_count", "message_room")]
        + [(name, c_longlong) for name in ("crossing_count", "crossing_room", "crossing_most")]
        + [(name, c_longlong) for name in ("most_between", "budget", "rounds", "tried")]
    )  # fmt: skip


@dataclass(frozen=True, eq=False)
class CrewProgram:
    """A network as C that computes some of its signals for many members; it may be sent to other processes.

    Attributes:
        texts: C files by name, that run one member after the other.
        wide: those that let members go side by side, and flags for them; none if the model is too large.
        width: how many signals are computed.
        free: inputs that are no formulas, with their derivatives.
        changes: modes and motions that may change at one instant.
    """

    texts: Mapping[str, str]
    wide: tuple[Mapping[str, str], Sequence[str]] | None
    width: int
    free: Sequence[tuple[str, int]]
    changes: int

    @property
    def goes_wide(self) -> bool:
        """Whether members may go side by side: GCC leaves vectors unaligned on Windows."""
        return self.wide is not None and sys.platform != "win32"

    @cached_property
    def best(self) -> CLibrary:
        """The program with vectors, for the very processor it runs on.

        Raises:
            ToolchainError: if there is no C compiler.
        """
        return self._with_vectors(("-march=native", f"-DPROCESSOR={_processor()}"))

    def _with_vectors(self, more: Sequence[str] = ()) -> CLibrary:
        texts, flags = self.wide or ({}, ())
        return CLibrary({**texts, **self.texts}, (*FLAGS, *flags, *more))

    @cached_property
    def library(self) -> Any:
        """The compiled program: the best one that the compiler can make."""
        if self.goes_wide:
            with suppress(ToolchainError):
                return self.best.load(_loaded)
            with suppress(ToolchainError):
                return self._with_vectors().load(_loaded)
        return CLibrary(self.texts, FLAGS).load(_loaded)

    def __getstate__(self) -> dict[str, Any]:
        return {name: value for name, value in vars(self).items() if name not in ("library", "best")}

    @property
    def lanes(self) -> int:
        """How many members go side by side."""
        return int(self.library.ensemble_size(4))

    def blank(self, members: int, outputs: Array, crossings: bool = False) -> Told:
        """Return what is told of members that have not begun; of their `crossings`, too, if wanted."""
        return Told.blank(members, outputs, self.width, self.lanes, crossings)

    def run(
        self,
        members: Members,
        outputs: Array,
        tolerance: tuple[float, float],
        told: Told,
        at: Callable[[int], None],
    ) -> None:
        """Run all members from the first output to the last; `told` of them keeps what Ctrl-C interrupts.

        Args:
            members: all of them.
            outputs: instants.
            tolerance: relative and absolute.
            told: blank, and filled by this.
            at: called with how many members have begun, now and then.
        """
        room = _Room(self, members, outputs, told)
        block = room.block(outputs, tolerance)
        crew, owner = _aligned(self.library.ensemble_size(0))
        budget, left = FIRST_ROUNDS, 1
        while left:
            heed()
            block.budget = budget
            began = clock.perf_counter()
            left = self.library.ensemble_run(crew, byref(block))
            room.drain(block, told)
            at(block.entered)
            share = PATIENCE / max(clock.perf_counter() - began, 1e-9)
            budget = max(1, int(budget * min(share, 2.0)))
        del owner


def crew_program(dae: DAE, functions: dict[str, Any], signals: Sequence[str], start: Start) -> CrewProgram:
    """Return the program of a network with some inputs built in."""
    model = CModel(dae, functions, signals, (), standalone=False, start=start)
    by_name = {f.name(): f for f in model.functions()}
    wide = [with_pieces_written(by_name[name]) for name in WIDE_FUNCTIONS]
    changes = len(dae.switching.mode_names) + (len(dae.jumps.motions) if dae.jumps else 0)
    free = [(declared.path, declared.order) for declared in model.free]
    texts, beside = model.texts() | sources(PLAIN), None
    if model.dense and all(map(can_be_wide, wide)):
        follow = any(ca.depends_on(dae.expression(name), dae.u) for name in signals)
        flags = "-DMODEL_WIDE=1", f"-DVARIABLES_FOLLOW_INPUTS={int(follow)}"
        beside = {"wide_model.c": '#include "wide_core.h"\n\n' + wide_text(wide)} | sources(WIDE), flags
    return CrewProgram(texts, beside, len(signals), free, changes)


class _Room:
    """Arrays that the C program reads and fills."""

    def __init__(self, program: CrewProgram, members: Members, outputs: Array, told: Told) -> None:
        size = program.library.ensemble_size
        self._message_room, self._message_length = MESSAGE_ROOM + program.lanes, int(size(5))
        self._messages = ctypes.create_string_buffer(self._message_room * self._message_length)
        events = EVENT_ROOM + program.lanes * (FIRING_ROUNDS * program.changes + 1)
        doubles = {
            "outputs": outputs, "parameters": members.parameters, "guesses": members.guesses,
            "aims": members.aims, "free": np.array([s.constants for s in members.signals]),
            "event_times": np.empty(events), "impulses": np.empty(events), "values": told.values,
            "ended": told.ended,
        }  # fmt: skip
        integers = {
            "signals_of": members.signals_of, "legs_of": members.legs_of, "status": told.status,
            "steps": told.steps, "rejected": told.rejected,
            "message_members": np.empty(self._message_room, np.int64),
            **{name: np.empty(events, np.int64) for name in ("event_members", "changes", "stays")},
        }  # fmt: skip
        if told.crossings is not None:
            doubles["crossings"] = np.empty((CROSSING_ROOM + LANE_CROSSINGS * program.lanes, int(size(6))))
        if members.found:
            doubles |= dict(zip(("points", "constants"), members.found, strict=True))
        self._arrays = {name: np.ascontiguousarray(a, dtype=float) for name, a in doubles.items()}
        self._arrays |= {name: np.ascontiguousarray(a, dtype=np.int64) for name, a in integers.items()}
        self._records = (Record * max(1, len(members.signals) * len(program.free)))()
        tables = [table for signals in members.signals for table in signals.tables]
        self._tables = [table and tuple(map(np.ascontiguousarray, table)) for table in tables]
        for record, table in zip(self._records, self._tables, strict=False):
            if table:
                record.times, record.powers, record.count = *map(_pointer, table), len(table[0])
        self._kept_legs = [LegTable(legs, np.inf) for legs in members.legs]
        self._legs = (LegTable * len(members.legs))(*self._kept_legs)
        self._count = len(members)

    def block(self, outputs: Array, tolerance: tuple[float, float]) -> _Block:
        """Return what the C program is asked."""
        return _Block(
            begin=outputs[0],
            stop=outputs[-1],
            interval=outputs[1] - outputs[0],
            rtol=tolerance[0],
            atol=tolerance[1],
            records=self._records,
            legs=self._legs,
            messages=ctypes.cast(self._messages, POINTER(c_char)),
            output_count=len(outputs),
            member_count=self._count,
            event_room=EVENT_ROOM,
            message_room=MESSAGE_ROOM,
            crossing_room=CROSSING_ROOM,
            crossing_most=len(self._arrays.get("crossings", ())),
            most_between=MOST_BETWEEN,
            **{name: _pointer(array) for name, array in self._arrays.items()},
        )

    def drain(self, block: _Block, told: Told) -> None:
        """Take over what happened while a block ran, and make room for more."""
        columns = [self._arrays[name][: block.event_count] for name in EVENT_COLUMNS]
        told.events.append(np.column_stack(columns).astype(float))
        length, texts = self._message_length, self._messages.raw
        for k, member in enumerate(self._arrays["message_members"][: block.message_count].tolist()):
            text = texts[k * length : (k + 1) * length].partition(b"\0")[0]
            told.messages[member] = text.decode(errors="replace")
        if told.crossings is not None:
            told.crossings.append(self._arrays["crossings"][: block.crossing_count].copy())
        block.event_count = block.message_count = block.crossing_count = 0
        told.rounds, told.tried = block.rounds, block.tried


def _pointer(array: NDArray[Any]) -> Any:
    return array.ctypes.data_as(INTEGERS if array.dtype == np.int64 else DOUBLES)


def _aligned(size: int) -> tuple[c_void_p, Any]:
    """Return the address of zeros at which vectors may stand, and what owns them."""
    owner = np.zeros(size + ALIGNMENT, dtype=np.uint8)
    return c_void_p(owner.ctypes.data + -owner.ctypes.data % ALIGNMENT), owner


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
    check_sizes(library.ensemble_size, (_Block, Record, LegTable))
    library.ensemble_run.restype, library.ensemble_run.argtypes = c_int, [c_void_p, POINTER(_Block)]
    return library
