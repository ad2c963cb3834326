"""Dry friction: between two flanges, on a support, and in a brake."""

import casadi as ca

from ..elastoplastic import ElastoPlastic
from ..language import (
    Component,
    Expression,
    RealInput,
    Stated,
    TranslationalFlange,
    der,
    dissipation,
    energy,
    parameter,
    variable,
)
from ..pressed import PressedStickSlip
from ..stickslip import StickSlip
from ..tables import interpolated, over_speed
from .compliances import Compliant, CompliantWithSpeed, Dissipative


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
        return self.f_c + 0 * speed


class StribeckFriction(Friction):
    """Coulomb, Stribeck and viscous friction.

    f = [f_c + (f_s - f_c) exp(-|v_rel|/v_s)] sgn(v_rel) + d v_rel while sliding;
    |f| <= peak f_s while stuck.

    Source: Ge & Wang on the planetary flywheel inerter (see `machines.ge_wang`), eq. (26) for translation.
    """

    f_c = parameter("N", "Coulomb friction force", min=0)
    f_s = parameter("N", "static friction force", min=0)
    v_s = parameter("m/s", "Stribeck velocity", above=0)
    d = parameter("N.s/m", "viscous friction", min=0, default=0.0)

    def sliding(self, speed: Expression) -> Expression:
        drop = (self.f_s - self.f_c) * ca.exp(-speed / self.v_s)
        return self.f_c + drop + self.d * speed


class TabulatedFriction(Friction):
    """Friction force interpolated linearly in a table of (speed, force), speeds from 0 upwards."""

    table = over_speed("speed [m/s], force [N]", "force")

    def sliding(self, speed: Expression) -> Expression:
        return interpolated(self.table, speed)


class Jenkins(CompliantWithSpeed, ElastoPlastic):
    """A spring in series with dry friction, without mass between them: f = k z, |f| <= f_c.

    z' = v_rel while it sticks, z' = 0 while it slips at |f| = f_c. Several side by side, which slip one
    after the other, are friction with presliding (Maxwell-slip, Iwan).

    Source: G. M. Jenkins, Analysis of the stress-strain relationships in reactor grade graphite, British
    Journal of Applied Physics 13 (1962) 30-32.

    Example:
        >>> from inertance import Jenkins
        >>> joint = Jenkins(k=1e6, f_c=200.0)
    """

    k = parameter("N/m", "stiffness of the spring", above=0)
    f_c = parameter("N", "Coulomb friction force", min=0)
    z = variable("m", "stretch of the spring")

    @property
    def speed(self) -> Expression:
        return self.v_rel

    @property
    def stiffness(self) -> Expression:
        return self.k

    @property
    def slip_stretch(self) -> Expression:
        return self.f_c / self.k

    def equations(self) -> Stated:
        yield self.f == self.k * self.z


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


class AsymmetricFriction(Friction):
    """Coulomb friction that differs by direction.

    f = f_forward for v_rel > 0 and -f_backward for v_rel < 0.
    While stuck, -peak f_backward <= f <= peak f_forward.

    Source: B. Armstrong-Helouvry, Control of Machines with Friction (1991), section 2.3.
    """

    f_forward = parameter("N", "friction force while the flanges part", min=0)
    f_backward = parameter("N", "friction force while they approach", min=0)

    def sliding(self, speed: Expression) -> Expression:
        return self.f_forward + 0 * speed

    def sliding_back(self, speed: Expression) -> Expression:
        return self.f_backward + 0 * speed


class LoadedFriction(Friction):
    """Friction in proportion to a load: f = mu |load| sgn(v_rel) while sliding.

    While stuck, |f| <= peak mu |load|.

    Example:
        >>> from inertance import ForceSensor, LoadedFriction
        >>> seal = LoadedFriction(mu=0.02)  # connect the force of a ForceSensor to seal.load
    """

    load = RealInput("N", "force that presses the surfaces together")
    mu = parameter("1", "friction force over load", min=0)

    def sliding(self, speed: Expression) -> Expression:
        return self.mu * ca.fabs(self.load) + 0 * speed


class DriftingFriction(Friction):
    """Friction whose level follows a signal: f = (f_c + f_u u + f_uu u^2) sgn(v_rel) while sliding.

    u is what the level depends on: time, or a measured temperature. A level below zero counts as none; with
    `regularised` it may be negative, so that it stands for what a drift adds to, or takes from, friction that
    is there.
    """

    u = RealInput("1", "what the level follows")
    f_c = parameter("N", "friction force at u = 0", default=0.0)
    f_u = parameter("N", "change of friction force with u")
    f_uu = parameter("N", "change of it with the square of u", default=0.0)

    def sliding(self, speed: Expression) -> Expression:
        return self.dry(self.f_c + self.f_u * self.u + self.f_uu * self.u**2) + 0 * speed


class PositionDependentFriction(Friction):
    """Dry friction whose level depends on where it slides: f = level sgn(v_rel).

    level = f_c + f_1 e + f_2 e^2 + f_cos cos(2 pi e/period) + f_sin sin(2 pi e/period), e = s_rel - s_rel0,
    the waves as of a screw or a rail that is tight at places.

    A level below zero counts as none; with `regularised` it may be negative, so that it stands for what is
    added to, or taken from, friction that is there.

    Source: B. Armstrong-Helouvry, Control of Machines with Friction (1991).
    """

    f_c = parameter("N", "friction force at s_rel0, but for the waves", default=0.0)
    f_1 = parameter("N/m", "slope of the friction force there", default=0.0)
    f_2 = parameter("N/m2", "half of its curvature", default=0.0)
    f_cos = parameter("N", "share of a wave that is greatest at s_rel0", default=0.0)
    f_sin = parameter("N", "share of a wave that rises there", default=0.0)
    period = parameter("m", "distance from wave to wave", above=0, default=1.0)
    s_rel0 = parameter("m", "distance from which e counts", default=0.0)

    def sliding(self, speed: Expression) -> Expression:
        e = self.s_rel - self.s_rel0
        at = 2 * ca.pi * e / self.period
        waves = self.f_cos * ca.cos(at) + self.f_sin * ca.sin(at)
        return self.dry(self.f_c + self.f_1 * e + self.f_2 * e**2 + waves) + 0 * speed


class DahlFriction(Dissipative):
    """Dry friction that builds up elastically before it slips: f = f_c z.

    s_p z' = v_rel - |v_rel| z: the share z of f_c grows by displacement/s_p at first, and comes within
    1/e of its end over s_p. It knows no events, and creeps under a load that changes.

    Source: P. R. Dahl, AIAA Journal 14 (1976) 1675-1682, with the exponent 1.
    """

    f_c = parameter("N", "friction force once it slips", min=0)
    s_p = parameter("m", "presliding displacement", above=0)
    z = variable("1", "share of the friction force that has built up")
    potential = energy(lambda self: self.f_c * self.s_p * self.z**2 / 2)
    lossPower = dissipation(lambda self: self.f_c * ca.fabs(self.v_rel) * self.z**2)

    def equations(self) -> Stated:
        yield self.f == self.f_c * self.z
        yield self.s_p * der(self.z) == self.v_rel - ca.fabs(self.v_rel) * self.z


class Brake(PressedStickSlip):
    """A sliding part held by friction on a support: f = mu(|v|) cgeo fn against v while sliding.

    fn = fn_max max(f_normalized, 0); |f| <= peak mu(0) cgeo fn while stuck; free when fn = 0.
    The support, which takes -f, is the ground when left unconnected.

    Source: MSL Translational.Components.Brake.
    """

    flange = TranslationalFlange("what slides")
    support = TranslationalFlange("what it slides on", optional=True)
    cgeo = parameter("1", "friction faces, weighted by the distribution of pressure", above=0, default=1.0)
    s = variable("m", "position against the support", state="prefer")
    v = variable("m/s", "velocity against the support", state="prefer")
    a = variable("m/s2", "acceleration against the support")
    f = variable("N", "braking force, positive against positive velocity")

    quantities = "f", "v", "a"

    def equations(self) -> Stated:
        yield self.s == self.flange.s - self.support.s
        yield self.v == der(self.s)
        yield self.a == der(self.v)
        yield self.flange.f == self.f
        yield self.support.f == -self.f
