"""The force that explains a record: a fixed-interval smoother along a run, linear in its points.

The machine is linear along the run, the force f at a site is a random process,

    x' = map x + here f + there f',   y = to_x x + to_f f + columns b + e,

with noise e of variance 1 and b what nobody measured: parameters, values of the record's own, its start. A
Kalman filter goes forward with the columns side by side, least squares of its innovations give b, and the
smoother of Bryson and Frazier goes back. Both passes are a C program of ours, and NumPy where no compiler is.

Sources: A. E. Bryson, M. Frazier, Smoothing for linear and nonlinear dynamic systems, 1963; F. C. Schweppe,
Evaluation of likelihood functions for Gaussian signals, IEEE Trans. Inf. Theory 11 (1965) 61-70; Matern
processes as state space: J. Hartikainen, S. Sarkka, Kalman filtering and smoothing solutions to temporal
Gaussian process regression models, 2010.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...base import Array
from . import stacked_passes
from .compiled_passes import compiled_passes
from .course import Course, Roughness
from .passed import Passed, measured_of


@dataclass(frozen=True, eq=False)
class Filtered:
    """What a filter has found of records side by side.

    Attributes:
        evidence: by site, the logarithm of the likelihood at the best values of what nobody measured.
        chi_squared: by site, the squares of what the filter could not foresee.
        unknown: (records, sites, columns): values of what nobody measured, shared ones first.
        passed: what it keeps of each point, for a smoother.
    """

    courses: Sequence[Course]
    roughness: Roughness
    evidence: Array
    chi_squared: Array
    unknown: Array
    passed: Passed


def filtered(courses: Sequence[Course], roughness: Roughness, keep: bool = True) -> Filtered:
    """Go forward through records side by side, for every site alone.

    Args:
        courses: the records.
        roughness: of the force at each site.
        keep: whether a smoother is to follow.
    """
    passed = (compiled_passes() or stacked_passes).forward(courses, roughness, keep)
    seen = measured_of(courses)[:, :, None, :]
    weighted = passed.innovations * np.sqrt(np.where(seen, 1.0, 0.0) / passed.spreads)[..., None]
    gram = np.einsum("krsjc,krsjd->rscd", weighted, weighted, optimize=True)
    unknown, squares = _solved(gram, courses)
    spent = np.where(seen, np.log(passed.spreads), 0.0).sum(axis=(0, 1, 3))
    return Filtered(courses, roughness, -0.5 * (spent + squares), squares, unknown, passed)


def smoothed(found: Filtered) -> tuple[Array, Array]:
    """Return the force at each site with its standard error, (points, records, sites) each."""
    passed, unknown = found.passed, found.unknown
    signs = np.concatenate([np.ones((*unknown.shape[:2], 1)), -unknown], axis=2)
    missed = (passed.innovations @ signs[..., None])[..., 0]
    passes = compiled_passes() or stacked_passes
    later, variance = passes.back(found.courses, found.roughness, passed, missed)
    return (passed.ahead * signs).sum(-1) + later, np.sqrt(np.maximum(variance, 0.0))


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
