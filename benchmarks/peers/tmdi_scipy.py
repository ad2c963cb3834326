"""A TMDI tuned with NumPy, SciPy and python-control: the transfer function is written down by hand."""

from __future__ import annotations

import importlib.util
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize, minimize_scalar

Array = NDArray[np.float64]
MU, BETA, LOSS = 0.02, 0.1, 0.02
BOUNDS = ((0.02, 0.4), (1e-3, 0.2))
START = (0.08, 0.02)
GRID = np.geomspace(0.3, 3.0, 400)


def coefficients(k: float, d: float) -> tuple[Array, Array]:
    """Return floor over force: the absorber's mass on spring and damper, its inerter to the ground."""
    upper = np.array([MU + BETA, d, k])
    link = np.array([d, k])
    den = np.polysub(np.polymul([1.0, LOSS + d, 1.0 + k], upper), np.polymul(link, link))
    return upper, den


def gain(w: Any, k: float, d: float) -> Any:
    num, den = coefficients(k, d)
    return np.abs(np.polyval(num, 1j * w) / np.polyval(den, 1j * w))


def peaks(k: float, d: float) -> list[float]:
    """Return the heights of the local maxima, those of a grid refined, highest first."""
    gains = gain(GRID, k, d)
    tops = np.flatnonzero((gains[1:-1] >= gains[:-2]) & (gains[1:-1] > gains[2:])) + 1
    found = []
    for n in tops:
        near = (GRID[n - 1], GRID[n + 1])
        best = minimize_scalar(
            lambda w: -gain(w, k, d), bounds=near, method="bounded", options={"xatol": 1e-9}
        )
        found.append(-float(best.fun))
    return sorted(found, reverse=True)


def by_nelder_mead() -> tuple[float, float]:
    """Tune the highest peak by Nelder-Mead."""
    options = {"xatol": 1e-7, "fatol": 1e-9}
    found = minimize(lambda x: peaks(*x)[0], START, method="Nelder-Mead", bounds=BOUNDS, options=options)
    return found.x[0], found.x[1]


def by_equal_peaks() -> tuple[float, float]:
    """Minimise a bound on the two highest peaks by SLSQP, derivatives by differences."""

    def room(y: Array) -> Array:
        found = [*peaks(y[0], y[1]), 0.0][:2]
        return y[2] - np.array(found)

    found = minimize(
        lambda y: y[2], np.r_[START, peaks(*START)[0]], jac=lambda _: np.array([0.0, 0.0, 1.0]),
        method="SLSQP",
        bounds=[*BOUNDS, (None, None)], constraints=[{"type": "ineq", "fun": room}], options={"ftol": 1e-10},
    )  # fmt: skip
    return found.x[0], found.x[1]


def by_control() -> tuple[float, float]:
    """Tune python-control's H-infinity norm by Nelder-Mead."""
    import control

    def norm(x: Array) -> float:
        k, d = x
        stiff = np.array([[1.0 + k, -k], [-k, k]])
        lossy = np.array([[LOSS + d, -d], [-d, d]])
        inverse = np.diag([1.0, 1.0 / (MU + BETA)])
        A = np.block([[np.zeros((2, 2)), np.eye(2)], [-inverse @ stiff, -inverse @ lossy]])
        B, C = np.array([[0.0], [0.0], [1.0], [0.0]]), np.array([[1.0, 0.0, 0.0, 0.0]])
        return float(control.norm(control.ss(A, B, C, 0.0), "inf", tol=1e-9))

    options = {"xatol": 1e-7, "fatol": 1e-9}
    found = minimize(norm, START, method="Nelder-Mead", bounds=BOUNDS, options=options)
    return found.x[0], found.x[1]


def has_control() -> bool:
    return importlib.util.find_spec("control") is not None


def fine_peak(k: float, d: float) -> float:
    """Return the highest gain on a fine grid, refined: the same judge for everyone."""
    w = np.linspace(0.3, 3.0, 200_001)
    best = w[np.argmax(gain(w, k, d))]
    near = minimize_scalar(
        lambda x: -gain(x, k, d),
        bounds=(best - 1e-4, best + 1e-4),
        method="bounded",
        options={"xatol": 1e-12},
    )
    return -float(near.fun)
