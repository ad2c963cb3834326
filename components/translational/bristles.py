"""Friction of bristles, which bend before they slip."""

import casadi as ca

from ..bristles import Bristles
from ..language import Expression, Stated, parameter, variable
from .compliances import CompliantWithSpeed


class LuGreFriction(CompliantWithSpeed, Bristles):
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

    @property
    def speed(self) -> Expression:
        return self.v_rel

    @property
    def level(self) -> Expression:
        return self.f_c + (self.f_s - self.f_c) * ca.exp(-((self.v_rel / self.v_s) ** 2))

    def equations(self) -> Stated:
        yield self.f == self.rubbing
