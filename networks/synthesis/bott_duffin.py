"""Realise: poles on the axis split off, resistance taken out, a bridge where neither is left.

Source: R. Bott, R. J. Duffin, Impedance synthesis without use of transformers, J. Appl. Phys. 20 (1949) 816;
a bridge with one reactive element less, as Reza, Pantell, Fialkow and Gerst found first: T. H. Hughes, IEEE
Trans. Automat. Contr. 62 (2017) 4333-4346; with force for current and velocity for voltage, M. C. Smith, IEEE
Trans. Automat. Contr. 47 (2002) 1648-1662.
"""

from __future__ import annotations

from collections.abc import Iterator
from decimal import Decimal

from .biquadratics import four_reactive, two_reactive_bridges
from .polynomials import ONE, ZERO, by_s, divided, plus, positive_roots, scaled, times, trimmed
from .ratio import INFINITY, AxisPole, Ratio
from .tree import Side, Tree

PROBES, TOLERANCE = (0.05 + 0.1j, 0.5 + 1j, 5 + 10j), 1e-6


def realise(function: Ratio, side: Side) -> Tree:
    """Return a network with a positive-real admittance (or impedance) other than zero."""
    ways = [(F, at, *F.axis_poles()) for F, at in ((function, side), (function.inverse, side.other))]
    split = [_less_poles(at, poles, rest) for _, at, poles, rest in ways if poles]
    return _fewest(split, function, side) if split else _without_poles(function, side)


def _fewest(networks: list[Tree], function: Ratio, side: Side) -> Tree:
    """Return the network with the fewest elements of those that rounding has not spoilt."""
    wanted = [function(s) if side.beside else 1 / function(s) for s in PROBES]

    def spoilt(network: Tree) -> bool:
        return any(abs(network(s) - Y) > TOLERANCE * abs(Y) for s, Y in zip(PROBES, wanted, strict=True))

    return min(networks, key=lambda network: (spoilt(network), network.size))


def _less_poles(side: Side, poles: list[AxisPole], rest: Ratio) -> Tree:
    left = [realise(rest, side)] if rest.num else []
    return side.joined([*map(side.pole, poles), *left])


def _without_poles(function: Ratio, side: Side) -> Tree:
    """Realise what has neither poles nor zeros on the axis."""
    if function.degree == 0:
        return side.term(0, function.num[0] / function.den[0])
    both = ((function, side), (function.inverse, side.other))
    ways = [(F, at, F.least_real()) for F, at in both]
    regular = [way for way in ways if way[2][1] in (0, INFINITY)]
    networks = [_without_resistance(*way) for way in regular or ways]
    if function.degree == 2:
        networks += [network for F, at in both for network in _by_a_pole(F, at)]
    if function.degree == 2 and not regular:
        networks += two_reactive_bridges(function, side)
        if min(network.size for network in networks) > 7:
            networks += [network for F, at in both for network in four_reactive(F, at, realise)]
    return _fewest(networks, function, side)


def _by_a_pole(function: Ratio, side: Side) -> Iterator[Tree]:
    """Take F(0) r/(s + r) or F(oo) s/(s + r) out of a biquadratic with a pole at -r, if the rest allows it.

    The rest vanishes at one end, and a part of first order is left when its pole or zero there is gone: six
    elements at most, three of them reactive.
    """
    num, den = function.num, function.den
    for rate in positive_roots([den[0], -den[1], den[2]]):
        beside = divided(den, [rate, ONE])[0]
        at_zero, at_infinity = num[0] / den[0], num[2] / den[2]
        for power, height, taken in ((-1, at_zero, [at_zero * rate]), (1, at_infinity, [ZERO, at_infinity])):
            left = plus(num, times(beside, taken), -ONE)
            left = [ZERO, *left[1:]] if power < 0 else trimmed(left[:2])
            rest = Ratio(left, den, function.tolerance).reduced()
            least, _, rounding = rest.least_real()
            if least >= -rounding:
                pole = side.inverse({0: 1 / height, -power: rate**power / height})
                yield side.joined([pole, realise(rest, side)])


def _without_resistance(function: Ratio, side: Side, least: tuple[Decimal, Decimal, Decimal]) -> Tree:
    """Take out the least real part; what is left has a zero on the axis, or is a minimum function."""
    real, x, rounding = least
    parts = [side.term(0, real)] if real > rounding else []
    rest = function.less(real, x)
    if x in (0, INFINITY) or rest.inverse.axis_poles()[0]:
        return side.joined([*parts, realise(rest, side)])
    minimum, at = (rest, side) if rest.on_axis(x)[1] > 0 else (rest.inverse, side.other)
    return side.joined([*parts, _cycle(minimum, at, x)])


def _cycle(function: Ratio, side: Side, x: Decimal) -> Tree:
    """Realise a minimum function with F(jw) = jw slope at w^2 = x, slope > 0, by two of lower degree.

    With F(k) = k slope and Richards' R = (k F - s F(k))/(k F(k) - s F), Bott and Duffin find

        F = 1/(1/(F(k) R) + s/(k F(k))) + 1/(R/F(k) + k/(F(k) s)).

    R has a zero at jw: 1/R = a s/(s^2 + w^2) + 1/R', so that F(k) R and F(k)/R hold two reactive elements
    each, and there are six. Five are enough: with g = w^2/(k + a) and F an impedance, the nodes of the bridge
    of the admittances

        s/((k + a) F(k)), R'/F(k), 1/(F(k) R') + (a + a g/k) s/((s^2 + w^2) F(k)), k/(F(k) s), g/(F(k) s)

    have voltages that nodes of Bott and Duffin's have, and the currents into each add up to zero.
    """
    num, den, slope = function.num, function.den, function.on_axis(x)[1]
    k = positive_roots(plus(num, by_s(den), -slope))[0]
    at_k = k * slope
    upper = plus(scaled(num, k), by_s(den), -at_k)
    lower = plus(scaled(den, k * at_k), by_s(num), -ONE)
    richards = Ratio(divided(upper, [-k, ONE])[0], divided(lower, [-k, ONE])[0], function.tolerance)
    zero, rest = richards.inverse.without_pair(x)
    other, a = side.other, zero.residue
    g = x / (k + a)
    series = (a + a * g / k) / at_k
    resonant = side.joined([other.term(1, series / x), other.term(-1, series)])
    return side.bridged(
        [
            other.term(1, 1 / ((k + a) * at_k)),
            realise(rest.times(at_k), side),
            other.joined([realise(rest.times(1 / at_k), other), resonant]),
            other.term(-1, k / at_k),
            other.term(-1, g / at_k),
        ]
    )
