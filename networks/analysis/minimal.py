"""Redundant states: what no input reaches or no output shows, left out of a system and of its slopes."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...base import Array
from .statespace import StateSpace, numbered

Triple = tuple[Array, Array, Array]
Slopes = dict[str, Triple]


def minimal(system: StateSpace, tolerance: float = 1e-9) -> StateSpace:
    """Return the part of a system that its inputs reach and its outputs show; see `StateSpace.minimal`."""
    A, B, C, scale = balanced(system)
    rate = float(np.abs(A).max(initial=1e-300))
    into, out = _norms(B, 0), _norms(C, 1)[:, None]
    slopes = {
        by: (s.A * scale / scale[:, None] / rate, s.B / scale[:, None] / into, s.C * scale / out)
        for by, s in system.slopes.items()
    }
    small, slopes = _reached((A / rate, B / into, C / out), slopes, tolerance)
    turned, slopes = _reached(_turned(small), {by: _turned(s) for by, s in slopes.items()}, tolerance)
    kept = len(turned[0])
    if kept == len(system.A):
        return system
    left_out = f"{len(system.A) - kept} states that no input reaches or no output shows are left out"

    def reduced(whole: StateSpace, part: Triple) -> StateSpace:
        A, B, C = _turned(part)
        names, units = numbered("x", kept), ("1",) * kept
        return replace(whole, A=A * rate, B=B * into, C=C * out, states=names, state_units=units)

    changes = {by: reduced(system.slopes[by], slope) for by, slope in slopes.items()}
    return replace(reduced(system, turned), slopes=changes, notes=(*system.notes, left_out))


def balanced(system: StateSpace) -> tuple[Array, Array, Array, Array]:
    """Return A, B, C with states scaled so that rows and columns of A are of like size, and the scales."""
    import scipy.linalg

    if not len(system.A):
        return system.A, system.B, system.C, np.ones(0)
    A, (scale, _) = scipy.linalg.matrix_balance(system.A, permute=False, separate=True)
    scales: Array = np.asarray(scale, dtype=float)
    return np.asarray(A, dtype=float), system.B / scales[:, None], system.C * scales, scales


def controllable_part(A: Array, B: Array, tolerance: float) -> Array:
    """Return an orthonormal basis of what the inputs reach, block by block.

    Source: H. Rosenbrock, State-space and Multivariable Theory (1970); the staircase by singular values.
    """
    basis, block = np.zeros((len(A), 0)), B
    while basis.shape[1] < len(A) and block.size:
        for _ in range(2):
            block = block - basis @ (basis.T @ block)
        left, strength, _ = np.linalg.svd(block, full_matrices=False)
        new = left[:, strength > tolerance]
        if not new.shape[1]:
            break
        basis = np.hstack([basis, new])
        block = A @ new
    return basis


def _reached(system: Triple, slopes: Slopes, tolerance: float) -> tuple[Triple, Slopes]:
    """Return what the inputs reach, V, and its slopes.

    V moves with parameters along what is not reached, W, as V + W X with A_WW X - X A_VV = -dA_WV and
    X B_V = dB_W. Where these contradict each other, more is reached nearby, and there is no slope.
    """
    import scipy.linalg

    A, B, C = system
    V = controllable_part(A, B, tolerance)
    if V.shape[1] == len(A):
        return system, slopes
    W = scipy.linalg.null_space(V.T)
    within, reached = V.T @ A @ V, V.T @ B
    eye, other = np.eye(len(within)), np.eye(W.shape[1])
    moving = np.vstack([np.kron(eye, W.T @ A @ W) - np.kron(within.T, other), np.kron(reached.T, other)])
    found: Slopes = {}
    for by, (dA, dB, dC) in slopes.items():
        wanted = np.hstack([-W.T @ dA @ V, W.T @ dB]).ravel("F")
        x = np.linalg.lstsq(moving, wanted, rcond=1e-12)[0]
        size = np.abs(dA).max() + np.abs(dB).max()
        if np.abs(moving @ x - wanted).max(initial=0.0) <= 1e-7 * size:
            X = x.reshape(len(within), -1).T
            found[by] = V.T @ (dA @ V + A @ W @ X), V.T @ dB, dC @ V + C @ W @ X
    return (within, reached, C @ V), found


def _turned(system: Triple) -> Triple:
    A, B, C = system
    return A.T, C.T, B.T


def _norms(matrix: Array, axis: int) -> Array:
    sizes: Array = np.linalg.norm(matrix, axis=axis)
    return np.where(sizes > 0, sizes, 1.0)
