"""`DenseOutput`: dense output, signals between the points of a run, by finer runs where need be."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any
from warnings import warn

import numpy as np

from ...base import Array, Flags, Ints
from ..evaluation.jacobians import Points
from ..results.pieces import Pieces
from .events.functions import NODES
from .integrator import IntegratorError
from .legs import Leg
from .point import Point, solve_algebraic
from .settings import Tolerance

BEND_SHARE, STRAY_SHARE = 0.03, 0.6  # of half a range: a signal that bends more, a state that strays more
DOUBTFUL_SHARE = 0.2  # of the pieces, above which none is trusted
LOST_SHARE = 0.01  # of a range over a window, above which a loss is told
PIECES_AROUND, MOST_PIECES, MOST_LEVELS, MOST_STEPS = 8, 10_000, 3, 5_000
FINE_STEPS = 8.0  # longest steps that a piece integrated again may last
ROUNDING, ULPS = 1e-9, 4


@dataclass(frozen=True, eq=False)
class Gaps:
    """Pieces of a run between neighbouring points, (pieces, ...): where they begin and end.

    What is constant in a piece is what holds at its end: at its beginning another piece may have ended.
    """

    first: Points
    last: Points

    @staticmethod
    def of(points: Points, pieces: Any) -> Gaps:
        """Return pieces by the numbers of the points at which they begin."""
        first, last = points.only(pieces), points.only(pieces + 1)
        z = first.z.copy()
        for k in np.flatnonzero((first.q != last.q).any(axis=1) & bool(z.shape[1])):
            begin = Point(float(first.t[k]), first.x[k], z[k], last.q[k])
            solve_algebraic(points.closed, begin)
            z[k] = begin.z
        return Gaps(Points(points.closed, first.t, first.x, z, last.q), last)

    @property
    def length(self) -> Array:
        """How long each piece is [s]."""
        return self.last.t - self.first.t

    def only(self, which: Any) -> Gaps:
        """Return some of the pieces."""
        return Gaps(self.first.only(which), self.last.only(which))


class DenseOutput:
    """What happened between the points of a run.

    Within a piece a signal is the cubic that meets its values and slopes at both ends. Where that departs
    far from the chord, or a state does so from what all the run shows of it, points are too far apart to
    tell: the piece is integrated again from its beginning, with points in between. Where that happens often,
    a piece that looks well may do so by chance, and is integrated again, too; and so is a piece in which
    something that is given switches, or moves faster than points show.
    """

    def __init__(self, legs: Sequence[Leg], solver: str, tolerance: Tolerance, points: Points) -> None:
        self.closed, self.points, self.tolerance = points.closed, points, tolerance
        self._switches = np.array([leg.begin for leg in legs[1:]])
        self._longest = np.array([leg.max_step for leg in legs])
        self._solver = "auto" if solver == "compiled" else solver
        self._finer: dict[tuple[float, float], Gaps] = {}

    def course(self, name: str, values: Array, begin: float, end: float) -> Pieces:
        """Return a signal between the points that enclose a window; `values` are those at all points."""
        known, ranges = _extremes(values), self._ranges
        gaps, done, budget = Gaps.of(self.points, self._pieces(begin, end)), list[Pieces](), MOST_PIECES
        level = 0
        while True:
            course = self._cubics(name, gaps)
            known, ranges = _extremes(known, course.ends), _extremes(ranges, gaps.last.x)
            doubtful = course.bend > BEND_SHARE * self._size(known)
            wanted = doubtful | self._stray(gaps, ranges)
            wanted |= np.count_nonzero(wanted) > DOUBTFUL_SHARE * len(wanted)
            wanted |= self._hidden(gaps, FINE_STEPS if level else 1.0)
            budget -= int(np.count_nonzero(wanted))
            if level == MOST_LEVELS or budget < 0 or not wanted.any():
                break
            done.append(course[~wanted])
            gaps, level = self._again(gaps.only(wanted)), level + 1
        whole = course.straight(doubtful).merged(*done)
        self._tell(name, course[doubtful], float(self._size(known) * whole.length.sum()))
        return whole

    def integrals(self, over: Callable[[Gaps], tuple[Array, Flags]]) -> tuple[Array, Array]:
        """Return where pieces of the whole run begin, and integrals over each, (pieces, integrals).

        `over` returns the integrals over pieces, and in which of them points are too far apart for it.
        """
        ranges, budget, level = self._ranges, MOST_PIECES, 0
        gaps, done = Gaps.of(self.points, self._pieces(-np.inf, np.inf)), list[tuple[Array, Array]]()
        while True:
            found, doubtful = over(gaps)
            ranges = _extremes(ranges, gaps.last.x)
            wanted = doubtful | self._stray(gaps, ranges) | self._hidden(gaps, FINE_STEPS if level else 1.0)
            budget -= int(np.count_nonzero(wanted))
            if level == MOST_LEVELS or budget < 0 or not wanted.any():
                break
            done.append((gaps.first.t[~wanted], found[~wanted]))
            gaps, level = self._again(gaps.only(wanted)), level + 1
        begins, integrals = zip(*done, (gaps.first.t, found), strict=True)
        return np.concatenate(begins), np.concatenate(integrals)

    @cached_property
    def _ranges(self) -> Array:
        return _extremes(self.points.x)

    def _size(self, extremes: Array) -> Array:
        """Return half of each range, and not less than what the integrator may have left wrong."""
        low, high = extremes
        size: Array = np.maximum(0.5 * (high - low), 10 * self.tolerance.of(np.maximum(-low, high)))
        return size

    def _pieces(self, begin: float, end: float) -> Ints:
        """Return the numbers of the points at which pieces begin that touch a window, and some around."""
        t = self.points.t
        pieces = np.flatnonzero(np.diff(t) > ULPS * np.spacing(np.abs(t[1:])))
        first, last = np.searchsorted(t[pieces + 1], begin), np.searchsorted(t[pieces], end, side="right")
        return pieces[max(0, int(first) - PIECES_AROUND) : int(last) + PIECES_AROUND]

    def _cubics(self, name: str, gaps: Gaps) -> Pieces:
        signal = self.closed.moving_signal(name)
        (y0, s0), (y1, s1) = (
            (m[:, 0, 0] for m in signal(p.x, p.z, p.q, p.t[:, None])) for p in (gaps.first, gaps.last)
        )
        return Pieces.cubics(gaps.first.t, gaps.length, (y0, y1), (s0, s1))

    def _stray(self, gaps: Gaps, ranges: Array) -> Flags:
        """Tell in which pieces a state must do what points do not show, from its rates at both ends."""
        change, h = gaps.last.x - gaps.first.x, gaps.length[:, None]
        at_first, at_last = (np.abs(h * p.rates - change) for p in (gaps.first, gaps.last))
        stray: Flags = np.any((at_first + at_last) / 12 > STRAY_SHARE * self._size(ranges), axis=1)
        return stray

    def _hidden(self, gaps: Gaps, steps: float) -> Flags:
        """Tell in which pieces something that is given may do what neither end shows.

        That is where it switches, and in what lasts longer than some of the longest steps that see it.
        """
        before = np.searchsorted(self._switches, gaps.first.t, side="right")
        after = np.searchsorted(self._switches, gaps.last.t, side="left")
        hidden: Flags = (after > before) | (gaps.length > (steps + ROUNDING) * self._longest[before])
        return hidden

    def _again(self, gaps: Gaps) -> Gaps:
        """Return the pieces that come of integrating each piece again, which is done once."""
        pieces = []
        for number in range(len(gaps.length)):
            one = gaps.only([number])
            key = float(one.first.t[0]), float(one.last.t[0])
            if key not in self._finer:
                self._finer[key] = self._fine(one)
            pieces.append(self._finer[key])
        return Gaps(*(_joined([getattr(piece, end) for piece in pieces]) for end in ("first", "last")))

    def _fine(self, gap: Gaps) -> Gaps:
        """Return the pieces that come of integrating one again; itself where that fails."""
        first, last = gap.first, gap.last
        begin, end = float(first.t[0]), float(last.t[0])
        inside = (self._switches > begin) & (self._switches < end)
        parts, point = [first], Point(begin, first.x[0], first.z[0], first.q[0])
        try:
            for stop in (*self._switches[inside].tolist(), end):
                parts.append(self._stretch(point, stop))
                point = Point(stop, parts[-1].x[-1], parts[-1].z[-1], point.q)
        except IntegratorError:
            return gap
        fine = _joined(parts)
        fine.x[-1], fine.z[-1] = last.x[0], last.z[0]
        return Gaps.of(fine, np.arange(len(fine.t) - 1))

    def _stretch(self, point: Point, stop: float) -> Points:
        """Return points after one up to an instant.

        Raises:
            IntegratorError: if they cannot be found.
        """
        shift = ULPS * np.spacing(abs(stop))
        span = stop - shift - point.t
        if not span > NODES * shift:
            raise IntegratorError("there are too few numbers between these instants")
        longest = self._longest[np.searchsorted(self._switches, point.t, side="right")]
        stepper = self.closed.stepper(self._solver, self.tolerance, NODES, MOST_STEPS)
        found = stepper.run(point, span, float(longest))
        times = np.linspace(point.t, stop, NODES + 1)[1:]
        return Points(self.closed, times, found.states, found.algebraic, np.tile(point.q, (NODES, 1)))

    def _tell(self, name: str, lost: Pieces, most: float) -> None:
        """Warn if what is lost of a signal between points may count."""
        missed = float(lost.bend @ lost.length)
        if missed > LOST_SHARE * most:
            dae = self.closed.dae
            warn(
                f"'{name}' [{dae.unit(name)}] of '{dae.name}' moves faster from {lost.begin[0]:.6g} s to "
                f"{lost.begin[-1] + lost.length[-1]:.6g} s than can be followed from the run's points; its "
                f"averages may be off by {missed / most:.1g} of its range: run again with a smaller step=",
                RuntimeWarning,
                stacklevel=5,
            )


def _extremes(*values: Array) -> Array:
    """Return the least and the greatest of the columns of values, (2, columns)."""
    joined = np.concatenate(values)
    return np.stack([joined.min(axis=0), joined.max(axis=0)])


def _joined(parts: list[Points]) -> Points:
    t, x, z, q = (np.concatenate([getattr(part, name) for part in parts]) for name in ("t", "x", "z", "q"))
    return Points(parts[0].closed, t, x, z, q)
