"""Crossings: where an indicator rises above zero between nodes, by cubic interpolation."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def first_crossing(
    times: Array, values: Array, rates: Array, active: NDArray[np.bool_], near: Array
) -> tuple[int, int, float] | None:
    """Return (interval, indicator, time) of the earliest crossing, or None.

    Args:
        times: instants of the nodes, (nodes,).
        values: indicators at the nodes, (indicators, nodes).
        rates: their time derivatives.
        active: which indicators count.
        near: size below which an indicator counts as zero, (indicators,).
    """
    step = np.diff(times)
    before, after = values[:, :-1], values[:, 1:]
    slope_a, slope_b = rates[:, :-1] * step, rates[:, 1:] * step
    highest = np.maximum(after, _interior_maximum(before, after, slope_a, slope_b))
    limit = near[:, None]
    returns = (before > limit) & (slope_a < 0) & (after > limit) & (slope_b > 0)
    crosses = active[:, None] & (((before <= limit) & (highest > limit)) | returns)
    intervals = np.flatnonzero(crosses.any(axis=0))
    if not len(intervals):
        return None
    k = int(intervals[0])
    found = []
    for i in np.flatnonzero(crosses[:, k]):
        theta = _root(before[i, k], after[i, k], slope_a[i, k], slope_b[i, k], near[i])
        found.append((theta, int(i)))
    theta, indicator = min(found)
    return k, indicator, float(times[k] + theta * step[k])


def _coefficients(a: Array, b: Array, da: Array, db: Array) -> tuple[Array, Array]:
    """Return the cubic and the square coefficient of the Hermite cubic a + da x + c2 x^2 + c3 x^3."""
    return 2 * a - 2 * b + da + db, -3 * a + 3 * b - 2 * da - db


def _interior_maximum(a: Array, b: Array, da: Array, db: Array) -> Array:
    c3, c2 = _coefficients(a, b, da, db)
    root = np.sqrt(np.maximum(c2**2 - 3 * c3 * da, 0))
    best = np.full(a.shape, -np.inf)
    with np.errstate(divide="ignore", invalid="ignore"):
        for x in (-da / (c2 + root), -da / (c2 - root)):
            inside = (x > 0) & (x < 1) & np.isfinite(x)
            x = np.where(inside, x, 0.0)
            value = a + x * (da + x * (c2 + x * c3))
            best = np.where(inside, np.maximum(best, value), best)
    return best


def _root(a: float, b: float, da: float, db: float, near: float) -> float:
    """Return where the cubic rises through zero, as a share of the interval."""
    c3, c2 = _coefficients(np.array(a), np.array(b), np.array(da), np.array(db))
    coefficients = np.trim_zeros(np.array([float(c3), float(c2), da, a]), "f")
    roots = np.roots(coefficients) if len(coefficients) > 1 else np.array([])
    real = sorted(float(r.real) for r in roots if abs(r.imag) < 1e-9 and 0 < r.real <= 1)
    for x in real:
        if da + x * (2 * float(c2) + 3 * x * float(c3)) >= 0:
            return x
    return 0.0 if a >= -near or b <= a else float(np.clip(-a / (b - a), 0.0, 1.0))
