"""A small line chart in SVG, drawn with nothing but text."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from html import escape
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...base import Array

COLOURS = ("#4477aa", "#ee6677", "#228833", "#ccbb44", "#66ccee", "#aa3377")
WIDTH, HEIGHT = 340, 150
LEFT, RIGHT, TOP, BOTTOM = 62, 8, 8, 22
BINS = 240


def line_chart(time: Array, series: Mapping[str, Array], unit: str) -> str:
    """Return an SVG chart of signals that share a unit, with a legend below it."""
    values = np.concatenate(list(series.values()))
    finite = values[np.isfinite(values)]
    low, high = (float(finite.min()), float(finite.max())) if len(finite) else (0.0, 0.0)
    shown = (low - 0.5, high + 0.5) if low == high else (low, high)
    return (
        '<figure style="margin:0">'
        f'<svg width="{WIDTH}" height="{HEIGHT}" viewBox="0 0 {WIDTH} {HEIGHT}" role="img" '
        'style="font:11px sans-serif;fill:currentColor">'
        f"{''.join(_frame(time, (low, high), shown, unit))}"
        f"{''.join(_lines(time, series, shown))}</svg>"
        f'<figcaption style="font:11px sans-serif;max-width:{WIDTH}px">{_legend(series)}</figcaption>'
        "</figure>"
    )


def _frame(
    time: Array, extremes: tuple[float, float], shown: tuple[float, float], unit: str
) -> Iterator[str]:
    right, bottom = WIDTH - RIGHT, HEIGHT - BOTTOM
    yield (
        f'<rect x="{LEFT}" y="{TOP}" width="{right - LEFT}" height="{bottom - TOP}" fill="none" '
        'stroke="currentColor" stroke-opacity="0.3"/>'
    )
    for value in dict.fromkeys(extremes):
        y = _place_y(value, shown) + 4
        told = value if abs(value) > 1e-9 * (shown[1] - shown[0]) else 0.0
        yield f'<text x="{LEFT - 5}" y="{y:.1f}" text-anchor="end">{told:.3g}</text>'
    if shown[0] < 0 < shown[1]:
        y = _place_y(0.0, shown)
        yield (
            f'<line x1="{LEFT}" x2="{right}" y1="{y:.1f}" y2="{y:.1f}" stroke="currentColor" '
            'stroke-opacity="0.25" stroke-dasharray="3 3"/>'
        )
    middle = (TOP + bottom) / 2 + 4
    yield f'<text x="4" y="{middle}" fill-opacity="0.65">{escape(unit)}</text>'
    for x, value, anchor in ((LEFT, time[0], "start"), (right, time[-1], "end")):
        yield f'<text x="{x}" y="{HEIGHT - 6}" text-anchor="{anchor}">{value:g} s</text>'


def _lines(time: Array, series: Mapping[str, Array], shown: tuple[float, float]) -> Iterator[str]:
    for number, (name, values) in enumerate(series.items()):
        kept = _thinned(values)
        share = (time[kept] - time[0]) / (float(time[-1] - time[0]) or 1.0)
        xs, ys = LEFT + share * (WIDTH - LEFT - RIGHT), _place_y(values[kept], shown)
        points = " ".join(f"{x:.1f},{y:.1f}" for x, y in zip(xs, ys, strict=True))
        yield (
            f'<polyline points="{points}" fill="none" stroke-width="1.3" '
            f'stroke="{COLOURS[number % len(COLOURS)]}"><title>{escape(name)}</title></polyline>'
        )


def _legend(series: Mapping[str, Array]) -> str:
    return " ".join(
        f'<span style="white-space:nowrap"><span style="color:{COLOURS[i % len(COLOURS)]}">━</span> '
        f"{escape(name)}</span>"
        for i, name in enumerate(series)
    )


def _place_y(values: Any, shown: tuple[float, float]) -> Any:
    return np.interp(values, shown, (HEIGHT - BOTTOM - 4, TOP + 4))


def _thinned(values: Array) -> NDArray[np.intp]:
    """Return the indices of finite points to draw: the extremes of each of some bins."""
    points = np.flatnonzero(np.isfinite(values))
    if len(points) <= 2 * BINS:
        return points
    parts = np.array_split(points, BINS)
    extremes = [part[[values[part].argmin(), values[part].argmax()]] for part in parts]
    return np.unique(np.concatenate([points[[0, -1]], *extremes]))
