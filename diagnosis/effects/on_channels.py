"""Effects on a channel: what sensors and actuators do to a signal."""

from __future__ import annotations

from collections.abc import Callable
from math import inf
from typing import Any

import numpy as np

from ...base import Array
from ...identification import Prior
from .. import criteria
from .effect import Effect, Quantity, Values, register

_WIDTH = Quantity("width", "unit")
_DELAY = Quantity("delay", "s", -inf)


def _late(t: Array, y: Array, p: Values) -> Array:
    """Return a signal that comes late, or early if the delay is negative, curved as runs take it.

    Before its first and after its last sample it goes on as the parabola through that sample, and those once
    and twice as far inside.
    """
    from scipy.interpolate import CubicSpline

    curve, at = CubicSpline(t, y), t - p["delay"]
    end = np.clip(at, t[0], t[-1])
    once, twice = (np.clip(end + count * (end - at), t[0], t[-1]) for count in (1, 2))
    return np.asarray(3 * curve(end) - 3 * curve(once) + curve(twice))


def _lagging(t: Array, y: Array, p: Values) -> Array:
    """Return what follows y with time constant T, y being curved between its samples as runs take it.

    On a cubic y it nears y less T, T^2, T^3 times its derivatives in turn, as exp(-t/T).
    """
    from scipy.interpolate import CubicSpline
    from scipy.signal import lfilter

    lag, step = p["T"], float(t[1] - t[0])
    if lag <= 0:
        return y
    third, second, first, value = CubicSpline(t, y - y[0]).c
    jerk = 6 * third
    begins = _steady(value, first, 2 * second, jerk, lag)
    value = value + step * (first + step * (second + step * third))
    first, second = first + step * (2 * second + step * 3 * third), second + step * 3 * third
    decay = np.exp(-step / lag)
    followed = lfilter([1.0], [1.0, -decay], _steady(value, first, 2 * second, jerk, lag) - decay * begins)
    return np.asarray(y[0] + np.append(0.0, followed))


def _steady(value: Array, speed: Array, acceleration: Array, jerk: Array, lag: float) -> Array:
    """Return what a lag makes of a cubic in the long run."""
    return value - lag * (speed - lag * (acceleration - lag * jerk))


def _dead_zone(t: Array, y: Array, p: Values) -> Array:
    return np.asarray(y - np.clip(y, -p["width"], p["width"]))


def _limited(t: Array, y: Array, p: Values) -> Array:
    """Return a signal less a share of what is above a limit; all of it if the limit is hard."""
    return y - p["share"] * (y - np.clip(y, -p["limit"], p["limit"]))


def _played(t: Array, y: Array, p: Values) -> Array:
    """Return what follows y with play: it stands still until y has crossed the gap.

    It begins `ahead` of y by a share of the width, in the middle if that is not told.
    """
    width, followed = p["width"], list[float]()
    at = float(y[0]) + p.get("ahead", 0.0) * width
    for value in y.tolist():
        at = min(max(at, value - width), value + width)
        followed.append(at)
    return np.array(followed)


def _on_channel(
    kind: str, change: Callable[[Array, Array, Values], Array], *quantities: Quantity, **more: Any
) -> None:
    step = criteria.CHANNEL_STEP_RATIO
    register(Effect(kind, "channel", {"channel": quantities}, change=change, step=step, **more))


_on_channel("sensor_delay", _late, _DELAY)
_on_channel("sensor_bias", lambda t, y, p: y + p["bias"], Quantity("bias", "unit", -inf))
_on_channel("sensor_gain", lambda t, y, p: y * (1 + p["gain"]), Quantity("gain", "1", -inf))
_on_channel(
    "sensor_drift",
    lambda t, y, p: y + (p["rate"] + p["bend"] * t) * t,
    Quantity("rate", "unit/s", -inf),
    Quantity("bend", "unit/s2", -inf),
    ages=True,
)
_on_channel("actuator_delay", _late, _DELAY, drives=True)
_on_channel("actuator_lag", _lagging, Quantity("T", "s"), drives=True)
_on_channel("actuator_dead_zone", _dead_zone, _WIDTH, drives=True)
_on_channel("actuator_backlash", _played, _WIDTH, drives=True, begins={"ahead": Prior(0.0, inf, -1.0, 1.0)})
_on_channel(
    "actuator_saturation",
    _limited,
    Quantity("share", "1"),
    Quantity("limit", "unit", 0.0, True),
    drives=True,
    shapes=lambda site: [{"limit": r * site.travel} for r in criteria.LIMIT_RATIOS],
)
