"""Curves and maps through points: straight or smooth in between, straight beyond their ends."""

from collections.abc import Callable
from itertools import pairwise
from typing import Any, Literal

import casadi as ca
import numpy as np

from ..base import Array, rows
from .language import Expression, option
from .tables import interpolated

Slopes = Callable[[Array, Array], Array]


def curve(columns: str) -> Any:
    """Declare rows (x, y), whose columns are told with units; the default is a straight line of slope 1."""
    what = "takes at least two rows (x, y) of finite numbers, x increasing"
    check = rows(what, 2, lambda given: len(given) > 1 and all(a[0] < b[0] for a, b in pairwise(given)))
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
        rising = all(a[0] < b[0] for a, b in pairwise(given))
        return len(given) > 2 and rising and given[-1][0] - given[0][0] < 2 * np.pi

    still = ((0.0, 0.0), (2.0, 0.0), (4.0, 0.0))
    return option("rows (angle [rad], lift [m]) over one turn", default=still, check=rows(what, 2, good))


def smoothness() -> Any:
    """Declare whether a curve is straight or smooth between its points."""
    told = "whether it is straight (linear) or smooth, with a steady slope, between the points"
    return option(told, default="linear", choices=("linear", "smooth"))


def between(points: Any, at: Expression, how: str) -> Expression:
    """Return the value of a curve; smooth, it never overshoots its points."""
    given = tuple(tuple(map(float, row)) for row in points)
    if how == "linear":
        return interpolated(given, at)
    x, y = np.array(given).T
    return _hermite(x, y, at, monotone_slopes(x, y))


def over_grid(points: Any, at_x: Expression, at_y: Expression, how: str) -> Expression:
    """Return the value of a map: bilinear, or smooth by cubic pieces in either direction."""
    given = np.array(sorted(tuple(map(float, row)) for row in points))
    x, y = np.unique(given[:, 0]), np.unique(given[:, 1])
    values = given[:, 2].reshape(len(x), len(y))
    return ca.bilin(ca.DM(values), ca.vertcat(*_cardinal(x, at_x, how)), ca.vertcat(*_cardinal(y, at_y, how)))


def periodic(points: Any, at: Expression, period: float) -> Expression:
    """Return the value of a curve that comes back with a period, its second derivative steady everywhere."""
    x, y = np.array([tuple(map(float, row)) for row in points]).T
    x, y = np.append(x, x[0] + period), np.append(y, y[0])
    turned = at - period * ca.floor((at - x[0]) / period)
    return _hermite(x, y, turned, _periodic_slopes(x, y))


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
    h, rise = np.diff(x), np.diff(y) / np.diff(x)
    count = len(h)
    matrix, right = np.zeros((count, count)), np.zeros(count)
    for i in range(count):
        before, after = h[i - 1], h[i]
        matrix[i, i - 1] += after
        matrix[i, i] += 2 * (before + after)
        matrix[i, (i + 1) % count] += before
        right[i] = 3 * (after * rise[i - 1] + before * rise[i])
    slopes = np.linalg.solve(matrix, right)
    return np.append(slopes, slopes[0])


def _cardinal(x: Array, at: Expression, how: str) -> list[Expression]:
    """Return for each point the curve that is 1 there and 0 at the others."""
    units = np.eye(len(x))
    if how == "linear":
        return [interpolated(tuple(zip(x, unit, strict=True)), at) for unit in units]
    order: Literal[1, 2] = 2 if len(x) > 2 else 1
    return [_hermite(x, unit, at, np.gradient(unit, x, edge_order=order)) for unit in units]


def _hermite(x: Array, y: Array, at: Expression, slopes: Array) -> Expression:
    """Return the cubic curve through points with these slopes, straight beyond its ends."""
    h, rise = np.diff(x), np.diff(y) / np.diff(x)
    second = (3 * rise - 2 * slopes[:-1] - slopes[1:]) / h
    third = (slopes[:-1] + slopes[1:] - 2 * rise) / h**2
    straight = np.zeros(1)
    coefficients = (
        np.concatenate([straight, third, straight]),
        np.concatenate([straight, second, straight]),
        np.concatenate([slopes[:1], slopes]),
        np.concatenate([y[:1], y]),
    )
    at = ca.SX(at)
    past = at - ca.pw_const(at, ca.DM(x), ca.DM(np.concatenate([x[:1], x])))
    value: Expression = 0.0
    for column in coefficients:
        value = value * past + ca.pw_const(at, ca.DM(x), ca.DM(column))
    return value
