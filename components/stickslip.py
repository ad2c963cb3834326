"""Stick-slip: dry friction that truly holds, in the same words for sliding and for turning."""

import casadi as ca

from ..base import smoothing
from .language import Component, Expression, Stated, mode, option, parameter

SLOW = 1e-9
HOLD = 1e-10


class StickSlip(Component):
    """Dry friction with three modes.

    Stuck: the acceleration is zero and the resistance whatever that takes, up to break-away.
    Forward and backward: the resistance follows the law `sliding(speed)` against the motion.

    A subclass defines `resistance`, `speed`, `acceleration` (properties), `speed_name`, and
    `sliding(speed)`, the resistance at a speed that is not negative; `sliding_back` if it differs backward.

    Source: M. Otter, H. Elmqvist, S. E. Mattsson, Hybrid modeling in Modelica based on the
    synchronous data flow principle (1999), section 4.
    """

    mode = mode("stuck", "forward", "backward", doc="sticking or sliding", in_shock={"stuck": "forward"})
    peak = parameter("1", "break-away resistance over sliding resistance at rest", default=1.0, min=1.0)
    regularised = option(
        "speed over which the sign of the motion is smoothed (no events, but creeps when it should stick)",
        default=None,
        check=smoothing,
    )

    speed_name = "v_rel"

    @property
    def grips(self) -> Expression:
        """Condition for sticking at all, if there is one."""
        return None

    @property
    def breakaway(self) -> Expression:
        """Resistance at which sliding begins."""
        return self.peak * self.sliding(0.0)

    def sliding_back(self, speed: Expression) -> Expression:
        """Resistance at a speed backward, by default as forward."""
        return self.sliding(speed)

    def laws(self) -> dict[str, Expression]:
        """What vanishes in each mode."""
        speed = ca.fabs(self.speed)
        return {
            "stuck": self.acceleration,
            "forward": self.resistance - self.sliding(speed),
            "backward": self.resistance + self.sliding_back(speed),
        }

    def equations(self) -> Stated:
        if self.regularised:
            speed = ca.fabs(self.speed)
            friction = ca.if_else(self.speed > 0, self.sliding(speed), self.sliding_back(speed))
            yield self.resistance == ca.tanh(self.speed / self.regularised) * friction
        else:
            yield self.mode.choose(**self.laws()) == 0

    def transitions(self) -> Stated:
        if self.regularised:
            return
        limits = self.breakaway, self.peak * self.sliding_back(0.0)
        slow = ca.fabs(self.speed) < SLOW
        allowed = slow if self.grips is None else ca.logic_and(slow, self.grips)
        yield from breakaways(self.mode, self.resistance, limits, allowed)
        yield from reversals(self.mode, self.speed, self.speed_name)


def breakaways(
    mode: Expression,
    resistance: Expression,
    limits: tuple[Expression, Expression],
    allowed: Expression = None,
) -> Stated:
    """Yield the ways out of sticking: a resistance beyond its limit forward or backward.

    A hair beyond: then what breaks away also accelerates, for all rounding in its load.
    """
    forward, backward = ((1 + HOLD) * limit for limit in limits)
    yield mode.goes("stuck", "forward", when=resistance > forward, allowed=allowed)
    yield mode.goes("stuck", "backward", when=-resistance > backward, allowed=allowed)


def reversals(mode: Expression, speed: Expression, name: str) -> Stated:
    """Yield what a change of the speed's sign does: it ends in sticking, unless the speed jumped."""
    stop = {name: ca.if_else(ca.fabs(speed) < SLOW, 0.0, speed)}
    yield mode.goes("stuck", "forward", when=speed > 0)
    yield mode.goes("stuck", "backward", when=speed < 0)
    yield mode.goes("forward", "stuck", when=speed < 0, reset=stop)
    yield mode.goes("backward", "stuck", when=speed > 0, reset=stop)
