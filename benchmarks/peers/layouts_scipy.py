"""J1 of the suspension layouts S1 to S8 with NumPy and SciPy, every state space written down by hand."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from math import pi, sqrt

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import solve_continuous_lyapunov
from scipy.optimize import minimize

Array = NDArray[np.float64]
Table = dict[tuple[str, float], float]
M_S, M_U, K_T = 250.0, 35.0, 150e3
LOST = 1e3
FACTOR = 2 * pi * sqrt(25.0 * 5e-7)
STIFFNESS = (30e3, 60e3, 90e3, 120e3)
START = {"d": 3000.0, "b": 200.0, "k_b": 1e5, "k_1": 1e4, "k_2": 1e4}
BOUNDS = {"d": (50.0, 30e3), "b": (0.5, 3000.0), "k": (10.0, 1e7)}
LAYOUTS: dict[str, Sequence[str]] = {
    "S1": ("d",),
    "S2": ("d", "k_b"),
    "S3": ("d", "b"),
    "S4": ("d", "b"),
    "S5": ("d", "b", "k_b"),
    "S6": ("d", "b", "k_b"),
    "S7": ("d", "b", "k_1", "k_2"),
    "S8": ("d", "b", "k_1", "k_2", "k_b"),
}


def matrices(
    layout: str, k: float, d: float = 0.0, b: float = 0.0, **springs: float
) -> tuple[Array, Array, Array]:
    """Return A, B, C from the speed of the road to the acceleration of the body.

    x = (v_u, v_s, z_r - z_u, z_s - z_u, ...); `f` is the force of the branch, as a row over x.
    """
    k_b, k_1, k_2 = (springs.get(name, 0.0) for name in ("k_b", "k_1", "k_2"))
    n = 4 + {"S1": 0, "S2": 1, "S3": 0, "S4": 1, "S5": 2, "S6": 2, "S7": 2, "S8": 3}[layout]
    A, x = np.zeros((n, n)), np.eye(n)
    w, mass = x[1] - x[0], np.diag([M_U, M_S])
    f = d * w
    if layout in ("S2", "S5", "S6"):  # x[4]: travel of the relaxation spring
        f = k_b * x[4]
    if layout == "S2":
        A[4] = w - f / d
    elif layout == "S3":
        mass = mass + b * np.array([[1.0, -1.0], [-1.0, 1.0]])
    elif layout == "S4":  # x[4]: speed of the inerter
        f = d * (w - x[4])
        A[4] = f / b
    elif layout == "S5":  # x[5]: speed of damper and inerter
        A[4], A[5] = w - x[5], (f - d * x[5]) / b
    elif layout == "S6":  # x[5]: speed of the inerter
        A[4], A[5] = w - f / d - x[5], f / b
    elif layout == "S7":  # x[4], x[5]: speed and travel of the inerter
        f = d * (w - x[4]) + k_1 * (x[3] - x[5])
        A[4], A[5] = (f - k_2 * x[5]) / b, x[4]
    elif layout == "S8":  # x[6]: travel of the damper
        f = k_b * (x[3] - x[5] - x[6])
        A[4], A[5], A[6] = (f - k_2 * x[5]) / b, x[4], (f - k_1 * x[6]) / d
    strut = k * x[3] + f
    A[:2] = np.linalg.solve(mass, np.array([K_T * x[2] + strut, -strut]))
    A[2], A[3] = -x[0], w
    B, C = np.zeros((n, 1)), A[[1]]
    B[2] = 1.0
    return A, B, C


def j1(layout: str, k: float, values: Sequence[float]) -> float:
    A, B, C = matrices(layout, k, **dict(zip(LAYOUTS[layout], values, strict=True)))
    P = solve_continuous_lyapunov(A, -B @ B.T)
    power = float((C @ P @ C.T)[0, 0])
    return FACTOR * sqrt(power) if power > 0 else LOST


def with_gradient(layout: str, k: float, values: Array) -> tuple[float, Array]:
    """Return J1 and its derivatives in the logarithms, dJ^2 = 2 tr(Q dA P) + 2 C P dC', C a row of A."""
    A, B, C = matrices(layout, k, **dict(zip(LAYOUTS[layout], values, strict=True)))
    P = solve_continuous_lyapunov(A, -B @ B.T)
    Q = solve_continuous_lyapunov(A.T, -C.T @ C)
    power = float((C @ P @ C.T)[0, 0])
    if not power > 0:
        return LOST, np.zeros(len(values))
    h2, QP, slopes = sqrt(power), Q @ P, []
    for n in range(len(values)):
        step = 1e-4 * values[n]
        ahead, behind = values.copy(), values.copy()
        ahead[n], behind[n] = values[n] + step, values[n] - step
        pair = [matrices(layout, k, **dict(zip(LAYOUTS[layout], v, strict=True)))[0] for v in (ahead, behind)]
        change = (pair[0] - pair[1]) / (2 * step) * values[n]
        slopes.append((float(np.sum(QP * change)) + float((C @ P @ change[1])[0])) / h2)
    return FACTOR * h2, FACTOR * np.array(slopes)


def tuned(layout: str, k: float, adjoint: bool) -> float:
    names = LAYOUTS[layout]
    bounds = [tuple(np.log(BOUNDS[name[0]])) for name in names]
    start = np.log([START[name] for name in names])
    options = {"ftol": 1e-13, "gtol": 1e-8, "maxiter": 500}
    if adjoint:
        found = minimize(
            lambda y: with_gradient(layout, k, np.exp(y)), start, jac=True, method="L-BFGS-B", bounds=bounds,
            options=options,
        )  # fmt: skip
    else:
        found = minimize(
            lambda y: j1(layout, k, np.exp(y)), start, method="L-BFGS-B", bounds=bounds, options=options
        )
    return float(found.fun)


def table(adjoint: bool) -> Table:
    return {(layout, k): tuned(layout, k, adjoint) for layout in LAYOUTS for k in STIFFNESS}


TABLES: dict[str, Callable[[], Table]] = {
    "SciPy, L-BFGS-B, differences": partial(table, False),
    "SciPy, L-BFGS-B, adjoint": partial(table, True),
}
