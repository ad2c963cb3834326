"""Polynomial inputs: set piece by piece while a run goes on."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from ...base import demand, whole


@dataclass(frozen=True)
class Polynomial:
    """An input that is a polynomial of time, exchanged on the way: u = c0 + c1 (t - t0) + c2 (t - t0)^2 ...

    Its instant t0 and its coefficients are constants of a segment, so that one compiled integrator serves
    all pieces. Derivatives of the input are those of the polynomial.

    Args:
        degree: highest power.
    """

    degree: int = 1

    def __post_init__(self) -> None:
        demand("a Polynomial", degree=(self.degree, whole(0)))

    def along(self, course: Any) -> Callable[[Any], Any]:
        """Return the signal, from the symbols of its instant and coefficients."""

        def signal(t: Any) -> Any:
            value = course[self.degree + 1]
            for power in range(self.degree, 0, -1):
                value = value * (t - course[0]) + course[power]
            return value

        return signal
