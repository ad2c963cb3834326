"""The passes of the filter and the smoother by a C program, which is compiled once for a machine."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from ctypes import POINTER, Structure, byref, c_double, c_longlong
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from ...base import Array
from ...networks import CLibrary, ToolchainError
from .course import Course, Roughness
from .passed import Passed

SOURCE = "passes.c"
DOUBLES = POINTER(c_double)


class _Course(Structure):
    """`Course` in passes.c."""

    COUNTS = "points", "states", "order", "sites", "outputs", "columns"
    ARRAYS = "map", "here", "there", "to_x", "to_f", "values", "measured", "kept", "added", "start"
    _fields_ = [*((name, c_longlong) for name in COUNTS), *((name, DOUBLES) for name in ARRAYS)]

    def __init__(self, course: Course, roughness: Roughness) -> None:
        outputs, states = course.to_x.shape[1:]
        counts = len(course.t), states, roughness.order, len(roughness.size), outputs, course.columns.shape[2]
        known = course.map, course.here, course.there, course.to_x, course.to_f, course.columns
        steps = *known, course.measured, *roughness.over(np.diff(course.t)), roughness.start
        self.held = [np.ascontiguousarray(array, dtype=float) for array in steps]
        super().__init__(*counts, *map(_pointer, self.held))


class _Passed(Structure):
    """`Passed` in passes.c."""

    COUNTS = "records", "record", "columns", "keep"
    ARRAYS = "innovations", "spreads", "gains", "rows", "ahead"
    _fields_ = [*((name, c_longlong) for name in COUNTS), *((name, DOUBLES) for name in ARRAYS)]

    def __init__(self, passed: Passed, record: int) -> None:
        records, columns = passed.innovations.shape[1], passed.innovations.shape[4]
        arrays = (_pointer(getattr(passed, name)) for name in self.ARRAYS)
        super().__init__(records, record, columns, len(passed.rows) > 0, *arrays)


class CompiledPasses:
    """Both passes, as `stacked_passes` has them."""

    def __init__(self, library: Any) -> None:
        self._library = library

    def forward(self, courses: Sequence[Course], roughness: Roughness, keep: bool) -> Passed:
        """Go forward through records, for every site alone; see `Passed`."""
        passed = Passed.nothing(courses, courses[0].map.shape[1] + roughness.order, keep)
        for record, course in enumerate(courses):
            along = _Course(course, roughness)
            room = self._room(along)
            self._library.passes_forward(byref(along), byref(_Passed(passed, record)), _pointer(room))
        return passed

    def back(
        self, courses: Sequence[Course], roughness: Roughness, passed: Passed, missed: Array
    ) -> tuple[Array, Array]:
        """Return what later points tell of the force and of its variance, (points, records, sites) each."""
        force, variance = (np.zeros(missed.shape[:3]) for _ in range(2))
        missed = np.ascontiguousarray(missed)
        for record, course in enumerate(courses):
            along = _Course(course, roughness)
            room = self._room(along)
            told = (_pointer(array) for array in (missed, force, variance, room))
            self._library.passes_back(byref(along), byref(_Passed(passed, record)), *told)
        return force, variance

    def _room(self, along: _Course) -> Array:
        """Return what the passes of a record work in."""
        return np.empty(self._library.passes_room(byref(along)))


@cache
def compiled_passes() -> CompiledPasses | None:
    """Return both passes as a C program; None where no compiler is."""
    text = Path(__file__).with_name(SOURCE).read_text(encoding="utf-8")
    try:
        return CompiledPasses(CLibrary({SOURCE: text}, ("-O3",), "passes").load(_loaded))
    except ToolchainError:
        return None


def _loaded(path: Path) -> Any:
    library = ctypes.CDLL(str(path))
    library.passes_size.restype = library.passes_room.restype = c_longlong
    library.passes_room.argtypes = [POINTER(_Course)]
    sizes = ctypes.sizeof(_Course), ctypes.sizeof(_Passed)
    if (library.passes_size(0), library.passes_size(1)) != sizes:
        raise ToolchainError("CC and CFLAGS must build for the machine that runs this Python")
    library.passes_forward.restype = library.passes_back.restype = None
    library.passes_forward.argtypes = [POINTER(_Course), POINTER(_Passed), DOUBLES]
    library.passes_back.argtypes = [POINTER(_Course), POINTER(_Passed), *[DOUBLES] * 4]
    return library


def _pointer(array: Array) -> Any:
    return array.ctypes.data_as(DOUBLES)
