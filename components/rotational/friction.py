"""Dry friction between two shafts, and in a bearing."""

import casadi as ca

from ..elastoplastic import ElastoPlastic
from ..language import (
    Component,
    Expression,
    RealInput,
    RotationalFlange,
    Stated,
    der,
    dissipation,
    energy,
    parameter,
    variable,
)
from ..stickslip import StickSlip
from ..tables import interpolated, over_speed
from .compliances import Compliant, CompliantWithSpeed, Dissipative


class Friction(Compliant, StickSlip):
    """Two shafts that rub on each other; subclasses say how much in `sliding(speed)`."""

    phi_rel = variable("rad", "angle between the flanges", state="prefer")
    w_rel = variable("rad/s", "relative speed of the flanges", state="prefer")
    a_rel = variable("rad/s2", "relative acceleration of the flanges")

    quantities = "tau", "w_rel", "a_rel"

    def equations(self) -> Stated:
        yield self.w_rel == der(self.phi_rel)
        yield self.a_rel == der(self.w_rel)


class CoulombFriction(Friction):
    """Coulomb friction: tau = tau_c sgn(w_rel) while sliding, |tau| <= peak tau_c while stuck.

    Source: C. A. Coulomb, Theorie des machines simples (1785).
    """

    tau_c = parameter("N.m", "Coulomb friction torque", min=0)

    def sliding(self, speed: Expression) -> Expression:
        return self.tau_c + 0 * speed


class StribeckFriction(Friction):
    """Coulomb, Stribeck and viscous friction.

    tau = [tau_c + (tau_s - tau_c) exp(-|w_rel|/w_s)] sgn(w_rel) + d w_rel while sliding;
    |tau| <= peak tau_s while stuck.

    Source: Ge & Wang on the planetary flywheel inerter (see `machines.ge_wang`), eq. (26).
    """

    tau_c = parameter("N.m", "Coulomb friction torque", min=0)
    tau_s = parameter("N.m", "static friction torque", min=0)
    w_s = parameter("rad/s", "Stribeck speed", above=0)
    d = parameter("N.m.s/rad", "viscous friction", min=0, default=0.0)

    def sliding(self, speed: Expression) -> Expression:
        drop = (self.tau_s - self.tau_c) * ca.exp(-speed / self.w_s)
        return self.tau_c + drop + self.d * speed


class TabulatedFriction(Friction):
    """Friction torque interpolated linearly over speed: |tau| = tau_pos(|w_rel|) while sliding.

    |tau| <= peak tau_pos(0) while stuck; beyond its end the table goes on straight.

    Source: MSL Rotational.Components.BearingFriction.
    """

    tau_pos = over_speed("speed [rad/s], torque [N.m]", "torque")

    def sliding(self, speed: Expression) -> Expression:
        return interpolated(self.tau_pos, speed)


class Jenkins(CompliantWithSpeed, ElastoPlastic):
    """A spring in series with dry friction, without inertia between them: tau = c z, |tau| <= tau_c.

    z' = w_rel while it sticks, z' = 0 while it slips at |tau| = tau_c.

    Source: G. M. Jenkins, Analysis of the stress-strain relationships in reactor grade graphite, British
    Journal of Applied Physics 13 (1962) 30-32, written for turning.
    """

    c = parameter("N.m/rad", "stiffness of the spring", above=0)
    tau_c = parameter("N.m", "Coulomb friction torque", min=0)
    z = variable("rad", "twist of the spring")

    @property
    def speed(self) -> Expression:
        return self.w_rel

    @property
    def stiffness(self) -> Expression:
        return self.c

    @property
    def slip_stretch(self) -> Expression:
        return self.tau_c / self.c

    def equations(self) -> Stated:
        yield self.tau == self.c * self.z


class BearingFriction(Component):
    """Friction of a shaft in its bearing, whose housing is the ground when left unconnected.

    Example:
        >>> from inertance import rotational
        >>> oiled = rotational.StribeckFriction(tau_c=0.2, tau_s=0.22, w_s=1.0, d=3e-3)
        >>> bearing = rotational.BearingFriction(friction=oiled)
        >>> table = rotational.TabulatedFriction(tau_pos=((0, 0.5), (1, 1)), peak=1.2)
        >>> bearing = rotational.BearingFriction(friction=table)
    """

    flange = RotationalFlange("shaft")
    support = RotationalFlange("housing", optional=True)
    friction = CoulombFriction(tau_c=0.0)

    def connections(self) -> Stated:
        yield self.support, self.friction.flange_a
        yield self.flange, self.friction.flange_b


class AsymmetricFriction(Friction):
    """Coulomb friction that differs by direction.

    tau = tau_forward for w_rel > 0 and -tau_backward for w_rel < 0.
    While stuck, -peak tau_backward <= tau <= peak tau_forward.

    Source: B. Armstrong-Helouvry, Control of Machines with Friction (1991), section 2.3.
    """

    tau_forward = parameter("N.m", "friction torque while the angle grows", min=0)
    tau_backward = parameter("N.m", "friction torque while it shrinks", min=0)

    def sliding(self, speed: Expression) -> Expression:
        return self.tau_forward + 0 * speed

    def sliding_back(self, speed: Expression) -> Expression:
        return self.tau_backward + 0 * speed


class LoadedFriction(Friction):
    """Friction in proportion to a load: tau = mu |load| sgn(w_rel) while sliding.

    While stuck, |tau| <= peak mu |load|.

    Example:
        >>> from inertance import rotational
        >>> seal = rotational.LoadedFriction(mu=0.02)  # connect a TorqueSensor's torque to seal.load
    """

    load = RealInput("N.m", "torque that presses the surfaces together")
    mu = parameter("1", "friction torque over load", min=0)

    def sliding(self, speed: Expression) -> Expression:
        return self.mu * ca.fabs(self.load) + 0 * speed


class DriftingFriction(Friction):
    """Friction whose level follows a signal: tau = (tau_c + tau_u u + tau_uu u^2) sgn(w_rel) while sliding.

    u is what the level depends on: time, or a measured temperature. A level below zero counts as none; with
    `regularised` it may be negative, so that it stands for what a drift adds to, or takes from, friction that
    is there.
    """

    u = RealInput("1", "what the level follows")
    tau_c = parameter("N.m", "friction torque at u = 0", default=0.0)
    tau_u = parameter("N.m", "change of friction torque with u")
    tau_uu = parameter("N.m", "change of it with the square of u", default=0.0)

    def sliding(self, speed: Expression) -> Expression:
        return self.dry(self.tau_c + self.tau_u * self.u + self.tau_uu * self.u**2) + 0 * speed


class PositionDependentFriction(Friction):
    """Dry friction whose level depends on where it slides: tau = level sgn(w_rel).

    level = tau_c + tau_1 e + tau_2 e^2 + tau_cos cos(2 pi e/period) + tau_sin sin(2 pi e/period),
    e = phi_rel - phi_rel0, the waves as of a bearing that is tight at places.

    A level below zero counts as none; with `regularised` it may be negative, so that it stands for what is
    added to, or taken from, friction that is there.

    Source: B. Armstrong-Helouvry, Control of Machines with Friction (1991).
    """

    tau_c = parameter("N.m", "friction torque at phi_rel0, but for the waves", default=0.0)
    tau_1 = parameter("N.m/rad", "slope of the friction torque at phi_rel0", default=0.0)
    tau_2 = parameter("N.m/rad2", "half of its curvature", default=0.0)
    tau_cos = parameter("N.m", "share of a wave that is greatest at phi_rel0", default=0.0)
    tau_sin = parameter("N.m", "share of a wave that rises there", default=0.0)
    period = parameter("rad", "angle from wave to wave", above=0, default=2 * ca.pi)
    phi_rel0 = parameter("rad", "angle from which e counts", default=0.0)

    def sliding(self, speed: Expression) -> Expression:
        e = self.phi_rel - self.phi_rel0
        at = 2 * ca.pi * e / self.period
        waves = self.tau_cos * ca.cos(at) + self.tau_sin * ca.sin(at)
        return self.dry(self.tau_c + self.tau_1 * e + self.tau_2 * e**2 + waves) + 0 * speed


class DahlFriction(Dissipative):
    """Dry friction that builds up elastically before it slips: tau = tau_c z.

    phi_p z' = w_rel - |w_rel| z: the share z of tau_c grows by angle/phi_p at first, and comes within
    1/e of its end over phi_p. It knows no events, and creeps under a load that changes.

    Source: P. R. Dahl, AIAA Journal 14 (1976) 1675-1682, with the exponent 1.
    """

    tau_c = parameter("N.m", "friction torque once it slips", min=0)
    phi_p = parameter("rad", "presliding angle", above=0)
    z = variable("1", "share of the friction torque that has built up")
    potential = energy(lambda self: self.tau_c * self.phi_p * self.z**2 / 2)
    lossPower = dissipation(lambda self: self.tau_c * ca.fabs(self.w_rel) * self.z**2)

    def equations(self) -> Stated:
        yield self.tau == self.tau_c * self.z
        yield self.phi_p * der(self.z) == self.w_rel - ca.fabs(self.w_rel) * self.z
