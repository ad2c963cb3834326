"""Blocks with states: lag, integral and derivative."""

from ..language import Stated, der, parameter, variable
from .blocks import Block


class FirstOrder(Block):
    """First-order lag: T y' + y = k u, with the state x = y.

    Source: MSL Blocks.Continuous.FirstOrder.
    """

    k = parameter("", "gain", default=1.0)
    T = parameter("s", "time constant", above=0)
    x = variable("", "state")

    def equations(self) -> Stated:
        yield self.y == self.x
        yield der(self.x) == (self.k * self.u - self.x) / self.T


class Integrator(Block):
    """Integral: y' = k u, with the state x = y.

    Source: MSL Blocks.Continuous.Integrator.
    """

    k = parameter("", "gain", default=1.0)
    x = variable("", "state")

    def equations(self) -> Stated:
        yield self.y == self.x
        yield der(self.x) == self.k * self.u


class Derivative(Block):
    """Derivative of a filtered input: y = k (u - x)/T with T x' = u - x, which is k s/(T s + 1).

    The state x starts at 0 unless something fixes it: a run from u = u0 begins with y = k u0/T.
    Fix the output, `start={"name.y": 0.0}`, and it begins with a filter at rest.

    Source: MSL Blocks.Continuous.Derivative.
    """

    k = parameter("", "gain", default=1.0)
    T = parameter("s", "time constant of the filter", above=0)
    x = variable("", "filtered input")

    def equations(self) -> Stated:
        yield self.y == self.k * (self.u - self.x) / self.T
        yield self.T * der(self.x) == self.u - self.x
