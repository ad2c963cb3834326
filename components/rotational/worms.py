"""Worm gears."""

import casadi as ca

from ..flanks import SlidingFlanks
from ..language import Expression, RotationalFlange, Stated, der, parameter, variable


class WormGear(SlidingFlanks):
    """Worm and wheel, whose flanks slide under load: phi_a = ratio phi_b; self-locking if mu > tan(lambda).

    flange_b.tau = -ratio (flange_a.tau - tau_loss). Worm driving, the efficiency is tan(lambda)/tan(lambda +
    rho) with tan(rho) = mu; wheel driving, tan(lambda - rho)/tan(lambda), and none where it locks itself. At
    rest the load is truly held. With a pressure angle alpha, mu is the friction coefficient over cos(alpha).

    Limits: as for `SlidingFlanks`: mu tan(lambda) below 1, no locking by inertia alone.

    Source: mechanics of the inclined plane, J. E. Shigley, Mechanical Engineering Design.
    """

    flange_a = RotationalFlange("worm")
    flange_b = RotationalFlange("wheel")
    support = RotationalFlange("housing", optional=True)
    ratio = parameter("1", "turns of the worm for one of the wheel", nonzero=True)
    lead_angle = parameter("rad", "lead angle of the worm", above=0, max=1.5)
    phi = variable("rad", "angle of the worm against the housing", state="prefer")
    w = variable("rad/s", "speed of the worm against the housing", state="prefer")
    a = variable("rad/s2", "acceleration of the worm against the housing")

    @property
    def load_torque(self) -> Expression:
        return -self.flange_b.tau / self.ratio

    @property
    def slope(self) -> Expression:
        return ca.tan(self.lead_angle)

    def equations(self) -> Stated:
        a, b, housing = self.flange_a, self.flange_b, self.support
        yield self.phi == a.phi - housing.phi
        yield self.phi == self.ratio * (b.phi - housing.phi)
        yield self.w == der(self.phi)
        yield self.a == der(self.w)
        yield b.tau == -self.ratio * (a.tau - self.tau_loss)
        yield housing.tau == -(a.tau + b.tau)
