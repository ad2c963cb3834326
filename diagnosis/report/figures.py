"""Figures of a report, as plain data for plotly."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ...base import Array
from ...identification import Experiment
from ...networks import pretty_unit
from ..effects.effect import Motion
from ..search.joint_fit import Refit
from ..verdict.localisation import spectrum
from ..verdict.verdict import Verdict

Figure = dict[str, Any]
Stages = Mapping[str, Refit]

MEASURED = "#888888"
COLOURS = ("#ccaa22", "#4477aa", "#ee6677")
SAMPLES = 900_000  # in all curves over time together; two bytes each
FEWEST = 2_000  # samples of a curve
POINTS = 12_000  # in all clouds of one kind together
BINS = 40
AXIS = {"exponentformat": "SI", "automargin": True, "zeroline": False}


def bars(verdict: Verdict, stages: Stages) -> Figure:
    """Return the misfit of each channel at each stage, over noise."""
    gaps = verdict.gap
    fields = ("nominal", "refit", "after")
    data = [
        {
            "type": "bar",
            "name": stage,
            "x": list(gaps),
            "y": [getattr(gap, field) / gap.floor for gap in gaps.values()],
            "marker": {"color": colour},
        }
        for stage, field, colour in zip(stages, fields, COLOURS, strict=False)
    ]
    highest = max(max(bar["y"]) for bar in data)
    floor = {"type": "line", "xref": "paper", "x0": 0, "x1": 1, "y0": 1, "y1": 1, "line": {"dash": "dash"}}
    note = {
        "xref": "paper", "x": 1, "y": 0, "yref": "y", "text": "noise", "showarrow": False, "xanchor": "right",
        "yanchor": "bottom",
    }  # fmt: skip
    span = [np.log10(0.5), np.log10(max(highest, 2.0)) + 0.1]
    layout = {
        "yaxis": {**AXIS, "type": "log", "range": span, "dtick": 1, "title": {"text": "misfit / noise"}},
        "shapes": [floor],
        "annotations": [note],
        "barmode": "group",
        "height": 300,
    }
    return {"data": data, "layout": layout}


def over_time(verdict: Verdict, stages: Stages) -> list[tuple[str, Figure]]:
    """Return name, and measured and simulated channels, of each test record."""
    campaign = verdict.evidence.campaign
    experiments = campaign.testing or campaign.training
    curves = len(campaign.outputs) * (len(stages) + 3)
    shown = experiments[: max(1, SAMPLES // (FEWEST * curves))]
    most = max(FEWEST, SAMPLES // (curves * len(shown)))
    return [(_title(e), _record(verdict, stages, number, most)) for number, e in enumerate(shown)]


def _title(experiment: Experiment) -> str:
    begin, end = experiment.window or (0.0, 0.0)
    return f"{experiment.name}, {begin:g} to {end:g} s" if experiment.window else experiment.name


def _record(verdict: Verdict, stages: Stages, number: int, most: int) -> Figure:
    campaign = verdict.evidence.campaign
    record = (campaign.testing or campaign.training)[number].compared
    data: list[dict[str, Any]] = []
    layout: dict[str, Any] = {"shapes": [], "hovermode": "x"}
    outputs = campaign.outputs
    for row, name in enumerate(outputs):
        sigma = campaign.floors[name].sigma
        unit = pretty_unit(campaign.measured[name].si)
        missed = {stage: (f.test or f.train)[number][name] * sigma for stage, f in stages.items()}
        signal, left = f"y{2 * row + 1}" if row else "y", f"y{2 * row + 2}"
        curves = [("measured", MEASURED, record.values[name], signal)]
        curves += [
            (stage, colour, record.values[name] - gone, signal)
            for (stage, gone), colour in zip(missed.items(), COLOURS, strict=False)
        ]
        curves += [
            (stage, colour, gone, left)
            for (stage, gone), colour in list(zip(missed.items(), COLOURS, strict=False))[-2:]
        ]
        for stage, colour, values, axis in curves:
            data.append(
                {
                    "type": "scatter", "mode": "lines", "name": stage, "legendgroup": stage, "yaxis": axis,
                    "showlegend": row == 0 and axis == signal, "hoverinfo": "x+y",
                    "line": {"color": colour, "width": 2.2 if stage == "measured" else 1.1},
                    "samples": _packed(record.time, values, most),
                }
            )  # fmt: skip
        top, height = 1 - row / len(outputs), 1 / len(outputs)
        for axis, low, high, told in (
            (signal, 0.42, 0.98, name),
            (left, 0.08, 0.36, "residual"),
        ):
            layout[axis.replace("y", "yaxis")] = {
                **AXIS,
                "title": {"text": f"{told} [{unit or '1'}]"},
                "domain": [top - (1 - low) * height, top - (1 - high) * height],
            }
        layout["shapes"].append(
            {
                "type": "rect", "xref": "paper", "x0": 0, "x1": 1, "yref": left, "y0": -2 * sigma,
                "y1": 2 * sigma, "fillcolor": MEASURED, "opacity": 0.25, "line": {"width": 0},
                "layer": "below",
            }
        )  # fmt: skip
    layout["xaxis"] = {**AXIS, "title": {"text": "time [s]"}, "anchor": f"y{2 * len(outputs)}"}
    layout["height"] = 90 + 270 * len(outputs)
    return {"data": data, "layout": layout}


def _packed(time: Array, values: Array, most: int) -> dict[str, Any]:
    """Return evenly spaced samples in two bytes each; of too many, the extremes of short stretches."""
    step = float(time[-1] - time[0]) / (len(time) - 1)
    stride = -(-2 * len(values) // most) if len(values) > most else 1
    if stride > 1:
        parts = np.array_split(values, len(values) // stride)
        ends = [sorted((int(part.argmin()), int(part.argmax()))) for part in parts]
        values = np.concatenate([part[end] for part, end in zip(parts, ends, strict=True)])
        step *= len(time) / len(values)
    low, size = float(values.min()), float(np.ptp(values)) or 1.0
    whole = np.round((values - low) / size * 65535).astype("<u2")
    return {
        "t0": float(time[0]),
        "step": step,
        "low": low,
        "size": size,
        "u2": b64encode(whole.tobytes()).decode(),
    }


def clouds(
    verdict: Verdict, stages: Stages, channel: str, motions: Sequence[Motion], units: Sequence[str]
) -> dict[str, Figure]:
    """Return the residual of a channel against how a site moves, by what it is drawn against."""
    if not motions:
        return {}
    titles = [
        f"{name} [{pretty_unit(unit)}]"
        for name, unit in zip(("position", "speed", "acceleration"), units, strict=True)
    ]
    moved = (np.concatenate([getattr(m, name) for m in motions]) for name in ("s", "v", "a"))
    return {
        title.split(" [")[0]: _cloud(verdict, stages, channel, against, title)
        for title, against in zip(titles, moved, strict=True)
    }


def _cloud(verdict: Verdict, stages: Stages, channel: str, against: Array, title: str) -> Figure:
    campaign = verdict.evidence.campaign
    sigma, unit = campaign.floors[channel].sigma, pretty_unit(campaign.measured[channel].si)
    every = max(1, len(against) * 3 * len(campaign.outputs) // POINTS)
    data = []
    for (stage, fitted), colour in list(zip(stages.items(), COLOURS, strict=False))[-2:]:
        missed = sigma * np.concatenate([record[channel] for record in fitted.test or fitted.train])
        x, y = _means(against, missed)
        marker = {"color": colour, "size": 3, "opacity": 0.3}
        common = {"type": "scatter", "name": stage, "showlegend": False, "hoverinfo": "x+y"}
        data.append(
            {
                **common,
                "mode": "markers",
                "x": _short(against[::every]),
                "y": _short(missed[::every]),
                "marker": marker,
            }
        )
        data.append(
            {
                **common,
                "mode": "lines",
                "x": _short(x),
                "y": _short(y),
                "line": {"color": colour, "width": 2.5},
            }
        )
    layout = {
        "xaxis": {**AXIS, "title": {"text": title}},
        "yaxis": {**AXIS, "title": {"text": f"residual [{unit or '1'}]"}},
        "height": 260,
    }
    return {"data": data, "layout": layout}


def _means(x: Array, y: Array) -> tuple[Array, Array]:
    """Return the mean of y over stretches of x that hold equally many points."""
    order = np.argsort(x)
    parts = np.array_split(order, min(BINS, len(x)))
    return np.array([x[part].mean() for part in parts]), np.array([y[part].mean() for part in parts])


def spectra(verdict: Verdict, stages: Stages, channel: str) -> Figure:
    """Return the power spectral density of a channel's residual, by Welch's method, and of noise."""
    campaign = verdict.evidence.campaign
    sigma, unit = campaign.floors[channel].sigma, pretty_unit(campaign.measured[channel].si)
    experiments = campaign.testing or campaign.training
    rate = experiments[0].compared.rate
    segment = max(64, min(len(e.compared.time) for e in experiments) // 8)
    data = []
    for (stage, fitted), colour in list(zip(stages.items(), COLOURS, strict=False))[-2:]:
        found = [
            spectrum(sigma * record[channel], e.compared.rate, segment)
            for record, e in zip(fitted.test or fitted.train, experiments, strict=True)
        ]
        density = np.mean([np.interp(found[0][0], f, d) for f, d in found], axis=0)
        data.append(
            {
                "type": "scatter", "mode": "lines", "name": stage, "showlegend": False, "hoverinfo": "x+y",
                "x": _short(found[0][0][1:]), "y": _short(density[1:]),
                "line": {"color": colour, "width": 1.5},
            }
        )  # fmt: skip
    floor = 2 * sigma**2 / rate
    line = {
        "type": "line",
        "xref": "paper",
        "x0": 0,
        "x1": 1,
        "y0": floor,
        "y1": floor,
        "line": {"dash": "dash"},
    }
    layout = {
        "xaxis": {**AXIS, "type": "log", "title": {"text": "frequency [Hz]"}},
        "yaxis": {
            **AXIS,
            "type": "log",
            "exponentformat": "power",
            "nticks": 6,
            "title": {"text": f"PSD [({unit or '1'})²/Hz]"},
        },
        "shapes": [line],
        "height": 260,
    }
    return {"data": data, "layout": layout}


def _short(values: Array) -> list[float]:
    """Return numbers with the digits that a plot needs."""
    return [float(f"{value:.5g}") for value in values.tolist()]
