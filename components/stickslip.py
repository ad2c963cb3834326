"""Stick-slip: dry friction that truly holds, in the same words for sliding and for turning."""

import casadi as ca

from ..base import smoothing
from .language import Expression, Stated, dissipation, mode, option, parameter
from .lossy import Lossy

REST_SPEED = 1e-9  # [m/s, rad/s]
BREAKAWAY_MARGIN = 1e-10  # share by which a limit is passed: so it accelerates, for all rounding in its load


class Sticking(Lossy):
    """What sticks and slips: the three modes of dry friction, and when they change.

    A subclass names its resistance, speed and acceleration in `quantities`, and gives `limits`, the
    resistances forward and backward beyond which sticking ends.
    """

    mode = mode("stuck", "forward", "backward", doc="sticking or sliding", in_shock={"stuck": "forward"})
    quantities = "f", "v_rel", "a_rel"
    regularised: Expression = None

    resistance = property(lambda self: getattr(self, self.quantities[0]))
    speed = property(lambda self: getattr(self, self.quantities[1]))
    acceleration = property(lambda self: getattr(self, self.quantities[2]))
    lossPower = dissipation(lambda self: self.resistance * self.speed)

    @property
    def grips(self) -> Expression:
        """Condition for sticking at all, if there is one."""
        return None

    def transitions(self) -> Stated:
        """Break away beyond a limit; stick where the speed changes its sign, unless it jumped."""
        if self.regularised:
            return
        resistance, speed = self.resistance, self.speed
        forward, backward = ((1 + BREAKAWAY_MARGIN) * limit for limit in self.limits)
        rests = ca.fabs(speed) < REST_SPEED
        allowed = rests if self.grips is None else ca.logic_and(rests, self.grips)
        stop = {self.quantities[1]: ca.if_else(rests, 0.0, speed)}
        yield self.mode.goes("stuck", "forward", when=resistance > forward, allowed=allowed)
        yield self.mode.goes("stuck", "backward", when=-resistance > backward, allowed=allowed)
        yield self.mode.goes("stuck", "forward", when=speed > 0)
        yield self.mode.goes("stuck", "backward", when=speed < 0)
        yield self.mode.goes("forward", "stuck", when=speed < 0, reset=stop)
        yield self.mode.goes("backward", "stuck", when=speed > 0, reset=stop)


def _onward(speed: Expression) -> Expression:
    """Return a speed that is not below zero; its slope at zero is 1, while that of |speed| would be 0."""
    return ca.if_else(speed >= 0, speed, 0.0)


class StickSlip(Sticking):
    """Dry friction with three modes.

    Stuck: the acceleration is zero and the resistance whatever that takes, up to break-away.
    Forward and backward: the resistance follows the law `sliding(speed)` against the motion.

    A subclass defines `quantities` and `sliding(speed)`, the resistance at a speed that is not negative;
    `sliding_back` if it differs backward.

    Source: M. Otter, H. Elmqvist, S. E. Mattsson, Hybrid modeling in Modelica based on the
    synchronous data flow principle (1999), section 4.
    """

    peak = parameter("1", "break-away resistance over sliding resistance at rest", default=1.0, min=1.0)
    regularised = option(
        "speed over which the sign of the motion is smoothed (no events, but creeps when it should stick)",
        default=None,
        check=smoothing,
    )

    @property
    def breakaway(self) -> Expression:
        """Resistance at which sliding begins."""
        return self.peak * self.sliding(0.0)

    @property
    def limits(self) -> tuple[Expression, Expression]:
        """Resistances at which sliding begins, forward and backward."""
        return self.breakaway, self.peak * self.sliding_back(0.0)

    def sliding_back(self, speed: Expression) -> Expression:
        """Resistance at a speed backward, by default as forward."""
        return self.sliding(speed)

    def dry(self, level: Expression) -> Expression:
        """Level of friction that may come out negative: no less than none, but where it is regularised."""
        return level if self.regularised else ca.fmax(level, 0.0)

    def laws(self) -> dict[str, Expression]:
        """What vanishes in each mode; at rest friction has the slope of the motion before or after."""
        return {
            "stuck": self.acceleration,
            "forward": self.resistance - self.sliding(_onward(self.speed)),
            "backward": self.resistance + self.sliding_back(_onward(-self.speed)),
        }

    def equations(self) -> Stated:
        if self.regularised:
            speed = ca.fabs(self.speed)
            friction = ca.if_else(self.speed > 0, self.sliding(speed), self.sliding_back(speed))
            yield self.resistance == ca.tanh(self.speed / self.regularised) * friction
        else:
            yield self.mode.choose(**self.laws()) == 0
