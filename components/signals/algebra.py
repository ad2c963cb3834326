"""Blocks without memory that compare and choose the larger, the smaller or the size of signals."""

import casadi as ca

from ..language import Component, RealInput, RealOutput, Stated
from .blocks import SISO


class _OfTwo(Component):
    u1 = RealInput("", "first input")
    u2 = RealInput("", "second input")
    y = RealOutput("", "output")


class Feedback(_OfTwo):
    """What is wanted less what is measured: y = u1 - u2.

    Source: MSL Blocks.Math.Feedback.
    """

    def equations(self) -> Stated:
        yield self.y == self.u1 - self.u2


class Max(_OfTwo):
    """The larger of two signals: y = max(u1, u2). Continuous, so it makes no event.

    Source: MSL Blocks.Math.Max.
    """

    def equations(self) -> Stated:
        yield self.y == ca.fmax(self.u1, self.u2)


class Min(_OfTwo):
    """The smaller of two signals: y = min(u1, u2). Continuous, so it makes no event.

    Source: MSL Blocks.Math.Min.
    """

    def equations(self) -> Stated:
        yield self.y == ca.fmin(self.u1, self.u2)


class Abs(SISO):
    """Size: y = |u|. Continuous, so it makes no event.

    Source: MSL Blocks.Math.Abs.
    """

    def equations(self) -> Stated:
        yield self.y == ca.fabs(self.u)
