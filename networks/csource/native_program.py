"""Native program: a network as C for runs in this process, made once for all of them."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any
from weakref import WeakKeyDictionary

from ..flattening.flat import Flat
from ..simulation.input_signals import SignalKey
from .library_cache import CLibrary
from .model import CModel
from .program import SOURCES, sources

if TYPE_CHECKING:
    from ..simulation.bound_dae import BoundDAE

FLAGS = ("-DCORE_RECORDS", "-O1")
SHARED = ("-O2", "-DCORE_SHARED", "-Werror=vla")  # an array without ROOM would be one
MOST_PROGRAMS = 16  # of a network, by the functions built in
_PROGRAMS: WeakKeyDictionary[Flat, dict[SignalKey, NativeProgram]] = WeakKeyDictionary()


class NativeProgram:
    """A network as C, with those signals built in that are functions of time; numbers and records are not."""

    def __init__(self) -> None:
        self._process: int | None = None
        self._library: CLibrary | None = None
        self._loaded: Any = None

    @property
    def is_begun(self) -> bool:
        """Whether this process, and not one that it was forked from, lets it be compiled."""
        return self._process == os.getpid()

    def begin(self, closed: BoundDAE) -> None:
        """Let it be compiled beside what goes on, unless it is kept."""
        self._process = os.getpid()
        if self._loaded is None:
            self._written(closed).begin()

    def is_ready(self, closed: BoundDAE) -> bool:
        """Tell whether it can be loaded at once."""
        return self._loaded is not None or self._written(closed).is_ready()

    def loaded(self, closed: BoundDAE, load: Callable[[Path], Any]) -> Any:
        """Return the library as `load` gives it, once it is compiled."""
        if self._loaded is None:
            self._loaded = self._written(closed).load(load)
            self._library = None
        return self._loaded

    def _written(self, closed: BoundDAE) -> CLibrary:
        if self._library is None:
            model = CModel(closed.dae, closed.functions, (), (), standalone=False)
            self._library = _library(model, closed.mark)
        return self._library


def _library(model: CModel, mark: str) -> CLibrary:
    """Return a model with the core of its size class, or, too large for any, with a core of its own."""
    texts, core = model.texts(), sources((*SOURCES, "record.c", "native.c"))
    header = model.shared_header
    if header is None:
        return CLibrary(texts | core, FLAGS, mark)
    shared = CLibrary({"model.h": header} | core, (*FLAGS, *SHARED), "core", suffix=".o")
    texts["model.c"] += model.shared_sizes
    return CLibrary(texts, FLAGS, mark, [shared])


def program_of(closed: BoundDAE) -> NativeProgram:
    """Return the program of a network with the inputs of a run; those of the same functions share it."""
    known, key = _PROGRAMS.setdefault(closed.dae.flat, {}), SignalKey(closed.functions)
    program = known[key] = known.pop(key) if key in known else NativeProgram()
    if len(known) > MOST_PROGRAMS:
        del known[next(iter(known))]
    return program
