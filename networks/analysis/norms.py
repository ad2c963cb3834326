"""Norms of linear systems: H2 by a Lyapunov equation, H-infinity by a Hamiltonian matrix."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from .realise import balanced, minimal

if TYPE_CHECKING:
    from .statespace import StateSpace

Array = NDArray[np.float64]
AXIS = 1e-11


class Norm(float):
    """A norm: a number that knows the frequency [Hz] of its peak, and why it is infinite if it is."""

    frequency: float | None
    reason: str

    def __new__(cls, value: float, frequency: float | None = None, reason: str = "") -> Norm:
        norm = super().__new__(cls, value)
        norm.frequency, norm.reason = frequency, reason
        return norm


def h2(system: StateSpace) -> Norm:
    """Return the H2 norm; see `StateSpace.h2`."""
    import scipy.linalg

    if not system.proper or np.abs(system.D).max(initial=0.0) > 0:
        return Norm(math.inf, reason="not strictly proper: an input reaches an output without delay")
    small, reason = _stable_part(system)
    if reason:
        return Norm(math.inf, reason=reason)
    A, B, C = balanced(small)
    P = scipy.linalg.solve_continuous_lyapunov(A, -B @ B.T)
    return Norm(math.sqrt(max(float(np.trace(C @ P @ C.T)), 0.0)))


def hinf(system: StateSpace, tolerance: float = 1e-10) -> Norm:
    """Return the H-infinity norm; see `StateSpace.hinf`."""
    if not system.proper:
        return Norm(math.inf, math.inf, "improper: the gain grows with frequency without end")
    small, reason = _stable_part(system)
    if reason:
        return Norm(math.inf, reason=reason)
    peak, w = _first_peak(small)
    if peak == 0.0:
        return Norm(0.0, 0.0)
    for _ in range(50):
        level = peak * (1 + 2 * tolerance)
        crossings = _crossings(small, level)
        if not len(crossings):
            break
        between = np.sqrt(crossings[:-1] * crossings[1:]) if len(crossings) > 1 else crossings
        best, at = _greatest(small, np.r_[between, crossings, (crossings[:-1] + crossings[1:]) / 2])
        if best <= peak:
            break
        peak, w = best, at
    return Norm(peak, w / (2 * math.pi))


def _stable_part(system: StateSpace) -> tuple[StateSpace, str]:
    """Return a system, without redundant states if they are not stable, and why it has no norm."""
    if len(system.A) == 0 or (system.poles.real < -AXIS * np.abs(system.poles).max()).all():
        return system, ""
    small = minimal(system)
    worst = small.poles[np.argmax(small.poles.real)] if len(small.A) else complex(-1)
    if worst.real < -AXIS * np.abs(small.poles).max(initial=1.0):
        return small, ""
    kind = "unstable" if worst.real > 1e-9 * abs(worst) else "not asymptotically stable"
    return small, f"{kind}: pole at {worst:.4g} rad/s"


def _first_peak(system: StateSpace) -> tuple[float, float]:
    poles = system.poles
    natural = np.abs(poles)
    tried = [0.0, *natural, *np.sqrt(np.maximum(natural**2 - 2 * poles.real**2, 0.0))]
    best, w = _greatest(system, np.array(tried))
    top = float(np.linalg.norm(system.D, 2)) if system.D.size else 0.0
    return (top, math.inf) if top > best else (best, w)


def _greatest(system: StateSpace, w: Array) -> tuple[float, float]:
    gains = np.linalg.norm(system(1j * w), 2, axis=(-2, -1))
    k = int(np.argmax(gains))
    return float(gains[k]), float(w[k])


def _crossings(system: StateSpace, level: float) -> Array:
    """Return the frequencies [rad/s] at which a singular value is `level`: imaginary eigenvalues."""
    A, B, C = balanced(system)
    D = system.D
    rate = float(np.abs(np.linalg.eigvals(A)).max(initial=1e-300))
    A, B, C = A / rate, B / math.sqrt(rate * level), C / math.sqrt(rate * level)
    D = D / level
    R = np.eye(D.shape[1]) - D.T @ D
    S = np.eye(D.shape[0]) - D @ D.T
    feedback = A + B @ np.linalg.solve(R, D.T @ C)
    hamiltonian = np.block(
        [[feedback, B @ np.linalg.solve(R, B.T)], [-C.T @ np.linalg.solve(S, C), -feedback.T]]
    )
    eigenvalues = np.linalg.eigvals(hamiltonian)
    on_axis = np.abs(eigenvalues.real) <= 1e-8 * (1e-3 + np.abs(eigenvalues))
    w = np.sort(eigenvalues.imag[on_axis & (eigenvalues.imag >= 0)]) * rate
    return np.asarray(w, dtype=float)
