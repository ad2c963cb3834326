"""Air springs and gas-charged dampers."""

import casadi as ca

from ..gases import ATMOSPHERE, gas_energy, gas_pressure
from ..language import Stated, der, dissipation, energy, parameter, variable
from .compliances import Compliant, Dissipative


class AirSpring(Compliant):
    """Closed volume of gas behind a piston or bellows: f = -A (p - p_amb), p = p_0 (V_0/V)^n.

    V = V_0 + A (s_rel - s_rel0). n is 1 for slow motion, 1.4 for air that exchanges no heat.

    Limits: the area is constant, and the motion must leave a volume.

    Source: J. C. Dixon, The Shock Absorber Handbook, 2nd ed. (2007).
    """

    A = parameter("m2", "effective area", above=0)
    p_0 = parameter("Pa", "pressure at s_rel0, absolute", above=0)
    V_0 = parameter("m3", "volume at s_rel0", above=0)
    n = parameter("1", "polytropic exponent", min=1, default=1.4)
    p_amb = parameter("Pa", "pressure outside", min=0, default=ATMOSPHERE)
    s_rel0 = parameter("m", "distance at which the pressure is p_0", default=0.0)
    p = variable("Pa", "pressure, absolute", nominal=1e5)
    e = property(lambda self: self.s_rel - self.s_rel0)
    V = property(lambda self: self.V_0 + self.A * self.e)
    gas = property(lambda self: gas_energy(self.V, self.p_0, self.V_0, self.n))
    potential = energy(lambda self: self.gas + self.p_amb * self.A * self.e)

    def equations(self) -> Stated:
        yield self.p == gas_pressure(self.V, self.p_0, self.V_0, self.n)
        yield self.f == -self.A * (self.p - self.p_amb)


class MonotubeDamper(Dissipative):
    """Gas-charged hydraulic damper: oil is pressed through a piston, and a gas takes up the rod's volume.

    f = A_r p_r - A_p p_g + (A_p - A_r) p_amb, with e = s_rel - s_rel0 and the oil's compression q:

        q' = A_r v_rel - Q,   p_r = p_0 + beta q/V_r,   p_g = p_0 (V_0/(V_0 + (A_p - A_r) e + q))^n
        Q = C_d A sqrt(2 dp/rho), dp = p_r - p_g; A is A_e in extension, A_c in compression

    Below dp of about p_t the flow through the piston is in proportion to dp.

    Limits: no cavitation (the pressures must stay above 0), no mass of oil or floating piston, V_r constant.

    Source: the flows and pressures of J. C. Dixon, The Shock Absorber Handbook, 2nd ed. (2007).
    """

    A_p = parameter("m2", "area of the piston", above=0)
    A_r = parameter("m2", "area of the piston less the rod's", above=0)
    A_e = parameter("m2", "opening of the valves in extension", above=0)
    A_c = parameter("m2", "opening of the valves in compression", above=0)
    V_r = parameter("m3", "volume of oil on the rod's side", above=0)
    V_0 = parameter("m3", "volume of gas at s_rel0", above=0)
    p_0 = parameter("Pa", "pressure at s_rel0, absolute", above=0)
    n = parameter("1", "polytropic exponent of the gas", min=1, default=1.4)
    C_d = parameter("1", "discharge coefficient", above=0, default=0.7)
    rho = parameter("kg/m3", "density of the oil", above=0, default=860.0)
    beta = parameter("Pa", "bulk modulus of the oil", above=0, default=1.4e9)
    p_t = parameter("Pa", "pressure difference below which the flow is laminar", above=0, default=1000.0)
    p_amb = parameter("Pa", "pressure outside", min=0, default=ATMOSPHERE)
    s_rel0 = parameter("m", "distance at which the pressure is p_0", default=0.0)
    q = variable("m3", "compression of the oil", nominal=1e-7)
    p_r = variable("Pa", "pressure on the rod's side, absolute", nominal=1e5)
    p_g = variable("Pa", "pressure of the gas, absolute", nominal=1e5)
    Q = variable("m3/s", "flow through the piston, positive in extension", nominal=1e-4)
    e = property(lambda self: self.s_rel - self.s_rel0)
    rod = property(lambda self: (self.A_p - self.A_r) * self.e)
    V = property(lambda self: self.V_0 + self.rod + self.q)
    gas = property(lambda self: gas_energy(self.V, self.p_0, self.V_0, self.n) + self.p_amb * self.rod)
    oil = property(lambda self: self.p_0 * self.q + self.beta * self.q**2 / (2 * self.V_r))
    potential = energy(lambda self: self.gas + self.oil)
    lossPower = dissipation(lambda self: self.Q * (self.p_r - self.p_g))

    def equations(self) -> Stated:
        dp = self.p_r - self.p_g
        opening = ca.if_else(dp > 0, self.A_e, self.A_c)
        yield der(self.q) == self.A_r * self.v_rel - self.Q
        yield self.p_r == self.p_0 + self.beta * self.q / self.V_r
        yield self.p_g == gas_pressure(self.V, self.p_0, self.V_0, self.n)
        yield self.C_d * opening * ca.sqrt(2 / self.rho) * dp / (dp**2 + self.p_t**2) ** 0.25 == self.Q
        yield self.f == self.A_r * self.p_r - self.A_p * self.p_g + (self.A_p - self.A_r) * self.p_amb
