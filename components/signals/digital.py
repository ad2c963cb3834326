"""What digital controllers do to signals: a dead zone, and samples that are held."""

import casadi as ca

from ..language import Stated, der, mode, parameter, variable
from .blocks import SISO


class DeadZone(SISO):
    """Dead zone: y = u - u_max above u_max, u - u_min below u_min, 0 between: continuous, without events.

    Source: MSL Blocks.Nonlinear.DeadZone.
    """

    u_max = parameter("", "upper end of the zone", min=0)
    u_min = parameter("", "lower end of the zone", max=0, default=lambda self: -self.u_max)

    def equations(self) -> Stated:
        yield self.y == ca.fmax(self.u - self.u_max, 0) + ca.fmin(self.u - self.u_min, 0)


class SampleHold(SISO):
    """Sampler: u is read at start_time + k period, and put out after a delay, to be held until the next is.

    Before the first sample y is y_0. Each sample, and each delayed output, is an event.

    Limits: the delay must be shorter than the period; longer ones are several blocks one after the other.

    Source: MSL Blocks.Discrete.Sampler, and with a delay UnitDelay.
    """

    period = parameter("s", "time between samples", above=0)
    delay = parameter("s", "from sample to output, shorter than the period", min=0, default=0.0)
    start_time = parameter("s", "time of the first sample", default=0.0)
    y_0 = parameter("", "output before the first sample", default=0.0)
    state = mode("waiting", "computing", doc="before the next sample, or before its output")
    count = variable("1", "samples taken", state="prefer")
    sample = variable("", "sample taken last", state="prefer")
    held = variable("", "what is put out, less y_0", state="prefer")

    def equations(self) -> Stated:
        yield der(self.count) == 0
        yield der(self.sample) == 0
        yield der(self.held) == 0
        yield self.y == self.y_0 + self.held

    def transitions(self) -> Stated:
        elapsed = self.time - self.start_time
        missed = ca.floor(elapsed / self.period)
        taken = {"count": ca.fmax(self.count, missed) + 1, "sample": self.u - self.y_0}
        yield self.state.goes("waiting", "computing", when=elapsed > self.count * self.period, reset=taken)
        due = (self.count - 1) * self.period + self.delay
        yield self.state.goes("computing", "waiting", when=elapsed > due, reset={"held": self.sample})
