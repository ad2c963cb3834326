"""Friction of bristles, which bend before they slip."""

import casadi as ca

from ..language import Stated, der, dissipation, energy, parameter, variable
from .compliances import Dissipative


class LuGreFriction(Dissipative):
    """Friction of bristles that bend by z: f = sigma_0 z + sigma_1 z' + sigma_2 v_rel.

    z' = v_rel - sigma_0 |v_rel| z/g with g = f_c + (f_s - f_c) exp(-(v_rel/v_s)^2), so that f comes to
    g sgn(v_rel) + sigma_2 v_rel at a steady speed. It knows no events.

    Limits: with a large sigma_1 it may give power back for an instant, and under a load that vibrates below
    break-away it drifts.

    Source: C. Canudas de Wit, H. Olsson, K. J. Astrom, P. Lischinsky, A new model for control of systems
    with friction, IEEE Trans. Automat. Contr. 40 (1995) 419-425.
    """

    f_c = parameter("N", "Coulomb friction force", above=0)
    f_s = parameter("N", "static friction force", above=0, default=lambda self: self.f_c)
    v_s = parameter("m/s", "Stribeck velocity", above=0)
    sigma_0 = parameter("N/m", "stiffness of the bristles", above=0)
    sigma_1 = parameter("N.s/m", "damping of the bristles", min=0, default=0.0)
    sigma_2 = parameter("N.s/m", "viscous friction", min=0, default=0.0)
    z = variable("m", "mean bend of the bristles", nominal=1e-6)
    potential = energy(lambda self: self.sigma_0 * self.z**2 / 2)
    lossPower = dissipation(lambda self: self.f * self.v_rel - self.sigma_0 * self.z * der(self.z))

    def equations(self) -> Stated:
        v, z = self.v_rel, self.z
        level = self.f_c + (self.f_s - self.f_c) * ca.exp(-((v / self.v_s) ** 2))
        yield der(z) == v - self.sigma_0 * ca.fabs(v) / level * z
        yield self.f == self.sigma_0 * z + self.sigma_1 * der(z) + self.sigma_2 * v
