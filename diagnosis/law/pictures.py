"""Pictures of a missing force and of its law."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ...networks import pretty_unit
from ..criteria import LAW_POINTS_DRAWN
from .axes import UNITS, along

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from .law import Law
    from .missing_force import MissingForce

INK, FORCE, SCATTER = "#1a1a1a", "#c0392b", "#2c6fbb"


def drawn_force(missing: MissingForce, path: Any = None) -> Figure:
    """Draw a missing force over time, and over position and speed of its site."""
    from matplotlib.figure import Figure

    count = len(missing.records)
    figure = Figure(figsize=(9, 2.2 * count + 3.2), layout="constrained")
    grid = figure.add_gridspec(count + 1, 2, height_ratios=[2] * count + [3])
    for row, one in enumerate(missing.records):
        axes = figure.add_subplot(grid[row, :])
        band = one.force - 2 * one.standard_error, one.force + 2 * one.standard_error
        axes.fill_between(one.time, *band, color=FORCE, alpha=0.25, linewidth=0)
        axes.plot(one.time, one.force, color=FORCE, linewidth=0.8)
        _labelled(axes, "time [s]", f"force [{pretty_unit(missing.unit)}]")
        axes.set_title(f"{one.record}: missing force at {missing.site.path}", loc="left", fontsize=9)
    for column, variable in enumerate(("position", "speed")):
        axes = figure.add_subplot(grid[count, column])
        for one in missing.records:
            _dots(axes, along(one.motion, variable), one.force)
        unit = pretty_unit(UNITS[missing.site.domain][variable])
        _labelled(axes, f"{variable} [{unit}]", f"force [{pretty_unit(missing.unit)}]")
    return _saved(figure, path)


def drawn_law(law: Law, path: Any = None) -> Figure:
    """Draw a law over the force that it was fitted to; of two variables as lines over the first."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(7, 4.6), layout="constrained")
    axes = figure.add_subplot()
    for force, motion in zip(law.forces, law.motions, strict=True):
        _dots(axes, along(motion, law.variables[0]), force)
    if len(law.grid.axes) == 1:
        x, f, error = law.grid.axes[0].points, law.values, 2 * law.standard_error
        fine = np.union1d(x, np.linspace(x[0], x[-1], 400))
        axes.fill_between(x, f - error, f + error, color=FORCE, alpha=0.25, linewidth=0)
        axes.plot(fine, law.grid.axes[0].basis(fine) @ f, color=FORCE, linewidth=1.6, label="law")
    else:
        _map(axes, law)
    names = zip(law.variables, law.units, strict=True)
    label = [f"{name} [{pretty_unit(unit)}]" for name, unit in names]
    _labelled(axes, label[0], f"force [{pretty_unit(law.unit)}]")
    axes.set_title(f"law at {law.site.path}: {law.explained:.0%} foreseen", loc="left", fontsize=10)
    axes.legend(frameon=False, fontsize=8)
    return _saved(figure, path)


def _map(axes: Axes, law: Law) -> None:
    from matplotlib import colormaps

    first, other = law.grid.axes
    values = law.values.reshape(len(first.points), len(other.points))
    chosen = np.unique(np.linspace(0, len(other.points) - 1, 7).round().astype(int))
    for shade, k in zip(np.linspace(0.05, 0.9, len(chosen)), chosen, strict=True):
        told = f"{other.variable} {other.points[k]:.3g} {pretty_unit(law.units[1])}"
        axes.plot(first.points, values[:, k], color=colormaps["viridis"](shade), label=told)


def _dots(axes: Axes, x: Any, f: Any) -> None:
    every = max(1, len(x) // LAW_POINTS_DRAWN)
    axes.plot(x[::every], f[::every], ".", color=SCATTER, markersize=2, alpha=0.4, rasterized=True)


def _labelled(axes: Axes, x: str, y: str) -> None:
    axes.set_xlabel(x, fontsize=9)
    axes.set_ylabel(y, fontsize=9)
    axes.tick_params(labelsize=8)
    axes.grid(color="#dddddd", linewidth=0.6)
    axes.set_axisbelow(True)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)


def _saved(figure: Figure, path: Any) -> Figure:
    if path is not None:
        figure.savefig(path, dpi=130)
    return figure
