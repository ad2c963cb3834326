"""Plot signals over time: one panel a unit, one a mode, a tick for every event."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from ...base import ModelError, shown
from .result import Result, matching_signals

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

PANEL_HEIGHT = 2.4
MOST_LEGEND_LINES = 12


def plot_result(result: Result, names: Sequence[str], axes: Any = None) -> Figure:
    """Plot signals over time and return the figure; see `Result.plot`."""
    panels = _panels(result, matching_signals(result.dae, names))
    if not panels:
        raise ModelError(f"name the signals of '{result.name}' to plot; it has no states")
    own = axes is None
    drawn_on = _new_axes(result, panels) if own else _given_axes(panels, axes)
    for ax, panel in zip(drawn_on, panels, strict=True):
        _draw(ax, result, panel)
    drawn_on[-1].set_xlabel("time [s]")
    figure = cast("Figure", drawn_on[0].get_figure(root=True))
    if own:
        figure.align_ylabels()
    return figure


def plot_phase(result: Result, x: str, y: str, axes: Any = None) -> Figure:
    """Plot a signal over another and return the figure; see `Result.plot_phase`."""
    from .figures import subplots

    across, up = result[x], result[y]
    if not (axes is None or hasattr(axes, "plot")):
        raise ModelError(f"axes are matplotlib axes, got {shown(axes)}")
    ax: Axes = subplots(figsize=(5.5, 4.5), layout="constrained")[1] if axes is None else axes
    (line,) = ax.plot(across, up, linewidth=1.2)
    ax.plot(across[:1], up[:1], "o", color=line.get_color(), fillstyle="none")
    units = (pretty_unit(result.unit(name)) for name in (x, y))
    labels = [f"{name} [{unit}]" if unit else name for name, unit in zip((x, y), units, strict=True)]
    ax.set(xlabel=labels[0], ylabel=labels[1], title=result.name)
    ax.grid(alpha=0.3)
    return cast("Figure", ax.get_figure(root=True))


def _panels(result: Result, names: Sequence[str]) -> list[list[str]]:
    """Group signals by unit, in the order in which they were asked for."""
    panels: dict[str, list[str]] = {}
    for name in names:
        key = name if result.values_of(name) else f"[{result.unit(name)}]"
        panels.setdefault(key, []).append(name)
    return list(panels.values())


def _new_axes(result: Result, panels: list[list[str]]) -> list[Axes]:
    from .figures import subplots

    size = (8.0, 1.0 + PANEL_HEIGHT * len(panels))
    figure, axes = subplots(len(panels), sharex=True, figsize=size, layout="constrained")
    figure.suptitle(result.name)
    return list(np.ravel(axes))


def _given_axes(panels: list[list[str]], axes: Any) -> list[Axes]:
    given = list(np.atleast_1d(np.asarray(axes, dtype=object)).ravel())
    if len(given) != len(panels):
        told = "; ".join(", ".join(panel) for panel in panels)
        raise ModelError(
            f"these signals need {len(panels)} axes, one for each unit and mode ({told}), got {len(given)}"
        )
    return given


def _draw(ax: Axes, result: Result, panel: list[str]) -> None:
    for name in panel:
        ax.plot(result.time, result[name], label=name, linewidth=1.4)
    ax.grid(alpha=0.3)
    ax.margins(x=0)
    if values := result.values_of(panel[0]):
        ax.set_yticks(range(len(values)), values)
        ax.set_ylim(-0.3, len(values) - 0.7)
    _label(ax, panel, pretty_unit(result.unit(panel[0])))
    _mark_events(ax, result)


def _label(ax: Axes, panel: list[str], unit: str) -> None:
    """Put the unit beside the panel and the names above it."""
    ax.set_ylabel(f"[{unit}]" if unit else "")
    if len(panel) > MOST_LEGEND_LINES:
        ax.set_title(f"{len(panel)} signals, {panel[0]} to {panel[-1]}", fontsize="small")
        return
    ax.legend(
        fontsize="small",
        ncols=3,
        frameon=False,
        loc="lower left",
        bbox_to_anchor=(0.0, 1.0),
        borderaxespad=0.1,
    )


def _mark_events(ax: Axes, result: Result) -> None:
    """Mark the instants of events by ticks that stand on the time axis."""
    times = sorted({event.time for event in result.events})
    if times:
        axis = ax.get_xaxis_transform()
        ax.vlines(times, 0.0, 0.05, transform=axis, colors="0.35", linewidth=0.9, label="_events")


def pretty_unit(unit: str) -> str:
    """Return a unit as it is printed: N.s/m as N·s/m, m/s2 as m/s²; none for "1"."""
    if unit == "1":
        return ""
    powers = str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹")
    raised = re.sub(r"(?<=[^\W\d_])\d+", lambda exponent: exponent[0].translate(powers), unit)
    return raised.replace(".", "·")
