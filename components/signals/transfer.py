"""Linear blocks with several states: a second-order lag, and any transfer function."""

from typing import Any

from ...base import ModelError, number
from ..language import Component, Stated, der, option, parameter, variable
from .blocks import SISO


class SecondOrder(SISO):
    """Second-order lag: y'' + 2 D w y' + w^2 y = k w^2 u.

    Source: MSL Blocks.Continuous.SecondOrder.
    """

    k = parameter("", "gain", default=1.0)
    w = parameter("rad/s", "angular frequency", above=0)
    D = parameter("1", "damping ratio", min=0)
    x = variable("", "output")
    yd = variable("", "rate of the output")

    def equations(self) -> Stated:
        yield self.y == self.x
        yield der(self.x) == self.yd
        yield der(self.yd) == self.w * (self.w * (self.k * self.u - self.x) - 2 * self.D * self.yd)


def coefficients(given: Any) -> str:
    """Check the coefficients of a polynomial in s."""
    good = isinstance(given, tuple) and given and not any(map(number, given)) and given[0] != 0
    return "" if good else "takes a tuple of numbers, highest power of s first, the first not 0"


class TransferState(Component):
    """One state of a `TransferFunction`."""

    x = variable("", "state")


class TransferFunction(SISO):
    """Transfer function: y = (b[0] s^m + ... + b[m])/(a[0] s^n + ... + a[n]) u, with m <= n.

    States in controller canonical form: a[0] x1' = u - a[1] x1 - ... - a[n] xn, xk' = x(k-1).

    Source: MSL Blocks.Continuous.TransferFunction, whose states are scaled.

    Example:
        >>> from inertance import signals
        >>> plant = signals.TransferFunction(b=(2.0, 3.0), a=(4.0, 5.0, 6.0))  # (2 s + 3)/(4 s^2 + 5 s + 6)
    """

    b = option("coefficients of the numerator, highest power first", default=(1.0,), check=coefficients)
    a = option("coefficients of the denominator, highest power first", default=(1.0, 1.0), check=coefficients)

    def parts(self) -> dict[str, Component]:
        """Return the states."""
        return {f"state{k}": TransferState() for k in range(1, len(self.a))}

    def equations(self) -> Stated:
        if len(self.b) > len(self.a):
            raise ModelError(f"b has {len(self.b)} coefficients; it may have as many as a, {len(self.a)}")
        x = [getattr(self, f"state{k}").x for k in range(1, len(self.a))]
        b = (0.0,) * (len(self.a) - len(self.b)) + self.b
        first = (self.u - sum(a * state for a, state in zip(self.a[1:], x, strict=True))) / self.a[0]
        yield self.y == b[0] * first + sum(weight * state for weight, state in zip(b[1:], x, strict=True))
        for state, rate in zip(x, [first, *x], strict=False):
            yield der(state) == rate
