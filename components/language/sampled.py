"""Sampled signals: measured data as a function of time."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...base.errors import ModelError

INTERPOLATIONS = ("cubic", "linear", "hold")
LEAST_SAMPLES = {"cubic": 4, "linear": 2, "hold": 2}
EXTRAPOLATIONS = ("none", "hold")
OVERRUN_SHARE = 1e-9  # share of a run by which it may go beyond its data, for rounding
REMEDIES = {
    "M": "; give seconds, (t - t[0]) / np.timedelta64(1, 's')",
    "m": "; give seconds, t / np.timedelta64(1, 's')",
    "c": "; give its real part or its size",
    "b": "; give 0.0 and 1.0",
}


@dataclass(frozen=True, eq=False)
class Sampled:
    """A signal known at instants, and what it is in between and beyond.

    Args:
        time: instants [s], increasing, shape (n,).
        values: the signal at these instants, shape (n,), in the SI unit of what it drives.
        interpolation: "cubic", a spline that is twice continuously differentiable (n >= 4), "linear"
            (n >= 2), which never goes beyond the samples but has no derivative: for data that jump, or
            "hold" (n >= 2), which keeps each sample until the next: for commands of digital controllers.
            Each jump is an event; where it prescribes a motion, it acts as a shock.
        extrapolation: "none", with which a run that goes beyond the instants is refused, or "hold", with
            which the signal keeps its first value before them and its last one after.

    Raises:
        ModelError: if time does not increase, lengths differ, or a value is no finite number.

    Source: MSL Blocks.Types, Smoothness (LinearSegments, ConstantSegments) and Extrapolation
    (NoExtrapolation, HoldLastPoint).

    Example:
        >>> import numpy as np
        >>> from inertance import Sampled
        >>> t = np.linspace(0, 1, 101)
        >>> road = Sampled(t, 0.01 * np.sin(2 * np.pi * t), extrapolation="hold")
    """

    time: NDArray[np.float64]
    values: NDArray[np.float64]
    interpolation: str
    extrapolation: str

    def __init__(
        self, time: ArrayLike, values: ArrayLike, *, interpolation: str = "cubic", extrapolation: str = "none"
    ) -> None:
        for name, choice, known in (
            ("interpolation", interpolation, INTERPOLATIONS),
            ("extrapolation", extrapolation, EXTRAPOLATIONS),
        ):
            if type(choice) is not str or choice not in known:
                told = " or ".join(f"'{one}'" for one in known)
                raise ModelError(f"Sampled signal: {name} is {told}, got {choice!r}")
            object.__setattr__(self, name, choice)
        object.__setattr__(self, "time", column("time", time))
        object.__setattr__(self, "values", column("values", values))
        problem = self._problem()
        if problem:
            raise ModelError(f"Sampled signal: {problem}")

    def covers(self, begin: float, stop: float) -> bool:
        """Return whether it is known from one instant to another [s]."""
        slack = OVERRUN_SHARE * (stop - begin) + 4 * float(np.spacing(max(abs(begin), abs(stop))))
        known = self.time[0] - slack <= begin and stop <= self.time[-1] + slack
        return self.extrapolation == "hold" or bool(known)

    def _problem(self) -> str:
        if len(self.time) != len(self.values):
            return f"{len(self.time)} instants but {len(self.values)} values"
        least = LEAST_SAMPLES[self.interpolation]
        if len(self.time) < least:
            smooth = {"cubic": "smooth", "linear": "linear", "hold": "held"}[self.interpolation]
            return f"at least {least} samples are needed for a {smooth} signal, got {len(self.time)}"
        for name, numbers in (("time", self.time), ("value", self.values)):
            bad = np.flatnonzero(~np.isfinite(numbers))
            if len(bad):
                return f"{name} {numbers[bad[0]]} at sample {bad[0]}; remove or fill it"
        step = np.diff(self.time)
        if (step <= 0).any():
            i = int(np.argmax(step <= 0))
            return f"time does not increase after sample {i} (t = {self.time[i]:g} s); sort it"
        return ""


def column(name: str, given: Any) -> NDArray[np.float64]:
    """Return real numbers as a vector of their own, masked ones as NaN; raise a ModelError for others."""
    try:
        array = np.asanyarray(given)
        kind = array.dtype.kind
        if kind not in "iufO":
            held = "text" if kind in "SU" else array.dtype
            raise TypeError(f"{name} is {held}{REMEDIES.get(kind, '')}")
        if array.size != max(array.shape, default=1):
            raise TypeError(f"{name} is one column, got an array of shape {array.shape}")
        numbers = np.array(array, dtype=float)
        return np.where(np.ma.getmaskarray(array), np.nan, numbers).ravel()
    except (TypeError, ValueError, OverflowError) as error:
        raise ModelError(f"Sampled signal: time and values must be numbers ({error})") from None
