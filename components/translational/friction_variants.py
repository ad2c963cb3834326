"""Dry friction that depends on more than speed: on direction, on a load, on time."""

import casadi as ca

from ..language import Expression, RealInput, parameter
from .friction import Friction


class AsymmetricFriction(Friction):
    """Coulomb friction that differs by direction.

    f = f_forward for v_rel > 0 and -f_backward for v_rel < 0.
    While stuck, -peak f_backward <= f <= peak f_forward.

    Source: B. Armstrong-Helouvry, Control of Machines with Friction (1991), section 2.3.
    """

    f_forward = parameter("N", "friction force while the flanges part", min=0)
    f_backward = parameter("N", "friction force while they approach", min=0)

    def sliding(self, speed: Expression) -> Expression:
        """Friction force while the flanges part."""
        return self.f_forward + 0 * speed

    def sliding_back(self, speed: Expression) -> Expression:
        """Friction force while they approach."""
        return self.f_backward + 0 * speed


class LoadedFriction(Friction):
    """Friction in proportion to a load: f = mu |load| sgn(v_rel) while sliding.

    While stuck, |f| <= peak mu |load|.

    Example:
        >>> from inertance import ForceSensor, LoadedFriction
        >>> seal = LoadedFriction(mu=0.02)  # connect the force of a ForceSensor to seal.load
    """

    load = RealInput("N", "force that presses the surfaces together")
    mu = parameter("1", "friction force over load", min=0)

    def sliding(self, speed: Expression) -> Expression:
        """Friction force at a speed."""
        return self.mu * ca.fabs(self.load) + 0 * speed


class DriftingFriction(Friction):
    """Friction whose level follows a signal: f = (f_c + f_u u) sgn(v_rel) while sliding.

    u is what the level depends on: time, or a measured temperature. With `regularised` the level may
    be negative, so that it stands for what a drift adds to, or takes from, friction that is there.
    """

    u = RealInput("1", "what the level follows")
    f_c = parameter("N", "friction force at u = 0", default=0.0)
    f_u = parameter("N", "change of friction force with u")

    def sliding(self, speed: Expression) -> Expression:
        """Friction force at a speed."""
        return self.f_c + self.f_u * self.u + 0 * speed
