"""Blocks without memory."""

import casadi as ca

from ..language import Component, Expression, RealInput, RealOutput, Stated, parameter


class Block(Component):
    """What a block with one input has: u in, y out."""

    u = RealInput("", "input")
    y = RealOutput("", "output")


class Gain(Block):
    """Gain: y = k u.

    Source: MSL Blocks.Math.Gain.
    """

    k = parameter("", "gain", default=1.0)

    def equations(self) -> Stated:
        yield self.y == self.k * self.u


class Limiter(Block):
    """Limits: y = min(max(u, y_min), y_max). Continuous, so it makes no event.

    Source: MSL Blocks.Nonlinear.Limiter.
    """

    y_max = parameter("", "upper limit")
    y_min = parameter("", "lower limit", default=lambda self: -self.y_max)

    def equations(self) -> Stated:
        yield self.y == limited(self.u, self.y_min, self.y_max)


class Add(Component):
    """Sum of two signals: y = k1 u1 + k2 u2; k2 = -1 makes it a difference.

    Source: MSL Blocks.Math.Add.
    """

    u1 = RealInput("", "first input")
    u2 = RealInput("", "second input")
    y = RealOutput("", "sum")
    k1 = parameter("", "weight of the first input", default=1.0)
    k2 = parameter("", "weight of the second input", default=1.0)

    def equations(self) -> Stated:
        yield self.y == self.k1 * self.u1 + self.k2 * self.u2


class Product(Component):
    """Product of two signals: y = u1 u2.

    Source: MSL Blocks.Math.Product.
    """

    u1 = RealInput("", "first input")
    u2 = RealInput("", "second input")
    y = RealOutput("", "product")

    def equations(self) -> Stated:
        yield self.y == self.u1 * self.u2


def limited(value: Expression, low: Expression, high: Expression) -> Expression:
    """Return a value brought between two limits."""
    return ca.fmin(ca.fmax(value, low), high)
