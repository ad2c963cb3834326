"""Native: solver "compiled", a run in this process by a network's own C program."""

from __future__ import annotations

import ctypes
import os
import time as clock
from ctypes import POINTER, Structure, byref, c_char_p, c_double, c_int, c_longlong, c_void_p, pointer
from numbers import Real
from pathlib import Path
from shutil import rmtree
from tempfile import mkdtemp
from typing import TYPE_CHECKING, Any
from weakref import WeakKeyDictionary, finalize

import numpy as np
from numpy.typing import NDArray

from ...base import ModelError, SimulationError, heed
from ...components.language import Sampled
from ..dae import DAE
from ..flattening.flat import Flat
from ..results.result import Segment
from ..simulation.bound_dae import BoundDAE
from ..simulation.events.constants import FIRING_ROUNDS
from ..simulation.events.switcher import Event, jumped
from ..simulation.input_signals import Given
from ..simulation.integrator import IntegratorError
from ..simulation.point import Point
from ..simulation.polynomial import Polynomial
from ..simulation.splines import piecewise
from .model import CModel
from .program import SOURCES, sources
from .toolchain import ToolchainError, compile_shared

if TYPE_CHECKING:
    from ..simulation.progress import Progress
    from ..simulation.run import Run

ARRIVED, PAUSED, STUCK, FAILED = range(4)
ROOM = 512
MOST_BETWEEN = 1_000_000  # steps from one output to the next
UNEVEN = 20  # times its share of `max_steps` that an interval between outputs may take
FIRST, PATIENCE = 256, 0.05  # steps and seconds [s] until the C program looks up from its work
DOUBLES, INTEGERS = POINTER(c_double), POINTER(c_longlong)
_LIBRARIES: WeakKeyDictionary[Flat, dict[Given, Any]] = WeakKeyDictionary()


class _Run(Structure):
    """`Run` in native.c."""

    _fields_ = (
        [(name, c_double) for name in ("stop", "interval", "rtol", "atol")]
        + [(name, DOUBLES) for name in ("outputs", "times", "points", "constants", "event_times", "impulses")]
        + [(name, INTEGERS) for name in ("segment_rows", "changes", "stays")]
        + [(name, c_longlong) for name in ("output_count", "next", "row_count", "segment_count")]
        + [(name, c_longlong) for name in ("event_count", "room", "crowd", "budget", "steps", "rejected")]
        + [("last", c_double)]
    )  # fmt: skip


class _Record(Structure):
    """`Record` in core_state.h."""

    _fields_ = [("times", DOUBLES), ("powers", DOUBLES), ("count", c_longlong), ("found", c_longlong)]


class _Legs(Structure):
    """`Legs` in core_state.h."""

    _fields_ = [
        ("count", c_longlong),
        ("begin", DOUBLES),
        ("end", DOUBLES),
        ("longest", DOUBLES),
        ("jumps", POINTER(c_int)),
    ]

    def __init__(self, run: Run) -> None:
        legs = run.legs
        self._kept = [np.array([getattr(leg, name) for leg in legs]) for name in ("begin", "end")]
        self._kept.append(np.array([min(leg.max_step, run.settings.max_step) for leg in legs]))
        self._jumps = np.array([leg.jumps for leg in legs], dtype=np.intc)
        jumps = self._jumps.ctypes.data_as(POINTER(c_int))
        super().__init__(len(legs), *map(_pointer, self._kept), jumps)


class Native:
    """A compiled network with its input signals; parameters and start values may change from run to run."""

    def __init__(self, closed: BoundDAE) -> None:
        self.dae = dae = closed.dae
        functions = {path: s for path, s in closed.signals.items() if not isinstance(s, Sampled | Real)}
        for path, signal in functions.items():
            if isinstance(signal, Polynomial):
                raise ModelError(f"input '{path}': solver 'compiled' takes no Polynomial; use 'auto'")
        self._library = _library(dae, functions)
        self.nx, self.nz, self.nq = dae.x.numel(), dae.z.numel(), dae.constants.numel()
        self._core = ctypes.create_string_buffer(self._library.native_size(0))
        free = [declared for declared in dae.inputs if declared.path not in functions]
        self._tables = [_table(closed.signals[declared.path], declared.order) for declared in free]
        self._free = np.array([_constant(closed.signals[i.path], i.order) for i in free] or [0.0])

    def _records(self) -> Any:
        """Return pointers to fresh records; an input without one stays constant."""
        records = (POINTER(_Record) * max(1, len(self._tables)))()
        for k, table in enumerate(self._tables):
            if table is not None:
                times, powers = table
                records[k] = pointer(_Record(_pointer(times), _pointer(powers), len(times), 0))
        return records

    def run(self, run: Run, outputs: NDArray[np.float64], progress: Progress) -> None:
        """Run to the last output, and record what happens in `run`.

        Raises:
            IntegratorError: if states cannot be followed further.
            SimulationError: if events cannot be resolved.
        """
        point, settings = run.point, run.settings
        y = np.concatenate([point.x, point.z])
        records = self._records()
        legs = _Legs(run)
        begin = point.t, _pointer(y), _pointer(point.q), _pointer(self._free), records, byref(legs)
        self._library.native_begin(self._core, *begin)
        store = _Store(self, outputs, (settings.rtol, settings.atol))
        if settings.max_steps is not None:
            store.shared.crowd = UNEVEN * settings.max_steps // (len(outputs) - 1) + UNEVEN
        budget, status = FIRST, PAUSED
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
            budget = max(1, int(budget * min(share, 2.0)))
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

    def __init__(self, native: Native, outputs: NDArray[np.float64], tolerance: tuple[float, float]) -> None:
        self.native, self.outputs = native, np.ascontiguousarray(outputs)
        modes = len(native.dae.switching.mode_names) + (
            len(native.dae.jumps.motions) if native.dae.jumps else 0
        )
        rows, events = len(outputs) + 2 * ROOM + 2, ROOM + FIRING_ROUNDS * modes + 1
        self.times, self.points = np.empty(rows), np.empty((rows, native.nx + native.nz))
        self.constants, self.starts = np.empty((ROOM + 2, native.nq)), np.empty(ROOM + 2, dtype=np.int64)
        self.event_times, self.impulses = np.empty(events), np.empty(events)
        self.changes, self.stays = np.empty(events, dtype=np.int64), np.empty(events, dtype=np.int64)
        shared = self.shared = _Run()
        shared.stop, shared.interval = outputs[-1], outputs[1] - outputs[0]
        shared.rtol, shared.atol = tolerance
        for name in (
            "outputs",
            "times",
            "points",
            "constants",
            "event_times",
            "impulses",
            "changes",
            "stays",
        ):
            setattr(shared, name, _pointer(getattr(self, name)))
        shared.segment_rows = _pointer(self.starts)
        shared.output_count, shared.next, shared.room = len(outputs), 1, ROOM // 2
        shared.last = -np.inf

    def drain(self, run: Run) -> None:
        """Move what was recorded into `run`."""
        shared, native = self.shared, self.native
        rows = shared.row_count
        starts = self.starts[: shared.segment_count].tolist()
        times, points = self.times[:rows].copy(), self.points[:rows].copy()
        states, algebraic = points[:, : native.nx], points[:, native.nx :]
        first = starts[0] if starts else rows
        if first:
            run.segments[-1].extend(times[:first], states[:first], algebraic[:first])
        for number, begin in enumerate(starts):
            end = starts[number + 1] if number + 1 < len(starts) else rows
            segment = Segment(self.constants[number].copy())
            segment.extend(times[begin:end], states[begin:end], algebraic[begin:end])
            run.segments.append(segment)
        run.events += [self._event(k) for k in range(shared.event_count)]
        if rows:
            run.point = Point(float(times[-1]), states[-1], algebraic[-1], run.segments[-1].q)
        shared.row_count = shared.segment_count = shared.event_count = 0
        run.count(shared.steps - run.steps)

    def _event(self, k: int) -> Event:
        switching, jumps = self.native.dae.switching, self.native.dae.jumps
        if jumps is not None and self.changes[k] >= len(switching.changes):
            number = int(self.changes[k]) - len(switching.changes)
            impulse = float(self.impulses[k]) if number < len(jumps.motions) else None
            return jumped(float(self.event_times[k]), jumps, number, impulse)
        change = switching.changes[self.changes[k]]
        values = switching.mode_values[change.mode]
        source = change.target if self.stays[k] else change.source
        impulse = float(self.impulses[k]) if change.impulse is not None else None
        name = switching.mode_names[change.mode]
        return Event(
            float(self.event_times[k]), change.component, name, values[source], values[change.target], impulse
        )


def _pointer(array: NDArray[Any]) -> Any:
    return array.ctypes.data_as(INTEGERS if array.dtype == np.int64 else DOUBLES)


def _constant(signal: Any, order: int) -> float:
    return float(signal) if isinstance(signal, Real) and not order else 0.0


def _table(signal: Any, order: int) -> tuple[NDArray[np.float64], NDArray[np.float64]] | None:
    """Return the instants and the powers of a record's spline, or of its derivative."""
    if not isinstance(signal, Sampled):
        return None
    course = piecewise(signal).derivative(order)
    missing = np.zeros((4 - len(course.c), len(course.x) - 1))
    return course.x, np.vstack([missing, course.c])


def _library(dae: DAE, functions: dict[str, Any]) -> Any:
    """Return the compiled program of a network with some inputs built in, made once."""
    known = _LIBRARIES.setdefault(dae.flat, {})
    key = Given(functions)
    if key not in known:
        folder = Path(mkdtemp(prefix="inertance-"))
        finalize(dae.flat, rmtree, folder, ignore_errors=True)
        model = CModel(dae, functions, (), (), products=False)
        files = model.texts() | sources((*SOURCES, "native.c"))
        for name, text in files.items():
            (folder / name).write_text(text, encoding="utf-8")
        listed = [folder / name for name in files if name.endswith(".c")]
        known[key] = _loaded(compile_shared(listed, folder / "network.so", flags=["-DCORE_RECORDS", "-O1"]))
        if os.name == "posix":  # a loaded library needs its file no more, and processes may end at any time
            rmtree(folder, ignore_errors=True)
    return known[key]


def _loaded(path: Path) -> Any:
    library = ctypes.CDLL(str(path))
    library.native_size.restype, library.native_size.argtypes = ctypes.c_size_t, [c_int]
    for kind, mirror in enumerate((_Run, _Record, _Legs), 1):
        size = library.native_size(kind)
        if size != ctypes.sizeof(mirror):
            raise ToolchainError(
                f"the compiled network takes {size} bytes for {mirror.__name__[1:]}, this Python "
                f"{ctypes.sizeof(mirror)}; CC and CFLAGS must build for the machine that runs it"
            )
    library.native_message.restype, library.native_message.argtypes = c_char_p, [c_void_p]
    library.native_begin.argtypes, library.native_begin.restype = (
        [c_void_p, c_double, *[DOUBLES] * 3, c_void_p, c_void_p],
        None,
    )
    library.native_tell.argtypes, library.native_tell.restype = [c_void_p, INTEGERS, INTEGERS], None
    library.native_run.argtypes, library.native_run.restype = [c_void_p, POINTER(_Run)], c_int
    return library
