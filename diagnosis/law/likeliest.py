"""How fast a missing force changes: by marginal likelihood."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from ...base import Array
from ..criteria import FORCE_EVERY, FORCE_SAMPLES, FORCE_SIZE_RATIO, FORCE_TIMES, FORCE_TIMES_AT_FIRST
from .course import Course, Roughness
from .smoother import filtered

FORGETS_AFTER = {1: 2 * FORCE_SIZE_RATIO**2, 2: (4 / 3 * 3**1.5 * FORCE_SIZE_RATIO**2) ** (1 / 3)}
"""By order, over how many times the time in which it changes by its size a force forgets itself."""


def likeliest(courses: Sequence[Course], sizes: Array, orders: Sequence[int] = (1, 2)) -> list[Roughness]:
    """Return, by order, how fast a force at each site most likely changes, for `sizes` that it may have.

    One measurement in `FORCE_EVERY` will do to tell that, or `FORCE_SAMPLES` of long records, and all that
    are tried go side by side.
    """
    step = float(np.median(np.diff(courses[0].t)))
    longest = max(float(np.ptp(course.t)) for course in courses)
    every = max(FORCE_EVERY, sum(len(course.t) for course in courses) // FORCE_SAMPLES)
    coarse = [course.coarser(every) for course in courses]
    return [_likeliest(coarse, sizes, order, np.log([step, longest])) for order in orders]


def _likeliest(courses: Sequence[Course], sizes: Array, order: int, ends: Array) -> Roughness:
    def of(times: Array) -> Roughness:
        count = times.size // len(sizes)
        forgets = FORGETS_AFTER[order] * np.exp(times.ravel())
        return Roughness(order, np.tile(FORCE_SIZE_RATIO * sizes, count), forgets)

    def evidence(times: Array) -> Array:
        side_by_side = [course.beside(len(times)) for course in courses]
        return filtered(side_by_side, of(times), keep=False).evidence.reshape(times.shape)

    return of(highest(evidence, float(ends[0]), float(ends[1]), len(sizes)))


def highest(value: Callable[[Array], Array], low: float, high: float, count: int) -> Array:
    """Return where functions of one number are highest: over a grid, then finer about its best."""
    grid = np.linspace(low, high, FORCE_TIMES_AT_FIRST)
    tried = np.repeat(grid[:, None], count, axis=1)
    found = value(tried)
    width = grid[1] - grid[0]
    columns = np.arange(count)
    while len(tried) < FORCE_TIMES:
        width /= 2
        best = tried[found.argmax(axis=0), columns]
        further = np.clip(best + np.array([[-width], [width]]), low, high)
        tried, found = np.vstack([tried, further]), np.vstack([found, value(further)])
    return np.asarray(tried[found.argmax(axis=0), columns])
