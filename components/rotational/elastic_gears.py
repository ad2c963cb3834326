"""Gears that give way: harmonic drives, belts and chains."""

import casadi as ca

from ..language import Expression, RotationalFlange, Stated, der, dissipation, energy, parameter, variable
from ..limits import limited
from ..lossy import Lossy


class HarmonicDrive(Lossy):
    """Harmonic drive: its flexspline turns back once for `ratio` turns of the wave generator, and winds up.

    tau = c x + c3 x^3 + d x' with the twist x = -phi_a/ratio + e(phi_a) - phi_b, angles against the circular
    spline, and a kinematic error e = e_1 sin(2 phi_a + phase), two waves a turn. flange_b.tau = -tau and
    flange_a.tau = tau dx/dphi_a. Put friction beside it, on the wave generator.

    Source: T. D. Tuttle, W. P. Seering, A nonlinear model of a harmonic drive gear transmission, IEEE Trans.
    Robot. Autom. 12 (1996) 368-374.
    """

    flange_a = RotationalFlange("wave generator")
    flange_b = RotationalFlange("flexspline")
    support = RotationalFlange("circular spline", optional=True)
    ratio = parameter("1", "turns of the wave generator for one of the flexspline", above=0)
    c = parameter("N.m/rad", "stiffness of the flexspline", above=0)
    c3 = parameter("N.m/rad3", "its stiffening", min=0, default=0.0)
    d = parameter("N.m.s/rad", "damping constant", min=0, default=0.0)
    e_1 = parameter("rad", "amplitude of the kinematic error, at the flexspline", min=0, default=0.0)
    phase = parameter("rad", "phase of the kinematic error", default=0.0)
    x = variable("rad", "twist of the flexspline", state="avoid")
    w_rel = variable("rad/s", "its rate", state="avoid")
    potential = energy(lambda self: self.c * self.x**2 / 2 + self.c3 * self.x**4 / 4)
    lossPower = dissipation(lambda self: self.d * self.w_rel**2)

    def equations(self) -> Stated:
        a, b, spline = self.flange_a, self.flange_b, self.support
        wave = 2 * (a.phi - spline.phi) + self.phase
        tau = self.c * self.x + self.c3 * self.x**3 + self.d * self.w_rel
        yield self.x == -(a.phi - spline.phi) / self.ratio + self.e_1 * ca.sin(wave) - (b.phi - spline.phi)
        yield self.w_rel == der(self.x)
        yield b.tau == -tau
        yield a.tau == tau * (2 * self.e_1 * ca.cos(wave) - 1 / self.ratio)
        yield spline.tau == -(a.tau + b.tau)


class BeltDrive(Lossy):
    """Belt or chain over two pulleys, whose strands pull and never push.

    A strand stretched by e + e_0 pulls with k (e + e_0), and damps with d e', never more than it pulls; one
    with e + e_0 < 0 is slack. e = r_a phi_a - r_b phi_b in one strand and -e in the other. e_0 > 0 is a belt
    put up with tension, e_0 < 0 a chain that hangs slack. flange_a.tau = r_a (f_1 - f_2), flange_b.tau =
    -r_b (f_1 - f_2).

    Limits: no slip on the pulleys, no mass.
    """

    flange_a = RotationalFlange("pulley a")
    flange_b = RotationalFlange("pulley b")
    support = RotationalFlange("what carries the pulleys", optional=True)
    r_a = parameter("m", "radius of pulley a", above=0)
    r_b = parameter("m", "radius of pulley b", above=0)
    k = parameter("N/m", "stiffness of a strand", above=0)
    d = parameter("N.s/m", "damping constant of a strand", min=0, default=0.0)
    e_0 = parameter("m", "stretch of the strands at rest; negative: slack", default=0.0)
    e = variable("m", "stretch that turning adds to a strand", state="avoid")
    v = variable("m/s", "its rate", state="avoid")
    f_1 = variable("N", "force of the strand that pulls as a drives forward")
    f_2 = variable("N", "force of the other strand")

    @property
    def springs(self) -> list[Expression]:
        """Elastic forces of the strands."""
        return [self.k * ca.fmax(self.e_0 + e, 0) for e in (self.e, -self.e)]

    @property
    def damping(self) -> list[Expression]:
        """What each strand damps with."""
        speeds = self.v, -self.v
        return [limited(self.d * v, -f, f) for v, f in zip(speeds, self.springs, strict=True)]

    potential = energy(lambda self: sum(f**2 for f in self.springs) / (2 * self.k))
    lossPower = dissipation(lambda self: (self.damping[0] - self.damping[1]) * self.v)

    def equations(self) -> Stated:
        a, b, axes = self.flange_a, self.flange_b, self.support
        yield self.e == self.r_a * (a.phi - axes.phi) - self.r_b * (b.phi - axes.phi)
        yield self.v == der(self.e)
        yield self.f_1 == self.springs[0] + self.damping[0]
        yield self.f_2 == self.springs[1] + self.damping[1]
        yield a.tau == self.r_a * (self.f_1 - self.f_2)
        yield b.tau == -self.r_b * (self.f_1 - self.f_2)
        yield axes.tau == -(a.tau + b.tau)
