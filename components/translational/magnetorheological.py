"""Magnetorheological dampers, whose hysteresis a current or a voltage sets."""

from ..hysteresis import wen_yielding
from ..language import Expression, RealInput, Stated, der, dissipation, energy, parameter, supply, variable
from .compliances import Dissipative


class Magnetorheological(Dissipative):
    """What magnetorheological dampers share: a coil that lags, i' = eta (u - i), and the hysteresis z.

    alpha = alpha_a + alpha_b i, c_0 = c_0a + c_0b i. The hysteresis stores alpha z^2/(2 A); as the coil makes
    it stiffer, that puts in supplyPower = alpha' z^2/(2 A).
    """

    u = RealInput("1", "current [A] or voltage [V] of the coil")
    alpha_a = parameter("N/m", "force over z without current")
    alpha_b = parameter("N/m", "its growth with u")
    c_0a = parameter("N.s/m", "damping constant without current", min=0)
    c_0b = parameter("N.s/m", "its growth with u")
    k_0 = parameter("N/m", "stiffness", min=0, default=0.0)
    s_rel0 = parameter("m", "distance without spring force", default=0.0)
    eta = parameter("1/s", "rate at which coil and fluid follow", above=0)
    A = parameter("1", "scale of the hysteretic displacement", above=0)
    beta = parameter("1/m^n", "loop shape against the motion", min=0)
    gamma = parameter("1/m^n", "loop shape along the motion")
    n = parameter("1", "sharpness of yield", min=1, default=2.0)
    i = variable("1", "what the fluid follows")
    z = variable("m", "hysteretic displacement")

    alpha = property(lambda self: self.alpha_a + self.alpha_b * self.i)
    c_0 = property(lambda self: self.c_0a + self.c_0b * self.i)
    bent = property(lambda self: self.alpha * self.z**2 / (2 * self.A))
    supplyPower = supply(lambda self: self.alpha_b * der(self.i) * self.z**2 / (2 * self.A))

    def yielding(self, v: Expression) -> Expression:
        """Return what z' falls short of A v by."""
        return wen_yielding(v, self.z, self.beta, self.gamma, self.n)

    def rubbed(self, v: Expression) -> Expression:
        """Return what is lost at a speed."""
        return self.c_0 * v**2 + self.alpha * self.z * self.yielding(v) / self.A

    def equations(self) -> Stated:
        yield der(self.i) == self.eta * (self.u - self.i)


class BoucWenDamper(Magnetorheological):
    """Magnetorheological damper, simple: f = alpha z + c_0 v_rel + k_0 (s_rel - s_rel0).

    z' = A v - beta |v| |z|^(n-1) z - gamma v |z|^n with v = v_rel. alpha = alpha_a + alpha_b i and
    c_0 = c_0a + c_0b i follow the coil's signal u by i' = eta (u - i).

    Source: B. F. Spencer, S. J. Dyke, M. K. Sain, J. D. Carlson, Phenomenological model of a
    magnetorheological damper, J. Eng. Mech. 123 (1997) 230-238.
    """

    potential = energy(lambda self: self.k_0 * (self.s_rel - self.s_rel0) ** 2 / 2 + self.bent)
    lossPower = dissipation(lambda self: self.rubbed(self.v_rel))

    def equations(self) -> Stated:
        yield der(self.z) == self.A * self.v_rel - self.yielding(self.v_rel)
        spring = self.k_0 * (self.s_rel - self.s_rel0)
        yield self.f == self.alpha * self.z + self.c_0 * self.v_rel + spring


class SpencerDamper(Magnetorheological):
    """Magnetorheological damper whose force rolls off at low speeds: f = c_1 y' + k_1 (s_rel - s_rel0).

    c_1 y' = alpha z + c_0 v + k_0 (s_rel - y) with v = v_rel - y', and z' = A v - beta |v| |z|^(n-1) z -
    gamma v |z|^n. alpha, c_0 and c_1 = c_1a + c_1b i follow the coil's signal u by i' = eta (u - i). The gas
    charge is k_1.

    Source: B. F. Spencer, S. J. Dyke, M. K. Sain, J. D. Carlson, Phenomenological model of a
    magnetorheological damper, J. Eng. Mech. 123 (1997) 230-238.
    """

    c_1a = parameter("N.s/m", "damping in series without current", above=0)
    c_1b = parameter("N.s/m", "its growth with u")
    k_1 = parameter("N/m", "stiffness of the gas charge", min=0, default=0.0)
    y = variable("m", "stretch of the damping in series")
    v = variable("m/s", "speed of the hysteresis")
    c_1 = property(lambda self: self.c_1a + self.c_1b * self.i)
    springs = property(
        lambda self: self.k_0 * (self.s_rel - self.y) ** 2 + self.k_1 * (self.s_rel - self.s_rel0) ** 2
    )
    potential = energy(lambda self: self.springs / 2 + self.bent)
    lossPower = dissipation(lambda self: self.rubbed(self.v) + self.c_1 * der(self.y) ** 2)

    def equations(self) -> Stated:
        spring = self.k_0 * (self.s_rel - self.y)
        yield self.v == self.v_rel - der(self.y)
        yield self.c_1 * der(self.y) == self.alpha * self.z + self.c_0 * self.v + spring
        yield der(self.z) == self.A * self.v - self.yielding(self.v)
        yield self.f == self.c_1 * der(self.y) + self.k_1 * (self.s_rel - self.s_rel0)
