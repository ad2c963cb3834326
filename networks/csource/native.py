"""Native: solver "compiled", a run in this process by a network's own C program."""

from __future__ import annotations

import ctypes
import time as clock
from collections.abc import Callable, Sequence
from ctypes import POINTER, Structure, byref, c_char_p, c_double, c_int, c_longlong, c_void_p, pointer
from itertools import pairwise
from numbers import Real
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ...base import Array, ModelError, SimulationError, heed
from ...components.language import Sampled
from ..results.result import Segment
from ..simulation.bound_dae import BoundDAE
from ..simulation.events.constants import FIRING_ROUNDS
from ..simulation.events.switcher import Event, changed, jumped
from ..simulation.integrator import IntegratorError
from ..simulation.legs import Leg
from ..simulation.point import Point
from ..simulation.splines import piecewise
from .toolchain import ToolchainError

if TYPE_CHECKING:
    from ..dae import DAE
    from ..simulation.progress import Progress
    from ..simulation.run import Run
    from ..simulation.settings import Tolerance

ARRIVED, PAUSED, STUCK, FAILED = range(4)
EVENT_CAPACITY = 512
MOST_BETWEEN = 1_000_000  # steps from one output to the next
UNEVEN_RATIO = 20  # times its share of `max_steps` that an interval between outputs may take
FIRST_STEPS, PATIENCE = 256, 0.05  # steps and seconds [s] until the C program looks up from its work
DOUBLES, INTEGERS = POINTER(c_double), POINTER(c_longlong)
DOUBLE_ARRAYS = ("outputs", "times", "points", "constants", "event_times", "impulses")
INTEGER_ARRAYS = ("segment_rows", "changes", "stays")


class _Run(Structure):
    """`Run` in native.c."""

    _fields_ = (
        [(name, c_double) for name in ("stop", "interval", "rtol", "atol")]
        + [(name, DOUBLES) for name in DOUBLE_ARRAYS]
        + [(name, INTEGERS) for name in INTEGER_ARRAYS]
        + [(name, c_longlong) for name in ("output_count", "next", "row_count", "segment_count")]
        + [(name, c_longlong) for name in ("event_count", "room", "crowd", "budget", "steps", "rejected")]
        + [("last", c_double)]
    )  # fmt: skip


class Record(Structure):
    """`Record` in core_state.h."""

    _fields_ = [("times", DOUBLES), ("powers", DOUBLES), ("count", c_longlong), ("found", c_longlong)]


class LegTable(Structure):
    """`Legs` in core_state.h."""

    _fields_ = [
        ("count", c_longlong),
        *((name, DOUBLES) for name in ("begin", "end", "longest")),
        ("jumps", POINTER(c_int)),
    ]

    def __init__(self, legs: Sequence[Leg], most: float) -> None:
        told = [(leg.begin, leg.end, min(leg.max_step, most)) for leg in legs]
        self._kept = np.array(told).T.copy(), np.array([leg.jumps for leg in legs], dtype=np.intc)
        jumps = self._kept[1].ctypes.data_as(POINTER(c_int))
        super().__init__(len(legs), *map(_pointer, self._kept[0]), jumps)


class Native:
    """A compiled network with its input signals; parameters and start values may change from run to run."""

    def __init__(self, closed: BoundDAE) -> None:
        self.dae = dae = closed.dae
        if closed.courses:
            path = next(iter(closed.courses))
            raise ModelError(f"input '{path}': solver 'compiled' takes no Polynomial; use 'auto'")
        self._library = closed.program.loaded(closed, _loaded)
        self.nx, self.nz, self.nq = dae.x.numel(), dae.z.numel(), dae.constants.numel()
        self._core = ctypes.create_string_buffer(self._library.native_size(0))
        free = [declared for declared in dae.inputs if declared.path not in closed.functions]
        given = [(closed.signals[declared.path], declared.order) for declared in free]
        self._tables = [record_table(signal, order) for signal, order in given]
        constants = [float(s) if isinstance(s, Real) and not order else 0.0 for s, order in given]
        self._free = np.array(constants or [0.0])

    def _records(self) -> Any:
        """Return pointers to fresh records; an input without one stays constant."""
        records = (POINTER(Record) * max(1, len(self._tables)))()
        for k, table in enumerate(self._tables):
            if table is not None:
                records[k] = pointer(Record(*map(_pointer, table), len(table[0]), 0))
        return records

    def run(self, run: Run, tolerance: Tolerance, outputs: Array, progress: Progress) -> None:
        """Run to the last output, and record what happens in `run`.

        Raises:
            IntegratorError: if states cannot be followed further.
            SimulationError: if events cannot be resolved.
        """
        point, settings = run.point, run.settings
        y = np.concatenate([point.x, point.z])
        records = self._records()
        legs = LegTable(run.legs, run.settings.max_step)
        begin = point.t, _pointer(y), _pointer(point.q), _pointer(self._free), records, byref(legs)
        self._library.native_begin(self._core, *begin)
        store = _Store(self, outputs, tolerance)
        if settings.max_steps is not None:
            store.shared.crowd = UNEVEN_RATIO * settings.max_steps // (len(outputs) - 1) + UNEVEN_RATIO
        budget, status = FIRST_STEPS, PAUSED
        output, steps = 0, 0
        while status == PAUSED:
            heed()
            if store.shared.next > output:
                output, steps = store.shared.next, store.shared.steps
            elif store.shared.steps > steps + MOST_BETWEEN:
                raise IntegratorError(f"{MOST_BETWEEN:.0e} steps did not lead to the next output")
            store.shared.budget = budget
            began = clock.perf_counter()
            status = self._library.native_run(self._core, byref(store.shared))
            run.calls += 1
            store.drain(run)
            progress.at(run.point.t)
            share = PATIENCE / max(clock.perf_counter() - began, 1e-9)
            budget = min(max(1, int(budget * min(share, 2.0))), MOST_BETWEEN)
        self._tell(run)
        if status == ARRIVED:
            return
        told = self._library.native_message(self._core).decode(errors="replace")
        raise SimulationError(told) if status == FAILED else IntegratorError(told)

    def _tell(self, run: Run) -> None:
        blocks = self.dae.blocks
        shared = np.zeros(max(1, len(blocks)), dtype=np.int64)
        limits = np.zeros(max(1, self.nx + self.nz), dtype=np.int64)
        self._library.native_tell(self._core, _pointer(shared), _pointer(limits))
        for block, told in zip(blocks, shared, strict=False):
            if told and run.switcher is not None:
                run.switcher.completion.tell_shared(block.labels)
        if self.nx and limits[: self.nx].any():
            run.limiting = self.dae.name_of(self.dae.states[int(limits[: self.nx].argmax())])


class _Store:
    """Arrays that the C program fills, and what becomes of them."""

    def __init__(self, native: Native, outputs: Array, tolerance: Tolerance) -> None:
        self.native, jumps = native, native.dae.jumps
        modes = len(native.dae.switching.mode_names) + (len(jumps.motions) if jumps else 0)
        rows, events, segments = (
            len(outputs) + 2 * EVENT_CAPACITY + 2,
            EVENT_CAPACITY + FIRING_ROUNDS * modes + 1,
            EVENT_CAPACITY + 2,
        )
        self.outputs = np.ascontiguousarray(outputs)
        self.times, self.points = np.empty(rows), np.empty((rows, native.nx + native.nz))
        self.constants, self.segment_rows = np.empty((segments, native.nq)), np.empty(segments, np.int64)
        self.event_times, self.impulses = np.empty(events), np.empty(events)
        self.changes, self.stays = np.empty(events, np.int64), np.empty(events, np.int64)
        self.shared = _Run(
            stop=outputs[-1],
            interval=outputs[1] - outputs[0],
            rtol=tolerance.rtol,
            atol=tolerance.atol,
            output_count=len(outputs),
            next=1,
            room=EVENT_CAPACITY // 2,
            last=-np.inf,
            **{name: _pointer(getattr(self, name)) for name in (*DOUBLE_ARRAYS, *INTEGER_ARRAYS)},
        )

    def drain(self, run: Run) -> None:
        """Move what was recorded into `run`."""
        shared, nx = self.shared, self.native.nx
        rows = shared.row_count
        starts = self.segment_rows[: shared.segment_count].tolist()
        times, points = self.times[:rows].copy(), self.points[:rows].copy()
        states, algebraic = points[:, :nx], points[:, nx:]
        for number, (begin, end) in enumerate(pairwise([0, *starts, rows])):
            if number:
                run.segments.append(Segment(self.constants[number - 1].copy()))
            if number or end:
                run.segments[-1].extend(times[begin:end], states[begin:end], algebraic[begin:end])
        run.events += [self._event(k) for k in range(shared.event_count)]
        if rows:
            run.point = Point(float(times[-1]), states[-1], algebraic[-1], run.segments[-1].q)
        shared.row_count = shared.segment_count = shared.event_count = 0
        run.count(shared.steps - run.steps)

    def _event(self, k: int) -> Event:
        told = float(self.event_times[k]), int(self.changes[k]), bool(self.stays[k]), float(self.impulses[k])
        return event_of(self.native.dae, *told)


def event_of(dae: DAE, t: float, number: int, stays: bool, impulse: float) -> Event:
    """Return the event that a change of this number, or a motion that jumps, is."""
    switching, jumps = dae.switching, dae.jumps
    motion = number - len(switching.changes)
    if jumps is not None and motion >= 0:
        return jumped(t, jumps, motion, impulse if motion < len(jumps.motions) else None)
    change = switching.changes[number]
    source = change.target if stays else change.source
    return changed(switching, t, change, source, None if change.impulse is None else impulse)


def _pointer(array: NDArray[Any]) -> Any:
    return array.ctypes.data_as(INTEGERS if array.dtype == np.int64 else DOUBLES)


def record_table(signal: Any, order: int) -> tuple[Array, Array] | None:
    """Return the instants and the powers of a record's spline, or of its derivative."""
    if not isinstance(signal, Sampled):
        return None
    course = piecewise(signal).derivative(order)
    missing = np.zeros((4 - len(course.c), len(course.x) - 1))
    return course.x, np.vstack([missing, course.c])


def _loaded(path: Path) -> Any:
    library = ctypes.CDLL(str(path))
    library.native_size.restype, library.native_size.argtypes = ctypes.c_size_t, [c_int]
    check_sizes(library.native_size, (_Run, Record, LegTable))
    library.native_begin.restype = None
    library.native_begin.argtypes = [c_void_p, c_double, *[DOUBLES] * 3, c_void_p, c_void_p]
    library.native_tell.restype, library.native_tell.argtypes = None, [c_void_p, INTEGERS, INTEGERS]
    library.native_run.restype, library.native_run.argtypes = c_int, [c_void_p, POINTER(_Run)]
    library.native_message.restype, library.native_message.argtypes = c_char_p, [c_void_p]
    return library


def check_sizes(size: Callable[[int], int], mirrors: Sequence[type[Structure]]) -> None:
    """Refuse a library whose structures, counted from 1, are not of the size that they have here."""
    for kind, mirror in enumerate(mirrors, 1):
        if size(kind) != ctypes.sizeof(mirror):
            raise ToolchainError(
                f"the compiled network takes {size(kind)} bytes for {mirror.__name__.strip('_')}, "
                f"this Python {ctypes.sizeof(mirror)}; CC and CFLAGS must build for the machine that runs it"
            )
