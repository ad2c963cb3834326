"""Friction of bristles between two shafts."""

import casadi as ca

from ..bristles import Bristles
from ..language import Expression, Stated, parameter, variable
from .compliances import CompliantWithSpeed


class LuGreFriction(CompliantWithSpeed, Bristles):
    """Friction of bristles that bend by z: tau = sigma_0 z + sigma_1 z' + sigma_2 w_rel.

    z' = w_rel - sigma_0 |w_rel| z/g with g = tau_c + (tau_s - tau_c) exp(-(w_rel/w_s)^2), so that tau comes
    to g sgn(w_rel) + sigma_2 w_rel at a steady speed. It knows no events.

    Limits: with a large sigma_1 it may give power back for an instant, and under a load that vibrates below
    break-away it drifts.

    Source: C. Canudas de Wit, H. Olsson, K. J. Astrom, P. Lischinsky, A new model for control of systems
    with friction, IEEE Trans. Automat. Contr. 40 (1995) 419-425.
    """

    tau_c = parameter("N.m", "Coulomb friction torque", above=0)
    tau_s = parameter("N.m", "static friction torque", above=0, default=lambda self: self.tau_c)
    w_s = parameter("rad/s", "Stribeck speed", above=0)
    sigma_0 = parameter("N.m/rad", "stiffness of the bristles", above=0)
    sigma_1 = parameter("N.m.s/rad", "damping of the bristles", min=0, default=0.0)
    sigma_2 = parameter("N.m.s/rad", "viscous friction", min=0, default=0.0)
    z = variable("rad", "mean bend of the bristles", nominal=1e-6)

    @property
    def speed(self) -> Expression:
        return self.w_rel

    @property
    def level(self) -> Expression:
        return self.tau_c + (self.tau_s - self.tau_c) * ca.exp(-((self.w_rel / self.w_s) ** 2))

    def equations(self) -> Stated:
        yield self.tau == self.rubbing
