"""Slopes of expressions in states, parameters and inputs, at all points of a run at once."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import casadi as ca
import numpy as np

from ...base import Array
from .compiled import Batch, dense

if TYPE_CHECKING:
    from ..dae import DAE
    from ..results.result import Segment
    from ..simulation.bound_dae import BoundDAE


@dataclass(frozen=True, eq=False)
class Points:
    """Points of a run: instants, states, algebraic unknowns, and what is constant in each one's segment."""

    closed: BoundDAE
    t: Array
    x: Array
    z: Array
    q: Array

    @staticmethod
    def of(closed: BoundDAE, segments: Sequence[Segment]) -> Points:
        """Return all points of a run."""
        t, x, z = (
            np.concatenate([part for segment in segments for part in getattr(segment, name)])
            for name in ("times", "states", "algebraic")
        )
        q = np.repeat([segment.q for segment in segments], [len(segment) for segment in segments], axis=0)
        return Points(closed, t, x, z, q)

    @cached_property
    def u(self) -> Array:
        """Inputs and their derivatives."""
        return np.asarray(self.closed.input_values(self.q, self.t))

    @cached_property
    def rates(self) -> Array:
        """Rates of the states."""
        return self.closed.motion(self.x, self.z, self.q, self.t[:, None])[0][:, :, 0]

    @property
    def arguments(self) -> tuple[Array, Array, Array, Array, Array]:
        """What every expression of the `DAE` depends on, (points, entries) each: x, z, u, constants, time."""
        constants = self.q[:, : self.closed.dae.constants.numel()]
        return self.x, self.z, self.u, constants, self.t[:, None]

    def only(self, which: Any) -> Points:
        """Return some of the points."""
        return Points(self.closed, self.t[which], self.x[which], self.z[which], self.q[which])

    def within(self, intervals: Any, parts: Any) -> Points:
        """Return points in so many equal parts of intervals each, ends included, by monotone cubics."""
        first, last = self.only(intervals), self.only(intervals + 1)
        step, change = (last.t - first.t)[:, None], last.x - first.x
        a, b = (np.clip(step * end.rates, -3 * np.abs(change), 3 * np.abs(change)) for end in (first, last))
        of = np.repeat(np.arange(len(parts)), parts + 1)
        number = np.arange(len(of)) - np.repeat(np.cumsum(parts + 1) - parts - 1, parts + 1)
        share = (number / parts[of])[:, None]
        x = first.x[of] + share**2 * (3 - 2 * share) * change[of]
        x = x + share * (1 - share) ** 2 * a[of] - share**2 * (1 - share) * b[of]
        z = first.z[of] + share * (last.z - first.z)[of]
        t = first.t[of] + share[:, 0] * step[of, 0]
        return Points(self.closed, t, x, z, first.q[of])

    @property
    def stretches(self) -> tuple[Any, Any]:
        """The first point of each stretch in which nothing discrete changes, and their lengths."""
        changed = np.any(np.diff(self.q, axis=0) != 0, axis=1)
        first = np.concatenate([[0], np.flatnonzero(changed) + 1])
        return first, np.diff(np.append(first, len(self.t)))


class Slopes:
    """Slopes (Jacobians) of expressions of a DAE, its algebraic unknowns eliminated.

    Attributes:
        still: whether slopes in the states are constant within a segment; one point of each then tells all.
    """

    def __init__(self, dae: DAE, expressions: Any, columns: Any) -> None:
        moving = ca.vertcat(dae.x, dae.z, dae.u, dae.time)
        own, driven = (
            [ca.jacobian(e, symbol) for e in (expressions, dae.alg) for symbol in symbols]
            for symbols in ((dae.x, dae.z), (columns, dae.u))
        )
        self.still = not any(ca.depends_on(m, moving) for m in own if m.nnz())
        self._own = Batch(ca.Function("own", dae.arguments(), dense(*own)))
        self._driven = Batch(ca.Function("driven", dae.arguments(), dense(*driven)))

    def __call__(self, points: Points) -> tuple[Array, Array, Array]:
        """Return slopes in x, in the parameters and in u, each (points, expressions, columns)."""
        if self.still and len(points.t) > 1:
            first, lengths = points.stretches
            few = (np.repeat(m, lengths, axis=0) for m in self._own(*points.only(first).arguments))
            to_x, to_z, alg_x, alg_z = few
        else:
            to_x, to_z, alg_x, alg_z = self._own(*points.arguments)
        to_p, to_u, alg_p, alg_u = self._driven(*points.arguments)
        if not points.z.shape[1]:
            return to_x, to_p, to_u
        gain = to_z @ np.linalg.inv(alg_z)
        return to_x - gain @ alg_x, to_p - gain @ alg_p, to_u - gain @ alg_u
