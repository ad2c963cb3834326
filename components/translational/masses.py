"""What is rigid: ground, rod, mass and levers."""

import casadi as ca

from ..language import Component, Stated, TranslationalFlange, der, energy, parameter, variable


class Fixed(Component):
    """A flange held at a constant position: s = s0.

    Source: MSL Translational.Components.Fixed.
    """

    has_law = False
    flange = TranslationalFlange("held flange")
    s0 = parameter("m", "position", default=0.0)

    def equations(self) -> Stated:
        yield self.flange.s == self.s0


class Rod(Component):
    """A rigid rod without mass: flange_b.s = flange_a.s + L.

    Source: MSL Translational.Components.Rod.
    """

    has_law = False
    flange_a = TranslationalFlange("left flange", free=True)
    flange_b = TranslationalFlange("right flange", free=True)
    L = parameter("m", "length from flange_a to flange_b", default=0.0)

    def equations(self) -> Stated:
        yield self.flange_b.s == self.flange_a.s + self.L
        yield self.flange_a.f == -self.flange_b.f


class Mass(Component):
    """A sliding mass: m a = f, v = der(s), a = der(v).

    Source: MSL Translational.Components.Mass; a body with length is a `MassWithLength`.
    """

    flange = TranslationalFlange("where it is joined", free=True)
    m = parameter("kg", "mass", above=0)
    s = variable("m", "position")
    v = variable("m/s", "velocity")
    a = variable("m/s2", "acceleration")
    kinetic = energy(lambda self: self.m * self.v**2 / 2)

    def equations(self) -> Stated:
        yield self.flange.s == self.s
        yield self.v == der(self.s)
        yield self.a == der(self.v)
        yield self.m * self.a == self.flange.f


class _Levered(Component):
    flange_a = TranslationalFlange("end of arm a")
    flange_b = TranslationalFlange("end of arm b")
    support = TranslationalFlange("fulcrum", optional=True)

    def equations(self) -> Stated:
        yield self.support.f == -(self.flange_a.f + self.flange_b.f)


class Lever(_Levered):
    """Lever at small angles: s_a = ratio s_b, ratio f_a + f_b = 0, s_a and s_b from the fulcrum.

    The ratio is arm a over arm b, negative when the fulcrum lies between the flanges.
    """

    ratio = parameter("1", "motion of flange_a over motion of flange_b")

    def equations(self) -> Stated:
        s_a, s_b = self.flange_a.s - self.support.s, self.flange_b.s - self.support.s
        yield s_a == self.ratio * s_b
        yield self.ratio * self.flange_a.f + self.flange_b.f == 0


class LargeAngleLever(_Levered):
    """Lever at any angle: s_a = l_a sin(phi), s_b = l_b sin(phi + alpha), both from the fulcrum.

    l_a cos(phi) f_a + l_b cos(phi + alpha) f_b = 0: power is conserved. The ends slide on parallel
    guides; alpha = pi is a straight lever with the fulcrum between, alpha = 0 one with both arms on
    one side, anything else a bent one.

    Limits: where an arm lies along its guide, phi or phi + alpha = pi/2, is a dead centre: its flange
    moves no more whatever the lever does.
    """

    l_a = parameter("m", "length of arm a", above=0)
    l_b = parameter("m", "length of arm b", above=0)
    alpha = parameter("rad", "angle from arm a to arm b", default=ca.pi)
    phi = variable("rad", "angle of arm a", state="prefer")
    w = variable("rad/s", "angular velocity", state="prefer")

    def equations(self) -> Stated:
        angle_b = self.phi + self.alpha
        yield self.w == der(self.phi)
        yield self.flange_a.s - self.support.s == self.l_a * ca.sin(self.phi)
        yield self.flange_b.s - self.support.s == self.l_b * ca.sin(angle_b)
        moment_a = self.l_a * ca.cos(self.phi) * self.flange_a.f
        yield moment_a + self.l_b * ca.cos(angle_b) * self.flange_b.f == 0
