"""`Passed`: what a filter keeps of each point of records, for what comes after."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...base import Array, Flags
from .course import Course


@dataclass(frozen=True, eq=False)
class Passed:
    """What a filter keeps of each point of records side by side, for every site alone.

    Attributes:
        innovations: of what was measured and of its slopes, (points, records, sites, outputs, columns).
        spreads: their variances, (points, records, sites, outputs).
        gains: (points, records, sites, outputs, size).
        rows: of the covariance of the force before the point, (points, records, sites, size).
        ahead: what the force was foreseen to be, by columns, (points, records, sites, columns).
    """

    innovations: Array
    spreads: Array
    gains: Array
    rows: Array
    ahead: Array

    @classmethod
    def nothing(cls, courses: Sequence[Course], size: int, keep: bool) -> Passed:
        """Return room for what is kept, of nothing but innovations unless a smoother is to follow."""
        points, sites = max(len(course.t) for course in courses), courses[0].to_f.shape[2]
        outputs, columns = courses[0].to_x.shape[1], widest(courses)
        shape, kept = (len(courses), sites), points if keep else 0
        return cls(
            np.zeros((points, *shape, outputs, columns)),
            np.ones((points, *shape, outputs)),
            np.zeros((kept, *shape, outputs, size)),
            np.zeros((kept, *shape, size)),
            np.zeros((kept, *shape, columns)),
        )


def widest(courses: Sequence[Course]) -> int:
    """Return how many columns the record has that has most."""
    return max(int(course.columns.shape[2]) for course in courses)


def measured_of(courses: Sequence[Course]) -> Flags:
    """Return which outputs were measured, (points, records, outputs)."""
    points = max(len(course.t) for course in courses)
    parts = [np.pad(course.measured, [(0, points - len(course.t)), (0, 0)]) for course in courses]
    return np.stack(parts, 1)
