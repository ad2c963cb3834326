"""Biquadratics that are not regular: by bridges of two reactive elements, or by seven, four reactive.

Source: E. L. Ladenheim, A synthesis of biquadratic impedances, Master's thesis, Polytechnic Institute of
Brooklyn (1948); J. Z. Jiang, M. C. Smith, IEEE Trans. Automat. Contr. 56 (2011) 1275-1290: of networks with
two reactive elements only these two bridges have biquadratics that are not regular.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from decimal import Decimal
from functools import partial

from .polynomials import ONE, ZERO, Polynomial, plus, positive_roots, scaled, times, value
from .ratio import INFINITY, Ratio, Scale
from .tree import Element, Side, Tree, scaled_by

EQUATION_TOLERANCE = Decimal("1e-20")
Realise = Callable[[Ratio, Side], Tree]


def two_reactive_bridges(function: Ratio, side: Side) -> Iterator[Tree]:
    """Return the bridges with a biquadratic F; there may be none.

    As an impedance F = (p s^2 + B s + q)/(s^2 + E s + 1), after scaling s, of the bridge with the impedances
    a s, b, c, d and e/s is

        t p = a (b c + b d + c d),  t B = a e (c + d) + b c d,    t q = e b (c + d),
        t   = a (b + d),            t E = a e + c (b + d),        t   = e (b + c + d).

    The other bridge is that of F(1/s).
    """
    return _both_ways(function, partial(_bridges, side))


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


def four_reactive(function: Ratio, side: Side, realise: Realise) -> Iterator[Tree]:
    """Return networks F = F(0) r/(s + r) + 1/(1/(L s) + Y), of which Y has four elements.

    Any r > 0 makes the first two vanish at 0 together, and leaves the biquadratic Y; it takes four elements
    where r makes one of five vanish. The same with s and 1/s exchanged.
    """
    return _both_ways(function, partial(_split, function.tolerance, side, realise))


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


def _both_ways(
    function: Ratio, networks: Callable[[Decimal, Decimal, Decimal, Decimal], Iterable[Tree]]
) -> Iterator[Tree]:
    """Yield networks of (p s^2 + B s + q)/(s^2 + E s + 1) after scaling s, and with s and 1/s exchanged."""
    (q, B, p), (f, E, d) = function.num, function.den
    middle, scale = (d * f).sqrt(), Scale(float((f / d).sqrt()), 1.0)
    p, B, q, E = p / d, B / middle, q / f, E / middle
    for network in networks(p, B, q, E):
        yield scaled_by(scale, network)
    for network in networks(q, B, p, E):
        yield scaled_by(scale, network.mapped(lambda e: Element(-e.power, e.value)))
