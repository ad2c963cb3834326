"""Periodic signals with edges: every edge is a time event."""

import casadi as ca

from ..language import Expression, Stated, der, mode, parameter, variable
from .sources import Source, portion


class Periodic(Source):
    """What signals with a period have: the number of periods begun, constant between events."""

    amplitude = parameter("", "height above the offset", default=1.0)
    period = parameter("s", "period", above=0)
    offset = parameter("", "value between the pulses", default=0.0)
    start_time = parameter("s", "when the first period begins", default=0.0)
    count = variable("1", "periods begun", state="prefer")

    @property
    def next_period(self) -> Expression:
        """The condition that the next period begins."""
        return self.time > self.start_time + self.count * self.period

    @property
    def elapsed(self) -> Expression:
        """Time since the present period began."""
        return self.time - self.start_time - (self.count - 1) * self.period

    @property
    def begun(self) -> dict[str, Expression]:
        """What a new period resets; a run that begins late catches up at once."""
        passed = ca.floor((self.time - self.start_time) / self.period)
        return {"count": ca.fmax(self.count, passed) + 1}

    def equations(self) -> Stated:
        yield der(self.count) == 0


class Pulse(Periodic):
    """Rectangular pulses: y = offset + amplitude for a share `width` of each period, else offset.

    Source: MSL Blocks.Sources.Pulse, where width is in percent.
    """

    width = parameter("1", "share of the period at offset + amplitude", above=0, max=1, default=0.5)
    mode = mode("low", "high", doc="between or in pulses")

    def equations(self) -> Stated:
        yield self.y == self.offset + self.mode.choose(low=0.0, high=self.amplitude)

    def transitions(self) -> Stated:
        yield self.mode.goes("low", "high", when=self.next_period, reset=self.begun)
        yield self.mode.goes("high", "low", when=self.elapsed > self.width * self.period)


class Trapezoid(Periodic):
    """Trapezoidal pulses: y rises to offset + amplitude, stays, falls back and rests.

    rising, width and falling must fit into the period; a rise or fall of 0 s is a jump.

    Source: MSL Blocks.Sources.Trapezoid.
    """

    rising = parameter("s", "how long it rises", min=0)
    width = parameter("s", "how long it stays at offset + amplitude", min=0)
    falling = parameter("s", "how long it falls", min=0)
    mode = mode("low", "rising", "high", "falling", doc="where in the period")

    def equations(self) -> Stated:
        up = portion(self.elapsed, self.rising)
        down = 1 - portion(self.elapsed - self.rising - self.width, self.falling)
        shape = self.mode.choose(low=0.0, rising=up, high=1.0, falling=down)
        yield self.y == self.offset + self.amplitude * shape

    def transitions(self) -> Stated:
        top = self.rising + self.width
        yield self.mode.goes("low", "rising", when=self.next_period, reset=self.begun)
        yield self.mode.goes("rising", "high", when=self.elapsed > self.rising)
        yield self.mode.goes("high", "falling", when=self.elapsed > top)
        yield self.mode.goes("falling", "low", when=self.elapsed > top + self.falling)
