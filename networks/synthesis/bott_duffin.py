"""Realise: poles on the axis split off, resistance taken out, a bridge where neither is left.

Source: R. Bott, R. J. Duffin, Impedance synthesis without use of transformers, J. Appl. Phys. 20 (1949) 816;
a bridge with one reactive element less, as Reza, Pantell, Fialkow and Gerst found first: T. H. Hughes, IEEE
Trans. Automat. Contr. 62 (2017) 4333-4346; with force for current and velocity for voltage, M. C. Smith, IEEE
Trans. Automat. Contr. 47 (2002) 1648-1662.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from decimal import Decimal

from .four_reactive import four_reactive
from .ladenheim import two_reactive_bridges
from .polynomials import ONE, ZERO, by_s, divided, plus, positive_roots, scaled, times, trimmed
from .ratio import INFINITY, AxisPole, Ratio
from .tree import Element, Tree, bridged, joined

PROBES, AGREES = (0.05 + 0.1j, 0.5 + 1j, 5 + 10j), 1e-6


@dataclass(frozen=True)
class Side:
    """Whether a function is an admittance, whose terms stand side by side, or an impedance."""

    beside: bool

    @property
    def other(self) -> Side:
        """The side of 1/F."""
        return Side(not self.beside)

    def term(self, power: int, factor: Decimal) -> Tree:
        """Return the element of the term factor s^power."""
        value = float(factor)
        return Element(power, value) if self.beside else Element(-power, 1 / value)

    def pole(self, pole: AxisPole) -> Tree:
        """Return what has a pole on the axis."""
        if pole.x == INFINITY:
            return self.term(1, pole.residue)
        if pole.x == 0:
            return self.term(-1, pole.residue)
        other = self.other
        return joined(other.beside, [other.term(1, 1 / pole.residue), other.term(-1, pole.x / pole.residue)])


def realise(function: Ratio, side: Side) -> Tree:
    """Return a network with a positive-real admittance (or impedance) other than zero."""
    ways = [(F, at, *F.axis_poles()) for F, at in ((function, side), (function.inverse, side.other))]
    split = [_less_poles(at, poles, rest) for _, at, poles, rest in ways if poles]
    return _fewest(split, function, side) if split else _without_poles(function, side)


def _fewest(networks: list[Tree], function: Ratio, side: Side) -> Tree:
    """Return the network with the fewest elements of those that rounding has not spoilt."""
    wanted = [function(s) if side.beside else 1 / function(s) for s in PROBES]

    def spoilt(network: Tree) -> bool:
        return any(abs(network(s) - Y) > AGREES * abs(Y) for s, Y in zip(PROBES, wanted, strict=True))

    return min(networks, key=lambda network: (spoilt(network), _size(network)))


def _size(network: Tree) -> int:
    return len(network.elements)


def _less_poles(side: Side, poles: list[AxisPole], rest: Ratio) -> Tree:
    parts = [side.pole(pole) for pole in poles]
    return joined(side.beside, [*parts, realise(rest, side)] if rest.num else parts)


def _without_poles(function: Ratio, side: Side) -> Tree:
    """Realise what has neither poles nor zeros on the axis."""
    if function.degree == 0:
        return side.term(0, function.num[0] / function.den[0])
    ways = [
        (function, side, function.least_real()),
        (function.inverse, side.other, function.inverse.least_real()),
    ]
    regular = [way for way in ways if way[2][1] in (0, INFINITY)]
    networks = [_without_resistance(*way) for way in regular or ways]
    if function.degree == 2:
        networks += [*_by_a_pole(function, side), *_by_a_pole(function.inverse, side.other)]
    if function.degree == 2 and not regular:
        networks += two_reactive_bridges(function, side)
        if min(map(_size, networks)) > 7:
            networks += four_reactive(function, side, realise)
            networks += four_reactive(function.inverse, side.other, realise)
    return _fewest(networks, function, side)


def _by_a_pole(function: Ratio, side: Side) -> Iterator[Tree]:
    """Take F(0) r/(s + r) or F(oo) s/(s + r) out of a biquadratic with a pole at -r, if the rest allows it.

    The rest vanishes at one end, and a part of first order is left when its pole or zero there is gone: six
    elements at most, three of them reactive.
    """
    num, den, other = function.num, function.den, side.other
    for rate in positive_roots([den[0], -den[1], den[2]]):
        beside = divided(den, [rate, ONE])[0]
        at_zero, at_infinity = num[0] / den[0], num[2] / den[2]
        for power, height, taken in ((-1, at_zero, [at_zero * rate]), (1, at_infinity, [ZERO, at_infinity])):
            left = plus(num, times(beside, taken), -ONE)
            left = [ZERO, *left[1:]] if power < 0 else trimmed(left[:2])
            rest = Ratio(left, den, function.tolerance).reduced()
            least, _, rounding = rest.least_real()
            if least >= -rounding:
                pole = [other.term(0, 1 / height), other.term(-power, rate**power / height)]
                yield joined(side.beside, [joined(other.beside, pole), realise(rest, side)])


def _without_resistance(function: Ratio, side: Side, least: tuple[Decimal, Decimal, Decimal]) -> Tree:
    """Take out the least real part; what is left has a zero on the axis, or is a minimum function."""
    real, x, rounding = least
    parts = [side.term(0, real)] if real > rounding else []
    rest = function.less(real, x)
    if x in (0, INFINITY):
        return joined(side.beside, [*parts, realise(rest, side)])
    poles, _ = rest.inverse.axis_poles()
    if poles:
        return joined(side.beside, [*parts, realise(rest, side)])
    slope = rest.on_axis(x)[1]
    if slope > 0:
        return joined(side.beside, [*parts, _cycle(rest, side, x, slope)])
    inverse = rest.inverse
    return joined(side.beside, [*parts, _cycle(inverse, side.other, x, inverse.on_axis(x)[1])])


def _cycle(function: Ratio, side: Side, x: Decimal, slope: Decimal) -> Tree:
    """Realise a minimum function with F(jw) = jw slope at w^2 = x, slope > 0, by two of lower degree.

    With F(k) = k slope and Richards' R = (k F - s F(k))/(k F(k) - s F), Bott and Duffin find

        F = 1/(1/(F(k) R) + s/(k F(k))) + 1/(R/F(k) + k/(F(k) s)).

    R has a zero at jw: 1/R = a s/(s^2 + w^2) + 1/R', so that F(k) R and F(k)/R hold two reactive elements
    each, and there are six. Five are enough: with g = w^2/(k + a) and F an impedance, the nodes of the bridge
    of the admittances

        s/((k + a) F(k)), R'/F(k), 1/(F(k) R') + (a + a g/k) s/((s^2 + w^2) F(k)), k/(F(k) s), g/(F(k) s)

    have voltages that nodes of Bott and Duffin's have, and the currents into each add up to zero.
    """
    num, den = function.num, function.den
    k = positive_roots(plus(num, by_s(den), -slope))[0]
    at_k = k * slope
    upper = plus(scaled(num, k), by_s(den), -at_k)
    lower = plus(scaled(den, k * at_k), by_s(num), -ONE)
    richards = Ratio(divided(upper, [-k, ONE])[0], divided(lower, [-k, ONE])[0], function.tolerance)
    zero, rest = richards.inverse.without_pair(x)
    other, a = side.other, zero.residue
    g = x / (k + a)
    series = (a + a * g / k) / at_k
    resonant = joined(side.beside, [other.term(1, series / x), other.term(-1, series)])
    return bridged(
        side.beside,
        [
            other.term(1, 1 / ((k + a) * at_k)),
            realise(rest.times(at_k), side),
            joined(other.beside, [realise(rest.times(1 / at_k), other), resonant]),
            other.term(-1, k / at_k),
            other.term(-1, g / at_k),
        ],
    )
