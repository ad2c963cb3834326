"""Sampled signals: measured data as a smooth function of time."""

from dataclasses import dataclass

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
