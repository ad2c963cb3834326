"""Signals of time; where they jump or bend, the run makes a time event."""

from collections.abc import Iterable
from itertools import pairwise

import casadi as ca

from ...base import instant, rows
from ..language import Component, Expression, RealOutput, Stated, mode, option, parameter


class Source(Component):
    """What all signals of time have: an output y [unit of what it drives]."""

    y = RealOutput("", "signal")


class Constant(Source):
    """A constant signal: y = k.

    Source: MSL Blocks.Sources.Constant.
    """

    k = parameter("", "value")

    def equations(self) -> Stated:
        yield self.y == self.k


class Clock(Source):
    """Time as a signal: y = offset + time [s].

    Source: MSL Blocks.Sources.ContinuousClock.
    """

    y = RealOutput("s", "time")
    offset = parameter("s", "what it shows at time = 0", default=0.0)

    def equations(self) -> Stated:
        yield self.y == self.offset + self.time


class Step(Source):
    """A step: y = offset before start_time, offset + height from it on.

    Source: MSL Blocks.Sources.Step.
    """

    height = parameter("", "height of the step", default=1.0)
    offset = parameter("", "value before the step", default=0.0)
    start_time = parameter("s", "time of the step", default=0.0)
    mode = mode("before", "after", doc="before or after the step")

    def equations(self) -> Stated:
        yield self.y == self.offset + self.mode.choose(before=0.0, after=self.height)

    def transitions(self) -> Stated:
        yield self.mode.goes("before", "after", when=self.time > self.start_time)


class Ramp(Source):
    """A ramp: y = offset, then rising by height within duration, then offset + height.

    A duration of 0 makes it a step.

    Source: MSL Blocks.Sources.Ramp.
    """

    height = parameter("", "height of the ramp", default=1.0)
    duration = parameter("s", "how long it rises", min=0)
    offset = parameter("", "value before the ramp", default=0.0)
    start_time = parameter("s", "when it begins to rise", default=0.0)
    mode = mode("before", "rising", "after", doc="before, on or after the slope")

    def equations(self) -> Stated:
        share = portion(self.time - self.start_time, self.duration)
        yield self.y == self.offset + self.height * self.mode.choose(before=0.0, rising=share, after=1.0)

    def transitions(self) -> Stated:
        elapsed = self.time - self.start_time
        yield self.mode.goes("before", "rising", when=elapsed > 0)
        yield self.mode.goes("rising", "after", when=elapsed > self.duration)


class Sine(Source):
    """A sine: y = offset + amplitude sin(2 pi f (time - start_time) + phase).

    With `start_time` given, y = offset before it; without, the sine has always run and time counts
    from 0.

    Source: MSL Blocks.Sources.Sine.
    """

    amplitude = parameter("", "amplitude", default=1.0)
    f = parameter("Hz", "frequency")
    phase = parameter("rad", "phase at start_time", default=0.0)
    offset = parameter("", "mean", default=0.0)
    start_time = option("time [s] before which y = offset", default=None, check=instant)
    mode = mode("before", "running", doc="before or after start_time")

    def equations(self) -> Stated:
        since = self.time - (self.start_time or 0.0)
        wave = self.amplitude * ca.sin(2 * ca.pi * self.f * since + self.phase)
        held = self.start_time is not None
        gated = self.mode.choose(before=0.0, running=wave) if held else wave
        yield self.y == self.offset + gated

    def transitions(self) -> Stated:
        if self.start_time is not None:
            yield self.mode.goes("before", "running", when=self.time > self.start_time)


class TimeTable(Source):
    """A signal linear between the rows of a table; two rows of equal time make a jump.

    Before the first row y is the first value, after the last row the last one.

    Source: MSL Blocks.Sources.CombiTimeTable with extrapolation HoldLastPoint. For measured data,
    which wants no event at every sample, take `Sampled`.
    """

    table = option(
        "rows (time [s], value), times not decreasing",
        default=((0.0, 0.0),),
        check=rows(
            "takes rows (time, value) of finite numbers, times not decreasing",
            2,
            lambda given: all(a[0] <= b[0] for a, b in pairwise(given)),
        ),
    )

    def slopes(self) -> Iterable[tuple[str, Expression, Expression]]:
        """Yield a name, the row before and the row after, wherever the signal changes."""
        for number, (last, following) in enumerate(zip(self.table, self.table[1:], strict=False)):
            if last[1] != following[1]:
                yield f"slope{number}", last, following

    def parts(self) -> dict[str, Component]:
        """Return a ramp for each slope."""
        return {
            name: Ramp(height=y1 - y0, duration=t1 - t0, start_time=t0)
            for name, (t0, y0), (t1, y1) in self.slopes()
        }

    def equations(self) -> Stated:
        yield self.y == self.table[0][1] + sum(getattr(self, name).y for name, *_ in self.slopes())


def portion(elapsed: Expression, duration: Expression) -> Expression:
    """Return elapsed/duration, without dividing by a duration of zero."""
    return elapsed / ca.if_else(duration > 0, duration, 1.0)
