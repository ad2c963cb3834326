"""What acts between two shafts: springs, dampers, the inerter and backlash."""

from math import pi

import casadi as ca

from ..hysteresis import wen_rate
from ..language import Component, Expression, RealInput, RotationalFlange, Stated, der, parameter, variable


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


class Spring(Compliant):
    """Linear spring: tau = c (phi_rel - phi_rel0).

    Source: MSL Rotational.Components.Spring.
    """

    c = parameter("N.m/rad", "stiffness", min=0)
    phi_rel0 = parameter("rad", "unstretched angle", default=0.0)

    def equations(self) -> Stated:
        yield self.tau == self.c * (self.phi_rel - self.phi_rel0)


class Damper(CompliantWithSpeed):
    """Linear damper: tau = d w_rel.

    Source: MSL Rotational.Components.Damper.
    """

    d = parameter("N.m.s/rad", "damping constant", min=0)

    def equations(self) -> Stated:
        yield self.tau == self.d * self.w_rel


class VariableDamper(CompliantWithSpeed):
    """Damper whose constant follows a signal: tau = (d + d_u u) w_rel."""

    u = RealInput("1", "what the damping follows")
    d = parameter("N.m.s/rad", "damping constant at u = 0", default=0.0)
    d_u = parameter("N.m.s/rad", "change of the damping constant with u")

    def equations(self) -> Stated:
        yield self.tau == (self.d + self.d_u * self.u) * self.w_rel


class SpringDamper(CompliantWithSpeed):
    """Linear spring and damper in parallel: tau = c (phi_rel - phi_rel0) + d w_rel.

    Source: MSL Rotational.Components.SpringDamper.
    """

    c = parameter("N.m/rad", "stiffness", min=0)
    d = parameter("N.m.s/rad", "damping constant", min=0)
    phi_rel0 = parameter("rad", "unstretched angle", default=0.0)

    def equations(self) -> Stated:
        yield self.tau == self.c * (self.phi_rel - self.phi_rel0) + self.d * self.w_rel


class CubicSpring(Compliant):
    """Spring with a cubic term: tau = c e + c3 e^3 with e = phi_rel - phi_rel0."""

    c = parameter("N.m/rad", "linear stiffness", min=0)
    c3 = parameter("N.m/rad3", "cubic stiffness; negative softens")
    phi_rel0 = parameter("rad", "unstretched angle", default=0.0)

    def equations(self) -> Stated:
        e = self.phi_rel - self.phi_rel0
        yield self.tau == self.c * e + self.c3 * e**3


class BilinearSpring(Compliant):
    """Spring that is stiffer one way: tau = c_pull e for e > 0 and c_push e for e < 0.

    e = phi_rel - phi_rel0.
    """

    c_pull = parameter("N.m/rad", "stiffness when pulled", min=0)
    c_push = parameter("N.m/rad", "stiffness when pushed", min=0)
    phi_rel0 = parameter("rad", "unstretched angle", default=0.0)

    def equations(self) -> Stated:
        e = self.phi_rel - self.phi_rel0
        yield self.tau == self.c_pull * ca.fmax(e, 0) + self.c_push * ca.fmin(e, 0)


class Ripple(Compliant):
    """Torque that comes back with every period: tau = tau_sin sin(2 pi phi_rel/period) + tau_cos cos(...)."""

    tau_sin = parameter("N.m", "amplitude of the sine")
    tau_cos = parameter("N.m", "amplitude of the cosine", default=0.0)
    period = parameter("rad", "angle after which the torque comes back", above=0)

    def equations(self) -> Stated:
        angle = 2 * pi * self.phi_rel / self.period
        yield self.tau == self.tau_sin * ca.sin(angle) + self.tau_cos * ca.cos(angle)


class BoucWen(CompliantWithSpeed):
    """Hysteretic spring: tau = alpha c phi_rel + (1 - alpha) c z.

    z' = A w_rel - beta |w_rel| |z|^(n-1) z - gamma w_rel |z|^n, with z [rad] the hysteretic angle.

    Source: Y.-K. Wen, J. Eng. Mech. Div. ASCE 102 (1976) 249-263, written for turning.
    """

    c = parameter("N.m/rad", "initial stiffness", min=0)
    alpha = parameter("1", "share of stiffness after yield", min=0, max=1, default=0.1)
    A = parameter("1", "scale of the hysteretic angle", above=0, default=1.0)
    beta = parameter("1/rad^n", "loop shape against the motion", min=0)
    gamma = parameter("1/rad^n", "loop shape along the motion")
    n = parameter("1", "sharpness of yield", min=1, default=2.0)
    z = variable("rad", "hysteretic angle")

    def equations(self) -> Stated:
        w, z = self.w_rel, self.z
        yield self.tau == self.alpha * self.c * self.phi_rel + (1 - self.alpha) * self.c * z
        yield der(z) == wen_rate(w, z, self.A, self.beta, self.gamma, self.n)


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

    def equations(self) -> Stated:
        x = 2 * pi * self.phi_rel / self.period
        first = self.tau_sin * ca.sin(x) + self.tau_cos * ca.cos(x)
        second = self.tau_sin_2 * ca.sin(2 * x) + self.tau_cos_2 * ca.cos(2 * x)
        third = self.tau_sin_3 * ca.sin(3 * x) + self.tau_cos_3 * ca.cos(3 * x)
        yield self.tau == first + second + third


class ArmGravity(Compliant):
    """Gravity on an arm that turns against the ground: tau = tau_sin sin(phi_rel) + tau_cos cos(phi_rel).

    An arm of mass m whose centre is at the distance r from its axis, phi_rel counted from where it hangs, has
    tau_sin = m g r; counted from the horizontal, tau_cos = m g r.
    """

    tau_sin = parameter("N.m", "torque a quarter of a turn from phi_rel = 0", default=0.0)
    tau_cos = parameter("N.m", "torque at phi_rel = 0", default=0.0)

    def equations(self) -> Stated:
        yield self.tau == self.tau_sin * ca.sin(self.phi_rel) + self.tau_cos * ca.cos(self.phi_rel)


class CubicDamper(CompliantWithSpeed):
    """Damper with torque growing with the cube of speed: tau = d3 w_rel^3."""

    d3 = parameter("N.m.s3/rad3", "cubic damping constant", min=0)

    def equations(self) -> Stated:
        yield self.tau == self.d3 * self.w_rel**3


class ShearThinningDamper(CompliantWithSpeed):
    """Damper whose oil thins where it is sheared fast: tau = d w_e asinh(w_rel/w_e).

    Viscous at speeds far below w_e; from there on it grows with the logarithm of the speed.

    Source: H. Eyring, J. Chem. Phys. 4 (1936) 283-291.
    """

    d = parameter("N.m.s/rad", "damping constant at rest", min=0)
    w_e = parameter("rad/s", "speed above which the oil thins", above=0)

    def equations(self) -> Stated:
        yield self.tau == self.d * self.w_e * ca.asinh(self.w_rel / self.w_e)


class QuadraticDamper(CompliantWithSpeed):
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

    def equations(self) -> Stated:
        yield self.a_rel == der(self.w_rel)
        yield self.tau == self.J * self.a_rel


class ElastoBacklash(CompliantWithSpeed):
    """Backlash b between elastic flanks that only ever press.

    With x = phi_rel - phi_rel0 and the spring torque tau_c = c max(|x| - b/2, 0) of the flank in
    contact, tau = sgn(x) max(tau_c + min(tau_c, sgn(x) d w_rel), 0): damping adds at most tau_c as
    the flank is pressed, and takes away at most tau_c as it is released, so tau is continuous.

    Source: MSL Rotational.Components.ElastoBacklash, whose law with b = 0 is the plain spring and
    damper instead.
    """

    c = parameter("N.m/rad", "stiffness in contact", above=0)
    d = parameter("N.m.s/rad", "damping constant in contact", min=0)
    b = parameter("rad", "total backlash", min=0, default=0.0)
    phi_rel0 = parameter("rad", "angle in the middle of the backlash", default=0.0)

    def pressed(self, depth: Expression, speed: Expression) -> Expression:
        """Torque of one flank, from how deep and how fast it is pressed."""
        spring = self.c * ca.fmax(depth, 0)
        return ca.fmax(spring + ca.fmin(spring, self.d * speed), 0)

    def equations(self) -> Stated:
        x, w, half = self.phi_rel - self.phi_rel0, self.w_rel, self.b / 2
        yield self.tau == self.pressed(x - half, w) - self.pressed(-x - half, -w)
