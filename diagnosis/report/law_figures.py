"""Figures of what is missing as a force: its law, its course in time, and an effect's curve through it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from ...base import Array
from ...networks import pretty_unit
from ..criteria import LAW_POINTS_DRAWN
from ..law.axes import UNITS, along
from ..law.law import Law
from ..law.missing_force import MissingForce
from ..law.without import Without
from .figures import MEASURED_COLOUR, STAGE_COLOURS, Figure, axis_of, curve_of, line_of, packed, points_of

FORCE_COLOUR = STAGE_COLOURS[-1]
HEIGHT = 340
CURVES_OF_MAP = 5
FINE = 400


def of_law(law: Law) -> Figure:
    """Return a law over the force that it was fitted to; of two variables as lines over the first."""
    first, *rest = law.grid.axes
    motions = [along(motion, first.variable) for motion in law.motions]
    data = [_dots("missing force", motions, law.forces)]
    if not rest:
        fine = np.union1d(first.points, np.linspace(first.points[0], first.points[-1], FINE))
        curve, error = first.basis(fine) @ law.values, 2 * first.basis(fine) @ law.standard_error
        edges = {"mode": "lines", "line": {"width": 0}, "hoverinfo": "skip"}
        data.append(curve_of("", **edges | points_of(fine, curve - error)))
        filled = {"fill": "tonexty", "fillcolor": "rgba(238,102,119,0.25)"}
        data.append(curve_of("", **edges | filled | points_of(fine, curve + error)))
        data.append(_named("law", **line_of(FORCE_COLOUR, 2.2), **points_of(fine, curve)))
    else:
        data += _lines_of(law)
    return _over(data, first.variable, law.units[0], law.unit)


def _lines_of(law: Law) -> Iterator[dict[str, Any]]:
    """Yield a map as lines over its first variable, each at a value of the other."""
    first, other = law.grid.axes
    values = law.values.reshape(len(first.points), len(other.points))
    chosen = np.unique(np.linspace(0, len(other.points) - 1, CURVES_OF_MAP).round().astype(int))
    for place, k in enumerate(chosen):
        told = f"{other.variable} {other.points[k]:.3g} {pretty_unit(law.units[1])}"
        colour = f"hsl({int(230 - 220 * place / max(len(chosen) - 1, 1))},70%,50%)"
        yield _named(told, **line_of(colour, 1.8), **points_of(first.points, values[:, k]))


def of_effect(seen: Without) -> Figure:
    """Return the force that is missing without an effect, and the effect's own through it."""
    units = UNITS[seen.placed.site.domain]
    named = seen.placed.effect.kind.replace("_", " ")
    x, f = (np.concatenate(parts) for parts in zip(*seen.own, strict=True))
    order = np.argsort(x)[:: max(1, len(x) // LAW_POINTS_DRAWN)]
    own = {"mode": "markers", "marker": {"color": FORCE_COLOUR, "size": 3}, **points_of(x[order], f[order])}
    data = [
        _dots("missing without it", [x for x, _ in seen.missing], [f for _, f in seen.missing]),
        _named(named, **own),
    ]
    return _over(data, seen.variable, units[seen.variable], units["load"])


def over_time(missing: MissingForce) -> Figure:
    """Return a missing force over time, one record below the other."""
    data, layout = list[dict[str, Any]](), dict[str, Any]()
    unit, count = pretty_unit(missing.unit), len(missing.records)
    for row, one in enumerate(missing.records):
        number = "" if row == 0 else str(row + 1)
        even = np.linspace(one.time[0], one.time[-1], len(one.time))
        samples = packed(even, np.interp(even, one.time, one.force), 4 * LAW_POINTS_DRAWN)
        axes = {"xaxis": f"x{number}", "yaxis": f"y{number}"}
        data.append(curve_of(one.record, **line_of(FORCE_COLOUR, 1.1), **axes, samples=samples))
        top, high = 1 - row / count, 1 / count
        domain = [top - 0.72 * high, top - 0.1 * high]
        layout[f"yaxis{number}"] = axis_of(f"force [{unit}]", domain=domain, anchor=f"x{number}")
        told = f"{one.record}: time [s]"
        layout[f"xaxis{number}"] = axis_of(told, anchor=f"y{number}")
    return {"data": data, "layout": {**layout, "height": 60 + 170 * count}}


def over_motion(missing: MissingForce) -> dict[str, Figure]:
    """Return a missing force over position and over speed of its site."""
    units = UNITS[missing.site.domain]
    return {
        variable: _over(
            [
                _dots(
                    "missing force",
                    [along(one.motion, variable) for one in missing.records],
                    [one.force for one in missing.records],
                )
            ],
            variable,
            units[variable],
            missing.unit,
        )
        for variable in ("position", "speed")
    }


def _over(data: list[dict[str, Any]], variable: str, unit: str, force: str) -> Figure:
    x, y = f"{variable} [{pretty_unit(unit)}]", f"force [{pretty_unit(force)}]"
    return {"data": data, "layout": {"xaxis": axis_of(x), "yaxis": axis_of(y), "height": HEIGHT}}


def _dots(name: str, x: Sequence[Array], f: Sequence[Array]) -> dict[str, Any]:
    across, along = np.concatenate(x), np.concatenate(f)
    every = max(1, len(across) // LAW_POINTS_DRAWN)
    marker = {"color": MEASURED_COLOUR, "size": 3, "opacity": 0.5}
    return _named(name, mode="markers", marker=marker, **points_of(across[::every], along[::every]))


def _named(name: str, **more: Any) -> dict[str, Any]:
    return {**curve_of(name, **more), "showlegend": True}
