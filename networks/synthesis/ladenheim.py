"""Biquadratics by a bridge of two reactive elements and three resistances.

Source: E. L. Ladenheim, A synthesis of biquadratic impedances, Master's thesis, Polytechnic Institute of
Brooklyn (1948); J. Z. Jiang, M. C. Smith, IEEE Trans. Automat. Contr. 56 (2011) 1275-1290: of networks with
two reactive elements only these two bridges have biquadratics that are not regular.
"""

from __future__ import annotations

from decimal import Decimal
from typing import TYPE_CHECKING

from .polynomials import ONE, ZERO, plus, positive_roots, scaled, times, value
from .ratio import Ratio
from .tree import Bridge, bridged

if TYPE_CHECKING:
    from .bott_duffin import Side

AGREES = Decimal("1e-20")


def two_reactive_bridges(function: Ratio, side: Side) -> list[Bridge]:
    """Return the bridges with a biquadratic F; there may be none.

    As an impedance F = (p s^2 + B s + q)/(s^2 + E s + 1), after scaling s, of the bridge with the impedances
    a s, b, c, d and e/s is

        t p = a (b c + b d + c d),  t B = a e (c + d) + b c d,    t q = e b (c + d),
        t   = a (b + d),            t E = a e + c (b + d),        t   = e (b + c + d).

    The other bridge is that of F(1/s).
    """
    (q, B, p), (f, E, d) = function.num, function.den
    middle, rate = (d * f).sqrt(), (f / d).sqrt()
    p, B, q, E = p / d, B / middle, q / f, E / middle
    there = [_bridge(side, 1, rate, found) for found in _resistances(p, B, q, E)]
    back = [_bridge(side, -1, rate, found) for found in _resistances(q, B, p, E)]
    return there + back


def _bridge(side: Side, power: int, rate: Decimal, found: tuple[Decimal, ...]) -> Bridge:
    a, b, c, d, e = found
    return bridged(
        side.beside,
        [
            side.term(power, a * rate**-power),
            *(side.term(0, r) for r in (b, c, d)),
            side.term(-power, e * rate**power),
        ],
    )


def _resistances(p: Decimal, B: Decimal, q: Decimal, E: Decimal) -> list[tuple[Decimal, ...]]:
    """Return all a, b, c, d, e > 0.

    With u = c + d, elimination leaves (c^2 - c (u + p)) (u - q) + u^2 (p - q) = 0 and c m(u) + n(u) = 0.
    """
    K, G = 4 * p * q - B**2, B * E - E**2 * q - p + q
    H = (p - 3 * q) * (p + q) - B * E * (p - q) + E**2 * p * q
    less_q, square = [-q, ONE], [ZERO, ZERO, ONE]
    m = plus(times(less_q, [-p * q * K, (p - q) * K, -K - H]), times(square, square), -G)
    n = times(square, plus(scaled(less_q, (q - p) * K), [ZERO, ZERO, K + H + q * G, G]))
    equation = plus(times(less_q, times(n, plus(n, times(m, [p, ONE])))), times(square, times(m, m)), p - q)
    tried = [
        _solved(p, B, q, E, u, -value(n, u) / value(m, u)) for u in positive_roots(equation) if value(m, u)
    ]
    return [found for found in tried if found is not None]


def _solved(
    p: Decimal, B: Decimal, q: Decimal, E: Decimal, u: Decimal, c: Decimal
) -> tuple[Decimal, ...] | None:
    """Return the elements for u = c + d if they are positive and all six equations hold."""
    d = u - c
    if not (u > q and c > 0 and d > 0 and E * u != B):
        return None
    b = q * u / (u - q)
    t = c * (c * b + c * d + d**2) / (E * u - B)
    a, e = t / (b + d), t / (b + c + d)
    wrong = abs(a * e + c * (b + d) - t * E) + abs(a * (b * (c + d) + c * d) - t * p)
    return (a, b, c, d, e) if t > 0 and wrong < AGREES * t * (E + p) else None
