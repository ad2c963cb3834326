"""Pressed surfaces: what clutches and brakes have in common, for sliding and for turning."""

import casadi as ca

from .language import Component, Expression, RealInput, Stated, mode, parameter
from .stickslip import StickSlip
from .tables import interpolated, over_speed

RELEASED_SIGNAL = 1e-9


class Pressed(Component):
    """Two surfaces that a signal presses together: fn = fn_max max(f_normalized, 0).

    A subclass declares `cgeo`, what fn is multiplied by.
    """

    f_normalized = RealInput("1", "normal force over its largest value")
    fn_max = parameter("N", "largest normal force", min=0)
    mu_pos = over_speed("speed, friction coefficient", "coefficient", default=0.5)

    def sliding(self, speed: Expression) -> Expression:
        """Friction mu(speed) cgeo fn while sliding."""
        return self.cgeo * (interpolated(self.mu_pos, speed) * self.fn_max * ca.fmax(self.f_normalized, 0))


class PressedStickSlip(Pressed, StickSlip):
    """Dry friction of pressed surfaces, which are free while f_normalized is not above zero.

    Break-away takes `peak` times the resistance to sliding at rest.
    Limits: a signal below 1e-9 counts as zero.
    """

    mode = mode(
        "free", "stuck", "forward", "backward",
        doc="free, sticking or sliding", in_shock={"stuck": "forward"},
    )  # fmt: skip

    @property
    def grips(self) -> Expression:
        """Whether the surfaces are pressed."""
        return self.f_normalized > RELEASED_SIGNAL

    def laws(self) -> dict[str, Expression]:
        """What vanishes in each mode; a plain variable would count as a motion that is held."""
        return {"free": -self.resistance, **StickSlip.laws(self)}

    def transitions(self) -> Stated:
        if self.regularised:
            return
        for pressed in ("stuck", "forward", "backward"):
            yield self.mode.goes(pressed, "free", when=self.f_normalized < RELEASED_SIGNAL)
        yield self.mode.goes("free", "forward", when=self.grips, allowed=self.speed > 0)
        yield self.mode.goes("free", "backward", when=self.grips, allowed=self.speed < 0)
        yield self.mode.goes("free", "stuck", when=self.grips, allowed=self.speed == 0)
