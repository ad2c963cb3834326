"""Bars that fill as a computation goes on, and are gone when it ends: on a terminal, in a notebook's cell."""

from __future__ import annotations

import sys
import time
from html import escape
from importlib import import_module
from typing import Any


def in_notebook() -> bool:
    """Return whether Python runs in a notebook's kernel."""
    ipython = sys.modules.get("IPython")
    return ipython is not None and type(ipython.get_ipython()).__name__ == "ZMQInteractiveShell"


class TerminalBar:
    """A bar on standard error."""

    def __init__(self, name: str, total: float, digits: int, unit: str) -> None:
        from rich.console import Console
        from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn

        columns = (
            TextColumn("{task.description}"), BarColumn(),
            TextColumn(f"{{task.completed:.{digits}f}}/{{task.total:.{digits}f}} {unit}"),
            TimeElapsedColumn(), TextColumn("left"), TimeRemainingColumn(),
        )  # fmt: skip
        self._bar = Progress(*columns, console=Console(stderr=True), transient=True)
        self._bar.start()
        self._task = self._bar.add_task(name, total=total)

    def to(self, done: float) -> None:
        """Fill it."""
        self._bar.update(self._task, completed=done)

    def stop(self) -> None:
        """Take it away."""
        self._bar.stop()


class NotebookBar:
    """A bar below the cell that computes."""

    def __init__(self, name: str, total: float, digits: int, unit: str) -> None:
        shown: Any = import_module("IPython.display")  # there is one in a notebook
        self._name, self._total, self._digits, self._unit = name, total, digits, unit
        self._html, self._begun = shown.HTML, time.perf_counter()
        self._shown = shown.display(shown.HTML(""), display_id=True)

    def to(self, done: float) -> None:
        """Fill it."""
        passed = time.perf_counter() - self._begun
        left = f", {passed * (self._total / done - 1):.0f} s left" if done > 0 and passed > 1.0 else ""
        told = f"{done:.{self._digits}f}/{self._total:.{self._digits}f} {self._unit}{left}"
        bar = f'<progress value="{done / self._total:.4f}" style="width:16em"></progress>'
        self._shown.update(self._html(f"<div>{escape(self._name)} {bar} {told}</div>"))

    def stop(self) -> None:
        """Take it away."""
        self._shown.update(self._html(""))
