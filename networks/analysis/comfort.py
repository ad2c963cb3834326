"""ISO 2631-1: how people feel vibration, as filters on the acceleration."""

from __future__ import annotations

from functools import cache
from math import ceil, pi, sqrt

import numpy as np
from numpy.typing import ArrayLike

from ...base import Array, ModelError, demand, instance, number, numbers, one_of, unit_for
from ..results.over_time import OverTime
from .statespace import StateSpace

BAND_HZ = (0.4, 100.0)
TRANSITION_HZ = {"Wk": 12.5, "Wd": 2.0, "Wc": 8.0, "We": 1.0}
TRANSITION_Q = 0.63
WEIGHTINGS = (*TRANSITION_HZ, "Wj")
SAMPLING_RATE_HZ = 4000.0
STEP = {"Wk": (2.37, 0.91, 3.35, 0.91), "Wj": (3.75, 0.91, 5.32, 0.91)}


def comfort_filter(weighting: str = "Wk") -> StateSpace:
    """Return a weighting of ISO 2631-1 as a system from acceleration to weighted acceleration [m/s2].

    Band limits of second order at f1, f2 (Q = 1/sqrt 2), transition (1 + s/w3)/(1 + s/(Q4 w4) + (s/w4)^2),
    upward step (1 + s/(Q5 w5) + (s/w5)^2)/(1 + s/(Q6 w6) + (s/w6)^2) (w5/w6)^2.

    Args:
        weighting: "Wk" vertical, "Wd" horizontal, "Wc" backrest, "We" rotation, "Wj" head.

    Raises:
        ModelError: for an unknown weighting.

    Source: ISO 2631-1:1997, annex A, table A.1.
    """
    demand("comfort_filter()", weighting=(weighting, one_of(WEIGHTINGS)))
    return _filter(weighting)


@cache
def _filter(weighting: str) -> StateSpace:
    from scipy.signal import tf2ss

    low, high = (2 * pi * f for f in BAND_HZ)
    above, below = np.poly1d([1.0, 0.0, 0.0]), _quadratic(low, 1 / sqrt(2)) * low**2
    below = below * _quadratic(high, 1 / sqrt(2))
    if weighting in TRANSITION_HZ:
        w = 2 * pi * TRANSITION_HZ[weighting]
        above, below = above * np.poly1d([1 / w, 1.0]), below * _quadratic(w, TRANSITION_Q)
    if weighting in STEP:
        f5, Q5, f6, Q6 = STEP[weighting]
        above = above * _quadratic(2 * pi * f5, Q5) * (f5 / f6) ** 2
        below = below * _quadratic(2 * pi * f6, Q6)
    A, B, C, D = tf2ss(above.coeffs, below.coeffs)
    unit = ("m/s2",)
    return StateSpace(
        A, B, C, D, name=weighting, inputs=("a",), outputs=("a_w",), input_units=unit, output_units=unit
    )


def weighted(system: StateSpace, weighting: str = "Wk") -> StateSpace:
    """Return a system with every output passed through a weighting of ISO 2631-1."""
    demand("weighted()", system=(system, instance(StateSpace)))
    filters = comfort_filter(weighting)
    for k, name in enumerate(system.outputs):
        system = system.then(filters, k, f"{name} ({weighting})")
    return system


def weighted_rms(run: OverTime | ArrayLike, acceleration: str | ArrayLike, weighting: str = "Wk") -> float:
    """Return the weighted rms acceleration of a run or a record over time [m/s2].

    ISO 2631-1 annex C calls 0.315 a little, 0.8 plainly and over 2 m/s2 extremely uncomfortable.

    Args:
        run: a `Result`, or anything else that is `OverTime`; of a record, its instants at equal steps [s].
        acceleration: its name in the run; of a record, its values [m/s2].
        weighting: as for `comfort_filter`.

    Raises:
        UnknownNameError: for an unknown name, with the nearest one.
        ModelError: for steps that are not equal, lengths that differ, or values that are not finite, and
            for what is no acceleration.
    """
    from scipy.signal import lsim

    t, a = _course(run, acceleration)
    if t.shape != a.shape or t.size < 2 or not (np.isfinite(t).all() and np.isfinite(a).all()):
        raise ModelError(
            f"weighted_rms() takes as many finite instants as accelerations, at least 2; got {t.size} and "
            f"{a.size} with {np.count_nonzero(~np.isfinite(a))} not finite"
        )
    if not (t[1] > t[0] and np.allclose(np.diff(t), t[1] - t[0], rtol=1e-6, atol=0)):
        raise ModelError(
            "weighted_rms() takes rising instants at equal steps; give it the run and a name, "
            "weighted_rms(run, 'body.a'), or Recorded(table) for a table"
        )
    _, felt, _ = lsim(comfort_filter(weighting).to_scipy(), a, t - t[0])
    return float(np.sqrt(np.trapezoid(felt**2, t) / (t[-1] - t[0])))


def _course(run: OverTime | ArrayLike, acceleration: str | ArrayLike) -> tuple[Array, Array]:
    """Return instants and values."""
    if not isinstance(run, OverTime):
        demand("weighted_rms()", time=(run, numbers(number)), acceleration=(acceleration, numbers(number)))
        return np.asarray(run, dtype=float), np.asarray(acceleration, dtype=float)
    if not isinstance(acceleration, str) or "*" in acceleration:
        raise ModelError(f"name the acceleration of '{run.name}': weighted_rms(run, 'body.a')")
    try:
        unit = unit_for(run.unit(acceleration) or "m/s2", "m/s2")
    except ModelError as error:
        raise ModelError(f"'{acceleration}' of '{run.name}' is not an acceleration: {error}") from error
    lasting = float(run.time[-1] - run.time[0])
    table = run.resample(lasting / max(2, ceil(SAMPLING_RATE_HZ * lasting)) if lasting else 1.0, acceleration)
    return table.index.to_numpy(dtype=float), unit.to_si(table[acceleration].to_numpy(dtype=float))


def _quadratic(w: float, Q: float) -> np.poly1d:
    return np.poly1d([1 / w**2, 1 / (Q * w), 1.0])
