"""`RationalFunction`: a quotient of polynomials in s, from coefficients, a linear system, or data."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...base import Array, ModelError, between, demand, finite, numbers, shown, text
from ..analysis.statespace import StateSpace

GIVEN_ACCURACY, COMPUTED_ACCURACY = 1e-14, 1e-11
LARGEST_FREQUENCY = 1e30  # [rad/s]


@dataclass(frozen=True, eq=False)
class RationalFunction:
    """A quotient of polynomials, F(s) = (n_m s^m + ... + n_0) / (d_n s^n + ... + d_0).

    Args:
        num: coefficients of the numerator, highest power first, as in SciPy and python-control.
        den: those of the denominator.
        accuracy: relative error of the coefficients; a violation or a remainder below it is rounding.

    Raises:
        ModelError: if a coefficient is not finite, or the denominator is zero.

    Example:
        >>> from inertance.synthesis import RationalFunction
        >>> Y = RationalFunction([1.0, 0.0], [1.0, 2.0])
        >>> round(float(abs(Y(2j))), 6)
        0.707107
    """

    num: tuple[float, ...]
    den: tuple[float, ...]
    accuracy: float

    def __init__(self, num: ArrayLike, den: ArrayLike, accuracy: float = GIVEN_ACCURACY) -> None:
        for name, given in (("num", num), ("den", den)):
            if numbers(finite())(given):
                raise ModelError(f"{name} must be finite real numbers, got {given!r}")
            coefficients = np.trim_zeros(np.atleast_1d(np.asarray(given, dtype=float)).ravel(), "f")
            object.__setattr__(self, name, tuple(float(c) for c in coefficients))
        demand("a RationalFunction", accuracy=(accuracy, between(0, 1)))
        object.__setattr__(self, "accuracy", accuracy)
        if not self.den:
            raise ModelError("the denominator must not be zero")

    def __call__(self, s: ArrayLike) -> Any:
        """Return the value at complex frequencies [rad/s]."""
        try:
            at = np.asarray(None if isinstance(s, str | bytes) or s is None else s, dtype=np.complex128)
        except (TypeError, ValueError, OverflowError):
            at = np.array(np.nan)
        if not (np.abs(at) < LARGEST_FREQUENCY).all() or numbers(text)(s) == "":
            raise ModelError(f"a rational function is taken at finite numbers [rad/s], got {shown(s)}")
        if (np.polyval(np.array(self.den), at) == 0).any():
            raise ModelError(f"a rational function is infinite at its poles, got {shown(s)} rad/s")
        value = np.polyval(np.array(self.num or (0.0,)), at) / np.polyval(np.array(self.den), at)
        return value[()]

    @property
    def degree(self) -> int:
        """The higher degree of both polynomials."""
        return max(len(self.num), len(self.den), 1) - 1

    @property
    def poles(self) -> NDArray[np.complex128]:
        """Finite poles [rad/s]."""
        return np.roots(self.den).astype(np.complex128)

    @property
    def zeros(self) -> NDArray[np.complex128]:
        """Finite zeros [rad/s]."""
        return np.roots(self.num or (1.0,)).astype(np.complex128)

    @classmethod
    def of(cls, given: Any) -> RationalFunction:
        """Return what is given as a rational function.

        Args:
            given: a `RationalFunction`, a pair (num, den), an `analysis.StateSpace` of one input and output,
                or a system of python-control or `scipy.signal`.

        Raises:
            ModelError: for anything else.
        """
        if isinstance(given, cls):
            return given
        if isinstance(given, StateSpace):
            return _of_state_space(given)
        if hasattr(given, "num") and hasattr(given, "den"):
            return cls(_inner(given.num), _inner(given.den))
        if isinstance(given, tuple | list) and len(given) == 2:
            return cls(*given)
        if hasattr(given, "A"):
            return _of_state_space(StateSpace.from_ss(given))
        raise ModelError(
            "an admittance is a RationalFunction, a pair of coefficients (num, den), a StateSpace, or a "
            f"system of python-control or scipy.signal; got {given!r}"
        )


def _inner(coefficients: Any) -> Any:
    """Return the array in python-control's num[output][input]."""
    while isinstance(coefficients, list) and len(coefficients) == 1 and np.ndim(coefficients[0]):
        coefficients = coefficients[0]
    if isinstance(coefficients, np.ndarray) and coefficients.dtype == object:
        coefficients = coefficients.ravel()[0]
    return coefficients


def _of_state_space(system: StateSpace) -> RationalFunction:
    """Return C (s - A)^-1 B + D + D_s s + ..., whose numerator has the coefficients det(s - A + B C) - ..."""
    if len(system.inputs) != 1 or len(system.outputs) != 1:
        raise ModelError(
            f"'{system.name}' has {len(system.inputs)} inputs and {len(system.outputs)} outputs; "
            "pick a pair: system[output, input]"
        )
    small = system.minimal()
    rate = float(np.abs(small.poles).max(initial=0.0)) or 1.0
    A, B, C = small.A / rate, small.B / rate, small.C
    gain = float(np.linalg.norm(B) * np.linalg.norm(C)) or 1.0
    den: Array = np.asarray(np.real(np.poly(A)) if len(A) else np.ones(1), dtype=np.float64)
    zeros = np.real(np.poly(A - B @ C / gain)) if len(A) else den
    num: Array = np.asarray((zeros - den) * gain, dtype=np.float64)
    reached = abs(num) + float(np.abs(small.D).max(initial=0.0)) * abs(den)
    for order, D in enumerate((small.D, *small.D_s)):
        num = np.r_[np.zeros(order + len(den) - len(num)), num]
        num += np.r_[float(D.item()) * rate**order * den, np.zeros(order)]
    num[np.abs(num) <= COMPUTED_ACCURACY * np.abs(np.r_[num, reached]).max()] = 0.0
    den[np.abs(den) <= COMPUTED_ACCURACY * np.abs(den).max()] = 0.0
    return RationalFunction(_at_rate(num, rate), _at_rate(den, rate), COMPUTED_ACCURACY)


def _at_rate(coefficients: Array, rate: float) -> Array:
    return coefficients / rate ** np.arange(len(coefficients) - 1, -1, -1.0)
