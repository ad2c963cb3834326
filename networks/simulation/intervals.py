"""Interval arithmetic: what an expression can be at all while its arguments move within bounds.

Source: Moore, Kearfott, Cloud, Introduction to Interval Analysis, SIAM 2009, chapters 2 and 5.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import casadi as ca
import numpy as np

from ...base import Array, Flags

Bounds = tuple[Array, Array]

_RISING: dict[int, Callable[[Any], Any]] = {
    ca.OP_EXP: np.exp,
    ca.OP_LOG: np.log,
    ca.OP_SQRT: np.sqrt,
    ca.OP_ATAN: np.arctan,
    ca.OP_SINH: np.sinh,
    ca.OP_TANH: np.tanh,
    ca.OP_ASINH: np.arcsinh,
    ca.OP_ASIN: np.arcsin,
    ca.OP_ACOSH: np.arccosh,
    ca.OP_ATANH: np.arctanh,
    ca.OP_LOG1P: np.log1p,
    ca.OP_EXPM1: np.expm1,
    ca.OP_TWICE: lambda x: 2 * x,
    ca.OP_ASSIGN: lambda x: x,
    ca.OP_LIFT: lambda x: x,
}
_STEPS = {ca.OP_FLOOR: np.floor, ca.OP_CEIL: np.ceil, ca.OP_SIGN: np.sign}
_LIMITS = {ca.OP_ERF: (-1.0, 1.0), ca.OP_ACOS: (0.0, np.pi)}


class Enclosure:
    """Bounds of a function's results over boxes of its arguments, for many boxes at once.

    Wherever a comparison, a rounding, a corner or a sign can go either way within a box, or a pole lies in
    it, the box counts as undecided: what the function does there is not one smooth course.

    Args:
        function: an SX function of columns.

    Limits: bounds are rounded to nearest, not outwards; where an operation has no tight rule they are
        wider than need be. They do not hold what fmin and fmax make of a NaN, which is the other argument.
    """

    def __init__(self, function: Any) -> None:
        self.rows = function.numel_out(0)
        self._steps = [
            (
                function.instruction_id(k),
                function.instruction_output(k),
                function.instruction_input(k),
                function.instruction_constant(k) if function.instruction_id(k) == ca.OP_CONST else 0.0,
            )
            for k in range(function.n_instructions())
        ]
        self._places = function.sparsity_out(0).row()

    def __call__(self, *columns: list[Bounds]) -> tuple[Array, Array, Flags]:
        """Return lower and upper bounds, (boxes, rows), and which boxes are undecided.

        Args:
            columns: bounds of every entry of every argument, (boxes,) each.
        """
        count = next(len(low) for column in columns for low, _ in column)
        lows, highs = np.zeros((count, self.rows)), np.zeros((count, self.rows))
        undecided = np.zeros(count, dtype=bool)
        work: dict[int, Bounds] = {}
        with np.errstate(all="ignore"):
            for operation, into, of, number in self._steps:
                if operation == ca.OP_OUTPUT:
                    row = self._places[into[1]]
                    lows[:, row], highs[:, row] = work[of[0]]
                elif operation == ca.OP_INPUT:
                    work[into[0]] = columns[of[0]][of[1]]
                elif operation == ca.OP_CONST:
                    constant = np.full(count, number)
                    work[into[0]] = constant, constant
                else:
                    low, high, unsure = _bounds(operation, *(work[place] for place in of))
                    work[into[0]] = _whole_where_nan(low, high)
                    undecided |= unsure
        return lows, highs, undecided


def _whole_where_nan(low: Array, high: Array) -> Bounds:
    unknown = ~((low < np.inf) & (high > -np.inf))
    return np.where(unknown, -np.inf, low), np.where(unknown, np.inf, high)


def _bounds(operation: int, a: Bounds, b: Bounds | None = None) -> tuple[Array, Array, Any]:
    """Return the bounds of an operation, and where it may go either way."""
    if operation in _RISING:
        return _RISING[operation](a[0]), _RISING[operation](a[1]), False
    if operation in _STEPS:
        low, high = _STEPS[operation](a[0]), _STEPS[operation](a[1])
        return low, high, low != high
    if operation in _UNARY:
        return _UNARY[operation](*a)
    if b is not None and operation in _BINARY:
        return _BINARY[operation](a, b)
    least, most = _LIMITS.get(operation, (-np.inf, np.inf))
    return np.full_like(a[0], least), np.full_like(a[0], most), False


def _even(function: Callable[[Any], Any]) -> Callable[[Array, Array], tuple[Array, Array, Any]]:
    """Return bounds of an even function that rises with the size of its argument."""

    def bounds(low: Array, high: Array) -> tuple[Array, Array, Any]:
        least = np.where((low <= 0) & (high >= 0), 0.0, np.minimum(np.abs(low), np.abs(high)))
        return function(least), function(np.maximum(np.abs(low), np.abs(high))), False

    return bounds


def _wave(function: Callable[[Any], Any], shift: float) -> Callable[[Array, Array], tuple[Array, Array, Any]]:
    """Return bounds of a function that is sin(x + shift)."""

    def bounds(low: Array, high: Array) -> tuple[Array, Array, Any]:
        first, last = low + shift, high + shift
        ends = function(low), function(high)
        crest = np.floor((last - np.pi / 2) / (2 * np.pi)) > np.floor((first - np.pi / 2) / (2 * np.pi))
        trough = np.floor((last + np.pi / 2) / (2 * np.pi)) > np.floor((first + np.pi / 2) / (2 * np.pi))
        return np.where(trough, -1.0, np.minimum(*ends)), np.where(crest, 1.0, np.maximum(*ends)), False

    return bounds


def _tangent(low: Array, high: Array) -> tuple[Array, Array, Any]:
    pole = np.floor(high / np.pi + 0.5) > np.floor(low / np.pi + 0.5)
    return np.where(pole, -np.inf, np.tan(low)), np.where(pole, np.inf, np.tan(high)), pole


def _inverse(low: Array, high: Array) -> tuple[Array, Array, Any]:
    through = (low <= 0) & (high >= 0)
    return np.where(through, -np.inf, 1 / high), np.where(through, np.inf, 1 / low), through


def _fabs(low: Array, high: Array) -> tuple[Array, Array, Any]:
    return *_even(lambda x: x)(low, high)[:2], (low < 0) & (high > 0)


def _truth(low: Array, high: Array) -> tuple[Flags, Flags]:
    """Tell where a value is certainly true (not zero), and certainly false."""
    return (low > 0) | (high < 0), (low == 0) & (high == 0)


def _logical(true: Flags, false: Flags, told: bool = True) -> tuple[Array, Array, Any]:
    unsure = ~(true | false)
    return np.where(true, 1.0, 0.0), np.where(false, 0.0, 1.0), unsure if told else False


def _not(low: Array, high: Array) -> tuple[Array, Array, Any]:
    true, false = _truth(low, high)
    return _logical(false, true, told=False)


def _and(a: Bounds, b: Bounds) -> tuple[Array, Array, Any]:
    (true, false), (also, neither) = _truth(*a), _truth(*b)
    return _logical(true & also, false | neither, told=False)


def _or(a: Bounds, b: Bounds) -> tuple[Array, Array, Any]:
    (true, false), (also, neither) = _truth(*a), _truth(*b)
    return _logical(true | also, false & neither, told=False)


def _same(a: Bounds, b: Bounds) -> tuple[Flags, Flags]:
    apart = (a[1] < b[0]) | (b[1] < a[0])
    return (a[0] == a[1]) & (b[0] == b[1]) & (a[0] == b[0]), apart


def _different(a: Bounds, b: Bounds) -> tuple[Array, Array, Any]:
    same, apart = _same(a, b)
    return _logical(apart, same)


def _if_else_zero(a: Bounds, b: Bounds) -> tuple[Array, Array, Any]:
    true, false = _truth(*a)
    low, high = np.where(false, 0.0, b[0]), np.where(false, 0.0, b[1])
    return np.where(true, low, np.minimum(low, 0.0)), np.where(true, high, np.maximum(high, 0.0)), False


def _product(a: Bounds, b: Bounds) -> tuple[Array, Array, Any]:
    corners = [np.where((x == 0) | (y == 0), 0.0, x * y) for x in a for y in b]
    return np.minimum.reduce(corners), np.maximum.reduce(corners), False


def _quotient(a: Bounds, b: Bounds) -> tuple[Array, Array, Any]:
    low, high, pole = _inverse(*b)
    return *_product(a, (low, high))[:2], pole


def _power(a: Bounds, b: Bounds) -> tuple[Array, Array, Any]:
    corners = [x**y for x in a for y in b]
    low, high = np.minimum.reduce(corners), np.maximum.reduce(corners)
    whole = (b[0] == b[1]) & (b[0] == np.rint(b[0])) & (b[0] > 0)
    through = (a[0] < 0) & (a[1] > 0)
    low = np.where(whole & through & (b[0] % 2 == 0), 0.0, low)
    tight = (a[0] >= 0) | whole
    corner = (a[0] <= 0) & (a[1] >= 0) & (b[0] <= 0) & (b[1] >= 0)
    return np.where(tight, low, -np.inf), np.where(tight, high, np.inf), corner


def _greater(a: Bounds, b: Bounds) -> tuple[Array, Array, Any]:
    return np.maximum(a[0], b[0]), np.maximum(a[1], b[1]), (a[1] > b[0]) & (b[1] > a[0])


def _lesser(a: Bounds, b: Bounds) -> tuple[Array, Array, Any]:
    return np.minimum(a[0], b[0]), np.minimum(a[1], b[1]), (a[1] > b[0]) & (b[1] > a[0])


def _copysign(a: Bounds, b: Bounds) -> tuple[Array, Array, Any]:
    least, most, _ = _even(lambda x: x)(*a)
    positive, negative = b[0] > 0, b[1] < 0
    low = np.where(positive, least, -most)
    return low, np.where(negative, -least, most), ~(positive | negative)


def _angle(a: Bounds, b: Bounds) -> tuple[Array, Array, Any]:
    """Return bounds of atan2(a, b), which jumps where a changes its sign beside a negative b, and at zero."""
    cut = (a[0] <= 0) & (a[1] >= 0) & (b[0] <= 0)
    corners = [np.arctan2(y, x) for y in a for x in b]
    low, high = np.minimum.reduce(corners), np.maximum.reduce(corners)
    return np.where(cut, -np.pi, low), np.where(cut, np.pi, high), cut


def _remains(rounded: Callable[[Any], Any]) -> Callable[[Bounds, Bounds], tuple[Array, Array, Any]]:
    """Return bounds of a - b round(a/b), for constant b."""

    def bounds(a: Bounds, b: Bounds) -> tuple[Array, Array, Any]:
        first, last = rounded(a[0] / b[0]), rounded(a[1] / b[0])
        one = (first == last) & (b[0] == b[1]) & (np.abs(first) < 2**53)
        known = ((b[0] > 0) | (b[1] < 0)) & np.isfinite(a[0]) & np.isfinite(a[1])
        size = np.where(known, np.maximum(np.abs(b[0]), np.abs(b[1])), np.inf)
        low, high = np.where(one, a[0] - first * b[0], -size), np.where(one, a[1] - last * b[0], size)
        return low, high, ~one

    return bounds


_UNARY: dict[int, Callable[[Array, Array], tuple[Array, Array, Any]]] = {
    ca.OP_NEG: lambda low, high: (-high, -low, False),
    ca.OP_SQ: _even(np.square),
    ca.OP_COSH: _even(np.cosh),
    ca.OP_FABS: _fabs,
    ca.OP_SIN: _wave(np.sin, 0.0),
    ca.OP_COS: _wave(np.cos, np.pi / 2),
    ca.OP_TAN: _tangent,
    ca.OP_INV: _inverse,
    ca.OP_NOT: _not,
}
_BINARY: dict[int, Callable[[Bounds, Bounds], tuple[Array, Array, Any]]] = {
    ca.OP_ADD: lambda a, b: (a[0] + b[0], a[1] + b[1], False),
    ca.OP_SUB: lambda a, b: (a[0] - b[1], a[1] - b[0], False),
    ca.OP_MUL: _product,
    ca.OP_DIV: _quotient,
    ca.OP_POW: _power,
    ca.OP_CONSTPOW: _power,
    ca.OP_LT: lambda a, b: _logical(a[1] < b[0], a[0] >= b[1]),
    ca.OP_LE: lambda a, b: _logical(a[1] <= b[0], a[0] > b[1]),
    ca.OP_EQ: lambda a, b: _logical(*_same(a, b)),
    ca.OP_NE: _different,
    ca.OP_AND: _and,
    ca.OP_OR: _or,
    ca.OP_IF_ELSE_ZERO: _if_else_zero,
    ca.OP_FMAX: _greater,
    ca.OP_FMIN: _lesser,
    ca.OP_COPYSIGN: _copysign,
    ca.OP_ATAN2: _angle,
    ca.OP_FMOD: _remains(np.trunc),
    ca.OP_REMAINDER: _remains(np.rint),
}
