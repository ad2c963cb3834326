"""The passes of the filter and the smoother in NumPy: records and sites stacked, a step is one product."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from ...base import Array
from .course import Course, Roughness
from .passed import Passed, measured_of, widest


def forward(courses: Sequence[Course], roughness: Roughness, keep: bool) -> Passed:
    """Go forward through records, for every site alone; see `Passed`."""
    stack = _Stack(courses, roughness)
    records, sites, n, order = stack.shape
    size, count = n + order, stack.columns.shape[3]
    passed = Passed.nothing(courses, size, keep)
    W = np.zeros((records, sites, size, size + count))  # covariance and columns side by side
    W[:, :, n:, n:size] = roughness.start
    for k in range(stack.points):
        if keep:
            passed.rows[k], passed.ahead[k] = W[:, :, n, :size], W[:, :, n, size:]
        for j in range(stack.outputs):
            if not stack.measured[k, j]:
                continue
            h = stack.seen(k, j)
            foreseen = (h[..., None, :] @ W)[..., 0, :]
            spread = (h * foreseen[..., :size]).sum(-1) + stack.weight[k, :, None, j]
            gain = foreseen[..., :size] / spread[..., None]
            foreseen[..., size:] -= stack.columns[k, :, None, j]
            W -= gain[..., None] * foreseen[..., None, :]
            passed.innovations[k, :, :, j], passed.spreads[k, :, :, j] = -foreseen[..., size:], spread
            if keep:
                passed.gains[k, :, :, j] = gain
        if k + 1 < stack.points:
            T, Q = stack.step(k)
            W = T @ W
            P = W[..., :size] @ np.swapaxes(T, 2, 3) + Q
            W[..., :size] = 0.5 * (P + np.swapaxes(P, 2, 3))
    return passed


def back(
    courses: Sequence[Course], roughness: Roughness, passed: Passed, missed: Array
) -> tuple[Array, Array]:
    """Return what later points tell of the force and of its variance, (points, records, sites) each.

    Args:
        courses: the records.
        roughness: of the force at each site.
        passed: what a filter has kept.
        missed: its innovations with what nobody measured at its best, (points, records, sites, outputs).
    """
    stack = _Stack(courses, roughness)
    records, sites, n, order = stack.shape
    size = n + order
    force, variance = np.zeros((2, stack.points, records, sites))
    M = np.zeros((records, sites, size, size + 1))  # what later points tell of the error, and of the state
    for k in range(stack.points - 1, -1, -1):
        for j in range(stack.outputs - 1, -1, -1):
            if not stack.measured[k, j]:
                continue
            h, gain, spread = stack.seen(k, j), passed.gains[k, :, :, j], passed.spreads[k, :, :, j]
            live = np.where(stack.weight[k, :, None, j] < UNSEEN, 1.0, 0.0) / spread
            told = (gain[..., None, :] @ M)[..., 0, :]
            both = (gain * told[..., :size]).sum(-1) + live
            part = h[..., None] * (told[..., :size] - 0.5 * both[..., None] * h)[..., None, :]
            M[..., :size] -= part + np.swapaxes(part, 2, 3)
            M[..., size] += h * (missed[k, :, :, j] * live - told[..., size])[..., None]
        row = passed.rows[k]
        told = (row[..., None, :] @ M)[..., 0, :]
        force[k], variance[k] = told[..., size], row[..., n] - (told[..., :size] * row).sum(-1)
        if k:
            T, _ = stack.step(k - 1)
            M = np.swapaxes(T, 2, 3) @ M
            M[..., :size] = M[..., :size] @ T
    return force, variance


UNSEEN = 1e200  # variance of what was not measured
TOGETHER = 64  # points, whose rows and transitions are made at once


class _Stack:
    """Records of several lengths side by side; shorter ones wait at their ends."""

    def __init__(self, courses: Sequence[Course], roughness: Roughness) -> None:
        order, seen = roughness.order, measured_of(courses)
        n, sites = courses[0].map.shape[1], courses[0].to_f.shape[2]
        self.shape = len(courses), sites, n, order
        self.points, self.outputs = max(len(c.t) for c in courses), courses[0].to_x.shape[1]

        def stacked(parts: Sequence[Array]) -> Array:
            most = max(len(part) for part in parts)
            return np.stack([np.pad(p, [(0, most - len(p))] + [(0, 0)] * (p.ndim - 1)) for p in parts], 1)

        width = widest(courses)
        wide = [np.pad(c.columns, [(0, 0), (0, 0), (0, width - c.columns.shape[2])]) for c in courses]
        self.columns = stacked(wide)
        self.to_x, self.to_f = stacked([c.to_x for c in courses]), stacked([c.to_f for c in courses])
        here, there = stacked([c.here for c in courses]), stacked([c.there for c in courses])
        self.map = stacked([c.map for c in courses])
        for number, course in enumerate(courses):
            self.map[len(course.map) :, number] = np.eye(n)
        self.weight = np.where(seen, 1.0, 2 * UNSEEN)
        self.measured: Any = seen.any(axis=1)
        steps = stacked([np.diff(c.t) for c in courses])
        kept, added = zip(*(roughness.over(step) for step in steps.T), strict=True)
        self.kept, self.added = np.stack(kept, 1), np.stack(added, 1)
        self.here, self.there = np.swapaxes(here, 2, 3), np.swapaxes(there, 2, 3)  # (k, r, s, n)
        self._part: tuple[int, Array, Array, Array] = -1, kept[0], kept[0], kept[0]

    def seen(self, k: int, j: int) -> Array:
        """Return the row of an output at a point, (records, sites, size)."""
        rows = self._near(k)[3]
        return np.asarray(rows[k % TOGETHER, j])

    def step(self, k: int) -> tuple[Array, Array]:
        """Return transition and added covariance of an interval, (records, sites, size, size)."""
        _, steps, added, _ = self._near(k)
        return steps[k % TOGETHER], added[k % TOGETHER]

    def _near(self, k: int) -> tuple[int, Array, Array, Array]:
        """Return transitions, added covariances and rows of the outputs about a point."""
        part = k // TOGETHER
        if part != self._part[0]:
            at = slice(part * TOGETHER, (part + 1) * TOGETHER)
            self._part = part, *self._steps(at), self._rows(at)
        return self._part

    def _rows(self, at: slice) -> Array:
        """Return the rows of the outputs at points, (points, outputs, records, sites, size)."""
        n, order = self.shape[2:]
        to_x, to_f = np.swapaxes(self.to_x[at], 1, 2), np.swapaxes(self.to_f[at], 1, 2)
        rows = np.zeros((*to_f.shape, n + order))
        rows[..., :n], rows[..., n] = to_x[:, :, :, None], to_f
        return rows

    def _steps(self, at: slice) -> tuple[Array, Array]:
        """Return transitions and added covariances of intervals."""
        n, order = self.shape[2:]
        kept, here, there = self.kept[at], self.here[at], self.there[at]
        T = np.zeros((*kept.shape[:3], n + order, n + order))
        T[..., :n, :n] = self.map[at, :, None]
        T[..., n:, n:] = kept
        T[..., :n, n:] = there[..., None] * kept[..., :1, :]
        T[..., :n, n] += here
        G = np.zeros((*kept.shape[:3], n + order, order))
        G[..., :n, 0] = there
        G[..., n:, :] = np.eye(order)
        return T, G @ self.added[at] @ np.swapaxes(G, -1, -2)
