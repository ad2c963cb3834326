"""Controllers."""

from ..language import Component, Expression, RealInput, RealOutput, Stated, der, parameter, variable
from ..limits import limited
from .blocks import SISO


class PI(SISO):
    """Proportional and integral: y = k (u + x) with T x' = u, which is k (1 + 1/(T s)).

    Source: MSL Blocks.Continuous.PI.
    """

    k = parameter("", "gain", default=1.0)
    T = parameter("s", "integral time", above=0)
    x = variable("", "integral part")

    def equations(self) -> Stated:
        yield self.y == self.k * (self.u + self.x)
        yield self.T * der(self.x) == self.u


class PID(SISO):
    """Proportional, integral and filtered derivative: k (1 + 1/(Ti s) + Td s/(1 + Td s/Nd)).

    Source: MSL Blocks.Continuous.PID.
    """

    k = parameter("", "gain", default=1.0)
    Ti = parameter("s", "integral time", above=0)
    Td = parameter("s", "derivative time", above=0)
    Nd = parameter("1", "derivative time over its filter's time constant", above=0, default=10.0)
    x = variable("", "integral part")
    filtered = variable("", "input of the derivative part, filtered")

    def equations(self) -> Stated:
        lag = self.u - self.filtered
        yield self.y == self.k * (self.u + self.x + self.Nd * lag)
        yield self.Ti * der(self.x) == self.u
        yield self.Td * der(self.filtered) == self.Nd * lag


class LimPI(Component):
    """PI controller with limited output, anti-windup and weight of the setpoint.

    y = min(max(v, y_min), y_max), v = k (wp u_s - u_m + x), Ti x' = u_s - u_m + (y - v)/(k Ni).

    Source: MSL Blocks.Continuous.LimPID, controllerType PI.
    """

    u_s = RealInput("", "setpoint")
    u_m = RealInput("", "measurement")
    y = RealOutput("", "limited output")
    k = parameter("", "gain", above=0)
    Ti = parameter("s", "integral time", above=0)
    y_max = parameter("", "upper limit of the output")
    y_min = parameter("", "lower limit of the output", default=lambda self: -self.y_max)
    Ni = parameter("1", "anti-windup time over integral time", above=0, default=0.9)
    wp = parameter("1", "weight of the setpoint in the proportional part", min=0, default=1.0)
    x = variable("", "integral part")
    v = variable("", "output before the limits")

    @property
    def rate(self) -> Expression:
        """Derivative part."""
        return 0.0

    def equations(self) -> Stated:
        error, cut = self.u_s - self.u_m, self.y - self.v
        yield self.v == self.k * (self.wp * self.u_s - self.u_m + self.x + self.rate)
        yield self.y == limited(self.v, self.y_min, self.y_max)
        yield self.Ti * der(self.x) == error + cut / (self.k * self.Ni)


class LimPID(LimPI):
    """PID controller with limited output, anti-windup and weights of the setpoint.

    As `LimPI`, with Nd (e - x_d) added inside v, Td x_d' = Nd (e - x_d) and e = wd u_s - u_m.

    Source: MSL Blocks.Continuous.LimPID, controllerType PID.
    """

    Td = parameter("s", "derivative time", above=0)
    Nd = parameter("1", "derivative time over its filter's time constant", above=0, default=10.0)
    wd = parameter("1", "weight of the setpoint in the derivative part", min=0, default=0.0)
    x_d = variable("", "input of the derivative part, filtered")

    @property
    def rate(self) -> Expression:
        """Derivative part."""
        return self.Nd * (self.wd * self.u_s - self.u_m - self.x_d)

    def equations(self) -> Stated:
        yield self.Td * der(self.x_d) == self.rate
