"""Realise: poles on the axis split off, resistance taken out, Bott and Duffin's cycle where neither is left.

Source: R. Bott, R. J. Duffin, Impedance synthesis without use of transformers, J. Appl. Phys. 20 (1949) 816;
with force for current and velocity for voltage, M. C. Smith, IEEE Trans. Automat. Contr. 47 (2002) 1648-1662.
"""

from __future__ import annotations

from dataclasses import dataclass
from decimal import Decimal

from .polynomials import ONE, by_s, divided, plus, positive_roots, scaled
from .ratio import INFINITY, AxisPole, Ratio
from .tree import Element, Tree, joined


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
    poles, rest = function.axis_poles()
    parts = [side.pole(pole) for pole in poles]
    if rest.num:
        parts.append(_without_poles(rest, side))
    return joined(side.beside, parts)


def _without_poles(function: Ratio, side: Side) -> Tree:
    """Realise what has no poles on the axis: invert it if it has zeros there."""
    if function.degree == 0:
        return side.term(0, function.num[0] / function.den[0])
    poles, _ = function.inverse.axis_poles()
    if poles:
        return realise(function.inverse, side.other)
    ways = [
        (function, side, function.least_real()),
        (function.inverse, side.other, function.inverse.least_real()),
    ]
    regular = [way for way in ways if way[2][1] in (0, INFINITY)]
    networks = [_without_resistance(*way) for way in regular or ways]
    return min(networks, key=lambda network: len(network.elements))


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
        return joined(side.beside, [*parts, _cycle(rest, side, slope)])
    inverse = rest.inverse
    return joined(side.beside, [*parts, _cycle(inverse, side.other, inverse.on_axis(x)[1])])


def _cycle(function: Ratio, side: Side, slope: Decimal) -> Tree:
    """Realise a minimum function with F(jw) = jw slope at its w, slope > 0, by two of lower degree.

    With F(k) = k slope and Richards' R = (k F - s F(k))/(k F(k) - s F),

        F = 1/(1/(F(k) R) + s/(k F(k))) + 1/(R/F(k) + k/(F(k) s)).
    """
    num, den = function.num, function.den
    k = positive_roots(plus(num, by_s(den), -slope))[0]
    at_k = k * slope
    upper = plus(scaled(num, k), by_s(den), -at_k)
    lower = plus(scaled(den, k * at_k), by_s(num), -ONE)
    richards = Ratio(divided(upper, [-k, ONE])[0], divided(lower, [-k, ONE])[0], function.tolerance)
    other = side.other
    first = [realise(richards.times(at_k).inverse, other), other.term(1, 1 / (k * at_k))]
    second = [realise(richards.times(1 / at_k), other), other.term(-1, k / at_k)]
    return joined(side.beside, [joined(other.beside, first), joined(other.beside, second)])
