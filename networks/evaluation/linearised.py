"""A run with the slopes along it: from point to point, over events."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ...base import Array
from .jacobians import Slopes
from .saltation import SaltationMatrices, passages
from .transition_matrices import Steps, steps_along

if TYPE_CHECKING:
    from ..dae import DAE
    from ..results.result import Result, Segment


@dataclass(frozen=True, eq=False)
class Line:
    """A run with the slopes along it; `edges` are the last points of its segments but the last.

    Those of them at which modes switch are `switched`.
    """

    result: Result
    to_x: Array
    to_p: Array
    to_u: Array
    steps: Steps
    edges: NDArray[np.intp]
    switched: NDArray[np.intp]
    crossed_by_u: Array


def linearised(result: Result, slopes: Slopes, saltation: SaltationMatrices) -> Line:
    """Return a run with the slopes of what begins with the states' rates."""
    points = result.points
    to_x, to_p, to_u = slopes(points)
    steps = steps_along(points, slopes, to_x, to_p)
    passed = dict(passages(result))
    edges = np.cumsum([len(segment) for segment in result.segments])[:-1] - 1
    switched, by_u = edges[[*passed]], np.zeros((0, 0, 0))
    if passed:
        parts = np.cumsum([to_x.shape[2], to_p.shape[2]])
        by_x, by_p, by_u = np.split(saltation(result.closed, [*passed.values()]), parts, axis=2)
        steps.map[switched], steps.own[switched] = by_x, by_p
        steps.here[switched] = steps.there[switched] = 0.0
    return Line(result, to_x, to_p, to_u, steps, edges, switched, by_u)


def held(dae: DAE, segment: Segment, moved: Array) -> Array:
    """Take out changes of what the modes hold at the start, such as the speed of what sticks."""
    modes, start = segment.q[dae.p.numel() :], segment.point(0)[1]
    for change in dae.switching.changes:
        if modes[change.mode] == change.target:
            roots = {reset[0] for reset in change.resets}
            rows = [row for row, root in enumerate(dae.states) if root in roots and start[row] == 0.0]
            moved[rows] = 0.0
    return moved
