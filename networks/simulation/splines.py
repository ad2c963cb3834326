"""Sampled signals between their instants, as splines, lines or steps, and beyond if they are held there."""

from __future__ import annotations

from functools import lru_cache
from math import inf
from typing import Any

import casadi as ca
import numpy as np

from ...base import Array
from ...components.language import Sampled

CACHED_SIGNALS = 64
SMOOTHNESS = {"cubic": 3, "linear": 0, "hold": inf}
"""The order of the last derivative that a signal has between its jumps, by its interpolation."""


@lru_cache(maxsize=CACHED_SIGNALS)
def piecewise(signal: Sampled) -> Any:
    """Return a signal as a `scipy.interpolate.PPoly`, of instants and order of derivative."""
    from scipy.interpolate import CubicSpline, PPoly

    instants = signal.time
    if signal.interpolation == "cubic":
        powers = CubicSpline(signal.time, signal.values).c
    elif signal.interpolation == "hold":
        powers = np.vstack([np.zeros((3, len(signal.values))), signal.values])
        instants = np.append(instants, 2 * instants[-1] - instants[-2])
    else:
        slopes = np.diff(signal.values) / np.diff(signal.time)
        powers = np.vstack([np.zeros((2, len(slopes))), slopes, signal.values[:-1]])
    if signal.extrapolation == "hold":
        powers = np.pad(powers, ((0, 0), (1, 1)))
        powers[3, [0, -1]] = signal.values[[0, -1]]
        instants = np.r_[instants[0] - 1.0, instants, instants[-1] + 1.0]
    return PPoly(powers, instants)


def breaks(signal: Sampled) -> Array:
    """Return the instants at which a signal jumps, or begins or ends to be held beyond its samples."""
    time: Array = signal.time
    if signal.interpolation == "hold":
        jumps: Array = time[1:][np.diff(signal.values) != 0]
        return jumps
    return time[[0, -1]] if signal.extrapolation == "hold" else time[:0]


def sampled_at(signal: Sampled, times: Array, order: int = 0) -> Array:
    """Return a signal, or a derivative of it, at instants, as `traced` has it."""
    known = times if signal.extrapolation == "hold" else np.clip(times, *_ends(signal))
    values: Array = piecewise(signal)(known, order)
    return values


@lru_cache(maxsize=CACHED_SIGNALS)
def traced(signal: Sampled, order: int = 0) -> Any:
    """Return a signal, or the second derivative of one that is not linear, as a CasADi function of time.

    A signal that is not held goes on smoothly for the length of a sample beyond its ends, and stays there,
    so that an integrator may look ahead. At an end it is continued from the right.

    The second derivative is linear between instants. CasADi 3.8.2 writes beyond its memory when the spline
    itself is differentiated three times; this function can be differentiated once more.
    """
    t = ca.MX.sym("t")
    begin, end = _ends(signal)
    between = _curvature(signal) if order else _between(signal)
    beyond = 0.0 if order else ca.if_else(t < begin, between(begin), between(end))
    within = ca.logic_and(t >= begin, t < end)
    return ca.Function("signal", [t], [ca.if_else(within, between(t), beyond)])


def _ends(signal: Sampled) -> tuple[float, float]:
    """Return the instants beyond which a traced signal stays as it is."""
    time = signal.time
    if signal.extrapolation == "hold":
        return float(time[0]), float(time[-1])
    return float(2 * time[0] - time[1]), float(2 * time[-1] - time[-2])


def _between(signal: Sampled) -> Any:
    if signal.interpolation == "hold":
        return _held(signal)
    if signal.interpolation == "linear":
        return ca.interpolant("linear", "linear", [signal.time], signal.values)
    from scipy.interpolate import make_interp_spline

    time = signal.time
    begin, end = _ends(signal)
    knots = np.r_[[begin] * 4, time[2:-2], [end] * 4]
    spline = make_interp_spline(time, signal.values, t=knots)
    return ca.Function.bspline("cubic", [spline.t.tolist()], spline.c.tolist(), [3], 1)


def _held(signal: Sampled) -> Any:
    """Return the last sample at or before an instant, the first one before all."""
    t = ca.MX.sym("t")
    edges = np.append(signal.time, signal.time[-1] + 1.0)
    number = ca.low(ca.MX(ca.DM(edges)), t, {"lookup_mode": "binary"})
    sample = ca.interpolant("sample", "linear", [np.arange(len(signal.values))], signal.values)
    return ca.Function("held", [t], [sample(number)])


def _curvature(signal: Sampled) -> Any:
    values = piecewise(signal)(signal.time, 2)
    return ca.interpolant("curvature", "linear", [signal.time], values)
