"""Contacts that open: springs and dampers with a gap."""

import casadi as ca

from ..contact import past_clearance
from ..language import Stated, parameter
from .bases import CompliantWithSpeed

TOUCH = 1e-300  # m


class ElastoGap(CompliantWithSpeed):
    """Spring and damper that touch only while s_rel < s_rel0.

    f = f_c + f_d with f_c = -k (s_rel0 - s_rel)^n and f_d = min(max(d v_rel, f_c), -f_c); f = 0 apart.
    So 2 f_c <= f <= 0: the contact never pulls, and f is continuous at touch and release.

    Source: MSL Translational.Components.ElastoGap.
    """

    k = parameter("N/m^n", "stiffness", min=0)
    d = parameter("N.s/m", "damping constant", min=0)
    s_rel0 = parameter("m", "distance at which the contact begins", default=0.0)
    n = parameter("1", "exponent of the spring", min=1, default=1.0)

    def equations(self) -> Stated:
        pressed = ca.fmax(self.s_rel0 - self.s_rel, TOUCH)  # above 0, where x^n has a slope in n
        spring = -self.k * (pressed**self.n - TOUCH**self.n)
        damping = ca.fmin(ca.fmax(self.d * self.v_rel, spring), -spring)
        yield self.f == spring + damping


class Backlash(CompliantWithSpeed):
    """Spring and damper with clearance: a dead zone of half-width k eps on P + D.

    f = u - k eps where u = P + D >= k eps, u + k eps where u <= -k eps, else 0, with
    P = k (s_rel - s_rel0) and D = d v_rel. So f is continuous and never opposes u.

    Limits: the damper counts inside the clearance too. Where d |v_rel| > k (eps - |s_rel - s_rel0|),
    f acts before contact, and on fast separation it may pull; `ElastoGap` limits the damping instead.

    Source: Ge & Wang, Modeling, Testing, and Characteristic Analysis of a Planetary Flywheel Inerter,
    eqs. (20) and (24).
    """

    k = parameter("N/m", "stiffness", min=0)
    d = parameter("N.s/m", "damping constant", min=0)
    eps = parameter("m", "half of the clearance", min=0)
    s_rel0 = parameter("m", "distance at the middle of the clearance", default=0.0)

    def equations(self) -> Stated:
        contact = self.k * (self.s_rel - self.s_rel0) + self.d * self.v_rel
        yield self.f == past_clearance(contact, self.k * self.eps)
