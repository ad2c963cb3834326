"""Indicators: what tells of events to come, watched along a run."""

from __future__ import annotations

from copy import copy
from dataclasses import dataclass

import numpy as np

from ....base import Array, Flags
from ..bound_dae import BoundDAE
from ..point import Point
from .constants import CUBIC_MISSES, INDICATOR_FLOOR, INDICATOR_ROUNDING, RATE_NOISE, SAME_INSTANT
from .root_finding import Crossing


@dataclass(eq=False)
class Indicators:
    """The indicators of all transitions, their size so far, and which of them may fire.

    Attributes:
        muted: transitions that have risen above zero but were not allowed to fire.
    """

    closed: BoundDAE

    def __post_init__(self) -> None:
        dae = self.closed.dae
        self.functions = self.closed.switch_functions
        self.muted = np.zeros(len(dae.switching.changes), dtype=bool)
        self.forget_sizes()
        begin = dae.p.numel()
        self._modes = slice(begin, begin + dae.modes.numel())

    def forget_sizes(self) -> None:
        """Forget how large indicators and their rates have been, as where what is given jumps."""
        self._seen, self._fastest = np.zeros(len(self.muted)), np.ones(len(self.muted))

    def copy(self) -> Indicators:
        """Return indicators that know as much, and go on by themselves."""
        other = copy(self)
        other.muted, other._seen, other._fastest = self.muted.copy(), self._seen.copy(), self._fastest.copy()
        return other

    def modes(self, q: Array) -> Array:
        """Return the view of the modes in q."""
        return q[self._modes]

    def active(self, q: Array) -> Flags:
        """Tell which transitions can fire in the present modes."""
        return self.leavable(q) & ~self.muted

    def leavable(self, q: Array) -> Flags:
        """Tell which transitions leave a present mode."""
        present: Flags = self.modes(q)[self.functions.mode_of] == self.functions.sources
        return present

    def watch(self, point: Point) -> tuple[Array, Array]:
        """Return indicators and their rates at a point; remember their size."""
        values, rates = self.functions.watch(point.x, point.z, point.q, point.t)
        np.maximum(self._seen, np.abs(values), out=self._seen)
        np.maximum(self._fastest, np.abs(rates), out=self._fastest)
        return values, rates

    def watch_nodes(self, t: Array, x: Array, z: Array, q: Array) -> tuple[Array, Array]:
        """Return indicators and their rates at the nodes of a stretch, (indicators, nodes)."""
        values, rates = self.functions.watch_nodes(x, z, q, t[:, None])
        np.maximum(self._seen, np.abs(values).max(axis=0, initial=0.0), out=self._seen)
        np.maximum(self._fastest, np.abs(rates).max(axis=0, initial=0.0), out=self._fastest)
        return values.T, rates.T

    def tolerance(self) -> Array:
        """Return the size below which each indicator counts as zero."""
        return np.maximum(INDICATOR_FLOOR, INDICATOR_ROUNDING * self._seen)

    def soonest(self, point: Point) -> tuple[float, int]:
        """Return how soon an indicator will cross at its present rate, and which."""
        values, rates = self.watch(point)
        ahead = self.active(point.q) & (rates > 0) & (values < -self.tolerance())
        if not ahead.any():
            return np.inf, -1
        delays = np.where(ahead, -values / np.where(ahead, rates, 1.0), np.inf)
        first = int(delays.argmin())
        return float(delays[first]), first

    def passed(self, start: Point, point: Point) -> int | None:
        """Return the indicator whose crossing after `start` lies farthest behind a point, if there is any."""
        values, rates = self.watch(point)
        below = self.watch(start)[0] <= self.tolerance()
        instant = SAME_INSTANT * max(1.0, abs(point.t)) * np.abs(rates)
        behind = self.active(point.q) & below & (values > self.tolerance() + instant)
        if not behind.any():
            return None
        since = np.where(behind, values / np.maximum(np.abs(rates), INDICATOR_FLOOR), -np.inf)
        return int(since.argmax())

    def resolved(self, point: Point, times: Array) -> bool:
        """Tell whether nodes are close enough for what time itself does to the indicators.

        No state need move for a force to come and go, so the integrator's steps do not tell.
        """
        watched = self.functions.timed & self.leavable(point.q)
        if not watched.any():
            return True
        halfway = times + 0.5 * (times[1] - times[0])
        here = point.x, point.z, point.q
        at, between = (self.functions.watch_nodes(*here, t[:, None])[0] for t in (times, halfway))
        cubic = (9 * (at[1:-2] + at[2:-1]) - at[:-3] - at[3:]) / 16
        error = np.abs(between[1:-2] - cubic).max(axis=0)
        allowed = CUBIC_MISSES * np.ptp(at, axis=0) + self.tolerance()
        return bool((error <= allowed)[watched].all())

    def flat_at(self, point: Point, crossing: Crossing) -> bool:
        """Tell whether a crossing is where the stretch began, though the indicator does not rise there."""
        _, indicator, t = crossing
        return t <= point.t and self.watch(point)[1][indicator] <= RATE_NOISE * self._fastest[indicator]

    def falling(self, rates: Array) -> Flags:
        """Tell which indicators fall, by more than noise."""
        return rates < -RATE_NOISE * self._fastest

    def rising(self, rates: Array) -> Flags:
        """Tell which indicators rise, by more than noise."""
        return rates > RATE_NOISE * self._fastest
