"""What joins shafts at an angle, and what shares a torque between two."""

import casadi as ca

from ..language import Component, RotationalFlange, Stated, dissipation, parameter


class UniversalJoint(Component):
    """Joint of Cardan and Hooke between shafts at an angle: tan(phi_a) = cos(beta) tan(phi_b), no loss.

    phi_a is taken from where the fork of shaft a lies in the plane of both shafts. Power is kept, so that
    tau_b = -tau_a/(dphi_b/dphi_a); what their difference takes, the bearings bear.

    Source: R. Willis, Principles of Mechanism (1841).
    """

    flange_a = RotationalFlange("driving shaft")
    flange_b = RotationalFlange("driven shaft")
    beta = parameter("rad", "angle between the shafts", min=-1.5, max=1.5)
    lossPower = dissipation(lambda _: 0.0)

    def equations(self) -> Stated:
        phi, bend = self.flange_a.phi, ca.cos(self.beta)
        sin, cos = ca.sin(phi), ca.cos(phi)
        lead = ca.atan((1 - bend) * sin * cos / (bend * cos**2 + sin**2))
        yield self.flange_b.phi == phi + lead
        yield self.flange_a.tau + bend / (bend**2 * cos**2 + sin**2) * self.flange_b.tau == 0


class Differential(Component):
    """Open differential: phi = ratio (phi_left + phi_right)/2, both shafts under the same torque.

    left.tau = right.tau = -ratio flange.tau/2; the support takes what is left of their sum. A friction
    element between left and right makes it one of limited slip.
    """

    flange = RotationalFlange("pinion")
    left = RotationalFlange("left shaft")
    right = RotationalFlange("right shaft")
    support = RotationalFlange("housing", optional=True)
    ratio = parameter("1", "turns of the pinion for one of the cage", nonzero=True, default=1.0)

    def equations(self) -> Stated:
        mean = (self.left.phi + self.right.phi) / 2
        yield self.flange.phi - self.support.phi == self.ratio * (mean - self.support.phi)
        yield self.left.tau == self.right.tau
        yield self.left.tau == -self.ratio * self.flange.tau / 2
        yield self.support.tau == -(self.flange.tau + self.left.tau + self.right.tau)
