"""Blocks that switch: each change is an event."""

from ..language import (
    BooleanInput,
    BooleanOutput,
    Component,
    IntegerOutput,
    RealInput,
    RealOutput,
    Stated,
    mode,
    parameter,
)
from .blocks import SISO


class Sign(SISO):
    """Sign: y = 1 for u > 0, -1 for u < 0; 0 where it begins at u = 0.

    Source: MSL Blocks.Math.Sign with generateEvent.
    """

    y = IntegerOutput("1", "-1, 0 or 1")
    mode = mode("zero", "positive", "negative", doc="sign of the input")

    def equations(self) -> Stated:
        yield self.y == self.mode.choose(zero=0.0, positive=1.0, negative=-1.0)

    def transitions(self) -> Stated:
        for other in ("zero", "negative"):
            yield self.mode.goes(other, "positive", when=self.u > 0)
        for other in ("zero", "positive"):
            yield self.mode.goes(other, "negative", when=self.u < 0)


class Hysteresis(SISO):
    """Two-point switch: y goes from 0 to 1 as u rises above uHigh, and back as u falls below uLow.

    It starts at 0, or at 1 if u is above uHigh there.

    Source: MSL Blocks.Logical.Hysteresis, whose y is Boolean.
    """

    y = BooleanOutput("1", "whether it is on")
    uLow = parameter("", "input below which it switches off", default=0.0)
    uHigh = parameter("", "input above which it switches on, above uLow", default=1.0)
    mode = mode("off", "on", doc="y = 0 or 1")

    def equations(self) -> Stated:
        yield self.y == self.mode.choose(off=0.0, on=1.0)

    def transitions(self) -> Stated:
        yield self.mode.goes("off", "on", when=self.u > self.uHigh)
        yield self.mode.goes("on", "off", when=self.u < self.uLow, allowed=self.uLow < self.uHigh)


class Switch(Component):
    """One signal or another: y = u1 while u2 > threshold, else u3.

    Source: MSL Blocks.Logical.Switch, whose u2 is Boolean: here it is on above `threshold`.
    """

    u1 = RealInput("", "passed on while u2 is on")
    u2 = RealInput("", "what switches")
    u3 = RealInput("", "passed on while u2 is off")
    y = RealOutput("", "output")
    threshold = parameter("", "value of u2 above which it is on", default=0.5)
    mode = mode("off", "on", doc="u3 or u1")

    def equations(self) -> Stated:
        yield self.y == self.mode.choose(off=self.u3, on=self.u1)

    def transitions(self) -> Stated:
        yield self.mode.goes("off", "on", when=self.u2 > self.threshold)
        yield self.mode.goes("on", "off", when=self.u2 < self.threshold)


class BooleanToReal(Component):
    """A number for on and one for off: y = realTrue while u is 1, realFalse while u is 0.

    Left to the run, u is a Boolean input of an FMU: what switches a clutch, a brake or a `Switch` behind it.

    Source: MSL Blocks.Math.BooleanToReal.
    """

    u = BooleanInput("1", "0 or 1")
    y = RealOutput("", "output")
    realTrue = parameter("", "output while u is 1", default=1.0)
    realFalse = parameter("", "output while u is 0", default=0.0)

    def equations(self) -> Stated:
        yield self.y == self.realFalse + (self.realTrue - self.realFalse) * self.u
