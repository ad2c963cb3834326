"""Order tracking: what a signal is made of by how often it comes in a turn of a shaft."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ...base import Array, ModelError, above, at_least, demand, instance, one_name
from ..results.over_time import OverTime
from .spectrograms import MOST_SAMPLES, ChangingSpectrum, amplitudes_in_windows, drawn, strongest_part

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SAMPLES_AN_ORDER = 8  # in a turn, for each order
ANGLES = 100_001  # instants at which the angle is taken


@dataclass(frozen=True, eq=False)
class OrderSpectrum(ChangingSpectrum):
    """What a signal is made of while a shaft turns: order n comes n times a turn, however fast that is.

    Attributes:
        name, unit: of the signal.
        time: middles of the windows [s], counted in turns.
        speed: of the shaft, mean of each window [rad/s].
        order: times a turn.
        amplitude: (orders, windows), in the signal's unit.
    """

    speed: Array
    order: Array

    def track(self, order: float) -> Array:
        """Return the amplitude of the nearest order in each window."""
        demand("track()", order=(order, at_least(0)))
        if order > self.order[-1]:
            raise ModelError(f"the orders end at {self.order[-1]:g}, got {order:g}; give a higher highest=")
        return np.asarray(self.amplitude[int(np.abs(self.order - order).argmin())])

    def strongest(self) -> Array:
        """Return the order of the greatest amplitude in each window, the mean left out."""
        return strongest_part(self, self.order)

    def plot(self, axes: Any = None) -> Figure:
        """Draw amplitudes over speed and order; over time if the speed does not rise or fall throughout."""
        steps = np.diff(np.abs(self.speed))
        if len(steps) and ((steps > 0).all() or (steps < 0).all()):
            return drawn(self, self.speed, self.order, ("speed [rad/s]", "order"), axes)
        return drawn(self, self.time, self.order, ("time [s]", "order"), axes)


def order_tracking(
    run: OverTime, name: str, shaft: str, *, turns: float = 8.0, highest: float = 20.0
) -> OrderSpectrum:
    """Return the amplitudes of a signal's orders while a shaft runs up or down.

    The signal is taken at equal angles (computed order tracking), then transformed in Hann windows of some
    turns, each an eighth of its length after the last; orders lie 1/turns apart.

    Args:
        run: a `Result`, or anything else that is `OverTime`, as `Recorded(table)`.
        name: of the signal.
        shaft: angle [rad] or speed [rad/s] of the shaft, by name; an angle in a table without units.
        turns: length of a window.
        highest: order up to which amplitudes are kept.

    Raises:
        UnknownNameError: for an unknown name, with the nearest one.
        ModelError: for a shaft that turns back or stands, for fewer turns than a window has, for windows too
            short for one order.

    Limits: what comes more than 4 times as often as the highest order folds back.

    Source: Fyfe & Munck, Mechanical Systems and Signal Processing 11 (1997) 187-205.

    Example:
        >>> import numpy as np, pandas as pd
        >>> from inertance import Recorded
        >>> from inertance.analysis import order_tracking
        >>> t = np.arange(0.0, 10.0, 1e-4)
        >>> phi = 20 * t + 10 * t**2
        >>> run = Recorded(pd.DataFrame({"phi": phi, "y": 3 * np.cos(2.5 * phi)}, index=t))
        >>> told = order_tracking(run, "y", "phi", highest=5)
        >>> round(float(told.strongest().mean()), 2), round(float(told.track(2.5).mean()), 2)
        (2.5, 3.0)
    """
    demand(
        "order_tracking()",
        run=(run, instance(OverTime)),
        name=(name, one_name),
        shaft=(shaft, one_name),
        turns=(turns, above(0)),
        highest=(highest, above(0)),
    )
    instants, angle = _turned(run, shaft)
    whole = abs(angle[-1]) / (2 * np.pi)
    per_turn = max(SAMPLES_AN_ORDER * highest, 4.0)
    if not 2.0 <= turns <= whole:
        raise ModelError(
            f"windows of {turns:g} turns do not fit: at least 2, and '{shaft}' of '{run.name}' makes "
            f"{whole:g}"
        )
    if whole * per_turn > MOST_SAMPLES:
        raise ModelError(
            f"{whole:g} turns at order {highest:g} are over {MOST_SAMPLES:g} samples; give a lower highest="
        )
    at = np.arange(int(whole * per_turn) + 1) / per_turn
    times = np.interp(2 * np.pi * at, np.abs(angle), instants)
    middles, order, amplitude = amplitudes_in_windows(run.at(name, times), per_turn, turns)
    ends = [np.interp(middles + side * turns / 2, at, times) for side in (-1, 0, 1)]
    speed = np.sign(angle[-1]) * 2 * np.pi * turns / (ends[2] - ends[0])
    kept = order <= highest * (1 + 1e-9)
    return OrderSpectrum(name, run.unit(name), ends[1], amplitude[kept], speed, order[kept])


def _turned(run: OverTime, shaft: str) -> tuple[Array, Array]:
    """Return instants, and the angle the shaft has turned by since the first."""
    from scipy.integrate import cumulative_trapezoid

    instants = np.union1d(run.time, np.linspace(run.time[0], run.time[-1], ANGLES))
    values = np.asarray(run.at(shaft, instants))
    if run.unit(shaft) == "rad/s":
        values = cumulative_trapezoid(values, instants, initial=0.0)
    elif run.unit(shaft) not in ("rad", ""):
        raise ModelError(
            f"'{shaft}' of '{run.name}' is in {run.unit(shaft)}; name the angle [rad] or speed [rad/s] of a "
            "shaft"
        )
    angle = values - values[0]
    steps = np.diff(angle) * (np.sign(angle[-1]) or 1.0)
    if not (steps > 0).all():
        at = float(instants[int(np.argmin(steps > 0))])
        raise ModelError(
            f"'{shaft}' of '{run.name}' stands or turns back at {at:g} s; order tracking needs a shaft that "
            "turns one way throughout"
        )
    return instants, angle
