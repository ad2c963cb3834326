"""Biquadratics by a bridge of two reactive elements and three resistances.

Source: E. L. Ladenheim, A synthesis of biquadratic impedances, Master's thesis, Polytechnic Institute of
Brooklyn (1948); J. Z. Jiang, M. C. Smith, IEEE Trans. Automat. Contr. 56 (2011) 1275-1290: of networks with
two reactive elements only these two bridges have biquadratics that are not regular.
"""

from __future__ import annotations

from collections.abc import Iterator
from decimal import Decimal
from functools import partial

from .polynomials import ONE, ZERO, plus, positive_roots, scaled, times, value
from .ratio import Ratio
from .tree import Side, Tree, both_ways

EQUATION_TOLERANCE = Decimal("1e-20")


def two_reactive_bridges(function: Ratio, side: Side) -> Iterator[Tree]:
    """Return the bridges with a biquadratic F; there may be none.

    As an impedance F = (p s^2 + B s + q)/(s^2 + E s + 1), after scaling s, of the bridge with the impedances
    a s, b, c, d and e/s is

        t p = a (b c + b d + c d),  t B = a e (c + d) + b c d,    t q = e b (c + d),
        t   = a (b + d),            t E = a e + c (b + d),        t   = e (b + c + d).

    The other bridge is that of F(1/s).
    """
    return both_ways(function, partial(_bridges, side))


def _bridges(side: Side, p: Decimal, B: Decimal, q: Decimal, E: Decimal) -> Iterator[Tree]:
    for elements in _resistances(p, B, q, E):
        terms = zip((1, 0, 0, 0, -1), elements, strict=True)
        yield side.bridged([side.term(power, value) for power, value in terms])


def _resistances(p: Decimal, B: Decimal, q: Decimal, E: Decimal) -> Iterator[tuple[Decimal, ...]]:
    """Yield all a, b, c, d, e > 0.

    With u = c + d, elimination leaves (c^2 - c (u + p)) (u - q) + u^2 (p - q) = 0 and c m(u) + n(u) = 0.
    """
    K, G = 4 * p * q - B**2, B * E - E**2 * q - p + q
    H = (p - 3 * q) * (p + q) - B * E * (p - q) + E**2 * p * q
    less_q, square = [-q, ONE], [ZERO, ZERO, ONE]
    m = plus(times(less_q, [-p * q * K, (p - q) * K, -K - H]), times(square, square), -G)
    n = times(square, plus(scaled(less_q, (q - p) * K), [ZERO, ZERO, K + H + q * G, G]))
    equation = plus(times(less_q, times(n, plus(n, times(m, [p, ONE])))), times(square, times(m, m)), p - q)
    for u in positive_roots(equation):
        if value(m, u):
            yield from _solved(p, B, q, E, u, -value(n, u) / value(m, u))


def _solved(
    p: Decimal, B: Decimal, q: Decimal, E: Decimal, u: Decimal, c: Decimal
) -> Iterator[tuple[Decimal, ...]]:
    """Yield the elements for u = c + d if they are positive and all six equations hold."""
    d = u - c
    if not (u > q and c > 0 and d > 0 and E * u != B):
        return
    b = q * u / (u - q)
    t = c * (c * b + c * d + d**2) / (E * u - B)
    a, e = t / (b + d), t / (b + c + d)
    wrong = abs(a * e + c * (b + d) - t * E) + abs(a * (b * (c + d) + c * d) - t * p)
    if t > 0 and wrong < EQUATION_TOLERANCE * t * (E + p):
        yield a, b, c, d, e
