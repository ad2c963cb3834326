"""What acts between two flanges: springs, dampers and the inerter."""

from math import pi

import casadi as ca

from ..hysteresis import HystereticSpring
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
from ..lossy import Lossy


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


class Dissipative(CompliantWithSpeed, Lossy):
    """A compliant element that turns all its work into heat, unless it states otherwise."""

    lossPower = dissipation(lambda self: self.f * self.v_rel)


class Spring(Compliant):
    """Linear spring: f = k (s_rel - s_rel0).

    Source: MSL Translational.Components.Spring.
    """

    k = parameter("N/m", "stiffness", min=0)
    s_rel0 = parameter("m", "unstretched length", default=0.0)
    potential = energy(lambda self: self.k * (self.s_rel - self.s_rel0) ** 2 / 2)

    def equations(self) -> Stated:
        yield self.f == self.k * (self.s_rel - self.s_rel0)


class Damper(Dissipative):
    """Linear damper: f = d v_rel.

    Source: MSL Translational.Components.Damper.
    """

    d = parameter("N.s/m", "damping constant", min=0)

    def equations(self) -> Stated:
        yield self.f == self.d * self.v_rel


class VariableDamper(Dissipative):
    """Damper whose constant follows a signal: f = (d + d_u u + d_uu u^2) v_rel.

    u is what it depends on: the current of a valve or a coil, a temperature, time. A constant below 0 stands
    for what is taken from damping that is there.
    """

    u = RealInput("1", "what the damping follows")
    d = parameter("N.s/m", "damping constant at u = 0", default=0.0)
    d_u = parameter("N.s/m", "change of the damping constant with u")
    d_uu = parameter("N.s/m", "change of it with the square of u", default=0.0)

    def equations(self) -> Stated:
        yield self.f == (self.d + self.d_u * self.u + self.d_uu * self.u**2) * self.v_rel


class SpringDamper(Dissipative):
    """Linear spring and damper in parallel: f = k (s_rel - s_rel0) + d v_rel.

    Source: MSL Translational.Components.SpringDamper.
    """

    k = parameter("N/m", "stiffness", min=0)
    d = parameter("N.s/m", "damping constant", min=0)
    s_rel0 = parameter("m", "unstretched length", default=0.0)
    potential = energy(lambda self: self.k * (self.s_rel - self.s_rel0) ** 2 / 2)
    lossPower = dissipation(lambda self: self.d * self.v_rel**2)

    def equations(self) -> Stated:
        yield self.f == self.k * (self.s_rel - self.s_rel0) + self.d * self.v_rel


class Inerter(CompliantWithSpeed):
    """Ideal inerter: f = b a_rel, force proportional to relative acceleration.

    Source: M. C. Smith, IEEE Trans. Automat. Contr. 47 (2002) 1648-1662, eq. (4).
    """

    b = parameter("kg", "inertance", min=0)
    a_rel = variable("m/s2", "relative acceleration of the flanges")
    kinetic = energy(lambda self: self.b * self.v_rel**2 / 2)

    def equations(self) -> Stated:
        yield self.a_rel == der(self.v_rel)
        yield self.f == self.b * self.a_rel


class CubicSpring(Compliant):
    """Spring with a cubic and a quadratic term: f = k e + k2 e^2 + k3 e^3 with e = s_rel - s_rel0.

    The quadratic term makes pull and push differ, as where a spring that hardens is preloaded.

    Source: G. Duffing, Erzwungene Schwingungen bei veraenderlicher Eigenfrequenz (1918).
    """

    k = parameter("N/m", "linear stiffness", min=0)
    k3 = parameter("N/m3", "cubic stiffness; negative softens")
    s_rel0 = parameter("m", "unstretched length", default=0.0)
    k2 = parameter("N/m2", "quadratic stiffness: stiffer when pulled, softer when pushed", default=0.0)
    e = property(lambda self: self.s_rel - self.s_rel0)
    potential = energy(lambda self: self.e**2 * (self.k / 2 + self.k2 * self.e / 3 + self.k3 * self.e**2 / 4))

    def equations(self) -> Stated:
        yield self.f == self.k * self.e + self.k2 * self.e**2 + self.k3 * self.e**3


class BilinearSpring(Compliant):
    """Spring that is stiffer one way: f = k_pull e for e > 0 and k_push e for e < 0.

    e = s_rel - s_rel0.
    """

    k_pull = parameter("N/m", "stiffness when pulled", min=0)
    k_push = parameter("N/m", "stiffness when pushed", min=0)
    s_rel0 = parameter("m", "unstretched length", default=0.0)
    pull = property(lambda self: ca.fmax(self.s_rel - self.s_rel0, 0))
    push = property(lambda self: ca.fmin(self.s_rel - self.s_rel0, 0))
    potential = energy(lambda self: self.k_pull * self.pull**2 / 2 + self.k_push * self.push**2 / 2)

    def equations(self) -> Stated:
        yield self.f == self.k_pull * self.pull + self.k_push * self.push


class Ripple(Compliant):
    """Force that comes back with every period of travel: f = f_sin sin(2 pi s_rel/period) + f_cos cos(...).

    The thread of a screw, the poles of a motor, the teeth of a rack.
    """

    f_sin = parameter("N", "amplitude of the sine")
    f_cos = parameter("N", "amplitude of the cosine", default=0.0)
    period = parameter("m", "travel after which the force comes back", above=0)
    waves = property(lambda self: 2 * pi / self.period)
    angle = property(lambda self: self.waves * self.s_rel)
    wave = property(lambda self: self.f_sin * (1 - ca.cos(self.angle)) + self.f_cos * ca.sin(self.angle))
    potential = energy(lambda self: self.wave / self.waves)

    def equations(self) -> Stated:
        yield self.f == self.f_sin * ca.sin(self.angle) + self.f_cos * ca.cos(self.angle)


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

    @property
    def harmonics(self) -> list[tuple[int, Expression, Expression, Expression]]:
        """Order, angle, and amplitudes of sine and cosine of each."""
        x = 2 * pi * self.s_rel / self.period
        amplitudes = (
            (self.f_sin, self.f_cos),
            (self.f_sin_2, self.f_cos_2),
            (self.f_sin_3, self.f_cos_3),
        )
        return [(h, h * x, *pair) for h, pair in enumerate(amplitudes, 1)]

    @property
    def store(self) -> Expression:
        """Energy stored."""
        waves = sum((s * (1 - ca.cos(x)) + c * ca.sin(x)) / h for h, x, s, c in self.harmonics)
        return waves * self.period / (2 * pi)

    potential = energy(lambda self: self.store)

    def equations(self) -> Stated:
        yield self.f == sum(s * ca.sin(x) + c * ca.cos(x) for _, x, s, c in self.harmonics)


class CubicDamper(Dissipative):
    """Damper with force growing with the cube of speed: f = d3 v_rel^3.

    Source: A. H. Nayfeh, D. T. Mook, Nonlinear Oscillations (1979).
    """

    d3 = parameter("N.s3/m3", "cubic damping constant", min=0)

    def equations(self) -> Stated:
        yield self.f == self.d3 * self.v_rel**3


class ShearThinningDamper(Dissipative):
    """Damper whose oil thins where it is sheared fast: f = d v_e asinh(v_rel/v_e).

    Viscous at speeds far below v_e; from there on it grows with the logarithm of the speed.

    Source: H. Eyring, J. Chem. Phys. 4 (1936) 283-291.
    """

    d = parameter("N.s/m", "damping constant at rest", min=0)
    v_e = parameter("m/s", "speed above which the oil thins", above=0)

    def equations(self) -> Stated:
        yield self.f == self.d * self.v_e * ca.asinh(self.v_rel / self.v_e)


class QuadraticDamper(Dissipative):
    """Damper with force growing with the square of speed: f = c v_rel |v_rel|."""

    c = parameter("N.s2/m2", "quadratic damping constant", min=0)

    def equations(self) -> Stated:
        yield self.f == self.c * self.v_rel * ca.fabs(self.v_rel)


class BoucWen(CompliantWithSpeed, HystereticSpring):
    """Hysteretic spring: f = alpha k s_rel + (1 - alpha) k z.

    z' = A v_rel - beta |v_rel| |z|^(n-1) z - gamma v_rel |z|^n, with z [m] the hysteretic displacement.

    Source: Y.-K. Wen, J. Eng. Mech. Div. ASCE 102 (1976) 249-263.
    """

    k = parameter("N/m", "initial stiffness", min=0)
    beta = parameter("1/m^n", "loop shape against the motion", min=0)
    gamma = parameter("1/m^n", "loop shape along the motion")
    z = variable("m", "hysteretic displacement")

    @property
    def stretch(self) -> Expression:
        return self.s_rel

    @property
    def speed(self) -> Expression:
        return self.v_rel

    @property
    def stiffness(self) -> Expression:
        return self.k

    def equations(self) -> Stated:
        yield self.f == self.restoring
