"""A hydraulically interconnected suspension: soft in heave, stiff and damped in roll."""

from __future__ import annotations

from ...base import above, demand
from ...components import (
    Component,
    Expression,
    Lossy,
    SpringDamper,
    TranslationalFlange,
    dissipation,
    energy,
    gas_energy,
    gas_pressure,
    parameter,
    variable,
)
from ...components.language import Stated, der
from ..network import Network
from .vehicles import PitchingBody, add_corner


class InterconnectedStruts(Lossy):
    """Two double-acting cylinders joined crosswise by two lines, each with a gas accumulator behind a valve.

        V_1 = A_r e_right - A_b e_left,   p_1 = p_0 (V_0/(V_0 - V_1))^n + R der(V_1),   line 2 the other way
        about, f_left = A_r (p_2 - p_0) - A_b (p_1 - p_0),   e = s_b - s_a - s_rel0 of a strut

    V is what has been pressed into an accumulator. Both struts compressed by e displace (A_b - A_r) e a
    line, in roll (A_b + A_r) e: so stiffness and damping in roll are ((A_b + A_r)/(A_b - A_r))^2 those in
    heave. Forces count from rest, where the struts carry (A_b - A_r) p_0 each.

    Limits: fluid without inertia or compressibility, lines without loss but that of the valves.

    Source: the arrangement of N. Zhang, W. A. Smith et al., Hydraulically interconnected vehicle suspension:
    background and modelling, Vehicle System Dynamics 48 (2010), without the fluid's inertia.
    """

    left_a = TranslationalFlange("left cylinder, on the wheel")
    left_b = TranslationalFlange("left rod, on the body")
    right_a = TranslationalFlange("right cylinder, on the wheel")
    right_b = TranslationalFlange("right rod, on the body")
    A_b = parameter("m2", "area of the piston on the bore side", above=0)
    A_r = parameter("m2", "area of the piston on the rod side", above=0)
    p_0 = parameter("Pa", "gas pressure at rest", above=0)
    V_0 = parameter("m3", "gas volume of an accumulator at rest", above=0)
    n = parameter("1", "polytropic exponent of the gas", min=1, default=1.4)
    R = parameter("Pa.s/m3", "resistance of a valve", min=0)
    s_rel0 = parameter("m", "length of a strut at rest", default=0.0)
    V_1 = variable("m3", "fluid in the accumulator of line 1")
    V_2 = variable("m3", "fluid in the accumulator of line 2")
    q_1 = variable("m3/s", "flow into it")
    q_2 = variable("m3/s", "flow into it")
    p_1 = variable("Pa", "pressure in line 1: left bore and right rod side", nominal=1e6)
    p_2 = variable("Pa", "pressure in line 2: right bore and left rod side", nominal=1e6)
    potential = energy(lambda self: self.stored(self.V_1) + self.stored(self.V_2))
    lossPower = dissipation(lambda self: self.R * (self.q_1**2 + self.q_2**2))

    def stored(self, pressed: Expression) -> Expression:
        """Return what an accumulator stores beyond what p_0 puts in."""
        return gas_energy(self.V_0 - pressed, self.p_0, self.V_0, self.n) - self.p_0 * pressed

    def pressure(self, pressed: Expression) -> Expression:
        """Return the gas pressure of an accumulator."""
        return gas_pressure(self.V_0 - pressed, self.p_0, self.V_0, self.n)

    def equations(self) -> Stated:
        left = self.left_b.s - self.left_a.s - self.s_rel0
        right = self.right_b.s - self.right_a.s - self.s_rel0
        yield self.A_r * right - self.A_b * left == self.V_1
        yield self.A_r * left - self.A_b * right == self.V_2
        yield self.q_1 == der(self.V_1)
        yield self.q_2 == der(self.V_2)
        yield self.p_1 == self.pressure(self.V_1) + self.R * self.q_1
        yield self.p_2 == self.pressure(self.V_2) + self.R * self.q_2
        over_1, over_2 = self.p_1 - self.p_0, self.p_2 - self.p_0
        yield self.left_b.f == self.A_r * over_2 - self.A_b * over_1
        yield self.right_b.f == self.A_r * over_1 - self.A_b * over_2
        yield self.left_a.f == -self.left_b.f
        yield self.right_a.f == -self.right_b.f


def interconnected_car(
    struts: Component,
    *,
    m: float = 700.0,
    J: float = 230.0,
    w: float = 1.5,
    k: float = 15e3,
    d: float = 800.0,
    m_u: float = 40.0,
    k_t: float = 200e3,
) -> Network:
    """Return one axle and its half of a body, seen from behind: `left_road`, ..., `right`, `struts`, `body`.

    `body.theta` is roll, positive when the right side is up.

    Args:
        struts: what joins both sides, with flanges `left_a`, `left_b`, `right_a`, `right_b`, such as
            `InterconnectedStruts(...)`.
        m: mass of the body on this axle [kg].
        J: its moment of inertia in roll [kg.m2].
        w: track [m].
        k: stiffness of the spring beside each strut [N/m].
        d: damping constant beside each strut [N.s/m].
        m_u: mass of each wheel [kg].
        k_t: stiffness of each tyre [N/m].
    """
    demand("interconnected_car()", w=(w, above(0, "m")))
    car = Network("interconnected car", body=PitchingBody(m=m, J=J, l_f=w / 2, l_r=w / 2), struts=struts)
    for side, corner in (("left", car.body.front), ("right", car.body.rear)):
        add_corner(car, side, SpringDamper(k=k, d=d), corner, m_u, k_t)
    for flange, node in (
        (car.struts.left_a, car.left_wheel.flange),
        (car.struts.left_b, car.body.front),
        (car.struts.right_a, car.right_wheel.flange),
        (car.struts.right_b, car.body.rear),
    ):
        car.connect(flange, node)
    return car
