"""Event location: where an indicator rises above zero between nodes, by cubic Hermite interpolation."""

from __future__ import annotations

from typing import Any

import numpy as np

from ....base import Array, Flags
from .constants import CUBIC_BISECTIONS, CUBIC_CREST

Crossing = tuple[int, int, float]
MISSED_SHARE = 0.05  # of its range, by which a cubic misses a node that does not follow


def first_crossing(times: Array, values: Array, rates: Array, active: Flags, near: Array) -> Crossing | None:
    """Return (interval, indicator, time) of the earliest crossing, or None.

    Values and rates are those of indicators at equidistant nodes, (indicators, nodes); only the `active` ones
    count, and as zero below the size `near`.
    """
    rows = np.flatnonzero(active)
    limit = near[rows, None]
    values, rises = values[rows], rates[rows] * (times[1] - times[0])
    before, after, slope_a, slope_b = values[:, :-1], values[:, 1:], rises[:, :-1], rises[:, 1:]
    bound = np.maximum(before, after) + CUBIC_CREST * (np.abs(slope_a) + np.abs(slope_b))
    near_by = np.flatnonzero((bound > limit).any(axis=0))
    if not len(near_by):
        return None
    before, after, slope_a, slope_b = (a[:, near_by] for a in (before, after, slope_a, slope_b))
    highest = np.maximum(after, _interior_maximum(before, after, slope_a, slope_b))
    returns = (before > limit) & (slope_a <= 0) & (after > limit) & (slope_b > 0)
    crosses = ((before <= limit) & (highest > limit)) | returns
    intervals = np.flatnonzero(crosses.any(axis=0))
    if not len(intervals):
        return None
    k = int(intervals[0])
    theta, indicator = min(
        (_root(before[i, k], after[i, k], slope_a[i, k], slope_b[i, k], limit[i, 0]), int(rows[i]))
        for i in np.flatnonzero(crosses[:, k])
    )
    first = int(near_by[k])
    return first, indicator, float(times[first] + theta * (times[first + 1] - times[first]))


def followed(times: Array, values: Array, rates: Array, active: Flags, near: Array) -> bool:
    """Tell whether nodes follow the indicators: a cubic over two intervals meets the node between.

    A jump and what dies out soon are missed by few nodes, a fast oscillation by most. Same arguments.
    """
    v, r = values[active], rates[active] * (times[1] - times[0])
    cubic = 0.5 * (v[:, :-2] + v[:, 2:]) + 0.25 * (r[:, :-2] - r[:, 2:])
    lost = np.abs(cubic - v[:, 1:-1]) > (MISSED_SHARE * np.ptp(v, axis=1) + near[active])[:, None]
    return bool((np.count_nonzero(lost, axis=1) <= len(times) // 8).all())


def _coefficients(a: Any, b: Any, da: Any, db: Any) -> tuple[Any, Any]:
    """Return the cubic and the square coefficient of the Hermite cubic a + da x + c2 x^2 + c3 x^3."""
    return 2 * a - 2 * b + da + db, -3 * a + 3 * b - 2 * da - db


def _interior_maximum(a: Array, b: Array, da: Array, db: Array) -> Array:
    """Return the highest value inside each interval that has a peak there, else minus infinity."""
    highest = np.full(a.shape, -np.inf)
    peaked = (da > 0) & (db < 0)
    if peaked.any():
        a, b, da, db = a[peaked], b[peaked], da[peaked], db[peaked]
        c3, c2 = _coefficients(a, b, da, db)
        lean = 3 * (b - a) - da - db
        x = da / (da + (np.sqrt(lean**2 - da * db) - lean))
        highest[peaked] = a + x * (da + x * (c2 + x * c3))
    return highest


def _root(a: float, b: float, da: float, db: float, near: float) -> float:
    """Return where the cubic rises through zero, as a share of the interval."""
    c3, c2 = _coefficients(a, b, da, db)
    turns = max(c2 * c2 - 3 * c3 * da, 0.0) ** 0.5
    low, high = 0.0, 1.0
    if a >= 0:
        if da >= 0:
            return 0.0
        low = -da / (c2 + turns)
    if b <= near:
        high = -da / (c2 - turns)
    for _ in range(CUBIC_BISECTIONS):
        middle = 0.5 * (low + high)
        below = a + middle * (da + middle * (c2 + middle * c3)) < 0
        low, high = (middle, high) if below else (low, middle)
    return high
