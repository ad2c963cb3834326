"""Biquadratics that are not regular by seven elements, four of them reactive."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from decimal import Decimal
from functools import partial

from .polynomials import ONE, ZERO, Polynomial, plus, positive_roots, scaled, times, value
from .ratio import INFINITY, Ratio
from .tree import Side, Tree, both_ways

Realise = Callable[[Ratio, Side], Tree]


def four_reactive(function: Ratio, side: Side, realise: Realise) -> Iterator[Tree]:
    """Return networks F = F(0) r/(s + r) + 1/(1/(L s) + Y), of which Y has four elements.

    Any r > 0 makes the first two vanish at 0 together, and leaves the biquadratic Y; it takes four elements
    where r makes one of five vanish. The same with s and 1/s exchanged.
    """
    return both_ways(function, partial(_split, function.tolerance, side, realise))


def _split(
    tolerance: Decimal, side: Side, realise: Realise, p: Decimal, B: Decimal, q: Decimal, E: Decimal
) -> Iterator[Tree]:
    """Yield networks of F = (p s^2 + B s + q)/(s^2 + E s + 1).

    Then L = b_0/r and Y = (s^2 + c_1 s + c_0)/(p s^2 + b_1 s + b_0), polynomials in r over b_0.
    """
    b1, b0 = [B, p - q], [q, B - q * E]
    c1_b0 = plus(times([E, ONE], b0), [ZERO, p], -ONE)
    c0_b0 = plus(times([ONE, E], b0), [ZERO, *b1], -ONE)
    other = side.other
    for r in sorted({r for lost in _lost(p, b1, b0, c1_b0, c0_b0) for r in positive_roots(lost)}):
        at_b1, at_b0 = value(b1, r), value(b0, r)
        if at_b0 <= 0:
            continue
        Y = Ratio([value(c0_b0, r) / at_b0, value(c1_b0, r) / at_b0, ONE], [at_b0, at_b1, p], tolerance)
        if _regular(Y):
            first = side.inverse({0: 1 / q, 1: 1 / (q * r)})
            second = other.joined([other.term(-1, r / at_b0), realise(Y, other)])
            yield side.joined([first, second])


def _lost(p: Decimal, b1: Polynomial, b0: Polynomial, c1: Polynomial, c0: Polynomial) -> Iterator[Polynomial]:
    """Yield what vanishes with an element of Y = (b_0 s^2 + c_1 s + c_0)/(p s^2 + b_1 s + b_0)/b_0.

    In this order: Y is the same at 0 and at infinity; with Y at 0, or at infinity, and then a pole of the
    inverse taken out, what is left vanishes at an end; the same for 1/Y.
    """
    square = times(b0, b0)
    ends = plus(scaled(c0, p), square, -ONE)
    yield ends
    yield plus(times(b1, plus(times(c1, b0), times(c0, b1), -ONE)), times(b0, ends))
    yield plus(times(b1, plus(scaled(c1, p), times(b1, b0), -ONE)), ends, -p)
    yield plus(times(c1, plus(times(b1, c0), times(b0, c1), -ONE)), times(c0, ends), -ONE)
    yield plus(times(c1, plus(times(b1, b0), c1, -p)), times(b0, ends))


def _regular(Y: Ratio) -> bool:
    """Return whether Y is positive-real, and Re Y or Re 1/Y least at 0 or infinity."""
    if not all(c > 0 for c in (*Y.num, *Y.den)):
        return False
    least, x, rounding = Y.least_real()
    return least >= -rounding and (x in (0, INFINITY) or Y.inverse.least_real()[1] in (0, INFINITY))
