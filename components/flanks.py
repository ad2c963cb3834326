"""Friction of flanks that slide on each other under load: worms and screws, which may lock themselves."""

import casadi as ca

from .language import Expression, Stated, mode, parameter, variable
from .stickslip import Sticking


class SlidingFlanks(Sticking):
    """A wedge that turning drives: what it loses follows its load, and at rest it holds as much.

    tau_loss = +-c |T| +- tau_bf against the motion, T the torque that the load takes without loss, and with
    t the tangent of the lead angle: c = mu (1 + t^2)/(t (1 - mu t)) against the load, mu (1 + t^2)/(t (1 +
    mu t)) along with it. Where mu > t no load drives it: it is self-locking.

    A subclass gives `load_torque` T and `slope` t, declares phi, w and a of what turns, and uses tau_loss.

    Limits: mu t must stay below 1. Locking in motion by inertia alone, where the driven side is too heavy for
    the flanks to brake, has no solution in finite forces and ends the run: real flanks and shafts give way.
    """

    mu = parameter("1", "friction coefficient of the flanks", min=0)
    tau_bf = parameter("N.m", "friction torque of the bearings", min=0, default=0.0)
    side = mode("against", "along", doc="whether the load resists turning forward or helps it")
    tau_loss = variable("N.m", "torque lost, seen where it is driven")

    quantities = "tau_loss", "w", "a"
    unsettled = (
        "its flanks lock themselves, and jam in motion: what the inertia behind them would have to push, "
        "friction takes; put a SpringDamper between it and the load, or lower mu or that inertia"
    )

    @property
    def load_torque(self) -> Expression:
        """The torque that the load takes, positive against turning forward."""
        raise NotImplementedError

    @property
    def slope(self) -> Expression:
        """Tangent of the lead angle."""
        raise NotImplementedError

    @property
    def torques(self) -> tuple[Expression, Expression]:
        """What the load makes the flanks resist by against it and, of the other sign, along with it."""
        t, mu, torque = self.slope, self.mu, self.load_torque
        uphill = mu * (1 + t**2) / (t * (1 - mu * t)) * torque
        downhill = mu * (1 + t**2) / (t * (1 + mu * t)) * torque
        return uphill, downhill

    @property
    def limits(self) -> tuple[Expression, Expression]:
        """Loss torques at which sliding begins forward and backward, whatever `side` says."""
        uphill, downhill = self.torques
        return self.tau_bf + ca.fmax(uphill, -downhill), self.tau_bf + ca.fmax(downhill, -uphill)

    def equations(self) -> Stated:
        uphill, downhill = self.torques
        forward = self.tau_bf + self.side.choose(against=uphill, along=-downhill)
        backward = self.tau_bf + self.side.choose(against=downhill, along=-uphill)
        held = {"stuck": self.a, "forward": self.tau_loss - forward, "backward": self.tau_loss + backward}
        yield self.mode.choose(**held) == 0

    def transitions(self) -> Stated:
        yield self.side.goes("against", "along", when=self.load_torque < 0)
        yield self.side.goes("along", "against", when=self.load_torque > 0)
