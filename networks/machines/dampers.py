"""Dampers and stops as they are built: two slopes, a slope that falls, a bump stop that stiffens."""

import casadi as ca

from ...components import Compliant, Dissipative, Stated, energy, parameter


class BilinearDamper(Dissipative):
    """Damper with different slopes in bump and rebound: f = d_r v_rel apart, d_c v_rel together.

    Source: J. C. Dixon, The Shock Absorber Handbook, 2nd ed. (2007), section 7.6.
    """

    d_c = parameter("N.s/m", "damping constant in compression", min=0)
    d_r = parameter("N.s/m", "damping constant in rebound", min=0)

    def equations(self) -> Stated:
        yield self.f == self.d_r * ca.fmax(self.v_rel, 0.0) + self.d_c * ca.fmin(self.v_rel, 0.0)


class DigressiveDamper(Dissipative):
    """Damper whose slope falls from d to d_h as its valves open: f = d_h v + (d - d_h) v/(1 + |v|/v_k).

    Limits: alike in bump and rebound.

    Source: the shape of measured dampers, J. C. Dixon, The Shock Absorber Handbook, 2nd ed. (2007), ch. 7.
    """

    d = parameter("N.s/m", "damping constant at rest", min=0)
    d_h = parameter("N.s/m", "damping constant at high speed", min=0)
    v_k = parameter("m/s", "speed of the knee", above=0)

    def equations(self) -> Stated:
        v = self.v_rel
        yield self.f == self.d_h * v + (self.d - self.d_h) * v / (1 + ca.fabs(v) / self.v_k)


class BumpStop(Compliant):
    """Elastic stops at both ends of a travel: f = k e + k3 e^3, e how far s_rel is past s_min or s_max.

    It is zero between them, and smooth where it begins but for its slope.
    """

    k = parameter("N/m", "stiffness at touch", min=0)
    k3 = parameter("N/m3", "stiffening", min=0, default=0.0)
    s_min = parameter("m", "distance at which it is compressed")
    s_max = parameter("m", "distance at which it is drawn out")
    e = property(lambda self: ca.fmax(self.s_rel - self.s_max, 0.0) + ca.fmin(self.s_rel - self.s_min, 0.0))
    potential = energy(lambda self: self.k * self.e**2 / 2 + self.k3 * self.e**4 / 4)

    def equations(self) -> Stated:
        yield self.f == self.k * self.e + self.k3 * self.e**3
