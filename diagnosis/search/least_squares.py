"""Descent: least squares by Gauss-Newton steps in a box, whose slopes are learnt on the way."""

from __future__ import annotations

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from ...components import SimulationError

Array = NDArray[np.float64]
MOST_STEPS = 100
LEAST_DROP = 1e-4  # of the sum of squares, that a step must promise
GOOD = 0.5  # share of what was promised that a step must keep for its slopes to be believed
POOR = 0.05  # share below which a step is not taken
NARROWEST = 1e-3  # of what quantities may be expected to be: steps below it see nothing but roughness
RIDGE = 1e-3


class Residual(Protocol):
    """Residuals at a vector, with slopes or without, which costs less."""

    def __call__(self, vector: Array, slopes: bool) -> tuple[Array, Array | None]:
        """Return both; `SimulationError` tells that there are none."""
        ...


def descend(
    residual: Residual, start: Array, bounds: tuple[Array, Array], steps: int = MOST_STEPS
) -> tuple[Array, float]:
    """Return the vector near `start`, within bounds, that has the least sum of squares, and that sum.

    Slopes are computed at the start, corrected by what each step really did (Broyden), and computed again
    when steps no longer keep what they promise. The first goes no further than what quantities may be
    expected to be; one that keeps its promise may be followed by one twice as far, one that does not by a
    shorter one.

    Raises:
        SimulationError: if there are no residuals at the start.

    Source: J. E. Dennis, R. B. Schnabel, Numerical Methods for Unconstrained Optimization and Nonlinear
    Equations, SIAM 1996, sections 6.4, 8.1 and 10.3.
    """
    x = np.clip(start, *bounds)
    slopes: Array | None
    rest, slopes = _sloped(residual, x)
    radius, exact = 1.0, True
    for _ in range(steps):
        if slopes is None:
            try:
                rest, slopes = _sloped(residual, x)
            except SimulationError:
                break
            exact = True
        within = np.maximum(bounds[0] - x, -radius), np.minimum(bounds[1] - x, radius)
        step, promised = _step(slopes, rest, within)
        cost, kept = float(rest @ rest), 0.0
        if promised > LEAST_DROP * cost + 1.0:
            found = _tried(residual, x + step)
            if found is not None:
                kept = (cost - float(found @ found)) / promised
            if found is not None and kept > POOR:
                slopes = slopes + np.outer(found - rest - slopes @ step, step) / float(step @ step)
                x, rest, exact = np.clip(x + step, *bounds), found, False
            elif exact:
                radius = 0.25 * float(np.abs(step).max())
                if radius < NARROWEST:
                    break
                continue
        elif exact:
            break
        if kept > GOOD:
            radius = max(radius, 2 * float(np.abs(step).max()))
        else:
            slopes = None
    return x, float(rest @ rest)


def _sloped(residual: Residual, x: Array) -> tuple[Array, Array]:
    """Return residuals and slopes.

    Raises:
        SimulationError: if there are none, or not all are finite.
    """
    rest, slopes = residual(x, True)
    if slopes is None or not (np.isfinite(rest).all() and np.isfinite(slopes).all()):
        raise SimulationError("the slopes of a run are not finite")
    return rest, slopes


def _tried(residual: Residual, x: Array) -> Array | None:
    try:
        rest = residual(x, False)[0]
    except SimulationError:
        return None
    return rest if np.isfinite(rest).all() else None


def _step(slopes: Array, rest: Array, within: tuple[Array, Array]) -> tuple[Array, float]:
    """Return the step within a box that promises the largest drop of the sum of squares, and that drop."""
    from scipy.optimize import lsq_linear

    small: Array = np.asarray(np.linalg.qr(np.column_stack([slopes, rest]), mode="r"), dtype=np.float64)
    matrix, aim = small[:, :-1], -small[:, -1]
    size = np.sqrt((matrix**2).sum(axis=0))
    size[size == 0] = 1.0
    tall = np.vstack([matrix / size, RIDGE * np.eye(len(size))])
    box = np.minimum(within[0] * size, -1e-12), np.maximum(within[1] * size, 1e-12)
    found = lsq_linear(tall, np.concatenate([aim, np.zeros(len(size))]), box, method="bvls").x
    after = matrix @ (found / size) - aim
    step: Array = np.clip(found / size, *within)
    return step, float(aim @ aim - after @ after)
