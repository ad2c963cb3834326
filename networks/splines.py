"""Splines through sampled signals: cubic, twice continuously differentiable."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import casadi as ca

from ..components.base import Sampled

KEPT = 64


@lru_cache(maxsize=KEPT)
def cubic_spline(signal: Sampled) -> Any:
    """Return the spline of a signal as a `scipy.interpolate.CubicSpline`, of instants and order."""
    from scipy.interpolate import CubicSpline

    return CubicSpline(signal.time, signal.values)


@lru_cache(maxsize=KEPT)
def traced_spline(signal: Sampled) -> Any:
    """Return the same as a CasADi function of time, which is zero outside the signal's instants."""
    from scipy.interpolate import make_interp_spline

    spline = make_interp_spline(signal.time, signal.values)
    return ca.Function.bspline("signal", [spline.t.tolist()], spline.c.tolist(), [3], 1)


@lru_cache(maxsize=KEPT)
def curvature(signal: Sampled) -> Any:
    """Return its second derivative as a CasADi function of time.

    It is linear between instants. CasADi 3.8.2 writes beyond its memory when the spline itself is
    differentiated three times; this function can be differentiated once more.
    """
    return ca.interpolant("curvature", "linear", [signal.time], cubic_spline(signal)(signal.time, 2))
