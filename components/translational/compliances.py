"""What acts between two flanges: springs, dampers and the inerter."""

from math import pi

import casadi as ca

from ..hysteresis import wen_rate
from ..language import Component, RealInput, Stated, TranslationalFlange, der, parameter, variable


class TwoFlanges(Component):
    """Two flanges and the distance between them: s_rel = flange_b.s - flange_a.s."""

    flange_a = TranslationalFlange("left flange")
    flange_b = TranslationalFlange("right flange")
    s_rel = variable("m", "distance of the flanges", state="avoid")

    def equations(self) -> Stated:
        yield self.s_rel == self.flange_b.s - self.flange_a.s


class Compliant(TwoFlanges):
    """Two flanges without mass between them: f = flange_b.f = -flange_a.f, tension positive."""

    f = variable("N", "force between the flanges, positive when it pulls them together")

    def equations(self) -> Stated:
        yield self.flange_b.f == self.f
        yield self.flange_a.f == -self.f


class CompliantWithSpeed(Compliant):
    """A compliant element whose law uses the relative velocity v_rel = der(s_rel)."""

    v_rel = variable("m/s", "relative velocity of the flanges", state="avoid")

    def equations(self) -> Stated:
        yield self.v_rel == der(self.s_rel)


class Spring(Compliant):
    """Linear spring: f = k (s_rel - s_rel0).

    Source: MSL Translational.Components.Spring.
    """

    k = parameter("N/m", "stiffness", min=0)
    s_rel0 = parameter("m", "unstretched length", default=0.0)

    def equations(self) -> Stated:
        yield self.f == self.k * (self.s_rel - self.s_rel0)


class Damper(CompliantWithSpeed):
    """Linear damper: f = d v_rel.

    Source: MSL Translational.Components.Damper.
    """

    d = parameter("N.s/m", "damping constant", min=0)

    def equations(self) -> Stated:
        yield self.f == self.d * self.v_rel


class VariableDamper(CompliantWithSpeed):
    """Damper whose constant follows a signal: f = (d + d_u u) v_rel.

    u is what it depends on: the current of a valve or a coil, a temperature, time. A constant below 0 stands
    for what is taken from damping that is there.
    """

    u = RealInput("1", "what the damping follows")
    d = parameter("N.s/m", "damping constant at u = 0", default=0.0)
    d_u = parameter("N.s/m", "change of the damping constant with u")

    def equations(self) -> Stated:
        yield self.f == (self.d + self.d_u * self.u) * self.v_rel


class SpringDamper(CompliantWithSpeed):
    """Linear spring and damper in parallel: f = k (s_rel - s_rel0) + d v_rel.

    Source: MSL Translational.Components.SpringDamper.
    """

    k = parameter("N/m", "stiffness", min=0)
    d = parameter("N.s/m", "damping constant", min=0)
    s_rel0 = parameter("m", "unstretched length", default=0.0)

    def equations(self) -> Stated:
        yield self.f == self.k * (self.s_rel - self.s_rel0) + self.d * self.v_rel


class Inerter(CompliantWithSpeed):
    """Ideal inerter: f = b a_rel, force proportional to relative acceleration.

    Source: M. C. Smith, IEEE Trans. Automat. Contr. 47 (2002) 1648-1662, eq. (4).
    """

    b = parameter("kg", "inertance", min=0)
    a_rel = variable("m/s2", "relative acceleration of the flanges")

    def equations(self) -> Stated:
        yield self.a_rel == der(self.v_rel)
        yield self.f == self.b * self.a_rel


class CubicSpring(Compliant):
    """Spring with a cubic term: f = k e + k3 e^3 with e = s_rel - s_rel0.

    Source: G. Duffing, Erzwungene Schwingungen bei veraenderlicher Eigenfrequenz (1918).
    """

    k = parameter("N/m", "linear stiffness", min=0)
    k3 = parameter("N/m3", "cubic stiffness; negative softens")
    s_rel0 = parameter("m", "unstretched length", default=0.0)

    def equations(self) -> Stated:
        e = self.s_rel - self.s_rel0
        yield self.f == self.k * e + self.k3 * e**3


class BilinearSpring(Compliant):
    """Spring that is stiffer one way: f = k_pull e for e > 0 and k_push e for e < 0.

    e = s_rel - s_rel0.
    """

    k_pull = parameter("N/m", "stiffness when pulled", min=0)
    k_push = parameter("N/m", "stiffness when pushed", min=0)
    s_rel0 = parameter("m", "unstretched length", default=0.0)

    def equations(self) -> Stated:
        e = self.s_rel - self.s_rel0
        yield self.f == self.k_pull * ca.fmax(e, 0) + self.k_push * ca.fmin(e, 0)


class Ripple(Compliant):
    """Force that comes back with every period of travel: f = f_sin sin(2 pi s_rel/period) + f_cos cos(...).

    The thread of a screw, the poles of a motor, the teeth of a rack.
    """

    f_sin = parameter("N", "amplitude of the sine")
    f_cos = parameter("N", "amplitude of the cosine", default=0.0)
    period = parameter("m", "travel after which the force comes back", above=0)

    def equations(self) -> Stated:
        angle = 2 * pi * self.s_rel / self.period
        yield self.f == self.f_sin * ca.sin(angle) + self.f_cos * ca.cos(angle)


class HarmonicRipple(Compliant):
    """Force that comes back with every period, as a sum of three harmonics.

    f = sum over h = 1, 2, 3 of f_sin_h sin(h x) + f_cos_h cos(h x), x = 2 pi s_rel/period; `f_sin` and
    `f_cos` are those of h = 1.

    Source: E. Favre, L. Cardoletti, M. Jufer, IEEE Trans. Ind. Appl. 29 (1993) 1141, on motors.
    """

    f_sin = parameter("N", "amplitude of the sine")
    f_cos = parameter("N", "amplitude of the cosine", default=0.0)
    f_sin_2 = parameter("N", "amplitude of the sine of half the period", default=0.0)
    f_cos_2 = parameter("N", "amplitude of the cosine of half the period", default=0.0)
    f_sin_3 = parameter("N", "amplitude of the sine of a third of the period", default=0.0)
    f_cos_3 = parameter("N", "amplitude of the cosine of a third of the period", default=0.0)
    period = parameter("m", "travel after which the force comes back", above=0)

    def equations(self) -> Stated:
        x = 2 * pi * self.s_rel / self.period
        first = self.f_sin * ca.sin(x) + self.f_cos * ca.cos(x)
        second = self.f_sin_2 * ca.sin(2 * x) + self.f_cos_2 * ca.cos(2 * x)
        third = self.f_sin_3 * ca.sin(3 * x) + self.f_cos_3 * ca.cos(3 * x)
        yield self.f == first + second + third


class CubicDamper(CompliantWithSpeed):
    """Damper with force growing with the cube of speed: f = d3 v_rel^3.

    Source: A. H. Nayfeh, D. T. Mook, Nonlinear Oscillations (1979).
    """

    d3 = parameter("N.s3/m3", "cubic damping constant", min=0)

    def equations(self) -> Stated:
        yield self.f == self.d3 * self.v_rel**3


class ShearThinningDamper(CompliantWithSpeed):
    """Damper whose oil thins where it is sheared fast: f = d v_e asinh(v_rel/v_e).

    Viscous at speeds far below v_e; from there on it grows with the logarithm of the speed.

    Source: H. Eyring, J. Chem. Phys. 4 (1936) 283-291.
    """

    d = parameter("N.s/m", "damping constant at rest", min=0)
    v_e = parameter("m/s", "speed above which the oil thins", above=0)

    def equations(self) -> Stated:
        yield self.f == self.d * self.v_e * ca.asinh(self.v_rel / self.v_e)


class QuadraticDamper(CompliantWithSpeed):
    """Damper with force growing with the square of speed: f = c v_rel |v_rel|."""

    c = parameter("N.s2/m2", "quadratic damping constant", min=0)

    def equations(self) -> Stated:
        yield self.f == self.c * self.v_rel * ca.fabs(self.v_rel)


class BoucWen(CompliantWithSpeed):
    """Hysteretic spring: f = alpha k s_rel + (1 - alpha) k z.

    z' = A v_rel - beta |v_rel| |z|^(n-1) z - gamma v_rel |z|^n, with z [m] the hysteretic displacement.

    Source: Y.-K. Wen, J. Eng. Mech. Div. ASCE 102 (1976) 249-263.
    """

    k = parameter("N/m", "initial stiffness", min=0)
    alpha = parameter("1", "share of stiffness after yield", min=0, max=1, default=0.1)
    A = parameter("1", "scale of the hysteretic displacement", above=0, default=1.0)
    beta = parameter("1/m^n", "loop shape against the motion", min=0)
    gamma = parameter("1/m^n", "loop shape along the motion")
    n = parameter("1", "sharpness of yield", min=1, default=2.0)
    z = variable("m", "hysteretic displacement")

    def equations(self) -> Stated:
        v, z = self.v_rel, self.z
        yield self.f == self.alpha * self.k * self.s_rel + (1 - self.alpha) * self.k * z
        yield der(z) == wen_rate(v, z, self.A, self.beta, self.gamma, self.n)
