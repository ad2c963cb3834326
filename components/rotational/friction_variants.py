"""Dry friction that depends on more than speed: on direction, on a load, on time."""

import casadi as ca

from ..language import Expression, RealInput, parameter
from .friction import Friction


class AsymmetricFriction(Friction):
    """Coulomb friction that differs by direction.

    tau = tau_forward for w_rel > 0 and -tau_backward for w_rel < 0.
    While stuck, -peak tau_backward <= tau <= peak tau_forward.

    Source: B. Armstrong-Helouvry, Control of Machines with Friction (1991), section 2.3.
    """

    tau_forward = parameter("N.m", "friction torque while the angle grows", min=0)
    tau_backward = parameter("N.m", "friction torque while it shrinks", min=0)

    def sliding(self, speed: Expression) -> Expression:
        """Friction torque while the angle grows."""
        return self.tau_forward + 0 * speed

    def sliding_back(self, speed: Expression) -> Expression:
        """Friction torque while it shrinks."""
        return self.tau_backward + 0 * speed


class LoadedFriction(Friction):
    """Friction in proportion to a load: tau = mu |load| sgn(w_rel) while sliding.

    While stuck, |tau| <= peak mu |load|.

    Example:
        >>> from inertance import rotational
        >>> seal = rotational.LoadedFriction(mu=0.02)  # connect a TorqueSensor's torque to seal.load
    """

    load = RealInput("N.m", "torque that presses the surfaces together")
    mu = parameter("1", "friction torque over load", min=0)

    def sliding(self, speed: Expression) -> Expression:
        """Friction torque at a speed."""
        return self.mu * ca.fabs(self.load) + 0 * speed


class DriftingFriction(Friction):
    """Friction whose level follows a signal: tau = (tau_c + tau_u u) sgn(w_rel) while sliding.

    u is what the level depends on: time, or a measured temperature. With `regularised` the level may
    be negative, so that it stands for what a drift adds to, or takes from, friction that is there.
    """

    u = RealInput("1", "what the level follows")
    tau_c = parameter("N.m", "friction torque at u = 0", default=0.0)
    tau_u = parameter("N.m", "change of friction torque with u")

    def sliding(self, speed: Expression) -> Expression:
        """Friction torque at a speed."""
        return self.tau_c + self.tau_u * self.u + 0 * speed
