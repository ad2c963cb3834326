"""Interval arithmetic: what an expression can be at all while its arguments move within bounds.

Source: Moore, Kearfott, Cloud, Introduction to Interval Analysis, SIAM 2009, chapters 2 and 5.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import casadi as ca
import numpy as np

from ...base import Array, Flags
from ..flattening.instructions import instructions

Bounds = tuple[Array, Array]
Truth = tuple[Flags, Flags]  # where something is certainly true, and where certainly false
Enclosed = tuple[Array, Array, Any]  # bounds, and where the result may go either way
Rule = Callable[..., Enclosed]


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
        self._instructions = instructions(function)
        self._places = function.sparsity_out(0).row()

    def __call__(self, *columns: list[Bounds]) -> tuple[Array, Array, Flags]:
        """Return lower and upper bounds, (boxes, rows), and which boxes are undecided.

        The bounds of every entry of every argument are given, (boxes,) each.
        """
        count = next(len(low) for column in columns for low, _ in column)
        lows, highs = np.zeros((2, count, self.rows))
        undecided = np.zeros(count, dtype=bool)
        work: dict[int, Bounds] = {}
        with np.errstate(all="ignore"):
            for instruction in self._instructions:
                operation, into, of = instruction.operation, instruction.into, instruction.of
                if operation == ca.OP_OUTPUT:
                    row = self._places[into[1]]
                    lows[:, row], highs[:, row] = work[of[0]]
                elif operation == ca.OP_INPUT:
                    work[into[0]] = columns[of[0]][of[1]]
                elif operation == ca.OP_CONST:
                    constant = np.full(count, instruction.constant)
                    work[into[0]] = constant, constant
                else:
                    low, high, unsure = _RULES.get(operation, _UNKNOWN)(*(work[place] for place in of))
                    unknown = ~((low < np.inf) & (high > -np.inf))  # NaN, too
                    bounds = np.where(unknown, -np.inf, low), np.where(unknown, np.inf, high)
                    work.update(dict.fromkeys(into, bounds))
                    undecided |= unsure
        return lows, highs, undecided


def _within(low: float, high: float) -> Rule:
    """Return bounds that hold whatever the operands are."""
    return lambda a, *_: (np.full_like(a[0], low), np.full_like(a[0], high), False)


def _rising(function: Callable[[Any], Any]) -> Rule:
    return lambda a: (function(a[0]), function(a[1]), False)


def _stepped(function: Callable[[Any], Any]) -> Rule:
    """Return bounds of a function that rises in steps."""
    return lambda a: (function(a[0]), function(a[1]), function(a[0]) != function(a[1]))


def _even(function: Callable[[Any], Any]) -> Rule:
    """Return bounds of an even function that rises with the size of its argument."""

    def bounds(a: Bounds) -> tuple[Array, Array, bool]:
        low, high = _size(a)
        return function(low), function(high), False

    return bounds


def _size(a: Bounds) -> Bounds:
    ends = np.abs(a)
    return np.where((a[0] <= 0) & (a[1] >= 0), 0.0, ends.min(axis=0)), ends.max(axis=0)


def _wave(function: Callable[[Any], Any], shift: float) -> Rule:
    """Return bounds of a function that is sin(x + shift)."""

    def rule(a: Bounds) -> Enclosed:
        ends = function(a[0]), function(a[1])
        first, last = ((end + (shift - np.pi / 2)) / (2 * np.pi) for end in a)  # turns since a crest
        crest, trough = (np.floor(last + at) > np.floor(first + at) for at in (0.0, 0.5))
        return np.where(trough, -1.0, np.minimum(*ends)), np.where(crest, 1.0, np.maximum(*ends)), False

    return rule


def _tangent(a: Bounds) -> Enclosed:
    pole = np.floor(a[1] / np.pi + 0.5) > np.floor(a[0] / np.pi + 0.5)
    return np.where(pole, -np.inf, np.tan(a[0])), np.where(pole, np.inf, np.tan(a[1])), pole


def _inverse(a: Bounds) -> Enclosed:
    pole = (a[0] <= 0) & (a[1] >= 0)
    return np.where(pole, -np.inf, 1 / a[1]), np.where(pole, np.inf, 1 / a[0]), pole


def _truth(a: Bounds) -> Truth:
    """Tell where a value is certainly true (not zero), and certainly false."""
    return (a[0] > 0) | (a[1] < 0), (a[0] == 0) & (a[1] == 0)


def _compared(decide: Callable[..., Truth]) -> Rule:
    """Return bounds of a comparison, and where it may go either way."""

    def rule(*operands: Any) -> Enclosed:
        true, false = decide(*operands)
        return np.where(true, 1.0, 0.0), np.where(false, 0.0, 1.0), ~(true | false)

    return rule


def _connected(decide: Callable[..., Truth]) -> Rule:
    """Return bounds of what joins truths; that these may go either way was told with them."""
    rule = _compared(decide)
    return lambda *operands: (*rule(*map(_truth, operands))[:2], False)


def _same(a: Bounds, b: Bounds) -> Truth:
    return (a[0] == a[1]) & (b[0] == b[1]) & (a[0] == b[0]), (a[1] < b[0]) | (b[1] < a[0])


def _if_else_zero(a: Bounds, b: Bounds) -> Enclosed:
    true, false = _truth(a)
    low, high = (np.where(false, 0.0, bound) for bound in b)
    return np.where(true, low, np.minimum(low, 0.0)), np.where(true, high, np.maximum(high, 0.0)), False


def _corners(function: Callable[[Any, Any], Any], a: Bounds, b: Bounds) -> Bounds:
    """Return the least and the greatest value at the corners of a box, which may have no width."""
    values = [function(x, y) for x in _ends(a) for y in _ends(b)]
    return np.minimum.reduce(values), np.maximum.reduce(values)


def _ends(a: Bounds) -> tuple[Array, ...]:
    return a[:1] if a[0] is a[1] else a


def _product(a: Bounds, b: Bounds) -> Enclosed:
    return *_corners(lambda x, y: np.where((x == 0) | (y == 0), 0.0, x * y), a, b), False


def _quotient(a: Bounds, b: Bounds) -> Enclosed:
    low, high, pole = _inverse(b)
    return *_product(a, (low, high))[:2], pole


def _power(a: Bounds, b: Bounds) -> Enclosed:
    low, high = _corners(np.power, a, b)
    whole = (b[0] == b[1]) & (b[0] == np.rint(b[0])) & (b[0] > 0)
    through = (a[0] < 0) & (a[1] > 0)
    low = np.where(whole & through & (b[0] % 2 == 0), 0.0, low)
    tight = (a[0] >= 0) | whole
    corner = (a[0] <= 0) & (a[1] >= 0) & (b[0] <= 0) & (b[1] >= 0)
    return np.where(tight, low, -np.inf), np.where(tight, high, np.inf), corner


def _extreme(chosen: Callable[[Any, Any], Any]) -> Rule:
    """Return bounds of the greater or the lesser of two, which bends also where they meet at an end."""
    return lambda a, b: (chosen(a[0], b[0]), chosen(a[1], b[1]), (a[1] >= b[0]) & (b[1] > a[0]))


def _copysign(a: Bounds, b: Bounds) -> Enclosed:
    sign = np.where(b[0] > 0, 1.0, -1.0), np.where(b[1] < 0, -1.0, 1.0)
    return *_product(_size(a), sign)[:2], sign[0] != sign[1]


def _angle(a: Bounds, b: Bounds) -> Enclosed:
    """Return bounds of atan2(a, b), which jumps where a changes its sign beside a negative b, and at zero."""
    cut = (a[0] <= 0) & (a[1] >= 0) & (b[0] <= 0)
    low, high = _corners(np.arctan2, a, b)
    return np.where(cut, -np.pi, low), np.where(cut, np.pi, high), cut


def _remains(rounded: Callable[[Any], Any]) -> Rule:
    """Return bounds of a - b round(a/b), for constant b."""

    def rule(a: Bounds, b: Bounds) -> Enclosed:
        first, last = rounded(a[0] / b[0]), rounded(a[1] / b[0])
        one = (first == last) & (b[0] == b[1]) & (np.abs(first) < 2**53)
        known = ((b[0] > 0) | (b[1] < 0)) & np.isfinite(a[0]) & np.isfinite(a[1])
        size = np.where(known, np.abs(b).max(axis=0), np.inf)
        low, high = np.where(one, a[0] - first * b[0], -size), np.where(one, a[1] - last * b[0], size)
        return low, high, ~one

    return rule


_UNKNOWN = _within(-np.inf, np.inf)
# CasADi and NumPy call these alike.
_RISING = "exp", "expm1", "log", "log1p", "sqrt", "sinh", "tanh", "asin", "atan", "asinh", "acosh", "atanh"
_RULES: dict[int, Rule] = {
    **{getattr(ca, f"OP_{name.upper()}"): _rising(getattr(np, name)) for name in _RISING},
    ca.OP_TWICE: _rising(lambda x: 2 * x),
    ca.OP_ASSIGN: _rising(lambda x: x),
    ca.OP_LIFT: _rising(lambda x: x),
    ca.OP_FLOOR: _stepped(np.floor),
    ca.OP_CEIL: _stepped(np.ceil),
    ca.OP_SIGN: _stepped(np.sign),
    ca.OP_ERF: _within(-1.0, 1.0),
    ca.OP_ACOS: _within(0.0, np.pi),
    ca.OP_NEG: lambda a: (-a[1], -a[0], False),
    ca.OP_SQ: _even(np.square),
    ca.OP_COSH: _even(np.cosh),
    ca.OP_FABS: lambda a: (*_size(a), (a[0] < 0) & (a[1] >= 0)),  # bends also where it comes to 0 at an end
    ca.OP_SIN: _wave(np.sin, 0.0),
    ca.OP_COS: _wave(np.cos, np.pi / 2),
    ca.OP_TAN: _tangent,
    ca.OP_INV: _inverse,
    ca.OP_ADD: lambda a, b: (a[0] + b[0], a[1] + b[1], False),
    ca.OP_SUB: lambda a, b: (a[0] - b[1], a[1] - b[0], False),
    ca.OP_MUL: _product,
    ca.OP_DIV: _quotient,
    ca.OP_POW: _power,
    ca.OP_CONSTPOW: _power,
    ca.OP_LT: _compared(lambda a, b: (a[1] < b[0], a[0] >= b[1])),
    ca.OP_LE: _compared(lambda a, b: (a[1] <= b[0], a[0] > b[1])),
    ca.OP_EQ: _compared(_same),
    ca.OP_NE: _compared(lambda a, b: (_same(a, b)[1], _same(a, b)[0])),
    ca.OP_NOT: _connected(lambda a: a[::-1]),
    ca.OP_AND: _connected(lambda a, b: (a[0] & b[0], a[1] | b[1])),
    ca.OP_OR: _connected(lambda a, b: (a[0] | b[0], a[1] & b[1])),
    ca.OP_IF_ELSE_ZERO: _if_else_zero,
    ca.OP_FMAX: _extreme(np.maximum),
    ca.OP_FMIN: _extreme(np.minimum),
    ca.OP_COPYSIGN: _copysign,
    ca.OP_ATAN2: _angle,
    ca.OP_FMOD: _remains(np.trunc),
    ca.OP_REMAINDER: _remains(np.rint),
}
