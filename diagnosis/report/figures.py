"""Figures of a report, as plain data for plotly."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ...base import Array
from ...networks import pretty_unit
from ..effects.effect import Motion
from ..search.model_comparison import Refit
from ..verdict.gap import titled
from ..verdict.localisation import spectrum
from ..verdict.verdict import Verdict

Figure = dict[str, Any]
Stages = Mapping[str, Refit]

MEASURED_COLOUR = "#888888"
STAGE_COLOURS = ("#ccaa22", "#4477aa", "#ee6677")
RECORD_SAMPLES = 900_000  # in all curves over time together; two bytes each
LEAST_CURVE_SAMPLES = 2_000
CLOUD_POINTS = 12_000  # in all clouds of one kind together
CLOUD_BINS = 40


def bars(verdict: Verdict, stages: Stages) -> Figure:
    """Return the misfit of each channel at each stage, over noise."""
    gaps = verdict.gap
    data: list[dict[str, Any]] = []
    for stage, field, colour in zip(stages, ("nominal", "refit", "after"), STAGE_COLOURS, strict=False):
        heights = [getattr(gap, field) / gap.floor for gap in gaps.values()]
        data.append(
            {"type": "bar", "name": stage, "x": list(gaps), "y": heights, "marker": {"color": colour}}
        )
    highest = max(max(bar["y"]) for bar in data)
    note = {"xref": "paper", "x": 1, "y": 0, "yref": "y", "text": "noise", "showarrow": False}
    span = [np.log10(0.5), np.log10(max(highest, 2.0)) + 0.1]
    layout = {
        "yaxis": axis_of("misfit / noise", type="log", range=span, dtick=1),
        "shapes": [_dashed(1)],
        "annotations": [{**note, "xanchor": "right", "yanchor": "bottom"}],
        "barmode": "group",
        "height": 300,
    }
    return {"data": data, "layout": layout}


def over_time(verdict: Verdict, stages: Stages) -> list[tuple[str, Figure]]:
    """Return name, and measured and simulated channels, of each test record."""
    experiments = verdict.evidence.study.judged
    curves = len(verdict.evidence.campaign.outputs) * (len(stages) + 3)
    shown = experiments[: max(1, RECORD_SAMPLES // (LEAST_CURVE_SAMPLES * curves))]
    most = max(LEAST_CURVE_SAMPLES, RECORD_SAMPLES // (curves * len(shown)))
    return [(titled(e), _record(verdict, stages, number, most)) for number, e in enumerate(shown)]


def _record(verdict: Verdict, stages: Stages, number: int, most: int) -> Figure:
    campaign, record = verdict.evidence.campaign, verdict.evidence.study.judged[number].compared
    data: list[dict[str, Any]] = []
    shapes: list[dict[str, Any]] = []
    layout: dict[str, Any] = {"shapes": shapes, "hovermode": "x"}
    for row, name in enumerate(campaign.outputs):
        sigma, unit = _noise(verdict, name)
        signal, left = f"y{2 * row + 1}" if row else "y", f"y{2 * row + 2}"
        measured = record.values[name]
        missed = [
            (stage, colour, verdict.evidence.missed(f, name)[number])
            for stage, f, colour in _coloured(stages)
        ]
        curves = [("measured", MEASURED_COLOUR, measured, signal)]
        curves += [(stage, colour, measured - gone, signal) for stage, colour, gone in missed]
        curves += [(*shown, left) for shown in missed[-2:]]
        for stage, colour, values, axis in curves:
            look = line_of(colour, 2.2 if stage == "measured" else 1.1)
            legend = {"yaxis": axis, "legendgroup": stage, "showlegend": row == 0 and axis == signal}
            data.append(curve_of(stage, **look, **legend, samples=packed(record.time, values, most)))
        height = 1 / len(campaign.outputs)
        top = 1 - row * height
        for axis, low, high, told in ((signal, 0.42, 0.98, name), (left, 0.08, 0.36, "residual")):
            domain = [top - (1 - low) * height, top - (1 - high) * height]
            layout[axis.replace("y", "yaxis")] = axis_of(f"{told} [{unit}]", domain=domain)
        shapes.append(_band(left, 2 * sigma))
    layout["xaxis"] = axis_of("time [s]", anchor=f"y{2 * len(campaign.outputs)}")
    layout["height"] = 90 + 270 * len(campaign.outputs)
    return {"data": data, "layout": layout}


def packed(time: Array, values: Array, most: int) -> dict[str, Any]:
    """Return evenly spaced samples in two bytes each; of too many, the extremes of short stretches."""
    step = float(time[-1] - time[0]) / (len(time) - 1)
    stride = -(-2 * len(values) // most) if len(values) > most else 1
    if stride > 1:
        parts = np.array_split(values, len(values) // stride)
        ends = [sorted((int(part.argmin()), int(part.argmax()))) for part in parts]
        values = np.concatenate([part[end] for part, end in zip(parts, ends, strict=True)])
        step *= len(time) / len(values)
    low, size = float(values.min()), float(np.ptp(values)) or 1.0
    whole = b64encode(np.round((values - low) / size * 65535).astype("<u2").tobytes()).decode()
    return {"t0": float(time[0]), "step": step, "low": low, "size": size, "u2": whole}


def clouds(
    verdict: Verdict, stages: Stages, channel: str, motions: Sequence[Motion], units: Sequence[str]
) -> dict[str, Figure]:
    """Return the residual of a channel against how a site moves, by what it is drawn against."""
    if not motions:
        return {}
    signals = {"position": "s", "speed": "v", "acceleration": "a"}
    figures = {}
    experiments = verdict.evidence.study.judged
    for (name, signal), unit in zip(signals.items(), units, strict=True):
        moved = (getattr(motion, signal) for motion in motions)
        against = np.concatenate([e.counted(values) for e, values in zip(experiments, moved, strict=True)])
        figures[name] = _cloud(verdict, stages, channel, against, f"{name} [{pretty_unit(unit)}]")
    return figures


def _cloud(verdict: Verdict, stages: Stages, channel: str, against: Array, title: str) -> Figure:
    _, unit = _noise(verdict, channel)
    experiments = verdict.evidence.study.judged
    every = max(1, len(against) * 3 * len(verdict.evidence.campaign.outputs) // CLOUD_POINTS)
    data = []
    for stage, fitted, colour in _coloured(stages)[-2:]:
        missed = np.concatenate(fitted.counted(experiments, channel))
        marker = {"color": colour, "size": 3, "opacity": 0.3}
        points = points_of(against[::every], missed[::every])
        data.append(curve_of(stage, mode="markers", marker=marker, **points))
        data.append(curve_of(stage, **line_of(colour, 2.5), **points_of(*_means(against, missed))))
    return _small(data, axis_of(title), axis_of(f"residual [{unit}]"))


def _means(x: Array, y: Array) -> tuple[Array, Array]:
    """Return the mean of y over stretches of x that hold equally many points."""
    parts = np.array_split(np.argsort(x), min(CLOUD_BINS, len(x)))
    return np.array([x[part].mean() for part in parts]), np.array([y[part].mean() for part in parts])


def spectra(verdict: Verdict, stages: Stages, channel: str) -> Figure:
    """Return the power spectral density of a channel's residual, by Welch's method, and of noise."""
    sigma, unit = _noise(verdict, channel)
    experiments = verdict.evidence.study.judged
    records = [e.compared for e in experiments]
    segment = max(64, min(len(e.counted(e.compared.time)) for e in experiments) // 8)
    data = []
    for stage, fitted, colour in _coloured(stages)[-2:]:
        found = [
            spectrum(missed, record.rate, segment)
            for missed, record in zip(fitted.counted(experiments, channel), records, strict=True)
        ]
        common = found[0][0]
        density = np.mean([np.interp(common, f, d) for f, d in found], axis=0)
        data.append(curve_of(stage, **line_of(colour, 1.5), **points_of(common[1:], density[1:])))
    power = axis_of(f"PSD [({unit})²/Hz]", type="log", exponentformat="power", nticks=6)
    noise = _dashed(2 * sigma**2 / records[0].rate)
    return _small(data, axis_of("frequency [Hz]", type="log"), power, shapes=[noise])


def _noise(verdict: Verdict, channel: str) -> tuple[float, str]:
    """Return the noise of a channel, and its unit as it is written."""
    campaign = verdict.evidence.campaign
    return campaign.sigma[channel], pretty_unit(campaign.measured[channel].si) or "1"


def _coloured(stages: Stages) -> list[tuple[str, Refit, str]]:
    return [(*stage, colour) for stage, colour in zip(stages.items(), STAGE_COLOURS, strict=False)]


def _small(data: list[dict[str, Any]], x: Figure, y: Figure, **more: Any) -> Figure:
    return {"data": data, "layout": {"xaxis": x, "yaxis": y, "height": 260, **more}}


def curve_of(stage: str, **more: Any) -> dict[str, Any]:
    """Return a curve, not in the legend."""
    return {"type": "scatter", "name": stage, "showlegend": False, "hoverinfo": "x+y", **more}


def line_of(colour: str, width: float) -> dict[str, Any]:
    """Return the look of a line."""
    return {"mode": "lines", "line": {"color": colour, "width": width}}


def points_of(x: Array, y: Array) -> dict[str, list[float]]:
    """Return coordinates with the digits that a plot needs."""
    return {axis: [float(f"{v:.5g}") for v in values.tolist()] for axis, values in (("x", x), ("y", y))}


def axis_of(title: str, **more: Any) -> dict[str, Any]:
    """Return an axis."""
    common = {"exponentformat": "SI", "automargin": True, "zeroline": False}
    return {**common, "title": {"text": title}, **more}


def _dashed(level: float) -> dict[str, Any]:
    """Return a dashed line across a figure: the level of noise."""
    ends = {"x0": 0, "x1": 1, "y0": level, "y1": level}
    return {"type": "line", "xref": "paper", **ends, "line": {"dash": "dash"}}


def _band(axis: str, half: float) -> dict[str, Any]:
    """Return a grey band about zero."""
    ends = {"xref": "paper", "x0": 0, "x1": 1, "yref": axis, "y0": -half, "y1": half}
    look = {"fillcolor": MEASURED_COLOUR, "opacity": 0.25, "line": {"width": 0}, "layer": "below"}
    return {"type": "rect", **ends, **look}
