"""The picture of a design: what is played, what is foreseen, and what parts the models."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ...base import unit_for
from ...networks import pretty_unit
from ..criteria import LAW_POINTS_DRAWN

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from .designed import Design

INPUT, COLOURS, NOISE = (
    "#333333",
    ("#1f77b4", "#d95f02", "#2a9d5c", "#8e44ad", "#b8860b", "#c0392b"),
    "#bbbbbb",
)


def drawn(design: Design, path: Any = None) -> Figure:
    """Draw the inputs, and for each output what the models foresee and how far they are from the first."""
    from matplotlib.figure import Figure

    outputs, count = design.campaign.outputs, len(design.inputs)
    figure = Figure(figsize=(9, 1.7 * (count + 2 * len(outputs)) + 0.8), layout="constrained")
    rows = figure.subplots(count + 2 * len(outputs), 1, sharex=True, squeeze=False)[:, 0]
    for axes, (name, values) in zip(rows, design.inputs.items(), strict=False):
        unit, told = _unit(design, name)
        every = max(1, len(values) // LAW_POINTS_DRAWN)
        axes.plot(design.time[::every], unit.from_si(values)[::every], color=INPUT, linewidth=0.8)
        _labelled(axes, f"{name} [{told}]")
    rows[0].set_title(design.told, loc="left", fontsize=10)
    for number, name in enumerate(outputs):
        _draw_output(design, name, rows[count + 2 * number], rows[count + 2 * number + 1])
    rows[count].legend(frameon=False, fontsize=8, loc="lower right", bbox_to_anchor=(1, 0.97), ncols=3)
    rows[-1].set_xlabel("time [s]", fontsize=9)
    if path is not None:
        figure.savefig(path, dpi=120)
    return figure


def _draw_output(design: Design, name: str, above: Axes, below: Axes) -> None:
    experiment, (unit, told) = design.made.experiment, _unit(design, name)
    time, first = experiment.compared.time, design.made.seen[0].run.seen[name]
    below.axhspan(-2, 2, color=NOISE, alpha=0.4, linewidth=0)
    for number, (model, seen) in enumerate(zip(design.models, design.made.seen, strict=True)):
        colour, values = COLOURS[number % len(COLOURS)], seen.run.seen[name]
        style = "-" if number == 0 else "--"
        label = model.told if design.purpose == "hypotheses" else ("as known", "other parameters")[number > 0]
        above.plot(time, unit.from_si(values), style, color=colour, linewidth=0.9, label=label)
        if number:
            apart = (values - first) / experiment.sigma[name]
            below.plot(time, apart, color=colour, linewidth=0.8)
    _labelled(above, f"{name} [{told}]")
    _labelled(below, "apart [noise]")
    reach = max(3.0, 1.05 * max(np.abs(np.asarray(line.get_ydata())).max() for line in below.lines))
    below.set_ylim(-reach, reach)


def _unit(design: Design, name: str) -> tuple[Any, str]:
    channel = design.campaign.measured[name]
    return unit_for(channel.unit, channel.si), pretty_unit(channel.unit or "1")


def _labelled(axes: Axes, label: str) -> None:
    axes.set_ylabel(label, fontsize=9)
    axes.tick_params(labelsize=8)
    axes.grid(color="#dddddd", linewidth=0.6)
    axes.set_axisbelow(True)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
