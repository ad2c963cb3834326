"""Progress of a run that takes more than a second, with an estimate of the time left."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from math import floor, log10
from threading import Event, Thread
from typing import ClassVar

from .progress_bars import NotebookBar, TerminalBar, in_notebook

REFRESH_PERIOD = 0.1  # s
SIMULATED = "s simulated"


class Progress:
    """A bar on the terminal, or in a notebook's cell, that appears once a run has lasted a second.

    Of what computes within something else that has a bar, none is shown.
    """

    outermost: ClassVar[Progress | None] = None

    def __init__(
        self, name: str, begin: float, stop: float, wanted: bool | None, unit: str = SIMULATED
    ) -> None:
        self.name, self.begin, self.stop, self.unit = name, begin, stop, unit
        self.wanted = sys.stderr.isatty() or in_notebook() if wanted is None else wanted
        self.started = time.perf_counter()
        self._bar: TerminalBar | NotebookBar | None = None

    def __enter__(self) -> Progress:
        if self.wanted and Progress.outermost is None:
            Progress.outermost = self
        return self

    def at(self, t: float) -> None:
        """Tell that the run has come to time t."""
        if Progress.outermost is not self or (self._bar is None and time.perf_counter() - self.started < 1.0):
            return
        self._bar = self._bar or self._new_bar()
        self._bar.to(t - self.begin)

    @contextmanager
    def watching(self, now: Callable[[], float]) -> Iterator[None]:
        """Ask, from another thread, to what time a long call has come."""
        if Progress.outermost is not self:
            yield
            return
        done = Event()

        def ask() -> None:
            while not done.wait(REFRESH_PERIOD):
                self.at(now())

        thread = Thread(target=ask, daemon=True)
        thread.start()
        try:
            yield
        finally:
            done.set()
            thread.join()

    def _new_bar(self) -> TerminalBar | NotebookBar:
        digits = 0 if self.unit != SIMULATED else max(0, 2 - floor(log10(self.stop - self.begin)))
        kind = NotebookBar if in_notebook() else TerminalBar
        return kind(self.name, self.stop - self.begin, digits, self.unit)

    def __exit__(self, *_: object) -> None:
        if Progress.outermost is self:
            Progress.outermost = None
        if self._bar is not None:
            self._bar.stop()
