"""Realise: derivatives of inputs and held motions, brought into the form A, B, C, D."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...base import Array, rate_unit


@dataclass(frozen=True)
class Drive:
    """What drives a linear system: an input, the `order`-th derivative of one, or a parameter."""

    name: str
    path: str
    order: int
    base_unit: str
    parameter: int | None


def drop_held(A: Array, B: Array, rows: Array) -> tuple[list[int], Array]:
    """Return the states to keep when some motions are held, and all states from those kept.

    A row h holds if h x stays as it is whatever the inputs do: h A is zero up to what is held already.
    """
    import scipy.linalg

    n = len(A)
    held = np.zeros((0, n))
    whole = np.hstack([A, B])
    for h in (*rows, *rows):
        rate, size = h @ whole, np.abs(h) @ np.abs(whole)
        rate[:n] -= rate[:n] @ np.linalg.pinv(held) @ held
        still = np.abs(rate[:n]).max(initial=0.0) <= 1e-10 * max(size[:n].max(initial=0.0), 1.0)
        if still and np.abs(rate[n:]).max(initial=0.0) <= 1e-10 * max(size[n:].max(initial=0.0), 1e-300):
            grown = np.vstack([held, h])
            if np.linalg.matrix_rank(grown, tol=1e-10) > len(held):
                held = grown
    pivots = scipy.linalg.qr(held, pivoting=True, mode="economic")[-1] if len(held) else []
    gone = sorted(int(k) for k in pivots[: len(held)])
    keep = [k for k in range(n) if k not in gone]
    restore = np.zeros((n, len(keep)))
    restore[keep] = np.eye(len(keep))
    restore[gone] = -np.linalg.solve(held[:, gone], held[:, keep])
    return keep, restore


def realised(
    free: tuple[Array, Array],
    states: Mapping[str, str],
    drives: list[tuple[Drive, dict[int, Array]]],
    told: Iterable[str] = (),
) -> dict[str, Any]:
    """Return x' = A x + sum B_k u^(k), y = C x + sum D_k u^(k) without derivatives in the first equation.

    That is what a `StateSpace` is made of, but for its name and its outputs.

    Where a drive is a derivative u^(n), the lower ones become states. Where derivatives are left,
    x = w + E u + F u' + ... with E, F such that they leave w' = A w + (B_0 + A B_1 + A^2 B_2 + ...) u.

    Args:
        free: A and C.
        states: their units by name.
        drives: its inputs, each with the columns of x' and y, one below the other, by order of derivative.
        told: notes on the system.
    """
    A, C = free
    n = at = len(A)
    size, dtype = n + sum(drive.order for drive, _ in drives), A.dtype
    highest = max((order - drive.order for drive, columns in drives for order in columns), default=0)
    rows = np.r_[:n, size : size + len(C)]
    slopes = np.zeros((size + len(C), size), dtype)
    slopes[rows, :n] = np.vstack([A, C])
    forced = np.zeros((max(highest, 0) + 1, size + len(C), len(drives)), dtype)
    names, units, notes = list(states), list(states.values()), list(told)
    for k, (drive, columns) in enumerate(drives):
        for order, column in columns.items():
            if order < drive.order:
                slopes[rows, at + order] = column
            else:
                forced[order - drive.order, rows, k] = column
        names += [f"{'der(' * order}{drive.path}{')' * order}" for order in range(drive.order)]
        units += [rate_unit(drive.base_unit, order) for order in range(drive.order)]
        if drive.order:
            integrals = np.arange(at, at + drive.order)
            slopes[integrals[:-1], integrals[1:]] = 1.0
            forced[0, integrals[-1], k] = 1.0
        at += drive.order
        notes += [] if columns else [f"nothing depends on {drive.name}"]
    (A, C), (B, D) = np.split(slopes, [size]), np.split(forced, [size], axis=1)
    if B[1:].any():
        notes.append("states are less what follows an input at once, so that no derivative of it drives them")
    for order in range(len(B) - 1, 0, -1):
        D[order - 1] += C @ B[order]
        B[order - 1] += A @ B[order]
    sizes = np.abs(D).max(axis=(1, 2), initial=0.0)
    left = np.flatnonzero(sizes > 1e-14 * sizes.max()).max(initial=0)
    if left:
        notes.append(f"improper: outputs contain derivatives of inputs up to order {left}")
    input_units = tuple(rate_unit(drive.base_unit, drive.order) for drive, _ in drives)
    return {
        "A": A, "B": B[0], "C": C, "D": D[0], "D_s": tuple(D[1 : left + 1]), "notes": tuple(notes),
        "states": tuple(names), "state_units": tuple(units),
        "inputs": tuple(drive.name for drive, _ in drives), "input_units": input_units,
    }  # fmt: skip
