"""Sampled signals: measured data as a smooth function of time."""

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import ModelError


@dataclass(frozen=True, eq=False)
class Sampled:
    """A signal known at instants, twice continuously differentiable in between (spline).

    Args:
        time: instants [s], increasing, shape (n,), n >= 4.
        values: the signal at these instants, shape (n,), in the SI unit of what it drives.

    Raises:
        ModelError: if time does not increase, lengths differ, or a value is not finite.

    Limits: outside its instants the spline is extrapolated; keep a run inside the record.

    Example:
        >>> import numpy as np
        >>> from inertance import Sampled
        >>> t = np.linspace(0, 1, 101)
        >>> road = Sampled(t, 0.01 * np.sin(2 * np.pi * t))
    """

    time: NDArray[np.float64]
    values: NDArray[np.float64]

    def __init__(self, time: ArrayLike, values: ArrayLike) -> None:
        try:
            object.__setattr__(self, "time", np.array(time, dtype=float).ravel())
            object.__setattr__(self, "values", np.array(values, dtype=float).ravel())
        except (TypeError, ValueError) as error:
            raise ModelError(f"Sampled signal: time and values must be numbers ({error})") from None
        problem = self._problem()
        if problem:
            raise ModelError(f"Sampled signal: {problem}")

    def _problem(self) -> str:
        if len(self.time) != len(self.values):
            return f"{len(self.time)} instants but {len(self.values)} values"
        if len(self.time) < 4:
            return f"at least 4 samples are needed for a smooth signal, got {len(self.time)}"
        for name, column in (("time", self.time), ("value", self.values)):
            bad = np.flatnonzero(~np.isfinite(column))
            if len(bad):
                return f"{name} {column[bad[0]]} at sample {bad[0]}; remove or fill it"
        step = np.diff(self.time)
        if (step <= 0).any():
            i = int(np.argmax(step <= 0))
            return f"time does not increase after sample {i} (t = {self.time[i]:g} s); sort it"
        return ""

    def at(self, times: ArrayLike, order: int = 0) -> NDArray[np.float64]:
        """Return the signal, or its derivative of some `order`, at instants [s]."""
        values: NDArray[np.float64] = self.cubic(times, order)
        return values

    @property
    def cubic(self) -> Any:
        """The spline as a `scipy.interpolate.CubicSpline`."""
        return _cubic(self)

    def interpolant(self, name: str) -> Any:
        """Return the signal as a CasADi function of time (cubic B-spline, C2); zero outside its instants."""
        return _spline(self, name)

    def curvature(self, name: str) -> Any:
        """Return the second derivative of the signal as a CasADi function of time.

        It is linear between instants. CasADi 3.8.2 writes beyond its memory when the spline itself is
        differentiated three times; this function can be differentiated once more.
        """
        return _curvature(self, name)


@lru_cache(maxsize=64)
def _cubic(signal: Sampled) -> Any:
    from scipy.interpolate import CubicSpline

    return CubicSpline(signal.time, signal.values)


@lru_cache(maxsize=64)
def _spline(signal: Sampled, name: str) -> Any:
    import casadi as ca
    from scipy.interpolate import make_interp_spline

    spline = make_interp_spline(signal.time, signal.values)
    return ca.Function.bspline(name, [spline.t.tolist()], spline.c.tolist(), [3], 1)


@lru_cache(maxsize=64)
def _curvature(signal: Sampled, name: str) -> Any:
    import casadi as ca

    return ca.interpolant(name, "linear", [signal.time], signal.at(signal.time, 2))
