"""Prescribed motions, which follow a reference exactly or by a filter."""

import casadi as ca

from .language import Component, Expression, Stated, der, option, parameter

BESSEL_FIRST, BESSEL_SECOND = 1.3617, 0.6180  # coefficients of the filter of order 2


class Filtered(Component):
    """What a prescribed motion makes of its reference: the same, or what a filter lets through.

    Source: MSL Translational.Sources.Position (Bessel, order 2) and Speed (order 1) with exact=false.
    """

    exact = option(
        "whether the reference is followed exactly; else by a filter, which knows no shocks",
        default=True,
        choices=(True, False),
    )
    f_crit = parameter("Hz", "critical frequency of the filter with exact=False", default=50.0, above=0)

    def follow_position(self, reference: Expression, position: Expression, lead: Expression) -> Stated:
        """State how a position follows another, with the lead where it would be after 1/(2 pi f_crit)."""
        if self.exact:
            yield position == reference
            yield lead == reference
            return
        omega = 2 * ca.pi * self.f_crit
        speed = (lead - position) * omega
        yield der(position) == speed
        yield der(lead) == speed + ((reference - position) * omega - BESSEL_FIRST * speed) / BESSEL_SECOND

    def follow_speed(self, reference: Expression, speed: Expression) -> Stated:
        """State how a speed follows another."""
        if self.exact:
            yield speed == reference
        else:
            yield der(speed) == (reference - speed) * 2 * ca.pi * self.f_crit
