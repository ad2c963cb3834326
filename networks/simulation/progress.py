"""Progress of a run that takes more than a second, with an estimate of the time left."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from math import floor, log10
from threading import Event, Thread
from typing import Any

REFRESH_PERIOD = 0.1  # s
SIMULATED = "s simulated"


class Progress:
    """A bar on the terminal that appears once a run has lasted a second."""

    def __init__(
        self, name: str, begin: float, stop: float, wanted: bool | None, unit: str = SIMULATED
    ) -> None:
        self.name, self.begin, self.stop, self.unit = name, begin, stop, unit
        self.wanted = sys.stderr.isatty() if wanted is None else wanted
        self.started = time.perf_counter()
        self._bar: Any = None

    def __enter__(self) -> Progress:
        return self

    def at(self, t: float) -> None:
        """Tell that the run has come to time t."""
        if not self.wanted or (self._bar is None and time.perf_counter() - self.started < 1.0):
            return
        bar = self._bar or self._show()
        bar.update(bar.task_ids[0], completed=t - self.begin)

    @contextmanager
    def watching(self, now: Callable[[], float]) -> Iterator[None]:
        """Ask, from another thread, to what time a long call has come."""
        if not self.wanted:
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

    def _show(self) -> Any:
        from rich.console import Console
        from rich.progress import BarColumn, TextColumn, TimeElapsedColumn, TimeRemainingColumn
        from rich.progress import Progress as Bar

        counted = self.unit != SIMULATED
        digits = 0 if counted else max(0, 2 - floor(log10(self.stop - self.begin)))
        columns = (
            TextColumn("{task.description}"), BarColumn(),
            TextColumn(f"{{task.completed:.{digits}f}}/{{task.total:.{digits}f}} {self.unit}"),
            TimeElapsedColumn(), TextColumn("left"), TimeRemainingColumn(),
        )  # fmt: skip
        self._bar = Bar(*columns, console=Console(stderr=True), transient=True)
        self._bar.start()
        self._bar.add_task(self.name, total=self.stop - self.begin)
        return self._bar

    def __exit__(self, *_: object) -> None:
        if self._bar is not None:
            self._bar.stop()
