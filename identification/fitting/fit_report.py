"""A fit in words and pictures."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from ...base import aligned
from .doubts import over_noise

if TYPE_CHECKING:
    from .outcome import Comparison, Fit

MOST_RECORDS = 6
SEEN = 400  # samples that a panel can show one by one


def table(fit: Fit) -> str:
    """Return parameters with standard errors, fits per channel and warnings as text."""
    records = ["", *_records(fit)] if fit.comparisons else []
    return "\n".join([*_parameters(fit), *records, *_remarks(fit)])


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


def _worst(comparison: Comparison, channel: str) -> slice:
    """Return a stretch of a record short enough to be seen, about where the fit misses most."""
    measured = comparison.experiment.record.values[channel]
    if len(measured) <= SEEN or channel not in comparison.after:
        return slice(0, len(measured))
    squares = np.concatenate([[0.0], np.cumsum((measured - comparison.after[channel]) ** 2)])
    first = int(np.argmax(squares[SEEN:] - squares[:-SEEN]))
    return slice(first, first + SEEN)


def _title(fit: Fit, comparison: Comparison, channel: str, near: slice) -> str:
    kind = "test" if comparison.tested else "train"
    count = len(comparison.experiment.record.time)
    part = ", where the fit misses most" if near.stop - near.start < count else ""
    left = over_noise(fit, comparison, channel)
    told = f"{left:.3g} times the noise left" if np.isfinite(left) else "not simulated"
    return f"{comparison.experiment.name} ({kind}): {told}{part}"


def plot(fit: Fit, channel: str) -> Any:
    """Return a figure with a row for every record: measured and predicted, and the residuals.

    Of a long record, measured and predicted are shown where the fit misses most.
    """
    from matplotlib.figure import Figure

    shown = fit.comparisons[:MOST_RECORDS]
    unit, sigma = _unit(fit, channel), fit.campaign.floors[channel].sigma
    figure = Figure(figsize=(12, 3.2 * len(shown)), layout="constrained")
    panels = figure.subplots(len(shown), 2, squeeze=False, width_ratios=(3, 2))
    for (signal, rest), c in zip(panels, shown, strict=True):
        record = c.experiment.record
        near = _worst(c, channel)
        for label, predicted, color in (("before", c.before, "C1"), ("fitted", c.after, "C0")):
            if channel in predicted:
                signal.plot(record.time[near], predicted[channel][near], color=color, lw=1.2, label=label)
                error = record.values[channel] - predicted[channel]
                rest.plot(record.time, error, color=color, lw=0.6, label=label)
        signal.plot(record.time[near], record.values[channel][near], "k.", ms=2.5, label="measured", zorder=0)
        rest.axhspan(-2 * sigma, 2 * sigma, color="0.85", label="noise, 2 sigma", zorder=0)
        signal.set_title(_title(fit, c, channel, near), loc="left", fontsize=10)
        signal.set_ylabel(f"{channel} [{unit}]")
        rest.set_ylabel(f"measured - predicted [{unit}]")
    panels[0, 0].legend(loc="upper right", fontsize=8)
    panels[0, 1].legend(loc="upper right", fontsize=8)
    for axes in panels[-1]:
        axes.set_xlabel("time [s]")
    return figure
