"""`Ratio`: a rational function in many digits, its poles on the imaginary axis, its least real part."""

from __future__ import annotations

import math
from dataclasses import dataclass
from decimal import Decimal

import numpy as np

from .polynomials import (
    ONE,
    ZERO,
    Polynomial,
    by_s,
    derivative,
    divided,
    even,
    odd,
    plus,
    positive_roots,
    scaled,
    size,
    times,
    trimmed,
    value,
)
from .rational import RationalFunction

INFINITY = Decimal("Infinity")
ROOT_TOLERANCE = Decimal("1e-10")


@dataclass(frozen=True)
class AxisPole:
    """A pole at s = 0 (residue/s), at infinity (residue s), or a pair (residue s/(s^2 + x)), x = w^2.

    A multiple pole has residue 0 here. `skew` is the part of a pair's residue that a positive-real function
    does not have.
    """

    x: Decimal
    residue: Decimal
    skew: Decimal = ZERO


@dataclass(frozen=True)
class Scale:
    """What a normalised function is of the true one: F(s) = gain f(s/rate)."""

    rate: float
    gain: float


@dataclass(frozen=True, eq=False)
class Ratio:
    """A rational function num/den, coefficients lowest power first.

    Args:
        tolerance: relative accuracy of its coefficients; what is smaller is rounding.
    """

    num: Polynomial
    den: Polynomial
    tolerance: Decimal

    @classmethod
    def normalised(cls, function: RationalFunction) -> tuple[Ratio, Scale]:
        """Return a function at middling frequencies and gains, without common factors."""
        num, den = ([Decimal(c) for c in reversed(p)] for p in (function.num, function.den))
        rate = _power_of_two(_middle(num, den))
        num, den = ([c * rate**k for k, c in enumerate(p)] for p in (num, den))
        gain = _power_of_two(max(map(abs, num), default=ONE) / max(map(abs, den)))
        sign = -1 if den[-1] < 0 else 1
        num, den = scaled(num, sign / gain), scaled(den, Decimal(sign))
        return cls(num, den, Decimal(function.accuracy)).reduced(), Scale(float(rate), float(gain))

    def reduced(self) -> Ratio:
        """Return the function without the factors common to numerator and denominator."""
        if self.num and self.num[0] == 0 == self.den[0]:
            return Ratio(self.num[1:], self.den[1:], self.tolerance).reduced()
        for root in np.roots([float(c) for c in reversed(self.den)]) if self.num else ():
            factor, w = _factor(complex(root)), Decimal(abs(root))
            divisions = [(p, *divided(p, factor)) for p in (self.num, self.den)]
            common = all(size(rest, w) <= self.tolerance * size(p, w) for p, _, rest in divisions)
            if root.imag >= 0 and common:
                (_, num, _), (_, den, _) = divisions
                return Ratio(num, den, self.tolerance).reduced()
        return self

    def __call__(self, s: complex) -> complex:
        """Return the value, in sixteen digits."""
        num, den = (np.polyval([float(c) for c in reversed(p)], s) for p in (self.num, self.den))
        return complex(num / den)

    @property
    def inverse(self) -> Ratio:
        return Ratio(self.den, self.num, self.tolerance)

    @property
    def degree(self) -> int:
        """The higher degree of both polynomials."""
        return max(len(self.num), len(self.den)) - 1

    def times(self, factor: Decimal) -> Ratio:
        return Ratio(scaled(self.num, factor), self.den, self.tolerance)

    def on_axis(self, x: Decimal) -> tuple[Decimal, Decimal]:
        """Return Re F(jw) and Im F(jw)/w at w^2 = x."""
        real, imaginary, below = _parts(self.num, self.den)
        return value(real, x) / value(below, x), value(imaginary, x) / value(below, x)

    def axis_poles(self) -> tuple[list[AxisPole], Ratio]:
        """Return the poles on the imaginary axis and what is left without them."""
        poles: list[AxisPole] = []
        num, den = self.num, self.den
        if len(num) > len(den):
            residue = num[-1] / den[-1]
            poles.append(AxisPole(INFINITY, residue))
            num = trimmed(plus(num[:-1], by_s(den[:-1]), -residue))
        if den[0] == 0:
            residue = num[0] / den[1]
            poles.append(AxisPole(ZERO, residue))
            num, den = trimmed(plus(num, den[1:], -residue)[1:]), den[1:]
        for x in axis_roots(den, self.tolerance):
            pole, num, den = _without_pair(num, den, x)
            poles.append(pole)
        return poles, Ratio(_unless_rounding(num, self.num, self.tolerance), den, self.tolerance)

    def without_pair(self, x: Decimal) -> tuple[AxisPole, Ratio]:
        """Return the pair of poles at w^2 = x and what is left without it."""
        pole, num, den = _without_pair(self.num, self.den, x)
        return pole, Ratio(_unless_rounding(num, self.num, self.tolerance), den, self.tolerance)

    def least_real(self) -> tuple[Decimal, Decimal, Decimal]:
        """Return the least Re F(jw), w^2 where it is, and how much of it is rounding; F has no axis poles.

        Of places that rounding does not tell apart it is an end, 0 or infinity, if one is among them.
        """
        real, _, below = _parts(self.num, self.den)
        turning = plus(times(derivative(real), below), times(real, derivative(below)), -ONE)
        found = []
        for x in [ZERO, *positive_roots(turning)]:
            w, magnitude = x.sqrt(), value(below, x)
            rounding = self.tolerance * size(self.num, w) * size(self.den, w) / magnitude
            found.append((value(real, x) / magnitude, x, rounding))
        top = self.num[-1] / self.den[-1] if len(self.num) == len(self.den) else ZERO
        found.append((top, INFINITY, abs(top) * self.tolerance))
        least, _, rounding = min(found)
        return min((end for end in (found[0], found[-1]) if end[0] - least <= rounding), default=min(found))

    def less(self, constant: Decimal, x: Decimal) -> Ratio:
        """Return F - constant, which is the least real part, at x."""
        num = plus(self.num, self.den, -constant)
        if x == 0:
            num = [ZERO, *num[1:]]
        elif x == INFINITY:
            num = trimmed(num[: len(self.den) - 1])
        return Ratio(num, self.den, self.tolerance)


def axis_roots(p: Polynomial, tolerance: Decimal) -> list[Decimal]:
    """Return w^2 > 0 of the roots on the imaginary axis: where the even and the odd part vanish together."""
    found: list[Decimal] = []
    for x in sorted([*positive_roots(even(p)), *positive_roots(odd(p))]):
        w = x.sqrt()
        limit = tolerance * size(p, w)
        near = any(abs(x - other) <= ROOT_TOLERANCE * x for other in found)
        if not near and abs(value(even(p), x)) <= limit and abs(w * value(odd(p), x)) <= limit:
            found.append(x)
    return found


def right_half_plane_roots(p: Polynomial) -> int:
    """Return how many roots of a polynomial without roots on the axis lie right of it (Routh)."""
    rows = [list(reversed(p))[::2], list(reversed(p))[1::2]]
    changes = 0
    for _ in range(len(p) - 1):
        above, here = rows
        if not here or here[0] == 0:
            return changes + 1
        changes += (above[0] < 0) != (here[0] < 0)
        ratio = above[0] / here[0]
        padded = here[1:] + [ZERO] * (len(above) - len(here))
        rows = [here, [a - ratio * b for a, b in zip(above[1:], padded, strict=True)]]
    return changes


def hertz(x: Decimal, scale: Scale) -> float:
    """Return the frequency [Hz] at w^2 = x of a normalised function."""
    return math.inf if x == INFINITY else math.sqrt(x) * scale.rate / (2 * math.pi)


def _middle(num: Polynomial, den: Polynomial) -> Decimal:
    """Return the geometric mean of the sizes of poles and zeros other than 0."""
    total, count = ZERO, 0
    for p in (num, den):
        own = [k for k, c in enumerate(p) if c]
        if own:
            total += abs(p[own[0]] / p[own[-1]]).ln()
            count += own[-1] - own[0]
    return (total / count).exp() if count else ONE


def _power_of_two(near: Decimal) -> Decimal:
    """Return the power of two near a number, by which floating-point numbers are multiplied exactly."""
    return Decimal(2) ** round(near.ln() / Decimal(2).ln())


def _parts(num: Polynomial, den: Polynomial) -> tuple[Polynomial, Polynomial, Polynomial]:
    """Return a, b, c with F(jw) = (a(x) + jw b(x))/c(x), x = w^2."""
    e, o, e_den, o_den = even(num), odd(num), even(den), odd(den)
    real = plus(times(e, e_den), by_s(times(o, o_den)))
    imaginary = plus(times(o, e_den), times(e, o_den), -ONE)
    return real, imaginary, plus(times(e_den, e_den), by_s(times(o_den, o_den)))


def _factor(root: complex) -> Polynomial:
    """Return s - root, or (s - root)(s - its conjugate)."""
    pair = [Decimal(abs(root)) ** 2, Decimal(-2 * root.real), ONE]
    return pair if root.imag else [Decimal(-root.real), ONE]


def _without_pair(num: Polynomial, den: Polynomial, x: Decimal) -> tuple[AxisPole, Polynomial, Polynomial]:
    pair = [x, ZERO, ONE]
    den = divided(den, pair)[0]
    real, imaginary, below = (value(p, x) for p in _parts(num, den))
    if below <= ROOT_TOLERANCE**2 * size(den, x.sqrt()) ** 2:
        return AxisPole(x, ZERO), num, den
    residue = imaginary / below
    rest = trimmed(divided(plus(num, by_s(den), -residue), pair)[0])
    return AxisPole(x, residue, real / below / x.sqrt()), rest, den


def _unless_rounding(rest: Polynomial, whole: Polynomial, tolerance: Decimal) -> Polynomial:
    """Return what a subtraction left, or zero if that is rounding."""
    small = tolerance * max(map(abs, whole), default=ZERO)
    return trimmed(rest) if any(abs(c) > small for c in rest) else []
