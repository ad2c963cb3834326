"""Dry friction between two flanges."""

import casadi as ca

from ..language import Component, Expression, Stated, TranslationalFlange, der, option, parameter, variable
from ..stickslip import StickSlip
from ..tables import interpolated, over_speed
from .bases import Compliant


class Friction(Compliant, StickSlip):
    """Two flanges that rub on each other; subclasses say how much in `sliding(speed)`."""

    s_rel = variable("m", "distance of the flanges", state="prefer")
    v_rel = variable("m/s", "relative velocity of the flanges", state="prefer")
    a_rel = variable("m/s2", "relative acceleration of the flanges")

    def equations(self) -> Stated:
        yield self.v_rel == der(self.s_rel)
        yield self.a_rel == der(self.v_rel)


class CoulombFriction(Friction):
    """Coulomb friction: f = f_c sgn(v_rel) while sliding, |f| <= peak f_c while stuck.

    Source: C. A. Coulomb, Theorie des machines simples (1785).
    """

    f_c = parameter("N", "Coulomb friction force", min=0)

    def sliding(self, speed: Expression) -> Expression:
        """Friction force at a speed."""
        return self.f_c + 0 * speed


class StribeckFriction(Friction):
    """Coulomb, Stribeck and viscous friction.

    f = [f_c + (f_s - f_c) exp(-|v_rel|/v_s)] sgn(v_rel) + d v_rel while sliding;
    |f| <= peak f_s while stuck.

    Source: Ge & Wang, Modeling, Testing, and Characteristic Analysis of a Planetary Flywheel Inerter,
    eq. (26), written for translation.
    """

    f_c = parameter("N", "Coulomb friction force", min=0)
    f_s = parameter("N", "static friction force", min=0)
    v_s = parameter("m/s", "Stribeck velocity", above=0)
    d = parameter("N.s/m", "viscous friction", min=0, default=0.0)

    def sliding(self, speed: Expression) -> Expression:
        """Friction force at a speed."""
        drop = (self.f_s - self.f_c) * ca.exp(-speed / self.v_s)
        return self.f_c + drop + self.d * speed


class TabulatedFriction(Friction):
    """Friction force interpolated linearly in a table of (speed, force), speeds from 0 upwards."""

    table = option(
        "rows (speed [m/s], force [N]), speeds increasing from 0",
        default=((0.0, 1.0),),
        check=over_speed("force"),
    )

    def sliding(self, speed: Expression) -> Expression:
        """Friction force at a speed."""
        return interpolated(self.table, speed)


class SupportFriction(Component):
    """Friction of a sliding flange on a support, which is the ground when left unconnected.

    Example:
        >>> from inertance import CoulombFriction, SupportFriction
        >>> guide = SupportFriction(friction=CoulombFriction(f_c=10.0))
    """

    flange = TranslationalFlange("what slides")
    support = TranslationalFlange("what it slides on", optional=True)
    friction = CoulombFriction(f_c=0.0)

    def connections(self) -> Stated:
        yield self.support, self.friction.flange_a
        yield self.flange, self.friction.flange_b
