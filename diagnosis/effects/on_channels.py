"""Effects on a channel: what sensors and actuators do to a signal."""

from __future__ import annotations

from collections.abc import Callable
from math import inf

import numpy as np

from ...base import Array
from ..criteria import CHANNEL_STEP_RATIO
from .effect import Effect, Quantity, Values, register


def _lagging(t: Array, y: Array, p: Values) -> Array:
    """Return what follows y with time constant T, y being straight between its samples."""
    from scipy.signal import lfilter

    if p["T"] <= 0:
        return y
    step = float(t[1] - t[0])
    a = np.exp(-step / p["T"])
    share = p["T"] / step * (1 - a)
    lagging: Array = y[0] + lfilter([1 - share, share - a], [1, -a], y - y[0])
    return lagging


def _dead_zone(t: Array, y: Array, p: Values) -> Array:
    middle = float(np.median(y))
    return middle + np.sign(y - middle) * np.maximum(np.abs(y - middle) - p["width"], 0)


def _on_channel(
    kind: str,
    name: str,
    unit: str,
    low: float,
    change: Callable[[Array, Array, Values], Array],
    drives: bool = False,
) -> None:
    quantities = {"channel": (Quantity(name, unit, low),)}
    register(Effect(kind, "channel", quantities, change=change, drives=drives, step=CHANNEL_STEP_RATIO))


_on_channel("sensor_delay", "delay", "s", 0.0, lambda t, y, p: np.interp(t - p["delay"], t, y))
_on_channel("sensor_bias", "bias", "unit", -inf, lambda t, y, p: y + p["bias"])
_on_channel("sensor_gain", "gain", "1", -inf, lambda t, y, p: y * (1 + p["gain"]))
_on_channel("sensor_drift", "rate", "unit/s", -inf, lambda t, y, p: y + p["rate"] * (t - t[0]))
_on_channel("actuator_lag", "T", "s", 0.0, _lagging, drives=True)
_on_channel("actuator_dead_zone", "width", "unit", 0.0, _dead_zone, drives=True)
