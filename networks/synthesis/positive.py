"""The positive-real test: which admittances springs, dampers and inerters can have."""

from __future__ import annotations

import math
from dataclasses import dataclass
from decimal import Decimal, localcontext
from typing import Any

import numpy as np

from ...base import ModelError
from .polynomials import DIGITS
from .ratio import Ratio, Scale, hertz, right_half_plane_roots
from .rational import RationalFunction

SKEW_TOLERANCE = Decimal("1e-7")


class NotPositiveRealError(ModelError):
    """An admittance that no passive network has; `frequency` [Hz] shows it."""

    def __init__(self, message: str, frequency: float) -> None:
        self.frequency = frequency
        super().__init__(message)


@dataclass(frozen=True)
class PositiveReal:
    """Whether a function is positive-real; true or false in a condition.

    Attributes:
        holds: whether it is.
        frequency: where its real part is least [Hz], or the frequency that shows it is not.
        least: its real part there, without the poles on the axis.
        reason: why it is not; empty if it is.
    """

    holds: bool
    frequency: float
    least: float
    reason: str = ""

    def __bool__(self) -> bool:
        return self.holds


def positive_real(admittance: Any) -> PositiveReal:
    """Return whether a function is positive-real, and the frequency that shows it if not.

    F is positive-real if it has no pole with Re s > 0, if its poles on the imaginary axis, at infinity too,
    are simple with positive residues, and Re F(jw) >= 0 at all other frequencies. The last is decided at the
    stationary points of Re F(jw), the roots of a polynomial in w^2, in 80 digits.

    Args:
        admittance: what `RationalFunction.of` takes: (num, den), highest power first, or a linear system. A
            violation smaller than the accuracy of its coefficients counts as rounding.

    Source: O. Brune, J. Math. Phys. 10 (1931) 191-236; M. C. Smith, IEEE Trans. Automat. Contr. 47 (2002)
    1648-1662, theorem 1.

    Example:
        >>> from inertance.synthesis import positive_real
        >>> bool(positive_real(([1.0, 1.0, 1.0], [1.0, 1.0, 4.0])))  # Re F(jw) = 0 at w^2 = 2
        True
        >>> positive_real(([1.0, 1.0, 1.0], [1.0, 1.0, 9.0])).reason
        'its real part is -0.6 N.s/m at 0.389848 Hz'
    """
    function = RationalFunction.of(admittance)
    with localcontext(prec=DIGITS):
        return _tested(*Ratio.normalised(function))


def required_positive_real(function: RationalFunction) -> tuple[Ratio, Scale]:
    """Return a function normalised; a NotPositiveRealError names the frequency where it is not."""
    ratio, scale = Ratio.normalised(function)
    found = _tested(ratio, scale)
    if not found:
        raise NotPositiveRealError(
            f"this admittance is not positive-real: {found.reason}; no springs, dampers and inerters have it",
            found.frequency,
        )
    return ratio, scale


def _tested(ratio: Ratio, scale: Scale) -> PositiveReal:
    if not ratio.num:
        return PositiveReal(True, 0.0, 0.0)
    if len(ratio.num) > len(ratio.den) + 1:
        return _refused(math.inf, f"it grows as s^{len(ratio.num) - len(ratio.den)} at infinite frequency")
    if ratio.den[0] == 0 and len(ratio.den) > 1 and ratio.den[1] == 0:
        return _refused(0.0, "it has a multiple pole at 0 Hz")
    poles, rest = ratio.axis_poles()
    for pole in poles:
        at = hertz(pole.x, scale)
        if pole.residue <= 0:
            return _refused(at, f"its pole at {at:.6g} Hz is not simple with a positive residue")
        if abs(pole.skew) > SKEW_TOLERANCE * pole.residue:
            return _refused(at, f"the residue of its pole at {at:.6g} Hz is not real")
    if right_half_plane_roots(rest.den):
        return _unstable(rest, scale)
    least, x, rounding = rest.least_real() if rest.num else (Decimal(0), Decimal(0), Decimal(0))
    frequency, real = hertz(x, scale), float(least) * scale.gain
    if least < -rounding:
        return _refused(frequency, f"its real part is {real:.6g} N.s/m at {frequency:.6g} Hz", real)
    return PositiveReal(True, frequency, real)


def _unstable(rest: Ratio, scale: Scale) -> PositiveReal:
    roots = np.roots([float(c) for c in reversed(rest.den)])
    worst = complex(roots[np.argmax(roots.real)]) * scale.rate
    frequency = abs(worst.imag) / (2 * math.pi)
    return _refused(frequency, f"it has an unstable pole, {worst:.6g} rad/s, at {frequency:.6g} Hz")


def _refused(frequency: float, reason: str, least: float = math.nan) -> PositiveReal:
    return PositiveReal(False, frequency, least, reason)
