"""A landing gear that drops: an oleo strut between airframe and wheel, a tyre on the ground."""

from __future__ import annotations

import casadi as ca

from ...base import above, at_least, between, demand
from ...components import (
    ConstantForce,
    Dissipative,
    ElastoGap,
    Fixed,
    HardStop,
    Mass,
    dissipation,
    energy,
    gas_energy,
    gas_pressure,
)
from ...components.language import Component, Stated, parameter
from ..network import Network

GRAVITY = 9.80665  # [m/s2]


class OleoStrut(Dissipative):
    """Oleo-pneumatic shock strut: a gas spring, and oil pressed through an orifice.

        f = -p_0 A_a (V_0/(V_0 - A_a s))^n - rho A_h^3/(2 (C_d A_o)^2) der(s) |der(s)|,   s = s_rel0 - s_rel

    `flange_a` is the wheel's end. What keeps it from drawing out beyond s_rel0 is a stop beside it.

    Limits: no bearing friction, no cavitation; the orifice alike both ways. s stays below V_0/A_a.

    Source: Milwitzky & Cook, Analysis of landing-gear behavior, NACA Report 1154 (1953).
    """

    A_a = parameter("m2", "pneumatic area", above=0)
    A_h = parameter("m2", "hydraulic area", above=0)
    A_o = parameter("m2", "area of the orifice", above=0)
    p_0 = parameter("Pa", "gas pressure when fully drawn out", above=0)
    V_0 = parameter("m3", "gas volume when fully drawn out", above=0)
    n = parameter("1", "polytropic exponent of the gas", min=1)
    C_d = parameter("1", "coefficient of discharge", above=0)
    rho = parameter("kg/m3", "density of the oil", above=0)
    s_rel0 = parameter("m", "length when fully drawn out", default=0.0)
    V = property(lambda self: self.V_0 + self.A_a * (self.s_rel - self.s_rel0))
    resistance = property(lambda self: self.rho * self.A_h**3 / (2 * (self.C_d * self.A_o) ** 2))
    oil = property(lambda self: self.resistance * self.v_rel * ca.fabs(self.v_rel))
    potential = energy(lambda self: gas_energy(self.V, self.p_0, self.V_0, self.n))
    lossPower = dissipation(lambda self: self.oil * self.v_rel)

    def equations(self) -> Stated:
        gas = self.A_a * gas_pressure(self.V, self.p_0, self.V_0, self.n)
        yield self.f == self.oil - gas


def landing_gear(
    strut: Component,
    *,
    L: float,
    m: float = 1000.0,
    m_w: float = 20.0,
    k_t: float = 300e3,
    d_t: float = 500.0,
    n_t: float = 1.0,
    sink: float = 3.0,
    lift: float = 1.0,
) -> Network:
    """Return a drop on one gear, from the touch of the tyre: `ground`, `tyre`, `wheel`, `strut`, `airframe`.

    `stop` ends the strut where it is fully drawn out, `weight` and `wheel_weight` are gravity less lift;
    `ground.flange.f` is the load on the ground.

    Args:
        strut: from the wheel (`flange_a`) to the airframe, such as `OleoStrut(s_rel0=L, ...)`.
        L: its length when fully drawn out, an `OleoStrut`'s s_rel0 [m].
        m: mass of the airframe on this gear [kg].
        m_w: mass of the wheel and what moves with it [kg].
        k_t: stiffness of the tyre [N/m^n_t].
        d_t: its damping constant [N.s/m].
        n_t: its exponent.
        sink: speed at touch-down [m/s].
        lift: of the wings over the weight; 1 as at touch-down, 0 for a free drop.
    """
    demand(
        "landing_gear()",
        L=(L, above(0, "m")),
        m=(m, above(0, "kg")),
        m_w=(m_w, above(0, "kg")),
        sink=(sink, at_least(0, "m/s")),
        lift=(lift, between(0, 1)),
    )
    gear = Network(
        "landing gear",
        ground=Fixed(),
        tyre=ElastoGap(k=k_t, d=d_t, n=n_t),
        wheel=Mass(m=m_w, s=0.0, v=-sink),
        strut=strut,
        stop=HardStop(s_min=-L),
        airframe=Mass(m=m, s=L, v=-sink),
        weight=ConstantForce(f_constant=(lift * (m + m_w) - m) * GRAVITY),
        wheel_weight=ConstantForce(f_constant=-m_w * GRAVITY),
    )
    gear.connect(gear.ground.flange, gear.tyre.flange_a)
    gear.connect(
        gear.tyre.flange_b,
        gear.wheel.flange,
        gear.strut.flange_a,
        gear.stop.flange_b,
        gear.wheel_weight.flange,
    )
    return gear.connect(gear.strut.flange_b, gear.airframe.flange, gear.stop.flange_a, gear.weight.flange)
