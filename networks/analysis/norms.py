"""Norms of linear systems: H2 by a Lyapunov equation, H-infinity by a Hamiltonian matrix."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import InitVar, dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from ...base import Array, ModelError, demand, finite
from .minimal import balanced, minimal

if TYPE_CHECKING:
    from .statespace import StateSpace

AXIS_MARGIN = 1e-11  # of poles left of the imaginary axis, against the fastest
HINF_ROUNDS = 50
Gains = Callable[[Iterable[float]], list["Norm"]]


@dataclass(eq=False, repr=False)
class Norm(float):
    """A norm: a number that knows the frequency [Hz] of its peak, and why it is infinite if it is.

    Attributes:
        gradient: its derivatives in the parameters that were `Varied`, by name.
        peaks: of an H-infinity norm with a gradient, the local peaks, highest first, itself included.
        gains: returns the gains at frequencies [Hz], with their gradients, of such a norm.
    """

    value: InitVar[float]
    frequency: float | None = None
    reason: str = ""
    gradient: Mapping[str, float] = field(default_factory=dict)
    peaks: Sequence[Norm] = ()
    gains: Gains = lambda _: []

    def __new__(cls, value: float, *_: Any, **__: Any) -> Norm:
        return super().__new__(cls, value)

    def scaled(self, factor: float) -> Norm:
        """Return the norm times a positive constant, with its gradient."""
        demand("scaled()", factor=(factor, finite()))
        gradient = {name: factor * slope for name, slope in self.gradient.items()}
        peaks = [peak.scaled(factor) for peak in self.peaks]

        return Norm(
            factor * self, self.frequency, self.reason, gradient, peaks,
            lambda f: [gain.scaled(factor) for gain in self.gains(f)],
        )  # fmt: skip


def h2(system: StateSpace) -> Norm:
    """Return the H2 norm; see `StateSpace.h2`."""
    import scipy.linalg

    if not system.proper or np.abs(system.D).max(initial=0.0) > 0:
        return Norm(math.inf, reason="not strictly proper: an input reaches an output without delay")
    small, reason = stable_part(system)
    if reason:
        return Norm(math.inf, reason=reason)
    A, B, C, scale = balanced(small)
    P = scipy.linalg.solve_continuous_lyapunov(A, -B @ B.T)
    value = math.sqrt(max(float(np.trace(C @ P @ C.T)), 0.0))
    if not (small.slopes and value):
        return Norm(value)
    Q = scipy.linalg.solve_continuous_lyapunov(A.T, -C.T @ C)
    P, Q = P * np.outer(scale, scale), Q / np.outer(scale, scale)
    gradient = {
        name: float(np.sum((Q @ P) * s.A) + np.sum((Q @ small.B) * s.B) + np.sum((small.C @ P) * s.C)) / value
        for name, s in small.slopes.items()
    }
    return Norm(value, gradient=gradient)


def hinf(system: StateSpace, tolerance: float = 1e-10) -> Norm:
    """Return the H-infinity norm; see `StateSpace.hinf`."""
    if not system.proper:
        return Norm(math.inf, math.inf, "improper: the gain grows with frequency without end")
    small, reason = stable_part(system)
    if reason:
        return Norm(math.inf, reason=reason)
    peak, w = _first_peak(small)
    if peak == 0.0:
        return Norm(0.0, 0.0)
    for _ in range(HINF_ROUNDS):
        crossings = _crossings(small, peak * (1 + 2 * tolerance))
        if not len(crossings):
            break
        between = np.sqrt(crossings[:-1] * crossings[1:]) if len(crossings) > 1 else crossings
        best, at = _greatest(small, np.r_[between, crossings, (crossings[:-1] + crossings[1:]) / 2])
        if best <= peak:
            break
        peak, w = best, at
    if not small.slopes:
        return Norm(peak, w / (2 * math.pi))
    peaks = sorted((_peak(small, other) for other in (0.0, *local_peaks(small))), reverse=True)
    if peaks[0] < peak * (1 - 1e-8):
        peaks.insert(0, _peak(small, w))
    return Norm(
        peaks[0], peaks[0].frequency, "", peaks[0].gradient, peaks,
        lambda f: [_peak(small, 2 * math.pi * each) for each in f],
    )  # fmt: skip


def stable_part(system: StateSpace) -> tuple[StateSpace, str]:
    """Return a system, without redundant states if they are not stable, and why it has no norm."""
    if not (system.inputs and system.outputs):
        raise ModelError(
            f"'{system.name}' has no inputs or no outputs, and so no norm; give linearise() some"
        )
    if len(system.A) == 0 or (system.poles.real < -AXIS_MARGIN * np.abs(system.poles).max()).all():
        return system, ""
    small = minimal(system)
    worst = small.poles[np.argmax(small.poles.real)] if len(small.A) else complex(-1)
    if worst.real < -AXIS_MARGIN * np.abs(small.poles).max(initial=1.0):
        return small, ""
    kind = "unstable" if worst.real > 1e-9 * abs(worst) else "not asymptotically stable"
    return small, f"{kind}: pole at {worst:.4g} rad/s"


def _first_peak(system: StateSpace) -> tuple[float, float]:
    poles = system.poles
    natural = np.abs(poles)
    resonances = np.sqrt(np.maximum(natural**2 - 2 * poles.real**2, 0.0))
    best, w = _greatest(system, np.r_[0.0, natural, resonances])
    top = float(np.linalg.norm(system.D, 2)) if system.D.size else 0.0
    return (top, math.inf) if top > best else (best, w)


def _greatest(system: StateSpace, w: Array) -> tuple[float, float]:
    gains = np.linalg.norm(system(1j * w), 2, axis=(-2, -1))
    k = int(np.argmax(gains))
    return float(gains[k]), float(w[k])


def _peak(system: StateSpace, w: float) -> Norm:
    """Return the gain at a frequency, with its gradient: Re u* dG v of the greatest singular value."""
    if math.isinf(w):
        return Norm(float(np.linalg.norm(system.D, 2)), w)
    resolvent = np.linalg.inv(1j * w * np.eye(len(system.A)) - system.A)
    left, gains, right = np.linalg.svd(system.C @ resolvent @ system.B + system.D)
    u, v = left[:, 0].conj(), right[0].conj()
    x, y = resolvent @ system.B @ v, u @ system.C @ resolvent
    gradient = {
        name: float((u @ s.C @ x + y @ s.A @ x + y @ s.B @ v + u @ s.D @ v).real)
        for name, s in system.slopes.items()
    }
    return Norm(float(gains[0]), w / (2 * math.pi), gradient=gradient)


def local_peaks(system: StateSpace) -> list[float]:
    """Return the frequencies [rad/s] of the local maxima of the gain that a grid about the poles shows.

    They are looked for in the sum over poles, whose error for almost multiple ones moves them little.
    """
    poles, modes = np.linalg.eig(system.A)
    from_inputs, to_outputs = np.linalg.solve(modes, system.B), system.C @ modes

    def gain(w: Array) -> Array:
        sums = np.einsum("ok,...k,ki->...oi", to_outputs, 1 / (1j * w[..., None] - poles), from_inputs)
        return np.asarray(np.linalg.norm(sums + system.D, 2, axis=(-2, -1)))

    natural = np.abs(poles)
    near = np.outer(natural, [0.9, 0.97, 0.99, 1.0, 1.01, 1.03, 1.1])
    w = np.unique(np.r_[np.geomspace(natural.min() / 3, natural.max() * 3, 60), near.ravel()])
    height = gain(w)
    inner = np.flatnonzero((height[1:-1] >= height[:-2]) & (height[1:-1] > height[2:])) + 1
    if not len(inner):
        return []
    low, high, rows = w[inner - 1], w[inner + 1], np.arange(len(inner))
    for _ in range(12):
        within = low[:, None] + (high - low)[:, None] * np.linspace(0.0, 1.0, 9)
        best = np.argmax(gain(within), axis=1)
        low, high = within[rows, np.maximum(best - 1, 0)], within[rows, np.minimum(best + 1, 8)]
    return [float(x) for x in (low + high) / 2]


def _crossings(system: StateSpace, level: float) -> Array:
    """Return the frequencies [rad/s] at which a singular value is `level`: imaginary eigenvalues."""
    A, B, C, _ = balanced(system)
    rate = float(np.abs(np.linalg.eigvals(A)).max(initial=1e-300))
    A, B, C = A / rate, B / math.sqrt(rate * level), C / math.sqrt(rate * level)
    D = system.D / level
    R, S = np.eye(D.shape[1]) - D.T @ D, np.eye(D.shape[0]) - D @ D.T
    feedback = A + B @ np.linalg.solve(R, D.T @ C)
    hamiltonian = np.block(
        [[feedback, B @ np.linalg.solve(R, B.T)], [-C.T @ np.linalg.solve(S, C), -feedback.T]]
    )
    eigenvalues = np.linalg.eigvals(hamiltonian)
    on_axis = np.abs(eigenvalues.real) <= 1e-8 * (1e-3 + np.abs(eigenvalues))
    return np.asarray(np.sort(eigenvalues.imag[on_axis & (eigenvalues.imag >= 0)]) * rate, dtype=float)
