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
SUMMED = 1.0  # size of slopes, times the length, up to which their exponential is summed as a series
DOUBLINGS = 5  # of lengths that are short enough for that; what is stiffer has settled


@dataclass(frozen=True, eq=False)
class Steps:
    """What becomes of changes of the states from each point to the next.

    With B dp + b forcing the changes dx, straight from point to point,

        dx' = map dx + own dp + here b + there b'.

    Attributes:
        map: (intervals, states, states).
        own: (intervals, states, parameters).
        here, there: (intervals, states, states).
    """

    map: Array
    own: Array
    here: Array
    there: Array

    def reversed(self) -> Steps:
        """Return the steps by which what the end is sensitive to goes back to the start."""
        return Steps(np.swapaxes(self.map, 1, 2)[::-1], *(m[::-1] for m in (self.own, self.here, self.there)))

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


def steps_along(points: Points, slopes: Slopes, to_x: Array, to_p: Array) -> Steps:
    """Return the steps between all points, from the slopes in states and parameters there.

    Intervals over which slopes change much, as at a clearance, are cut into parts.
    """
    n = to_x.shape[2]
    A, B = to_x[:, :n], to_p[:, :n]
    scale = _balance(A)
    lengths = np.diff(points.t)
    if slopes.still:
        return _forced(*_repeated(points, A, scale), B)
    steps = _forced(*_single(lengths, _middle(A), scale), B)
    uneven = _uneven(A, lengths, scale)
    if len(uneven):
        bent = _cut(steps, points, uneven, np.full(len(uneven), 2), slopes, scale)
        parts = _parts(uneven, bent)
        fine = parts > 2
        if np.any(fine):
            _cut(steps, points, uneven[fine], parts[fine], slopes, scale)
    return steps


def _forced(map: Array, here: Array, there: Array, B: Array) -> Steps:
    return Steps(map, here @ B[:-1] + there @ B[1:], here, there)


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


def _cut(steps: Steps, points: Points, intervals: Any, counts: Any, slopes: Slopes, scale: Array) -> Array:
    """Put in the steps of intervals in parts, and return how far slopes in their middle are off a line."""
    n, finer = len(scale), points.within(intervals, counts)
    to_x, to_p, _ = slopes(finer)
    A, B = to_x[:, :n], to_p[:, :n]
    last = np.cumsum(counts + 1) - 1
    first = last - counts
    inside = np.ones(len(finer.t) - 1, dtype=bool)
    inside[last[:-1]] = False
    maps, here, there = _single(np.diff(finer.t)[inside], _middle(A)[inside], scale)
    own = here @ B[:-1][inside] + there @ B[1:][inside]
    begins = np.cumsum(counts) - counts
    passed = (np.arange(len(maps)) - np.repeat(begins, counts))[:, None, None]
    begun, ended = ((passed + more) / np.repeat(counts, counts)[:, None, None] for more in (0, 1))
    falling, rising = here * (1 - begun) + there * (1 - ended), here * begun + there * ended
    added = np.concatenate([own, falling, rising], axis=2)
    product, gathered = maps[begins], added[begins]
    for k in range(1, int(counts.max())):
        on = np.flatnonzero(counts > k)
        step = maps[begins[on] + k]
        product[on] = step @ product[on]
        gathered[on] = step @ gathered[on] + added[begins[on] + k]
    steps.map[intervals] = product
    ends = np.cumsum([own.shape[2], n])
    for kept, part in zip(
        (steps.own, steps.here, steps.there), np.split(gathered, ends, axis=2), strict=True
    ):
        kept[intervals] = part
    bent = _size(A[first + counts // 2] - 0.5 * (A[first] + A[last]), scale)
    return np.asarray(bent * (finer.t[last] - finer.t[first]))


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


def _single(lengths: Array, A: Array, scale: Array) -> tuple[Array, Array, Array]:
    """Return exp(h A), and what forces at both ends of an interval add, straight between them."""
    maps, here, there = (np.empty(A.shape) for _ in range(3))
    inner, outer = scale.T / scale, scale / scale.T
    for begin in range(0, len(A), BLOCK):
        some = slice(begin, begin + BLOCK)
        h = lengths[some, None, None]
        maps[some], first, second = (part * outer for part in _exponential(h * A[some] * inner))
        here[some], there[some] = h * (first - second), h * second
    return maps, here, there


def _exponential(Z: Array) -> Array:
    """Return e^Z, (e^Z - 1)/Z and (e^Z - 1 - Z)/Z^2; where Z is large, by a rational function."""
    size = np.sqrt(np.einsum("kij,kij->k", Z, Z))
    doublings = np.ceil(np.log2(np.maximum(size / SUMMED, 1.0)))
    stiff = doublings > DOUBLINGS
    if not np.any(stiff):
        return _doubled(Z, doublings)
    found: Array = np.empty((3, *Z.shape))
    found[:, stiff], found[:, ~stiff] = _rational(Z[stiff]), _doubled(Z[~stiff], doublings[~stiff])
    return found


def _doubled(Z: Array, doublings: Array) -> Array:
    """Return the same, the last summed for a part of Z, and doubled so many times from there.

    It is then a quarter of the second's square and half of itself before.

    Source: B. Skaflestad, W. M. Wright, The scaling and modified squaring method for matrix functions related
    to the exponential, Applied Numerical Mathematics 59 (2009) 783-799.
    """
    one, part = np.eye(Z.shape[1]), 0.5 ** doublings[:, None, None] * Z
    second = _series(part)
    first = one + part @ second
    for number in range(int(doublings.max(initial=0))):
        on = doublings > number
        second[on] = 0.25 * first[on] @ first[on] + 0.5 * second[on]
        part[on] *= 2
        first[on] = one + part[on] @ second[on]
    return np.stack([one + Z @ first, first, second])


def _series(Z: Array) -> Array:
    """Return (e^Z - 1 - Z)/Z^2 by terms up to order 8."""
    one, Z2 = np.eye(Z.shape[1]), Z @ Z
    Z3 = Z2 @ Z
    rest = one / 120 + Z / 720 + Z2 / 5040 + Z3 @ (one / 40320 + Z / 362880 + Z2 / 3628800)
    return np.asarray(one / 2 + Z / 6 + Z2 / 24 + Z3 @ rest)


def _rational(Z: Array) -> Array:
    """Return the same as Radau IIA of order 5 does, which damps what dies out."""
    one, Z2 = np.eye(Z.shape[1]), Z @ Z
    left = one - 0.6 * Z + 0.15 * Z2 - Z2 @ Z / 60
    right = one + 0.4 * Z + 0.05 * Z2, one - 0.1 * Z + Z2 / 60, one / 2 - 2 / 15 * Z + Z2 / 60
    try:
        found = np.linalg.solve(left, np.concatenate(right, axis=2))
    except np.linalg.LinAlgError:
        raise SimulationError(
            "slopes along the run are beyond what can be followed between its points"
        ) from None
    return np.asarray(np.split(found, 3, axis=2), dtype=float)


def _repeated(points: Points, A: Array, scale: Array) -> tuple[Array, Array, Array]:
    """Return the same as for single intervals where A is constant in each segment: few steps differ."""
    lengths = np.diff(points.t)
    segment = np.cumsum(np.any(np.diff(points.q, axis=0) != 0, axis=1))
    rounded = np.round(lengths / max(float(lengths.max(initial=0.0)), 1e-300), 9)
    kinds = np.column_stack([segment, rounded])
    _, first, kind = np.unique(kinds, axis=0, return_index=True, return_inverse=True)
    maps, here, there = _single(lengths[first], A[first + 1], scale)
    return maps[kind.ravel()], here[kind.ravel()], there[kind.ravel()]
