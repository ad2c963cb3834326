"""`Pieces`: a signal between the points of a run, as cubics, and its integrals over time."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields, replace

import numpy as np
from numpy.typing import NDArray

from ...base import Array

NODES, WEIGHTS = (each / 2 for each in np.polynomial.legendre.leggauss(4))


@dataclass(frozen=True, eq=False)
class Pieces:
    """A signal over time in pieces that follow each other, y = y0 + c x + a x (1 - x)^2 - b x^2 (1 - x).

    x runs from 0 to 1 within a piece. Between two pieces the signal may jump, which takes no time and so
    counts for nothing.

    Attributes:
        begin, length: of each piece [s]; every length is above 0.
        y0, c: value at the beginning of each piece, and its change over the piece.
        a, b: what the slopes at the beginning and at the end have beyond the chord's, times the length.
    """

    begin: Array
    length: Array
    y0: Array
    c: Array
    a: Array
    b: Array

    @staticmethod
    def lines(time: Array, values: Array) -> Pieces:
        """Return straight lines through points; two points at one instant are a jump."""
        kept = np.flatnonzero(np.diff(time) > 0)
        length, change, nothing = np.diff(time)[kept], np.diff(values)[kept], np.zeros(len(kept))
        return Pieces(time[kept], length, values[kept], change, nothing, nothing)

    @staticmethod
    def cubics(begin: Array, length: Array, ends: tuple[Array, Array], slopes: tuple[Array, Array]) -> Pieces:
        """Return pieces from values and slopes at both ends; a slope that is not finite is the chord's."""
        y0, change = ends[0], ends[1] - ends[0]
        a, b = (length * slope - change for slope in slopes)
        whole = np.isfinite(a) & np.isfinite(b)
        return Pieces(begin, length, y0, change, np.where(whole, a, 0.0), np.where(whole, b, 0.0))

    def __len__(self) -> int:
        return len(self.begin)

    def __getitem__(self, which: NDArray[np.bool_] | NDArray[np.intp] | slice) -> Pieces:
        return Pieces(*(getattr(self, f.name)[which] for f in fields(self)))

    @property
    def ends(self) -> Array:
        """Values at the end of each piece."""
        return self.y0 + self.c

    @property
    def bend(self) -> Array:
        """How far each piece departs from its chord, on average."""
        return np.asarray((np.abs(self.a) + np.abs(self.b)) / 12)

    def straight(self, which: NDArray[np.bool_]) -> Pieces:
        """Return the course with chords for some of its pieces."""
        return replace(self, a=np.where(which, 0.0, self.a), b=np.where(which, 0.0, self.b))

    def merged(self, *others: Pieces) -> Pieces:
        """Return the pieces of several courses in their order in time."""
        courses = (self, *others)
        joined = Pieces(*(np.concatenate([getattr(c, f.name) for c in courses]) for f in fields(self)))
        return joined[np.argsort(joined.begin, kind="stable")]

    def value(self, x: Array) -> Array:
        """Return the signal at places within the pieces, 0 to 1, (pieces, places)."""
        y0, c, a, b = (each[:, None] for each in (self.y0, self.c, self.a, self.b))
        return np.asarray(y0 + x * (c + (1 - x) * (a * (1 - x) - b * x)))

    def at(self, times: Array) -> Array:
        """Return the signal at instants, after a jump if there is one."""
        piece = np.clip(np.searchsorted(self.begin, times, side="right") - 1, 0, len(self) - 1)
        x = np.clip((times - self.begin[piece]) / self.length[piece], 0.0, 1.0)
        return self[piece].value(x[:, None])[:, 0]

    def integral(self, of: Callable[[Array], Array], begin: float, end: float) -> float:
        """Return the integral of a function of the signal over a window; exact up to its square."""
        low, high = self._window(begin, end)
        x = low[:, None] + (high - low)[:, None] * (0.5 + NODES)
        return float(((high - low) * self.length) @ (of(self.value(x)) @ WEIGHTS))

    def lasting(self, holds: Callable[[Array], NDArray[np.bool_]], begin: float, end: float) -> float:
        """Return for how much of a window something holds of a signal that only jumps [s]."""
        low, high = self._window(begin, end)
        ends = 0.5 * (holds(self.y0).astype(float) + holds(self.ends))
        return float(((high - low) * self.length) @ ends)

    def extremes(self, begin: float, end: float) -> tuple[float, float]:
        """Return the least and the largest value within a window."""
        low, high = self._window(begin, end)
        inside = high > low
        pieces, places = self[inside], (low[inside], high[inside])
        turns = [np.clip(turn, *places) for turn in pieces._turns()]
        values = pieces.value(np.column_stack([*places, *turns]))
        return float(values.min()), float(values.max())

    def _window(self, begin: float, end: float) -> tuple[Array, Array]:
        """Return where a window begins and ends in each piece, 0 to 1; alike where it is elsewhere."""
        low, high = (np.clip((edge - self.begin) / self.length, 0.0, 1.0) for edge in (begin, end))
        return low, high

    def _turns(self) -> tuple[Array, Array]:
        """Return where the slope of each piece vanishes, 0 where it does not."""
        three, two, one = 3 * (self.a + self.b), -2 * (2 * self.a + self.b), self.c + self.a
        root = np.sqrt(np.maximum(two**2 - 4 * three * one, 0.0))
        q = -0.5 * (two + np.where(two < 0, -root, root))
        with np.errstate(divide="ignore", invalid="ignore"):
            first, second = (np.nan_to_num(m, posinf=0.0, neginf=0.0) for m in (q / three, one / q))
        return first, second
