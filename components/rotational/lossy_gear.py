"""A gear with the losses of its mesh and its bearings."""

import casadi as ca

from ..language import Expression, RotationalFlange, Stated, der, mode, option, parameter, variable
from ..stickslip import Sticking
from ..tables import interpolated, over_speed_with_losses


class LossyGear(Sticking):
    """A gearbox with mesh efficiency and bearing friction that truly sticks: phi_a = ratio phi_b.

    The mesh passes on tau_a - tau_loss: flange_b.tau = -ratio (flange_a.tau - tau_loss). Turning
    forward, tau_loss is the larger of
    (1 - eta1) tau_a + tau_bf1 (a drives b) and (1 - 1/eta2) tau_a + tau_bf2 (b drives a);
    turning backward, the same with both torques reversed. Stuck, it is whatever holds the gear,
    between these two at rest. Angles are taken against the support, which bears the rest of the torques.

    `lossTable` has rows (|w| [rad/s], eta1, eta2, tau_bf1 [N.m], tau_bf2 [N.m]) over the speed of
    flange_a: efficiencies above 0 up to 1, and bearing friction seen at flange_a, for either
    direction of power. In between it is interpolated, beyond its end it goes on straight.

    Source: C. Pelchen, C. Schweiger, M. Otter, Modeling and Simulating the Efficiency of Gearboxes
    and of Planetary Gearboxes, 2nd Modelica Conference (2002); MSL Rotational.Components.LossyGear.
    """

    flange_a = RotationalFlange("left shaft")
    flange_b = RotationalFlange("right shaft")
    support = RotationalFlange("housing", optional=True)
    ratio = parameter("1", "turns of flange_a for one of flange_b", nonzero=True)
    lossTable = option(  # noqa: N815
        "rows (speed, eta1, eta2, tau_bf1, tau_bf2)",
        default=((0.0, 1.0, 1.0, 0.0, 0.0),),
        check=over_speed_with_losses,
    )
    driver = mode("a", "b", doc="the side that drives the mesh")
    phi = variable("rad", "angle of flange_a against the support", state="prefer")
    w = variable("rad/s", "speed of flange_a against the support", state="prefer")
    a = variable("rad/s2", "acceleration of flange_a against the support")
    tau_loss = variable("N.m", "torque lost, seen at flange_a")

    quantities = "tau_loss", "w", "a"

    def losses(self, torque: Expression, speed: Expression) -> tuple[Expression, Expression]:
        """Loss torque when a drives and when b drives, for turning forward."""
        eta1, eta2, tau_bf1, tau_bf2 = (interpolated(self.lossTable, ca.fabs(speed), i) for i in (1, 2, 3, 4))
        return (1 - eta1) * torque + tau_bf1, (1 - 1 / eta2) * torque + tau_bf2

    @property
    def limits(self) -> tuple[Expression, ...]:
        """Loss torques at which turning begins, forward and backward."""
        return tuple(ca.fmax(*self.losses(sign * self.flange_a.tau, 0.0)) for sign in (1, -1))

    def equations(self) -> Stated:
        a, b, housing, loss = self.flange_a, self.flange_b, self.support, self.tau_loss
        yield self.phi == a.phi - housing.phi
        yield self.phi == self.ratio * (b.phi - housing.phi)
        yield self.w == der(self.phi)
        yield self.a == der(self.w)
        yield b.tau == -self.ratio * (a.tau - loss)
        yield housing.tau == -(a.tau + b.tau)
        forward, backward = (
            self.driver.choose(**dict(zip("ab", self.losses(sign * a.tau, sign * self.w), strict=True)))
            for sign in (1, -1)
        )
        yield self.mode.choose(stuck=self.a, forward=loss - forward, backward=loss + backward) == 0

    def transitions(self) -> Stated:
        (forward_a, forward_b), (backward_a, backward_b) = (
            self.losses(sign * self.flange_a.tau, sign * self.w) for sign in (1, -1)
        )
        lead = self.mode.choose(stuck=0.0, forward=forward_a - forward_b, backward=backward_a - backward_b)
        yield self.driver.goes("a", "b", when=lead < 0)
        yield self.driver.goes("b", "a", when=lead > 0)
