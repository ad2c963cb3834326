"""Hops: onto a crossing that is too near to integrate to."""

from __future__ import annotations

import numpy as np

from ....base import Array
from ..point import Point, solve_algebraic
from ..tolerance import Tolerance
from .indicators import Indicators


def hopped(
    indicators: Indicators, point: Point, duration: float, indicator: int, tolerance: Tolerance
) -> Point | None:
    """Return the crossing a very short time later (or earlier), or None if it is too far for one step.

    One step of the trapezoidal rule, corrected twice; the second correction bounds its error.
    """
    later = Point(point.t, point.x, point.z, point.q)
    _move(indicators, later, duration)
    before, change = _motion(indicators, point), np.zeros(0)
    for _ in range(2):
        corrected = point.x + 0.5 * duration * (before + _motion(indicators, later))
        change, later.x = np.abs(corrected - later.x), corrected
        solve_algebraic(indicators.closed, later)
    allowed = 0.1 * (tolerance.rtol * np.abs(point.x) + tolerance.atol)
    if (change > allowed).any() or not _shift(indicators, later, indicator):
        return None
    return later if indicators.passed(point, later) is None else None


def _shift(indicators: Indicators, point: Point, indicator: int) -> bool:
    """Move a point that is very near a crossing onto it, along its velocity; tell whether it is there."""
    for _ in range(2):
        values, rates = indicators.watch(point)
        if rates[indicator] <= 0:
            return False
        _move(indicators, point, -float(values[indicator] / rates[indicator]))
    return bool(abs(indicators.watch(point)[0][indicator]) <= indicators.tolerance()[indicator])


def _move(indicators: Indicators, point: Point, duration: float) -> None:
    """Move a point by a very short time, along its velocity."""
    point.x = point.x + duration * _motion(indicators, point)
    point.t += duration
    solve_algebraic(indicators.closed, point)


def _motion(indicators: Indicators, point: Point) -> Array:
    return indicators.functions.motion(point.x, point.z, point.q, point.t)[0]
