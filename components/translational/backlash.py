"""Backlash of which the flanks only ever press."""

import casadi as ca

from ..language import Expression, Stated, dissipation, energy, parameter
from .compliances import Dissipative


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
