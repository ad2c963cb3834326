"""Tyres along the road."""

import casadi as ca
import numpy as np

from ..language import Expression, Stated, der, dissipation, energy, parameter, variable
from ..lossy import Lossy
from .conversions import Transmission

NODES, WEIGHTS = np.polynomial.legendre.leggauss(16)


class Tyre(Transmission, Lossy):
    """Tyre that slips along the road: f_x = D sin(C atan(B kappa - E (B kappa - atan(B kappa)))), D = mu F_z.

    The slip kappa builds up over the relaxation length: sigma kappa' = R w - v - |v| kappa, also at rest.
    f_x drives `flange_t`, the hub, forward and brakes `flange_r`, the rim, with R f_x. With a belt of its own
    it is a `machines.RigidRingTyre`.

    The carcass stores sigma times the integral of f_x over kappa; what is lost is f_x |v| kappa.

    Limits: no camber, no side slip, no rolling resistance; F_z is constant.

    Source: H. B. Pacejka, Tyre and Vehicle Dynamics, 3rd ed. (2012), the magic formula and transient slip.
    """

    R = parameter("m", "effective rolling radius", above=0)
    F_z = parameter("N", "load on the tyre", min=0)
    mu = parameter("1", "largest f_x over F_z", min=0)
    B = parameter("1", "stiffness factor", above=0)
    C = parameter("1", "shape factor", above=0)
    E = parameter("1", "curvature factor", max=1, default=0.0)
    sigma = parameter("m", "relaxation length", above=0)
    w = variable("rad/s", "speed of the rim", state="prefer")
    v = variable("m/s", "speed over the road", state="prefer")
    s = variable("m", "travel over the road", state="prefer")
    kappa = variable("1", "slip")
    f_x = variable("N", "driving force")
    potential = energy(lambda self: self.sigma * self.area)
    lossPower = dissipation(lambda self: self.f_x * ca.fabs(self.v) * self.kappa)

    def force(self, kappa: Expression) -> Expression:
        """Return the force of a slip that is steady."""
        slip = self.B * kappa
        return self.mu * self.F_z * ca.sin(self.C * ca.atan(slip - self.E * (slip - ca.atan(slip))))

    @property
    def area(self) -> Expression:
        """Integral of the force over kappa from 0, by Gauss's points in u, B kappa = sinh(u)."""
        end = ca.asinh(self.B * self.kappa)
        points = [end * (1 + node) / 2 for node in NODES]
        parts = [
            w * ca.cosh(u) * self.force(ca.sinh(u) / self.B) for w, u in zip(WEIGHTS, points, strict=True)
        ]
        return end / (2 * self.B) * sum(parts)

    def equations(self) -> Stated:
        yield self.w == der(self.phi)
        yield self.v == der(self.s)
        yield self.sigma * der(self.kappa) == self.R * self.w - self.v - ca.fabs(self.v) * self.kappa
        yield self.f_x == self.force(self.kappa)
        yield self.flange_t.f == -self.f_x
        yield self.flange_r.tau == self.R * self.f_x
