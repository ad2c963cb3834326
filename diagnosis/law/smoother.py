"""The force that explains a record: a fixed-interval smoother along a run, linear in its points.

The machine is linear along the run, the force f at a site is a random process,

    x' = map x + here f + there f',   y = to_x x + to_f f + columns b + e,

with noise e of variance 1 and b what nobody measured: parameters, values of the record's own, its start. A
Kalman filter goes forward with the columns side by side, least squares of its innovations give b, and the
smoother of Bryson and Frazier goes back. Records and sites are stacked, so that a step is one product.

Sources: A. E. Bryson, M. Frazier, Smoothing for linear and nonlinear dynamic systems, 1963; F. C. Schweppe,
Evaluation of likelihood functions for Gaussian signals, IEEE Trans. Inf. Theory 11 (1965) 61-70; Matern
processes as state space: J. Hartikainen, S. Sarkka, Kalman filtering and smoothing solutions to temporal
Gaussian process regression models, 2010.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...base import Array
from .course import Course, Roughness


@dataclass(frozen=True, eq=False)
class Filtered:
    """What a filter keeps of each point of stacked records, for what comes after.

    Attributes:
        evidence: by site, the logarithm of the likelihood at the best values of what nobody measured.
        chi_squared: by site, the squares of what the filter could not foresee.
        unknown: (records, sites, columns): values of what nobody measured, shared ones first.
    """

    courses: Sequence[Course]
    roughness: Roughness
    evidence: Array
    chi_squared: Array
    unknown: Array
    innovations: Array
    gains: Array
    spreads: Array
    rows: Array
    ahead: Array


def filtered(courses: Sequence[Course], roughness: Roughness, keep: bool = True) -> Filtered:
    """Go forward through records side by side, for every site alone.

    Args:
        courses: the records.
        roughness: of the force at each site.
        keep: whether a smoother is to follow.
    """
    stack = _Stack(courses, roughness)
    records, sites, n, order = stack.shape
    size, outputs, count = n + order, stack.outputs, stack.columns.shape[3]
    W = np.zeros((records, sites, size, size + count))  # covariance and columns side by side
    W[:, :, n:, n:size] = roughness.start
    innovations = np.zeros((stack.points, records, sites, outputs, count))
    spreads = np.ones((stack.points, records, sites, outputs))
    kept = stack.points if keep else 0
    gains = np.zeros((kept, records, sites, outputs, size))
    rows, ahead = np.zeros((kept, records, sites, size)), np.zeros((kept, records, sites, count))
    for k in range(stack.points):
        if keep:
            rows[k], ahead[k] = W[:, :, n, :size], W[:, :, n, size:]
        for j in range(outputs):
            if not stack.measured[k, j]:
                continue
            h = stack.seen(k, j)
            foreseen = (h[..., None, :] @ W)[..., 0, :]
            spread = (h * foreseen[..., :size]).sum(-1) + stack.weight[k, :, None, j]
            gain = foreseen[..., :size] / spread[..., None]
            foreseen[..., size:] -= stack.columns[k, :, None, j]
            W -= gain[..., None] * foreseen[..., None, :]
            innovations[k, :, :, j], spreads[k, :, :, j] = -foreseen[..., size:], spread
            if keep:
                gains[k, :, :, j] = gain
        if k + 1 < stack.points:
            T, Q = stack.step(k)
            W = T @ W
            P = W[..., :size] @ np.swapaxes(T, 2, 3) + Q
            W[..., :size] = 0.5 * (P + np.swapaxes(P, 2, 3))
    seen: Any = (stack.weight < UNSEEN)[:, :, None, :]
    weighted = innovations * np.sqrt(np.where(seen, 1.0, 0.0) / spreads)[..., None]
    gram = np.einsum("krsjc,krsjd->rscd", weighted, weighted, optimize=True)
    unknown, squares = _solved(gram, courses)
    spent = np.where(seen, np.log(spreads), 0.0).sum(axis=(0, 1, 3))
    evidence = -0.5 * (spent + squares)
    return Filtered(courses, roughness, evidence, squares, unknown, innovations, gains, spreads, rows, ahead)


def smoothed(found: Filtered) -> tuple[Array, Array]:
    """Return the force at each site with its standard error, (points, records, sites) each."""
    stack = _Stack(found.courses, found.roughness)
    records, sites, n, order = stack.shape
    size = n + order
    signs = np.concatenate([np.ones((records, sites, 1)), -found.unknown], axis=2)
    missed = (found.innovations @ signs[..., None])[..., 0]
    force = (found.ahead * signs).sum(-1)
    error = np.zeros_like(force)
    M = np.zeros((records, sites, size, size + 1))  # what later points tell of the error, and of the state
    for k in range(stack.points - 1, -1, -1):
        for j in range(stack.outputs - 1, -1, -1):
            if not stack.measured[k, j]:
                continue
            h, gain, spread = stack.seen(k, j), found.gains[k, :, :, j], found.spreads[k, :, :, j]
            live = np.where(stack.weight[k, :, None, j] < UNSEEN, 1.0, 0.0) / spread
            told = (gain[..., None, :] @ M)[..., 0, :]
            both = (gain * told[..., :size]).sum(-1) + live
            part = h[..., None] * (told[..., :size] - 0.5 * both[..., None] * h)[..., None, :]
            M[..., :size] -= part + np.swapaxes(part, 2, 3)
            M[..., size] += h * (missed[k, :, :, j] * live - told[..., size])[..., None]
        row = found.rows[k]
        told = (row[..., None, :] @ M)[..., 0, :]
        force[k] += told[..., size]
        error[k] = row[..., n] - (told[..., :size] * row).sum(-1)
        if k:
            T, _ = stack.step(k - 1)
            M = np.swapaxes(T, 2, 3) @ M
            M[..., :size] = M[..., :size] @ T
    return force, np.sqrt(np.maximum(error, 0.0))


UNSEEN = 1e200  # variance of what was not measured
TOGETHER = 64  # points, whose rows and transitions are made at once


class _Stack:
    """Records of several lengths side by side; shorter ones wait at their ends."""

    def __init__(self, courses: Sequence[Course], roughness: Roughness) -> None:
        self.courses, order = courses, roughness.order
        n, sites = courses[0].map.shape[1], courses[0].to_f.shape[2]
        self.shape = len(courses), sites, n, order
        self.points, self.outputs = max(len(c.t) for c in courses), courses[0].to_x.shape[1]

        def stacked(parts: Sequence[Array]) -> Array:
            most = max(len(part) for part in parts)
            return np.stack([np.pad(p, [(0, most - len(p))] + [(0, 0)] * (p.ndim - 1)) for p in parts], 1)

        width = max(c.columns.shape[2] for c in courses)
        wide = [np.pad(c.columns, [(0, 0), (0, 0), (0, width - c.columns.shape[2])]) for c in courses]
        self.columns = stacked(wide)
        self.to_x, self.to_f = stacked([c.to_x for c in courses]), stacked([c.to_f for c in courses])
        here, there = stacked([c.here for c in courses]), stacked([c.there for c in courses])
        self.map = stacked([c.map for c in courses])
        for number, course in enumerate(courses):
            self.map[len(course.map) :, number] = np.eye(n)
        self.weight = np.full((self.points, len(courses), self.outputs), 2 * UNSEEN)
        for number, course in enumerate(courses):
            self.weight[: len(course.t), number] = np.where(course.measured, 1.0, 2 * UNSEEN)
        self.measured: Any = (self.weight < UNSEEN).any(axis=1)
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


def _solved(gram: Array, courses: Sequence[Course]) -> tuple[Array, Array]:
    """Return what nobody measured by least squares, and by site the squares that are left."""
    records, sites, count, _ = gram.shape
    shared = courses[0].shared
    first, squares, unknown = 1 + shared, np.zeros(sites), np.zeros((records, sites, count - 1))
    for site in range(sites):
        total = np.zeros((first, first))
        own = []
        for number, course in enumerate(courses):
            G = gram[number, site].copy()
            prior = np.pad(course.priors, (0, count - first - len(course.priors)))
            inner = _inverse(G[first:, first:] + np.diag(prior**2))
            own.append(inner @ G[first:, :first])
            total += G[:first, :first] - G[:first, first:] @ own[-1]
        inner = np.asarray(np.linalg.inv(total[1:, 1:] + np.eye(shared)), dtype=float)
        moved = inner @ total[1:, 0]
        squares[site] = total[0, 0] - total[0, 1:] @ moved
        for number in range(records):
            unknown[number, site] = np.concatenate([moved, own[number] @ np.array([1.0, *-moved])])
    return unknown, squares


def _inverse(matrix: Array) -> Array:
    """Return the inverse over what a matrix tells at all."""
    size = np.sqrt(np.maximum(np.diag(matrix), 1e-300))
    strength, vectors = np.linalg.eigh(matrix / np.outer(size, size))
    kept = strength > 1e-12 * max(strength.max(initial=0.0), 1e-300)
    return np.asarray((vectors[:, kept] / strength[kept]) @ vectors[:, kept].T / np.outer(size, size))
