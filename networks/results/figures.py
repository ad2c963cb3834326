"""Figures that a notebook shows once."""

from __future__ import annotations

from typing import Any, Never

from matplotlib import pyplot
from matplotlib.figure import Figure


class ShownOnce(Figure):
    """A figure that a notebook's cell shows as its value or, through pyplot, at its end, and not twice."""

    def _ipython_display_(self) -> Never:
        """Take the figure from what the inline backend shows at the end, and leave it to the notebook."""
        if "inline" in pyplot.get_backend():
            pyplot.close(self)
        raise NotImplementedError


def subplots(*args: Any, **options: Any) -> tuple[Figure, Any]:
    """Return what `pyplot.subplots` does, in a figure that a notebook shows once."""
    return pyplot.subplots(*args, FigureClass=ShownOnce, **options)
