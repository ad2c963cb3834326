"""What acts between two shafts: springs, dampers, the inerter and backlash."""

from math import pi

import casadi as ca

from ..hysteresis import HystereticSpring
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
from ..lossy import Lossy


class TwoFlanges(Component):
    """Two flanges and the angle between them: phi_rel = flange_b.phi - flange_a.phi."""

    flange_a = RotationalFlange("left flange")
    flange_b = RotationalFlange("right flange")
    phi_rel = variable("rad", "angle between the flanges", state="avoid")

    def equations(self) -> Stated:
        yield self.phi_rel == self.flange_b.phi - self.flange_a.phi


class Compliant(TwoFlanges):
    """Two flanges without inertia between them: tau = flange_b.tau = -flange_a.tau."""

    tau = variable("N.m", "torque between the flanges, positive when it turns b back towards a")

    def equations(self) -> Stated:
        yield self.flange_b.tau == self.tau
        yield self.flange_a.tau == -self.tau


class CompliantWithSpeed(Compliant):
    """A compliant element whose law uses the relative speed w_rel = der(phi_rel)."""

    w_rel = variable("rad/s", "relative speed of the flanges", state="avoid")

    def equations(self) -> Stated:
        yield self.w_rel == der(self.phi_rel)


class Dissipative(CompliantWithSpeed, Lossy):
    """A compliant element that turns all its work into heat, unless it states otherwise."""

    lossPower = dissipation(lambda self: self.tau * self.w_rel)


class Spring(Compliant):
    """Linear spring: tau = c (phi_rel - phi_rel0).

    Source: MSL Rotational.Components.Spring.
    """

    c = parameter("N.m/rad", "stiffness", min=0)
    phi_rel0 = parameter("rad", "unstretched angle", default=0.0)
    potential = energy(lambda self: self.c * (self.phi_rel - self.phi_rel0) ** 2 / 2)

    def equations(self) -> Stated:
        yield self.tau == self.c * (self.phi_rel - self.phi_rel0)


class Damper(Dissipative):
    """Linear damper: tau = d w_rel.

    Source: MSL Rotational.Components.Damper.
    """

    d = parameter("N.m.s/rad", "damping constant", min=0)

    def equations(self) -> Stated:
        yield self.tau == self.d * self.w_rel


class VariableDamper(Dissipative):
    """Damper whose constant follows a signal: tau = (d + d_u u + d_uu u^2) w_rel."""

    u = RealInput("1", "what the damping follows")
    d = parameter("N.m.s/rad", "damping constant at u = 0", default=0.0)
    d_u = parameter("N.m.s/rad", "change of the damping constant with u")
    d_uu = parameter("N.m.s/rad", "change of it with the square of u", default=0.0)

    def equations(self) -> Stated:
        yield self.tau == (self.d + self.d_u * self.u + self.d_uu * self.u**2) * self.w_rel


class SpringDamper(Dissipative):
    """Linear spring and damper in parallel: tau = c (phi_rel - phi_rel0) + d w_rel.

    Source: MSL Rotational.Components.SpringDamper.
    """

    c = parameter("N.m/rad", "stiffness", min=0)
    d = parameter("N.m.s/rad", "damping constant", min=0)
    phi_rel0 = parameter("rad", "unstretched angle", default=0.0)
    potential = energy(lambda self: self.c * (self.phi_rel - self.phi_rel0) ** 2 / 2)
    lossPower = dissipation(lambda self: self.d * self.w_rel**2)

    def equations(self) -> Stated:
        yield self.tau == self.c * (self.phi_rel - self.phi_rel0) + self.d * self.w_rel


class CubicSpring(Compliant):
    """Spring with a cubic and a quadratic term: tau = c e + c2 e^2 + c3 e^3 with e = phi_rel - phi_rel0."""

    c = parameter("N.m/rad", "linear stiffness", min=0)
    c3 = parameter("N.m/rad3", "cubic stiffness; negative softens")
    phi_rel0 = parameter("rad", "unstretched angle", default=0.0)
    c2 = parameter("N.m/rad2", "quadratic stiffness: stiffer when pulled, softer when pushed", default=0.0)
    e = property(lambda self: self.phi_rel - self.phi_rel0)
    potential = energy(lambda self: self.e**2 * (self.c / 2 + self.c2 * self.e / 3 + self.c3 * self.e**2 / 4))

    def equations(self) -> Stated:
        yield self.tau == self.c * self.e + self.c2 * self.e**2 + self.c3 * self.e**3


class BilinearSpring(Compliant):
    """Spring that is stiffer one way: tau = c_pull e for e > 0 and c_push e for e < 0.

    e = phi_rel - phi_rel0.
    """

    c_pull = parameter("N.m/rad", "stiffness when pulled", min=0)
    c_push = parameter("N.m/rad", "stiffness when pushed", min=0)
    phi_rel0 = parameter("rad", "unstretched angle", default=0.0)
    pull = property(lambda self: ca.fmax(self.phi_rel - self.phi_rel0, 0))
    push = property(lambda self: ca.fmin(self.phi_rel - self.phi_rel0, 0))
    potential = energy(lambda self: self.c_pull * self.pull**2 / 2 + self.c_push * self.push**2 / 2)

    def equations(self) -> Stated:
        yield self.tau == self.c_pull * self.pull + self.c_push * self.push


class Ripple(Compliant):
    """Torque that comes back with every period: tau = tau_sin sin(2 pi phi_rel/period) + tau_cos cos(...)."""

    tau_sin = parameter("N.m", "amplitude of the sine")
    tau_cos = parameter("N.m", "amplitude of the cosine", default=0.0)
    period = parameter("rad", "angle after which the torque comes back", above=0)
    waves = property(lambda self: 2 * pi / self.period)
    angle = property(lambda self: self.waves * self.phi_rel)
    wave = property(lambda self: self.tau_sin * (1 - ca.cos(self.angle)) + self.tau_cos * ca.sin(self.angle))
    potential = energy(lambda self: self.wave / self.waves)

    def equations(self) -> Stated:
        yield self.tau == self.tau_sin * ca.sin(self.angle) + self.tau_cos * ca.cos(self.angle)


class BoucWen(CompliantWithSpeed, HystereticSpring):
    """Hysteretic spring: tau = alpha c phi_rel + (1 - alpha) c z.

    z' = A w_rel - beta |w_rel| |z|^(n-1) z - gamma w_rel |z|^n, with z [rad] the hysteretic angle.

    Source: Y.-K. Wen, J. Eng. Mech. Div. ASCE 102 (1976) 249-263, written for turning.
    """

    c = parameter("N.m/rad", "initial stiffness", min=0)
    beta = parameter("1/rad^n", "loop shape against the motion", min=0)
    gamma = parameter("1/rad^n", "loop shape along the motion")
    z = variable("rad", "hysteretic angle")

    @property
    def stretch(self) -> Expression:
        return self.phi_rel

    @property
    def speed(self) -> Expression:
        return self.w_rel

    @property
    def stiffness(self) -> Expression:
        return self.c

    def equations(self) -> Stated:
        yield self.tau == self.restoring


class HarmonicRipple(Compliant):
    """Torque that comes back with every period, as a sum of three harmonics.

    tau = sum over h = 1, 2, 3 of tau_sin_h sin(h x) + tau_cos_h cos(h x), x = 2 pi phi_rel/period; `tau_sin`
    and `tau_cos` are those of h = 1.

    Source: E. Favre, L. Cardoletti, M. Jufer, IEEE Trans. Ind. Appl. 29 (1993) 1141, on motors.
    """

    tau_sin = parameter("N.m", "amplitude of the sine")
    tau_cos = parameter("N.m", "amplitude of the cosine", default=0.0)
    tau_sin_2 = parameter("N.m", "amplitude of the sine of half the period", default=0.0)
    tau_cos_2 = parameter("N.m", "amplitude of the cosine of half the period", default=0.0)
    tau_sin_3 = parameter("N.m", "amplitude of the sine of a third of the period", default=0.0)
    tau_cos_3 = parameter("N.m", "amplitude of the cosine of a third of the period", default=0.0)
    period = parameter("rad", "angle after which the torque comes back", above=0)

    @property
    def harmonics(self) -> list[tuple[int, Expression, Expression, Expression]]:
        """Order, angle, and amplitudes of sine and cosine of each."""
        x = 2 * pi * self.phi_rel / self.period
        amplitudes = (
            (self.tau_sin, self.tau_cos),
            (self.tau_sin_2, self.tau_cos_2),
            (self.tau_sin_3, self.tau_cos_3),
        )
        return [(h, h * x, *pair) for h, pair in enumerate(amplitudes, 1)]

    @property
    def store(self) -> Expression:
        """Energy stored."""
        waves = sum((s * (1 - ca.cos(x)) + c * ca.sin(x)) / h for h, x, s, c in self.harmonics)
        return waves * self.period / (2 * pi)

    potential = energy(lambda self: self.store)

    def equations(self) -> Stated:
        yield self.tau == sum(s * ca.sin(x) + c * ca.cos(x) for _, x, s, c in self.harmonics)


class ArmGravity(Compliant):
    """Gravity on an arm that turns against the ground: tau = tau_sin sin(phi_rel) + tau_cos cos(phi_rel).

    An arm of mass m whose centre is at the distance r from its axis, phi_rel counted from where it hangs, has
    tau_sin = m g r; counted from the horizontal, tau_cos = m g r.
    """

    tau_sin = parameter("N.m", "torque a quarter of a turn from phi_rel = 0", default=0.0)
    tau_cos = parameter("N.m", "torque at phi_rel = 0", default=0.0)
    potential = energy(
        lambda self: self.tau_sin * (1 - ca.cos(self.phi_rel)) + self.tau_cos * ca.sin(self.phi_rel)
    )

    def equations(self) -> Stated:
        yield self.tau == self.tau_sin * ca.sin(self.phi_rel) + self.tau_cos * ca.cos(self.phi_rel)


class CubicDamper(Dissipative):
    """Damper with torque growing with the cube of speed: tau = d3 w_rel^3."""

    d3 = parameter("N.m.s3/rad3", "cubic damping constant", min=0)

    def equations(self) -> Stated:
        yield self.tau == self.d3 * self.w_rel**3


class ShearThinningDamper(Dissipative):
    """Damper whose oil thins where it is sheared fast: tau = d w_e asinh(w_rel/w_e).

    Viscous at speeds far below w_e; from there on it grows with the logarithm of the speed.

    Source: H. Eyring, J. Chem. Phys. 4 (1936) 283-291.
    """

    d = parameter("N.m.s/rad", "damping constant at rest", min=0)
    w_e = parameter("rad/s", "speed above which the oil thins", above=0)

    def equations(self) -> Stated:
        yield self.tau == self.d * self.w_e * ca.asinh(self.w_rel / self.w_e)


class QuadraticDamper(Dissipative):
    """Damper with torque growing with the square of speed (a fan): tau = k w_rel |w_rel|."""

    k = parameter("N.m.s2/rad2", "quadratic damping constant", min=0)

    def equations(self) -> Stated:
        yield self.tau == self.k * self.w_rel * ca.fabs(self.w_rel)


class Inerter(CompliantWithSpeed):
    """A flywheel between two shafts that feels their relative motion only: tau = J a_rel.

    Source: M. C. Smith, IEEE Trans. Automat. Contr. 47 (2002) 1648-1662, section II.
    """

    J = parameter("kg.m2", "rotational inertance", min=0)
    a_rel = variable("rad/s2", "relative acceleration of the flanges")
    kinetic = energy(lambda self: self.J * self.w_rel**2 / 2)

    def equations(self) -> Stated:
        yield self.a_rel == der(self.w_rel)
        yield self.tau == self.J * self.a_rel
