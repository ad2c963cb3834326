"""Backlash: elastic flanks that only ever press, and the dead zone of screws and meshes."""

import casadi as ca

from ..contact import clearance_energy, past_clearance
from ..language import Expression, Stated, dissipation, energy, mode, parameter, variable
from ..relaxing_flanks import RelaxingFlanks
from .compliances import CompliantWithSpeed, Dissipative


class ElasticFlanks(Dissipative):
    """What elements with elastic flanks and a backlash b between them have in common.

    Within x = phi_rel - phi_rel0 from -b/2 to b/2 they touch nowhere. `elastic` is the torque of the springs.
    """

    c = parameter("N.m/rad", "stiffness in contact", above=0)
    d = parameter("N.m.s/rad", "damping constant in contact", min=0)
    b = parameter("rad", "total backlash", min=0, default=0.0)
    phi_rel0 = parameter("rad", "angle in the middle of the backlash", default=0.0)
    x = property(lambda self: self.phi_rel - self.phi_rel0)
    elastic = property(
        lambda self: self.c * (ca.fmax(self.x - self.b / 2, 0) + ca.fmin(self.x + self.b / 2, 0))
    )
    potential = energy(lambda self: self.elastic**2 / (2 * self.c))
    lossPower = dissipation(lambda self: (self.tau - self.elastic) * self.w_rel)


class ElastoBacklash(ElasticFlanks):
    """Backlash b between elastic flanks that only ever press.

    With x = phi_rel - phi_rel0 and the spring torque tau_c = c max(|x| - b/2, 0) of the flank in
    contact, tau = sgn(x) max(tau_c + min(tau_c, sgn(x) d w_rel), 0): damping adds at most tau_c as
    the flank is pressed, and takes away at most tau_c as it is released, so tau is continuous.

    Source: MSL Rotational.Components.ElastoBacklash, whose law with b = 0 is the plain spring and
    damper instead.
    """

    def pressed(self, depth: Expression, speed: Expression) -> Expression:
        """Torque of one flank, from how deep and how fast it is pressed."""
        spring = self.c * ca.fmax(depth, 0)
        return ca.fmax(spring + ca.fmin(spring, self.d * speed), 0)

    def equations(self) -> Stated:
        half, w = self.b / 2, self.w_rel
        yield self.tau == self.pressed(self.x - half, w) - self.pressed(-self.x - half, -w)


class ElastoBacklash2(ElasticFlanks):
    """Backlash b between elastic flanks whose damping acts at once: tau = c (x -+ b/2) + d w_rel in contact.

    x = phi_rel - phi_rel0. A flank is in contact beyond -b/2 or b/2 while its torque presses; it touches and
    lets go at events, and tau jumps as it touches. `ElastoBacklash` limits the damping instead.

    Source: MSL Rotational.Components.ElastoBacklash2, whose law with b = 0 is the plain spring and damper.
    """

    mode = mode("free", "forward", "backward", doc="apart, or in contact for x > 0 or x < 0")
    forward = property(lambda self: self.c * (self.x - self.b / 2) + self.d * self.w_rel)
    backward = property(lambda self: self.c * (self.x + self.b / 2) + self.d * self.w_rel)

    def equations(self) -> Stated:
        yield self.tau == self.mode.choose(free=0.0, forward=self.forward, backward=self.backward)

    def transitions(self) -> Stated:
        ahead = ca.fmin(self.c * (self.x - self.b / 2), self.forward)
        behind = ca.fmin(-self.c * (self.x + self.b / 2), -self.backward)
        yield self.mode.goes("free", "forward", when=ahead > 0)
        yield self.mode.goes("forward", "free", when=ahead < 0)
        yield self.mode.goes("free", "backward", when=behind > 0)
        yield self.mode.goes("backward", "free", when=behind < 0)


class RelaxingBacklash(CompliantWithSpeed, RelaxingFlanks):
    """Backlash b in series with a spring and damper without inertia, which relax while they touch nothing.

    With x = phi_rel - phi_rel0 and their stretch z, d z' + c z = p: they press by p = c (x -+ b/2) + d w_rel
    from where x -+ b/2 meets z until they would pull, and by p = 0 between. tau = p + d_0 w_rel, which jumps
    as they meet, since the damper is struck. `ElastoBacklash2` knows no z: what a flank gives comes back at
    once.

    Without backlash it is a `SpringDamper`, without stiffness a damper with play. Where a spring follows it
    without inertia between them, something must fill the backlash (d_0 > 0), or nothing tells where that
    stays.
    """

    c = parameter("N.m/rad", "stiffness in contact", min=0)
    d = parameter("N.m.s/rad", "damping constant in contact", above=0)
    b = parameter("rad", "total backlash", min=0, default=0.0)
    phi_rel0 = parameter("rad", "angle in the middle of the backlash", default=0.0)
    d_0 = parameter("N.m.s/rad", "damping constant of what fills the backlash", min=0, default=0.0)
    z = variable("rad", "stretch of spring and damper")

    @property
    def offset(self) -> Expression:
        return self.phi_rel - self.phi_rel0

    @property
    def speed(self) -> Expression:
        return self.w_rel

    @property
    def stiffness(self) -> Expression:
        return self.c

    @property
    def width(self) -> Expression:
        return self.b

    def equations(self) -> Stated:
        yield self.tau == self.pressing + self.d_0 * self.speed


class Backlash(Dissipative):
    """Spring and damper with clearance: a dead zone of half-width c eps on P + D.

    tau = u - c eps where u = P + D >= c eps, u + c eps where u <= -c eps, else 0, with
    P = c (phi_rel - phi_rel0) and D = d w_rel. So tau is continuous and never opposes u.

    Limits: the damper counts inside the clearance too, as in the translational `Backlash`.

    Source: Ge & Wang on the planetary flywheel inerter (see `machines.ge_wang`), eqs. (20) and (24), written
    for turning.
    """

    c = parameter("N.m/rad", "stiffness", min=0)
    d = parameter("N.m.s/rad", "damping constant", min=0)
    eps = parameter("rad", "half of the clearance", min=0)
    phi_rel0 = parameter("rad", "angle at the middle of the clearance", default=0.0)
    elastic = property(
        lambda self: past_clearance(self.c * (self.phi_rel - self.phi_rel0), self.c * self.eps)
    )
    potential = energy(lambda self: clearance_energy(self.phi_rel - self.phi_rel0, self.c, self.eps))
    lossPower = dissipation(lambda self: (self.tau - self.elastic) * self.w_rel)

    def equations(self) -> Stated:
        contact = self.c * (self.phi_rel - self.phi_rel0) + self.d * self.w_rel
        yield self.tau == past_clearance(contact, self.c * self.eps)
