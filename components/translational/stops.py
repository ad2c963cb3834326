"""Contacts that open: rigid stops with restitution, and elastic ones with a gap."""

import casadi as ca

from ..contact import clearance_energy, past_clearance
from ..language import (
    Component,
    Shock,
    Stated,
    TranslationalFlange,
    der,
    dissipation,
    energy,
    impulse,
    mode,
    parameter,
    variable,
)
from ..limits import limited
from ..lossy import Lossy
from .compliances import Compliant, Dissipative
from .friction import StribeckFriction
from .masses import Mass

REST_SPEED = 1e-12  # [m/s]
LOWEST_REBOUND = 1e-12  # [m]
LEAST_DEPTH = 1e-300  # [m]


class HardStop(Compliant, Lossy):
    """Two flanges that cannot come closer than s_rel = s_min.

    A shock reverses the relative velocity, v_rel+ = -e v_rel-, by the impulse J that this takes.
    Slower than `v_rest` afterwards, or too slow for a rebound of 1e-12 m against what presses them
    together, they stay in contact until they are pulled apart. `lossPower` is zero: shocks take no time, and
    what they lose is told by `run.energy()`.

    Source: I. Newton's law of restitution.
    """

    s_min = parameter("m", "least distance of the flanges", default=0.0)
    e = parameter("1", "coefficient of restitution", min=0, max=1, default=0.0)
    v_rest = parameter("m/s", "rebound speed below which contact is kept", min=0, default=1e-5)
    mode = mode("free", "contact", doc="apart or in contact", in_shock={"contact": "free"})
    J = impulse("N.s", "impulse of a shock, positive when it pushes the flanges apart")
    s_rel = variable("m", "distance of the flanges", state="prefer")
    v_rel = variable("m/s", "relative velocity of the flanges", state="prefer")
    a_rel = variable("m/s2", "relative acceleration of the flanges")
    lossPower = dissipation(lambda self: self.f * self.v_rel)

    def equations(self) -> Stated:
        yield self.v_rel == der(self.s_rel)
        yield self.a_rel == der(self.v_rel)
        yield self.mode.choose(free=self.f + self.J, contact=self.a_rel) == 0

    def transitions(self) -> Stated:
        still = {"v_rel": 0.0}
        closing = self.s_rel < self.s_min
        rebound = -self.e * self.v_rel
        bounce = Shock(self.J, self.v_rel, rebound)
        settle = Shock(self.J, self.v_rel, 0.0)
        pressed = ca.logic_or(self.v_rel < 0, ca.logic_and(self.v_rel < REST_SPEED, self.a_rel < 0))
        low = ca.logic_and(self.a_rel < 0, rebound**2 < -2 * LOWEST_REBOUND * self.a_rel)
        leaves = ca.logic_and(rebound > self.v_rest, ca.logic_not(low))
        rests = ca.logic_and(pressed, ca.logic_not(leaves))
        yield self.mode.goes("free", "free", when=closing, allowed=leaves, shock=bounce)
        yield self.mode.goes("free", "contact", when=closing, allowed=rests, shock=settle, reset=still)
        touching = ca.logic_and(self.s_rel <= self.s_min + LOWEST_REBOUND, ca.fabs(self.v_rel) < REST_SPEED)
        load = ca.if_else(touching, -self.a_rel, -1.0)
        yield self.mode.goes("free", "contact", when=load > 0, reset=still)
        yield self.mode.goes("contact", "free", when=self.f > 0)
        yield self.mode.goes("contact", "free", when=self.v_rel > 0)
        yield self.mode.goes("contact", "free", when=self.v_rel < 0)


class MassWithStopAndFriction(Component):
    """A mass that rubs on a support between two rigid stops (plastic unless `lower.e`, `upper.e`).

    Source: MSL Translational.Components.MassWithStopAndFriction.
    """

    flange = TranslationalFlange("where the mass is joined", free=True)
    support = TranslationalFlange("what it slides on", optional=True)
    m = parameter("kg", "mass", above=0)
    s_min = parameter("m", "lower stop")
    s_max = parameter("m", "upper stop")
    d = parameter("N.s/m", "viscous friction", min=0, default=0.0)
    f_c = parameter("N", "Coulomb friction force", min=0, default=0.0)
    f_s = parameter("N", "static friction force", min=0, default=lambda self: self.f_c)
    v_s = parameter("m/s", "Stribeck velocity", above=0, default=1.0)
    peak = parameter("1", "break-away force over f_s", min=1, default=1.0)
    s = variable("m", "position")
    v = variable("m/s", "velocity")
    a = variable("m/s2", "acceleration")

    mass = Mass(m=m)
    friction = StribeckFriction(f_c=f_c, f_s=f_s, v_s=v_s, d=d, peak=peak)
    lower = HardStop(s_min=s_min)
    upper = HardStop(s_min=lambda self: -self.s_max)

    def equations(self) -> Stated:
        yield self.s == self.mass.s
        yield self.v == self.mass.v
        yield self.a == self.mass.a

    def connections(self) -> Stated:
        yield self.flange, self.mass.flange, self.friction.flange_b, self.lower.flange_b, self.upper.flange_a
        yield self.support, self.friction.flange_a, self.lower.flange_a, self.upper.flange_b


class ElastoGap(Dissipative):
    """Spring and damper that touch only while s_rel < s_rel0.

    f = f_c + f_d with f_c = -k (s_rel0 - s_rel)^n and f_d = min(max(d v_rel, f_c), -f_c); f = 0 apart.
    So 2 f_c <= f <= 0: the contact never pulls, and f is continuous at touch and release.

    Source: MSL Translational.Components.ElastoGap.
    """

    k = parameter("N/m^n", "stiffness", min=0)
    d = parameter("N.s/m", "damping constant", min=0)
    s_rel0 = parameter("m", "distance at which the contact begins", default=0.0)
    n = parameter("1", "exponent of the spring", min=1, default=1.0)
    depth = property(lambda self: ca.fmax(self.s_rel0 - self.s_rel, LEAST_DEPTH))  # x^n has a slope in n
    spring = property(lambda self: -self.k * (self.depth**self.n - LEAST_DEPTH**self.n))
    damping = property(lambda self: limited(self.d * self.v_rel, self.spring, -self.spring))
    potential = energy(lambda self: self.k * self.depth ** (self.n + 1) / (self.n + 1))
    lossPower = dissipation(lambda self: self.damping * self.v_rel)

    def equations(self) -> Stated:
        yield self.f == self.spring + self.damping


class Backlash(Dissipative):
    """Spring and damper with clearance: a dead zone of half-width k eps on P + D.

    f = u - k eps where u = P + D >= k eps, u + k eps where u <= -k eps, else 0, with
    P = k (s_rel - s_rel0) and D = d v_rel. So f is continuous and never opposes u.

    Limits: the damper counts inside the clearance too. Where d |v_rel| > k (eps - |s_rel - s_rel0|),
    f acts before contact, and on fast separation it may pull; `ElastoGap` limits the damping instead.

    Source: Ge & Wang on the planetary flywheel inerter (see `machines.ge_wang`), eqs. (20) and (24).
    """

    k = parameter("N/m", "stiffness", min=0)
    d = parameter("N.s/m", "damping constant", min=0)
    eps = parameter("m", "half of the clearance", min=0)
    s_rel0 = parameter("m", "distance at the middle of the clearance", default=0.0)
    elastic = property(lambda self: past_clearance(self.k * (self.s_rel - self.s_rel0), self.k * self.eps))
    potential = energy(lambda self: clearance_energy(self.s_rel - self.s_rel0, self.k, self.eps))
    lossPower = dissipation(lambda self: (self.f - self.elastic) * self.v_rel)

    def equations(self) -> Stated:
        contact = self.k * (self.s_rel - self.s_rel0) + self.d * self.v_rel
        yield self.f == past_clearance(contact, self.k * self.eps)
