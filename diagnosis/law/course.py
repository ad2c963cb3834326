"""A machine along a run of one record, and how fast a force may change that acts on it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ...base import Array


@dataclass(frozen=True, eq=False)
class Course:
    """A machine along a run of one record, in units of noise.

    Attributes:
        t: points of the run [s].
        map: of the states from each point to the next, (intervals, states, states).
        here, there: of a force at each site at both ends of an interval, (intervals, states, sites).
        to_x, to_f: of the outputs, (points, outputs, states or sites); zero where nothing was measured.
        columns: what was measured, less what the run predicts, then its slopes in what is known but for its
            priors, then in what is known of this record alone, (points, outputs, columns).
        shared: how many slopes are in what all records share.
        priors: weights of the columns of this record alone, 0 for what nothing is known of.
    """

    t: Array
    map: Array
    here: Array
    there: Array
    to_x: Array
    to_f: Array
    columns: Array
    shared: int
    priors: Array

    @property
    def measured(self) -> Any:
        """Which outputs were measured, (points, outputs)."""
        return np.any(self.to_x != 0, axis=2) | np.any(self.to_f != 0, axis=2)

    def coarser(self, every: int) -> Course:
        """Return it from one of so many measured points to the next, a force straight between them."""
        kept = np.flatnonzero(self.measured.any(axis=1))[::every]
        if len(kept) < 2:
            return self
        first, after = kept[:-1], kept[1:]
        lasting = self.t[after] - self.t[first]
        map = np.tile(np.eye(self.map.shape[1]), (len(first), 1, 1))
        here, there = np.zeros((2, len(first), *self.here.shape[1:]))
        for number in range(int(np.diff(kept).max())):
            which = np.flatnonzero(first + number < after)
            at = first[which] + number
            passed = ((self.t[at + n] - self.t[first[which]]) / lasting[which] for n in (0, 1))
            begun, ended = (share[:, None, None] for share in passed)
            near, far = self.here[at], self.there[at]
            here[which] = self.map[at] @ here[which] + near * (1 - begun) + far * (1 - ended)
            there[which] = self.map[at] @ there[which] + near * begun + far * ended
            map[which] = self.map[at] @ map[which]
        to_x, to_f, columns = self.to_x[kept], self.to_f[kept], self.columns[kept]
        return Course(self.t[kept], map, here, there, to_x, to_f, columns, self.shared, self.priors)

    def held(self, moved: Array) -> Course:
        """Return it with what all records share held so far from the centers of its priors."""
        end = 1 + self.shared
        first = self.columns[:, :, :1] - (self.columns[:, :, 1:end] @ moved)[:, :, None]
        columns = np.concatenate([first, self.columns[:, :, end:]], axis=2)
        return replace(self, columns=columns, shared=0)

    def beside(self, count: int) -> Course:
        """Return it with its sites so many times over."""
        here, there, to_f = (np.tile(part, (1, 1, count)) for part in (self.here, self.there, self.to_f))
        return replace(self, here=here, there=there, to_f=to_f)


@dataclass(frozen=True, eq=False)
class Roughness:
    """How fast a force may change: a Matern process of order 1 or 2, of a size, over a time.

    Attributes:
        order: 1 for a force that may jump, 2 for one with a steady slope.
        size: standard deviation by site.
        time: by site, over which the force forgets [s].
    """

    order: int
    size: Array
    time: Array

    @property
    def start(self) -> Array:
        """The covariance of force and slope, (sites, order, order)."""
        if self.order == 1:
            return np.asarray(self.size**2)[:, None, None]
        slope = self.size**2 * 3 / self.time**2
        return np.stack([self.size**2, slope], axis=1)[:, :, None] * np.eye(2)

    def of(self, place: int) -> Roughness:
        """Return that of one site."""
        return Roughness(self.order, self.size[place : place + 1], self.time[place : place + 1])

    def over(self, step: Array) -> tuple[Array, Array]:
        """Return transition and added covariance over steps, (steps, sites, order, order)."""
        h = step[:, None]
        if self.order == 1:
            kept = np.exp(-h / self.time)[:, :, None, None]
        else:
            rate = np.sqrt(3.0) / self.time
            part = np.array([[1 + rate * h, h + 0 * rate], [-(rate**2) * h, 1 - rate * h]])
            kept = np.moveaxis(part, (0, 1), (2, 3)) * np.exp(-rate * h)[:, :, None, None]
        start = self.start
        return kept, start - kept @ start @ np.swapaxes(kept, 2, 3)
