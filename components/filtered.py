"""Filtered motions: what a prescribed motion makes of a reference that it does not follow exactly."""

from typing import Any

import casadi as ca

from .language import option, parameter

FIRST, SECOND = 1.3617, 0.6180


def exactness() -> Any:
    """Declare whether a motion follows its reference exactly."""
    return option(
        "whether the reference is followed exactly; else by a filter, which knows no shocks",
        default=True,
        choices=(True, False),
    )


def critical_frequency() -> Any:
    """Declare the critical frequency of the filter."""
    return parameter("Hz", "critical frequency of the filter with exact=False", default=50.0, above=0)


def after_position(reference: Any, position: Any, lead: Any, f_crit: Any) -> tuple[Any, Any]:
    """Return the rates of a position that follows another by a Bessel filter of order 2, and of its lead.

    The lead is where it would be after 1/(2 pi f_crit) at its present speed.

    Source: MSL Translational.Sources.Position with exact=false.
    """
    omega = 2 * ca.pi * f_crit
    speed = (lead - position) * omega
    return speed, speed + ((reference - position) * omega - FIRST * speed) / SECOND


def after_speed(reference: Any, speed: Any, f_crit: Any) -> Any:
    """Return the acceleration of what follows a speed by a filter of order 1.

    Source: MSL Translational.Sources.Speed with exact=false.
    """
    return (reference - speed) * 2 * ca.pi * f_crit
