"""`DenseOutput`: signals between the points of a run, where need be from running that piece again, finely."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any
from warnings import warn

import numpy as np
from numpy.typing import NDArray

from ...base import Array
from ..evaluation.jacobians import Points
from ..results.pieces import Pieces
from .events.functions import NODES
from .integrator import IntegratorError, Stepper
from .legs import Leg
from .point import Point, solve_algebraic
from .tolerance import Tolerance

BENT, STRAY, MANY = 0.03, 0.6, 0.2
AROUND, DEPTH, MOST_PIECES, MOST_STEPS = 8, 3, 10_000, 500
NOTABLE = 0.01
SEEN, SLACK, ULPS = 8.0, 1e-9, 4


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
        lasting: Array = self.last.t - self.first.t
        return lasting

    def only(self, which: Any) -> Gaps:
        """Return some of the pieces."""
        return Gaps(self.first.only(which), self.last.only(which))


@dataclass(frozen=True, eq=False)
class Range:
    """Least and largest of some values, and how little of them is noise of the integrator."""

    low: Array
    high: Array
    tolerance: Tolerance

    @staticmethod
    def of(values: Array, tolerance: Tolerance) -> Range:
        """Return the range of the columns of values."""
        return Range(values.min(axis=0), values.max(axis=0), tolerance)

    def widened(self, values: Array) -> Range:
        """Return the range of these values, too."""
        if not len(values):
            return self
        low, high = np.minimum(self.low, values.min(axis=0)), np.maximum(self.high, values.max(axis=0))
        return Range(low, high, self.tolerance)

    @property
    def size(self) -> Array:
        """Half of the range, and not less than what the integrator may have left wrong."""
        noise = self.tolerance.rtol * np.maximum(-self.low, self.high) + self.tolerance.atol
        half: Array = np.maximum(0.5 * (self.high - self.low), 10 * noise)
        return half


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
        self._finer: dict[tuple[float, float], Points | None] = {}

    def course(self, name: str, values: Array, begin: float, end: float) -> Pieces:
        """Return a signal between the points that enclose a window; `values` are those at all points."""
        known, ranges = Range.of(values, self.tolerance), self._ranges
        gaps, done, budget = Gaps.of(self.points, self._pieces(begin, end)), list[Pieces](), MOST_PIECES
        level = 0
        while True:
            course = self._cubics(name, gaps)
            known, ranges = known.widened(course.ends), ranges.widened(gaps.last.x)
            doubtful = course.bend > BENT * known.size
            wanted = doubtful | self._stray(gaps, ranges)
            wanted |= np.count_nonzero(wanted) > MANY * len(wanted)
            wanted |= self._hidden(gaps, 1.0 if level == 0 else SEEN)
            budget -= int(np.count_nonzero(wanted))
            if level == DEPTH or budget < 0 or not wanted.any():
                break
            done.append(course[~wanted])
            gaps, level = self._again(gaps.only(wanted)), level + 1
        whole = course.straight(doubtful).merged(*done)
        self._tell(name, course[doubtful], float(known.size * whole.length.sum()))
        return whole

    @cached_property
    def _ranges(self) -> Range:
        return Range.of(self.points.x, self.tolerance)

    def _pieces(self, begin: float, end: float) -> NDArray[np.intp]:
        """Return the numbers of the points at which pieces begin that touch a window, and some around."""
        t = self.points.t
        pieces = np.flatnonzero(np.diff(t) > ULPS * np.spacing(np.abs(t[1:])))
        first, last = np.searchsorted(t[pieces + 1], begin), np.searchsorted(t[pieces], end, side="right")
        return pieces[max(0, int(first) - AROUND) : int(last) + AROUND]

    def _cubics(self, name: str, gaps: Gaps) -> Pieces:
        signal = self.closed.moving_signal(name)
        (y0, s0), (y1, s1) = (
            (m[:, 0, 0] for m in signal(p.x, p.z, p.q, p.t[:, None])) for p in (gaps.first, gaps.last)
        )
        return Pieces.cubics(gaps.first.t, gaps.length, (y0, y1), (s0, s1))

    def _stray(self, gaps: Gaps, ranges: Range) -> NDArray[np.bool_]:
        """Tell in which pieces a state must do what points do not show, from its rates at both ends."""
        if not gaps.first.x.shape[1]:
            return np.zeros(len(gaps.length), dtype=bool)
        change, h = gaps.last.x - gaps.first.x, gaps.length[:, None]
        at_first, at_last = (np.abs(h * points.rates - change) for points in (gaps.first, gaps.last))
        stray: Any = (at_first + at_last) / 12 > STRAY * ranges.size
        return np.asarray(stray.any(axis=1))

    def _hidden(self, gaps: Gaps, seen: float) -> NDArray[np.bool_]:
        """Tell in which pieces something that is given may do what neither end shows.

        That is where it switches, and in what is longer than `seen` of the longest steps that see it.
        """
        begin, end = gaps.first.t, gaps.last.t
        before = np.searchsorted(self._switches, begin, side="right")
        after = np.searchsorted(self._switches, end, side="left")
        hidden: NDArray[np.bool_] = (after > before) | (gaps.length > (seen + SLACK) * self._longest[before])
        return hidden

    def _again(self, gaps: Gaps) -> Gaps:
        """Return the pieces that come of integrating each piece again; itself where that fails."""
        pieces = []
        for number in range(len(gaps.length)):
            one = gaps.only([number])
            finer = self._integrated(one)
            pieces.append(one if finer is None else Gaps.of(finer, np.arange(len(finer.t) - 1)))
        return Gaps(*(_joined([getattr(piece, end) for piece in pieces]) for end in ("first", "last")))

    def _integrated(self, gap: Gaps) -> Points | None:
        """Return points between the ends of a piece, its ends included, computed once."""
        key = float(gap.first.t[0]), float(gap.last.t[0])
        if key not in self._finer:
            self._finer[key] = self._fine(gap.first, gap.last)
        return self._finer[key]

    def _fine(self, first: Points, last: Points) -> Points | None:
        begin, end = float(first.t[0]), float(last.t[0])
        inside = (self._switches > begin) & (self._switches < end)
        parts, point = [first], Point(begin, first.x[0], first.z[0], first.q[0])
        for stop in (*self._switches[inside].tolist(), end):
            part = self._stretch(point, stop)
            if part is None:
                return None
            parts.append(part)
            point = Point(stop, part.x[-1], part.z[-1], point.q)
        fine = _joined(parts)
        fine.x[-1], fine.z[-1] = last.x[0], last.z[0]
        return fine

    def _stretch(self, point: Point, stop: float) -> Points | None:
        """Return points after one up to an instant; None if they cannot be found."""
        shift = ULPS * np.spacing(abs(stop))
        times = np.linspace(point.t, stop, NODES + 1)[1:]
        span = stop - shift - point.t
        if not span > NODES * shift:
            return None
        longest = self._longest[np.searchsorted(self._switches, point.t, side="right")]
        try:
            found = self._stepper.run(point.t, point.x, point.z, point.q, span, float(longest))
        except IntegratorError:
            return None
        q = np.repeat(point.q[None], NODES, axis=0)
        return Points(self.closed, times, found.states, found.algebraic, q)

    @cached_property
    def _stepper(self) -> Stepper:
        return self.closed.stepper(self._solver, self.tolerance, NODES, MOST_STEPS)

    def _tell(self, name: str, lost: Pieces, most: float) -> None:
        """Warn if what is lost of a signal between points may count."""
        missed = float(lost.bend @ lost.length)
        if missed > NOTABLE * most:
            dae = self.closed.dae
            warn(
                f"'{name}' [{dae.unit(name)}] of '{dae.name}' moves faster from {lost.begin[0]:.6g} s to "
                f"{lost.begin[-1] + lost.length[-1]:.6g} s than can be followed from the run's points; its "
                f"averages may be off by {missed / most:.1g} of its range: run again with a smaller step=",
                RuntimeWarning,
                stacklevel=5,
            )


def _joined(parts: list[Points]) -> Points:
    t, x, z, q = (np.concatenate([getattr(part, name) for part in parts]) for name in ("t", "x", "z", "q"))
    return Points(parts[0].closed, t, x, z, q)
