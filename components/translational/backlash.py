"""Backlash of which the flanks only ever press: at once, or relaxing between."""

import casadi as ca

from ..language import Expression, Stated, dissipation, energy, parameter, variable
from ..relaxing_flanks import RelaxingFlanks
from .compliances import CompliantWithSpeed, Dissipative


class ElastoBacklash(Dissipative):
    """Backlash b between elastic flanks that only ever press, as `rotational.ElastoBacklash`.

    With x = s_rel - s_rel0 and the spring force f_c = k max(|x| - b/2, 0) of the flank in contact,
    f = sgn(x) max(f_c + min(f_c, sgn(x) d v_rel), 0): damping adds at most f_c as the flank is pressed,
    and takes away at most f_c as it is released, so f is continuous.

    Source: MSL Rotational.Components.ElastoBacklash, written for sliding.
    """

    k = parameter("N/m", "stiffness in contact", above=0)
    d = parameter("N.s/m", "damping constant in contact", min=0)
    b = parameter("m", "total backlash", min=0, default=0.0)
    s_rel0 = parameter("m", "distance in the middle of the backlash", default=0.0)
    x = property(lambda self: self.s_rel - self.s_rel0)
    elastic = property(
        lambda self: self.k * (ca.fmax(self.x - self.b / 2, 0) + ca.fmin(self.x + self.b / 2, 0))
    )
    potential = energy(lambda self: self.elastic**2 / (2 * self.k))
    lossPower = dissipation(lambda self: (self.f - self.elastic) * self.v_rel)

    def pressed(self, depth: Expression, speed: Expression) -> Expression:
        """Force of one flank, from how deep and how fast it is pressed."""
        spring = self.k * ca.fmax(depth, 0)
        return ca.fmax(spring + ca.fmin(spring, self.d * speed), 0)

    def equations(self) -> Stated:
        half, v = self.b / 2, self.v_rel
        yield self.f == self.pressed(self.x - half, v) - self.pressed(-self.x - half, -v)


class RelaxingBacklash(CompliantWithSpeed, RelaxingFlanks):
    """Backlash b in series with a spring and damper without mass, which relax while they touch nothing.

    With x = s_rel - s_rel0 and their stretch z, d z' + k z = p: they press by p = k (x -+ b/2) + d v_rel from
    where x -+ b/2 meets z until they would pull, and by p = 0 between. f = p + d_0 v_rel, which jumps as they
    meet, since the damper is struck. `ElastoBacklash` knows no z: what a flank gives comes back at once.

    Without backlash it is a `SpringDamper`, without stiffness a damper with play. Where a spring follows it
    without mass between them, something must fill the backlash (d_0 > 0), or nothing tells where that stays.
    """

    k = parameter("N/m", "stiffness in contact", min=0)
    d = parameter("N.s/m", "damping constant in contact", above=0)
    b = parameter("m", "total backlash", min=0, default=0.0)
    s_rel0 = parameter("m", "distance in the middle of the backlash", default=0.0)
    d_0 = parameter("N.s/m", "damping constant of what fills the backlash", min=0, default=0.0)
    z = variable("m", "stretch of spring and damper")

    @property
    def offset(self) -> Expression:
        return self.s_rel - self.s_rel0

    @property
    def speed(self) -> Expression:
        return self.v_rel

    @property
    def stiffness(self) -> Expression:
        return self.k

    @property
    def width(self) -> Expression:
        return self.b

    def equations(self) -> Stated:
        yield self.f == self.pressing + self.d_0 * self.speed
