"""State-transition matrices: small changes of the states along a run, from point to point, over events."""

from __future__ import annotations

from dataclasses import dataclass
from math import isqrt
from typing import Any

import numpy as np

from ...base import Array, SimulationError
from .jacobians import Points, Slopes

MOST_PARTS = 32
UNEVENNESS = 0.01  # of slopes over an interval, times its length, from which it is cut into parts
CORNER = 3  # neighbouring intervals of them that there are at most at a corner of what is even elsewhere
BLOCK = 512  # intervals at a time, whose matrices stay in a processor's cache
STRAIGHT = 0.1  # the same, up to which an interval stays whole where slopes go on in a line
SOFT = 4.0  # size of slopes, times the length, up to which their exponential is summed as a series


@dataclass(frozen=True, eq=False)
class Steps:
    """What becomes of changes of the states from each point to the next.

    With B dp + b forcing the changes dx,

        dx' = map dx + own dp + weight (b + b')/2.

    Attributes:
        map: (intervals, states, states).
        own: (intervals, states, parameters).
        weight: (intervals, states, states); (intervals, states, 0) if nothing but parameters is to change.
    """

    map: Array
    own: Array
    weight: Array

    def reversed(self) -> Steps:
        """Return the steps by which what the end is sensitive to goes back to the start."""
        return Steps(np.swapaxes(self.map, 1, 2)[::-1], self.own[::-1], self.weight[::-1])

    def carry(self, moved: Array, added: Array) -> Array:
        """Return the changes at all points, (points, states, columns), that begin as `moved`.

        Stretches are followed side by side: first what each makes of any change, then from where it begins.
        """
        n, length = self.map.shape[1], max(1, isqrt(len(self.map)))
        whole = len(self.map) - len(self.map) % length
        maps, more = (
            np.swapaxes(m[:whole].reshape(whole // length, length, *m.shape[1:]), 0, 1)
            for m in (self.map, added)
        )
        product = np.broadcast_to(np.eye(n), maps.shape[1:])
        gathered = np.zeros((len(product), *moved.shape))
        for step, extra in zip(maps, more, strict=True):
            product, gathered = step @ product, step @ gathered + extra
        begins = np.concatenate([moved[None], _followed(product, moved, gathered)])
        inside = np.swapaxes(_followed(maps, begins[:-1], more), 0, 1).reshape(whole, *moved.shape)
        rest = _followed(self.map[whole:], begins[-1], added[whole:])
        return np.concatenate([moved[None], inside, rest])


def _followed(maps: Array, moved: Array, added: Array) -> Array:
    """Return what changes become after each step, one after another."""
    states: Array = np.empty((len(maps), *moved.shape))
    for k, (step, extra) in enumerate(zip(maps, added, strict=True)):
        moved = states[k] = step @ moved + extra
    return states


def steps_along(points: Points, slopes: Slopes, to_x: Array, to_p: Array, pushed: bool) -> Steps:
    """Return the steps between all points, from the slopes in states and parameters there.

    If more than parameters is to change, they are `pushed` by what else does.
    Intervals over which slopes change much, as at a clearance, are cut into parts.
    """
    A, B = _rates(to_x, to_p, pushed)
    scale = _balance(A)
    lengths = np.diff(points.t)
    if slopes.still:
        matrices = _repeated(points, A, to_p[:, : len(scale)], scale)
    else:
        matrices = _single(lengths, _middle(A), _middle(B), scale)
        uneven = _uneven(A, lengths, scale)
        if len(uneven):
            halves = np.full(len(uneven), 2)
            matrices[uneven], bent = _in_parts(points, uneven, halves, slopes, scale, pushed)
            parts = _parts(uneven, bent)
            fine = parts > 2
            if np.any(fine):
                some, count = uneven[fine], parts[fine]
                matrices[some], _ = _in_parts(points, some, count, slopes, scale, pushed)
    ends = np.cumsum([len(scale), to_p.shape[2]])
    return Steps(*np.split(matrices, ends, axis=2))


def _uneven(A: Array, lengths: Array, scale: Array) -> Any:
    """Return the intervals over which slopes change much, other than in a line with those beside them."""
    changes = np.diff(A, axis=0)
    change = _size(changes, scale) * lengths
    turn = np.pad(_size(np.diff(changes, axis=0), scale), 1, constant_values=np.inf)
    bent = np.maximum(turn[1:], turn[:-1]) * lengths > UNEVENNESS
    return np.flatnonzero((change > STRAIGHT) | ((change > UNEVENNESS) & bent))


def _parts(uneven: Any, bent: Array) -> Any:
    """Return into how many parts uneven intervals are cut, by how far slopes in their middle are off a line.

    Errors fall with the number of parts at a corner, and with its square where slopes bend over many
    intervals.
    """
    stretch = np.append(0, np.cumsum(np.diff(uneven) > 1))
    is_corner = np.bincount(stretch)[stretch] <= CORNER
    bends = bent / UNEVENNESS
    parts = np.ceil(2 * np.where(is_corner, bends, np.sqrt(bends)))
    return np.minimum(parts, MOST_PARTS).astype(int)


def _rates(to_x: Array, to_p: Array, pushed: bool) -> tuple[Array, Array]:
    """Return the slopes of the states' rates in the states, and in what forces them: parameters and rates."""
    n = to_x.shape[2]
    A = to_x[:, :n]
    own = to_p[:, :n]
    return A, np.concatenate([own, np.broadcast_to(np.eye(n), A.shape)], axis=2) if pushed else own


def _in_parts(
    points: Points, intervals: Any, counts: Any, slopes: Slopes, scale: Array, pushed: bool
) -> tuple[Array, Array]:
    """Return the matrices of intervals in parts, and how far slopes in their middle are off a line."""
    n, finer = len(scale), points.within(intervals, counts)
    to_x, to_p, _ = slopes(finer)
    A, B = _rates(to_x, to_p, pushed)
    last = np.cumsum(counts + 1) - 1
    first = last - counts
    inside = np.ones(len(finer.t) - 1, dtype=bool)
    inside[last[:-1]] = False
    lengths, a, b = (m[inside] for m in (np.diff(finer.t), _middle(A), _middle(B)))
    steps, begins = _single(lengths, a, b, scale), np.cumsum(counts) - counts
    total = steps[begins]
    for k in range(1, int(counts.max())):
        on = np.flatnonzero(counts > k)
        step = steps[begins[on] + k]
        moved = step[:, :, :n] @ total[on]
        moved[:, :, n:] += step[:, :, n:]
        total[on] = moved
    bent = _size(A[first + counts // 2] - 0.5 * (A[first] + A[last]), scale)
    return total, bent * (finer.t[last] - finer.t[first])


def _middle(values: Array) -> Array:
    return 0.5 * (values[1:] + values[:-1])


def _balance(A: Array) -> Array:
    """Return sizes of the states that make the slopes of their rates comparable."""
    from scipy.linalg import matrix_balance

    if not A.shape[1]:
        return np.ones((0, 1))
    scaling = matrix_balance(np.abs(A).mean(axis=0), permute=False, separate=True)[1][0]
    return np.asarray(scaling, dtype=np.float64)[:, None]


def _size(A: Array, scale: Array) -> Array:
    """Return the largest entry of each matrix, balanced."""
    flat = A.reshape(len(A), -1) * (scale.T / scale).ravel()
    return np.asarray(np.abs(flat).max(axis=1, initial=0.0))


def _single(lengths: Array, A: Array, B: Array, scale: Array) -> Array:
    """Return exp(h A), and its integral times B, side by side."""
    n, columns = A.shape[1], A.shape[1] + B.shape[2]
    found = np.empty((len(A), n, columns))
    inner, outer = scale.T / scale, np.concatenate([scale / scale.T, np.tile(scale, B.shape[2])], axis=1)
    for begin in range(0, len(A), BLOCK):
        some = slice(begin, begin + BLOCK)
        h = lengths[some, None, None]
        found[some] = _exponential(h * A[some] * inner, h * B[some] / scale) * outer
    return found


def _exponential(Z: Array, b: Array) -> Array:
    """Return exp(Z), and its integral times b: where Z is large, by a rational function."""
    stiff = np.einsum("kij,kij->k", Z, Z) > SOFT**2
    if not np.any(stiff):
        return _series(Z, b)
    found = np.empty((*Z.shape[:2], Z.shape[2] + b.shape[2]))
    found[stiff], found[~stiff] = _rational(Z[stiff], b[stiff]), _series(Z[~stiff], b[~stiff])
    return found


def _series(Z: Array, b: Array) -> Array:
    """Return exp(Z), and its integral times b, by terms up to order 9 and 8."""
    one, Z2 = np.eye(Z.shape[1]), Z @ Z
    Z3 = Z2 @ Z
    mean = one / 24 + Z / 120 + Z2 / 720 + Z3 @ (one / 5040 + Z / 40320 + Z2 / 362880)
    mean = one + Z / 2 + Z2 / 6 + Z3 @ mean
    return np.concatenate([one + Z @ mean, mean @ b], axis=2)


def _rational(Z: Array, b: Array) -> Array:
    """Return exp(Z), and its integral times b, as Radau IIA of order 5 does, which damps what dies out."""
    one, Z2 = np.eye(Z.shape[1]), Z @ Z
    Z3 = Z2 @ Z
    left = one - 0.6 * Z + 0.15 * Z2 - Z3 / 60
    right = np.concatenate([one + 0.4 * Z + 0.05 * Z2, (one - 0.1 * Z + Z2 / 60) @ b], axis=2)
    try:
        return np.asarray(np.linalg.solve(left, right), dtype=float)
    except np.linalg.LinAlgError:
        raise SimulationError(
            "slopes along the run are beyond what can be followed between its points"
        ) from None


def _repeated(points: Points, A: Array, B: Array, scale: Array) -> Array:
    """Return the same where A is constant in each segment: few steps differ."""
    n, lengths = len(scale), np.diff(points.t)
    segment = np.cumsum(np.any(np.diff(points.q, axis=0) != 0, axis=1))
    rounded = np.round(lengths / max(float(lengths.max(initial=0.0)), 1e-300), 9)
    kinds = np.column_stack([segment, rounded])
    _, first, kind = np.unique(kinds, axis=0, return_index=True, return_inverse=True)
    few = _single(lengths[first], A[first + 1], np.broadcast_to(np.eye(n), (len(first), n, n)), scale)
    many = few[kind.ravel()]
    weight = many[:, :, n:]
    own = weight @ _middle(B)
    return np.concatenate([many[:, :, :n], own, weight], axis=2)
