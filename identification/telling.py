"""A fit in words and pictures."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from .outcome import Fit

MOST_RECORDS = 6


def table(fit: Fit) -> str:
    """Return parameters with standard errors, fits per channel and warnings as text."""
    return "\n".join([*_parameters(fit), "", *_records(fit), *_remarks(fit)])


def _parameters(fit: Fit) -> Iterator[str]:
    rows: list[tuple[str, ...]] = [("parameter", "fitted", "std. error", "started at", "unit")]
    for name, value in fit.values.items():
        error, prior = fit.errors.get(name, np.nan), fit.campaign.priors[name]
        rows.append(
            (name, f"{value:.6g}", f"{error:.2g}", f"{prior.center:.6g}", fit.campaign.dae.unit(name))
        )
    yield from aligned(rows, right={1, 2, 3})


def _records(fit: Fit) -> Iterator[str]:
    rows: list[tuple[str, ...]] = [
        ("record", "", "channel", "rms before", "after", "noise", "of signal", "unit")
    ]
    for c in fit.comparisons:
        for name in fit.campaign.outputs:
            floor = fit.campaign.floors[name]
            after = c.rms(name, c.after)
            rows.append(
                (
                    c.experiment.name, "test" if c.tested else "train", name, f"{c.rms(name, c.before):.4g}",
                    f"{after:.4g}", f"{floor.sigma:.3g} ({floor.source})", f"{after / c.size(name):.3%}",
                    _unit(fit, name),
                )
            )  # fmt: skip
    yield from aligned(rows, right={3, 4, 6})


def _unit(fit: Fit, channel: str) -> str:
    measured = fit.campaign.measured[channel]
    return measured.si or measured.unit


def _remarks(fit: Fit) -> Iterator[str]:
    remarks = [f"note: {note}" for note in fit.campaign.notes]
    remarks += [f"warning: {warning}" for warning in fit.warnings]
    if remarks:
        yield ""
        yield from remarks


def aligned(rows: list[tuple[str, ...]], right: set[int]) -> Iterator[str]:
    """Yield rows as lines of equal columns."""
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    for row in rows:
        cells = [
            cell.rjust(width) if i in right else cell.ljust(width)
            for i, (cell, width) in enumerate(zip(row, widths, strict=True))
        ]
        yield "  ".join(cells).rstrip()


def plot(fit: Fit, channel: str) -> Any:
    """Return a figure with a row for every record: measured and predicted, and the residuals."""
    from matplotlib.figure import Figure

    shown = fit.comparisons[:MOST_RECORDS]
    unit, sigma = _unit(fit, channel), fit.campaign.floors[channel].sigma
    figure = Figure(figsize=(12, 3.2 * len(shown)), layout="constrained")
    panels = figure.subplots(len(shown), 2, squeeze=False, width_ratios=(3, 2))
    for (signal, rest), c in zip(panels, shown, strict=True):
        record = c.experiment.record
        signal.plot(record.time, record.values[channel], color="0.2", lw=1.4, label="measured")
        for label, predicted, color in (("before", c.before, "C1"), ("fitted", c.after, "C0")):
            if channel in predicted:
                signal.plot(record.time, predicted[channel], color=color, lw=0.8, label=label)
                error = record.values[channel] - predicted[channel]
                rest.plot(record.time, error, color=color, lw=0.6, label=label)
        rest.axhspan(-2 * sigma, 2 * sigma, color="0.85", label="noise, 2 sigma")
        signal.set_title(f"{c.experiment.name} ({'test' if c.tested else 'train'})", loc="left", fontsize=10)
        signal.set_ylabel(f"{channel} [{unit}]")
        rest.set_ylabel(f"measured - predicted [{unit}]")
    panels[0, 0].legend(loc="upper right", fontsize=8)
    panels[0, 1].legend(loc="upper right", fontsize=8)
    for axes in panels[-1]:
        axes.set_xlabel("time [s]")
    return figure
