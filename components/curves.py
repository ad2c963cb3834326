"""Curves and maps through points: straight or smooth in between, straight beyond their ends."""

from __future__ import annotations

from typing import Any, Literal

import casadi as ca
import numpy as np

from ..base import Array, rows
from .language import Expression, Pieces, option
from .tables import increasing


def curve(columns: str) -> Any:
    """Declare rows (x, y), whose columns are told with units; the default is a straight line of slope 1."""
    what = "takes at least two rows (x, y) of finite numbers, x increasing"
    check = rows(what, 2, lambda given: len(given) > 1 and increasing(given))
    return option(f"rows ({columns}), the first increasing", default=((0.0, 0.0), (1.0, 1.0)), check=check)


def surface(columns: str) -> Any:
    """Declare rows (x, y, value) that fill a grid, in any order; the default is the plane x + y."""
    what = "takes rows (x, y, value) of finite numbers, one for each pair of at least two x and two y"
    plane = ((0.0, 0.0, 0.0), (0.0, 1.0, 1.0), (1.0, 0.0, 1.0), (1.0, 1.0, 2.0))
    return option(f"rows ({columns}) that fill a grid", default=plane, check=rows(what, 3, _fill_a_grid))


def curve_over_a_turn() -> Any:
    """Declare rows (angle, lift) within one turn, at least three; by default it lifts nothing."""
    what = "takes at least three rows (angle, lift) of finite numbers, angles increasing within one turn"

    def good(given: list[tuple[float, ...]]) -> bool:
        return len(given) > 2 and increasing(given) and given[-1][0] - given[0][0] < 2 * np.pi

    still = ((0.0, 0.0), (2.0, 0.0), (4.0, 0.0))
    return option("rows (angle [rad], lift [m]) over one turn", default=still, check=rows(what, 2, good))


def smoothness() -> Any:
    """Declare whether a curve is straight or smooth between its points."""
    told = "whether it is straight (linear) or smooth, with a steady slope, between the points"
    return option(told, default="linear", choices=("linear", "smooth"))


def between(points: Any, at: Expression, how: str) -> Expression:
    """Return the value of a curve; smooth, it never overshoots its points."""
    return _through(points, how).value(at)


def area(points: Any, at: Expression, how: str) -> Expression:
    """Return the area below a curve, from 0."""
    return _through(points, how).area(at)


class Map:
    """Values over a grid: bilinear, or smooth by cubic pieces in either direction."""

    def __init__(self, x: Any, y: Any, values: Any, how: str = "linear") -> None:
        self.x, self.y, self.values = (np.asarray(given, dtype=float) for given in (x, y, values))
        self.how = how

    def value(self, at_x: Expression, at_y: Expression) -> Expression:
        """Return the value at a place."""
        hats = (
            ca.vertcat(*(curve.written(at) for curve in self._cardinal(points)))
            for points, at in ((self.x, at_x), (self.y, at_y))
        )
        return ca.bilin(ca.DM(self.values), *hats)

    def area(self, at_x: Expression, at_y: float) -> Expression:
        """Return the area below it over x, from 0, along a line y."""
        hats = ca.vertcat(*(curve.written(at_y) for curve in self._cardinal(self.y)))
        below = ca.vertcat(*(curve.area(at_x) for curve in self._cardinal(self.x)))
        return ca.bilin(ca.DM(self.values), below, hats)

    def _cardinal(self, points: Array) -> list[Pieces]:
        """Return for each point the curve that is 1 there and 0 at the others."""
        order: Literal[1, 2] = 2 if len(points) > 2 else 1
        slopes = (lambda x, y: np.gradient(y, x, edge_order=order)) if self.how == "smooth" else None
        return [Pieces.through(points, unit, slopes) for unit in np.eye(len(points))]


def over_grid(points: Any, how: str) -> Map:
    """Return the map of rows (x, y, value) that fill a grid."""
    x, y, values = _columns(sorted(points))
    x, y = np.unique(x), np.unique(y)
    return Map(x, y, values.reshape(len(x), len(y)), how)


def periodic(points: Any, at: Expression, period: float) -> Expression:
    """Return the value of a curve that comes back with a period, its second derivative steady everywhere."""
    x, y = _columns(points)
    x, y = np.append(x, x[0] + period), np.append(y, y[0])
    turned = at - period * ca.floor((at - x[0]) / period)
    return Pieces.through(x, y, _periodic_slopes).value(turned)


def monotone_slopes(x: Array, y: Array) -> Array:
    """Return slopes of a cubic Hermite curve that keeps to the rise and fall of its points.

    Source: F. N. Fritsch, J. Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300-304, ends by three points.
    """
    h, rise = np.diff(x), np.diff(y) / np.diff(x)
    if len(x) == 2:
        return np.array([rise[0], rise[0]])
    left, right = h[1:] + 2 * h[:-1], 2 * h[1:] + h[:-1]
    same = rise[1:] * rise[:-1] > 0
    before, after = np.where(same, rise[:-1], 1.0), np.where(same, rise[1:], 1.0)
    inner = np.where(same, (left + right) / (right / before + left / after), 0.0)
    return np.array([_end(h[0], h[1], rise[0], rise[1]), *inner, _end(h[-1], h[-2], rise[-1], rise[-2])])


def _columns(points: Any) -> Array:
    return np.array([tuple(map(float, row)) for row in points]).T


def _through(points: Any, how: str) -> Pieces:
    x, y = _columns(points)
    return Pieces.through(x, y, monotone_slopes if how == "smooth" else None)


def _fill_a_grid(given: list[tuple[float, ...]]) -> bool:
    pairs = {row[:2] for row in given}
    x, y = {a for a, _ in pairs}, {b for _, b in pairs}
    return len(given) == len(pairs) == len(x) * len(y) and min(len(x), len(y)) > 1


def _end(h: float, next_h: float, rise: float, next_rise: float) -> float:
    slope = ((2 * h + next_h) * rise - h * next_rise) / (h + next_h)
    if slope * rise <= 0:
        return 0.0
    return 3 * rise if rise * next_rise <= 0 and abs(slope) > 3 * abs(rise) else slope


def _periodic_slopes(x: Array, y: Array) -> Array:
    """Return the slopes at which the second derivative is steady at every point, the ends being one."""
    after, rise, one = np.diff(x), np.diff(y) / np.diff(x), np.eye(len(x) - 1)
    before = np.roll(after, 1)
    matrix = np.diag(2 * (before + after))
    matrix += after[:, None] * np.roll(one, -1, axis=1) + before[:, None] * np.roll(one, 1, axis=1)
    right = 3 * (after * np.roll(rise, 1) + before * rise)
    slopes = np.asarray(np.linalg.solve(matrix, right), dtype=float)
    return np.append(slopes, slopes[0])
