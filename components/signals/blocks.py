"""Blocks: without memory, and with states."""

from ...base import counting
from ..language import Component, RealInput, RealOutput, Stated, der, option, parameter, variable
from ..limits import limited


class SISO(Component):
    """What a block with a single input and a single output has: u in, y out."""

    u = RealInput("", "input")
    y = RealOutput("", "output")


class Gain(SISO):
    """Gain: y = k u.

    Source: MSL Blocks.Math.Gain.
    """

    k = parameter("", "gain", default=1.0)

    def equations(self) -> Stated:
        yield self.y == self.k * self.u


class Limiter(SISO):
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


class FirstOrder(SISO):
    """First-order lag: T y' + y = k u, with the state x = y.

    Source: MSL Blocks.Continuous.FirstOrder.
    """

    k = parameter("", "gain", default=1.0)
    T = parameter("s", "time constant", above=0)
    x = variable("", "state")

    def equations(self) -> Stated:
        yield self.y == self.x
        yield der(self.x) == (self.k * self.u - self.x) / self.T


class Integrator(SISO):
    """Integral: y' = k u, with the state x = y.

    Source: MSL Blocks.Continuous.Integrator.
    """

    k = parameter("", "gain", default=1.0)
    x = variable("", "state")

    def equations(self) -> Stated:
        yield self.y == self.x
        yield der(self.x) == self.k * self.u


class Derivative(SISO):
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


class DelayStage(Component):
    """One stage of a `Delay`: its state and the signal that runs through it."""

    x = variable("", "state")
    i = variable("", "signal through the stage", state="avoid")


class Delay(SISO):
    """Transport delay by the Pade approximation of order n: y(t) ~ u(t - T).

    exp(-T s) ~ (1 - h)/(1 + h), where h is Lambert's continued fraction of tanh(T s/2) cut after n
    terms, q/(1 + q^2/(3 + q^2/(5 + ...))) with q = T s/2: a ladder of n stages with one state each.

    Limits: the amplitude is exact at every frequency. The phase, for n = 5, lags too little by 2e-6 rad
    at omega T = n/2, 3e-3 rad at n and 0.6 rad at 2n: smooth signals are delayed well. A jump is not:
    y jumps at once by (-1)^n of it, then rings. The stages start at 0, as if u had been 0 before; to
    start with a constant u0 behind, fix `stage1.x` at u0.

    Source: J. H. Lambert, Memoires sur quelques proprietes remarquables des quantites
    transcendentes (1768); MSL Blocks.Nonlinear.PadeDelay for the order and its limits.
    """

    T = parameter("s", "delay", above=0)
    n = option("order: number of stages", default=5, check=counting)

    def parts(self) -> dict[str, Component]:
        """Return the stages."""
        return {f"stage{k}": DelayStage() for k in range(1, self.n + 1)}

    def equations(self) -> Stated:
        stages = [getattr(self, f"stage{k}") for k in range(1, self.n + 1)]
        entering = (self.u + self.y) / 2
        through = [entering, *[stage.i for stage in stages], 0.0]
        yield self.u - self.y == 2 * through[1]
        for k, stage in enumerate(stages, start=1):
            yield through[k - 1] == stage.x + through[k + 1]
            yield self.T / 2 * der(stage.x) == (2 * k - 1) * stage.i
