"""Stick-slip: dry friction that truly holds, in the same words for sliding and for turning."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import casadi as ca

from .base import Component, mode, option, parameter


class StickSlip(Component):
    """Dry friction with three modes.

    Stuck: the acceleration is zero and the resistance whatever that takes, up to break-away.
    Forward and backward: the resistance follows the law `sliding(speed)` against the motion.

    A subclass defines `resistance`, `speed`, `acceleration` (properties), `speed_name`, and
    `sliding(speed)`, the resistance at a speed that is not negative.

    Source: M. Otter, H. Elmqvist, S. E. Mattsson, Hybrid modeling in Modelica based on the
    synchronous data flow principle (1999), section 4.
    """

    mode = mode("stuck", "forward", "backward", doc="sticking or sliding", in_shock={"stuck": "forward"})
    peak = parameter("1", "break-away resistance over sliding resistance at rest", default=1.0, min=1.0)
    regularised = option(
        "speed over which the sign of the motion is smoothed (no events, but creeps when it should stick)",
        default=None,
    )

    speed_name = "v_rel"

    @property
    def breakaway(self) -> Any:
        """Resistance at which sliding begins."""
        return self.peak * self.sliding(0.0)  # type: ignore[attr-defined]

    def equations(self) -> Iterable[Any]:
        resistance, speed = self.resistance, self.speed
        if self.regularised:
            yield resistance == ca.tanh(speed / self.regularised) * self.sliding(ca.fabs(speed))
        else:
            forward, backward = self.sliding(speed), self.sliding(-speed)
            yield (
                self.mode.choose(
                    stuck=self.acceleration,
                    forward=resistance - forward,
                    backward=resistance + backward,
                )
                == 0
            )

    def transitions(self) -> Iterable[Any]:
        if self.regularised:
            return
        limit, speed, stop = self.breakaway, self.speed, {self.speed_name: 0.0}
        yield self.mode.goes("stuck", "forward", when=self.resistance > limit)
        yield self.mode.goes("stuck", "backward", when=-self.resistance > limit)
        yield self.mode.goes("stuck", "forward", when=speed > 0)
        yield self.mode.goes("stuck", "backward", when=speed < 0)
        yield self.mode.goes("forward", "stuck", when=speed < 0, reset=stop)
        yield self.mode.goes("backward", "stuck", when=speed > 0, reset=stop)
