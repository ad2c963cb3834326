"""A fit as text, numbers and pictures."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from ...base import aligned
from ...base.html import listed_notes, page, table_of_texts
from .doubts import over_noise
from .outcome import Comparison, Fit

Rows = list[tuple[str, ...]]
MOST_RECORDS = 6
PANEL_SAMPLES = 400  # that a panel can show one by one


def table(fit: Fit) -> str:
    """See `Fit.table`."""
    remarks = [f"note: {note}" for note in fit.campaign.notes]
    remarks += [f"warning: {warning}" for warning in fit.warnings]
    parts = [*(aligned(rows, right) for rows, right in _tables(fit)), remarks]
    return "\n\n".join(filter(None, map("\n".join, parts)))


def html(fit: Fit) -> str:
    """Return what `table` tells as HTML."""
    campaign = fit.campaign
    tables = (table_of_texts(head, rows) for (head, *rows), _ in _tables(fit))
    told = "interrupted before the end" if fit.interrupted else f"{len(fit.values)} parameters"
    remarks = listed_notes([*campaign.notes, *(f"warning: {warning}" for warning in fit.warnings)])
    return page(f"fit of {campaign.dae.name}", told, *tables, remarks)


def _tables(fit: Fit) -> Iterator[tuple[Rows, set[int]]]:
    """Yield tables, heads first, and which of their columns are of numbers."""
    yield _parameters(fit), {1, 2, 3}
    if any(c.own for c in fit.comparisons):
        yield _own(fit), {3, 4, 5}
    if fit.comparisons:
        yield _records(fit), {3, 4, 6}


def _parameters(fit: Fit) -> Rows:
    rows: Rows = [("parameter", "fitted", "std. error", "started at", "unit", *_levels(fit))]
    for name, value in fit.values.items():
        error, start = fit.errors.get(name, np.nan), fit.campaign.priors[name].center
        own = fit.intervals.get(name)
        between = [] if not fit.intervals else [""] if own is None else [f"{own.low:.5g} to {own.high:.5g}"]
        unit = fit.campaign.dae.unit(name)
        rows.append((name, f"{value:.6g}", f"{error:.2g}", f"{start:.6g}", unit, *between))
    return rows


def _levels(fit: Fit) -> list[str]:
    """Return the head of the column of intervals, if there is one."""
    return [f"{one.level:.3g} interval" for one in list(fit.intervals.values())[:1]]


def _own(fit: Fit) -> Rows:
    head = ("record", "", "its own", "fitted", "std. error", "started at", "unit")
    rows: Rows = [head]
    for c in fit.comparisons:
        for name, value in c.own.items():
            start, unit = fit.campaign.per_record[name].center, fit.campaign.dae.unit(name)
            numbers = f"{value:.6g}", f"{c.own_errors[name]:.2g}", f"{start:.6g}"
            rows.append((c.experiment.name, c.kind, name, *numbers, unit))
    return rows


def _records(fit: Fit) -> Rows:
    head = ("record", "", "channel", "rms before", "after", "noise", "of signal", "unit")
    rows: Rows = [head]
    for c in fit.comparisons:
        for name, floor in fit.campaign.floors.items():
            before, after = (c.rms(name, predicted) for predicted in (c.before, c.after))
            noise, size = f"{floor.sigma:.3g} ({floor.source})", c.size(name)
            share = f"{after / size:.3%}" if size else "-"
            record = c.experiment.name, c.kind, name
            rows.append((*record, f"{before:.4g}", f"{after:.4g}", noise, share, _unit(fit, name)))
    return rows


def _unit(fit: Fit, channel: str) -> str:
    measured = fit.campaign.measured[channel]
    return measured.si or measured.unit


def as_dict(fit: Fit) -> dict[str, Any]:
    """See `Fit.to_dict`."""
    priors, own, units = fit.campaign.priors, fit.campaign.per_record, fit.campaign.dae.unit
    return {
        "parameters": {
            name: {
                "value": value, "error": fit.errors.get(name), "start": priors[name].center,
                "unit": units(name), "prior_deviations": priors[name].moved(value),
                **_told_interval(fit, name),
            }
            for name, value in fit.values.items()
        },
        "correlation": [
            {"parameters": list(done.optimum.values), "matrix": done.uncertainty.correlation.tolist()}
            for done in fit.stages
        ],
        "record_values": [
            {
                "record": c.experiment.name, "tested": c.tested, "parameter": name,
                "value": value, "error": c.own_errors[name], "start": own[name].center,
                "unit": units(name), "prior_deviations": own[name].moved(value),
            }
            for c in fit.comparisons
            for name, value in c.own.items()
        ],
        "noise": {name: floor.to_dict() for name, floor in fit.campaign.floors.items()},
        "records": [
            {
                "record": c.experiment.name, "tested": c.tested, "channel": name,
                "before": c.rms(name, c.before), "after": c.rms(name, c.after), "size": c.size(name),
                "over_noise": over_noise(fit, c, name),
                **_told_change(fit, c),
            }
            for c in fit.comparisons
            for name in fit.campaign.outputs
        ],
        "suspects": [
            {"channels": list(s.channels), "factor": s.factor, "told": s.told} for s in fit.suspects
        ],
        "notes": fit.campaign.notes,
        "interrupted": fit.interrupted,
        "warnings": fit.warnings,
    }  # fmt: skip


def _told_interval(fit: Fit, name: str) -> dict[str, Any]:
    if name not in fit.intervals:
        return {}
    one = fit.intervals[name]
    low, high = (end if np.isfinite(end) else None for end in (one.low, one.high))
    return {"interval": {"level": one.level, "low": low, "high": high}}


def _told_change(fit: Fit, comparison: Comparison) -> dict[str, str]:
    change = comparison.experiment.change
    return {} if change is None else {"change": change.told(fit.campaign.machine)}


def _worst(comparison: Comparison, channel: str) -> slice:
    """Return a stretch of a record short enough to be seen, about where the fit misses most."""
    count = len(comparison.experiment.record.time)
    if count <= PANEL_SAMPLES or channel not in comparison.after:
        return slice(0, count)
    squares = np.concatenate([[0.0], np.cumsum(comparison.residual(channel, comparison.after) ** 2)])
    first = int(np.argmax(squares[PANEL_SAMPLES:] - squares[:-PANEL_SAMPLES]))
    return slice(first, first + PANEL_SAMPLES)


def _title(fit: Fit, comparison: Comparison, channel: str, near: slice) -> str:
    count = len(comparison.experiment.record.time)
    part = ", where the fit misses most" if near.stop - near.start < count else ""
    left = over_noise(fit, comparison, channel)
    told = f"{left:.3g} times the noise left" if np.isfinite(left) else "not simulated"
    return f"{comparison.experiment.name} ({comparison.kind}): {told}{part}"


def plot(fit: Fit, channel: str) -> Any:
    """See `Fit.plot`; of a long record, measured and predicted are shown where the fit misses most."""
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
                rest.plot(record.time, c.residual(channel, predicted), color=color, lw=0.6, label=label)
        signal.plot(record.time[near], record.values[channel][near], "k.", ms=2.5, label="measured", zorder=0)
        rest.axhspan(-2 * sigma, 2 * sigma, color="0.85", label="noise, 2 sigma", zorder=0)
        signal.set_title(_title(fit, c, channel, near), loc="left", fontsize=10)
        signal.set_ylabel(f"{channel} [{unit}]")
        rest.set_ylabel(f"measured - predicted [{unit}]")
    for top, bottom in zip(panels[0], panels[-1], strict=True):
        top.legend(loc="upper right", fontsize=8)
        bottom.set_xlabel("time [s]")
    return figure
