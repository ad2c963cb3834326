"""Profile-likelihood intervals: how far a parameter may go while all others make up for it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from math import inf, sqrt
from typing import Protocol

import numpy as np

from ...base import Array
from ...components import InertanceError
from ..campaign.priors import Prior
from .problem import Optimum

MOST_REFITS = 12  # to find one end
END_TOLERANCE = 0.02  # of the rise that an end is found by, as a share of its root
STEEP = 4.0  # [level] of the root of a rise, from where on halving finds the end sooner than a secant
FURTHER_RATIO = 3.0  # by which a step goes further where nothing has risen yet
LOWER_COST = 1.0  # [chi squared] by which a fit with a parameter held is better than one that ended elsewhere


class Problem(Protocol):
    """What was fitted: parameters by name, and a fit of all of them but one that may be held."""

    @property
    def priors(self) -> Mapping[str, Prior]:
        """Bounds and scales of what was fitted, in the order of an optimum's vector."""
        ...

    def minimise(self, *, begin: Array, held: str) -> Optimum:
        """Return the optimum from a vector, with one entry held."""
        ...


class EndedEarlyError(Exception):
    """With a parameter held away from where it was fitted, the misfit is lower; `values` are there."""

    def __init__(self, values: dict[str, float]) -> None:
        self.values = values
        super().__init__("the fit had ended early")


@dataclass(frozen=True)
class Interval:
    """Where a parameter may be, at a level of confidence.

    Attributes:
        level: the share of such intervals that hold the truth.
        low, high: its ends: bounds of the parameter where the records allow these, infinite where they allow
            whatever was tried.
        note: what was met on the way.
    """

    level: float
    low: float
    high: float
    note: str = ""

    def told(self, name: str) -> Iterator[str]:
        """Yield what to know of it, in words."""
        if self.note:
            yield f"{name}: {self.note}"
        ends = [side for side, end in (("below", self.low), ("above", self.high)) if np.isinf(end)]
        if ends:
            yield f"{name}: the records set it no limit {' and '.join(ends)}"


def profiled(
    problem: Problem,
    optimum: Optimum,
    errors: Mapping[str, float],
    level: float,
    freedom: float = inf,
    tell: Callable[[str], None] = lambda line: None,
) -> Iterator[tuple[str, Interval]]:
    """Yield parameters of a fit with their intervals, by how the cost rises with all others fitted.

        min over the others of cost(p) - cost(estimate) <= q^2 (e/e_white)^2,

    with q the quantile of Student's t, e the standard error, and e_white what it would be if residuals were
    white noise as it was thought to be. Where the cost is a parabola, that is the estimate and q standard
    errors to either side; elsewhere the interval follows the cost, and need not be symmetric.

    Args:
        problem: what was fitted.
        optimum: where it ended.
        errors: the standard errors, by the parameters whose intervals are wanted.
        level: share of intervals that are to hold the truth.
        freedom: degrees of freedom of the standard errors.
        tell: called with a line of progress.

    Raises:
        EndedEarlyError: if the cost is lower elsewhere.

    Sources: D. J. Venzon, S. H. Moolgavkar, Applied Statistics 37 (1988) 87-94; for residuals that are not
    white J. T. Kent, Biometrika 69 (1982) 19-27, section 3.
    """
    from scipy.stats import t

    inverse = optimum.inverse
    quantile = float(t.isf((1 - level) / 2, freedom))
    for name, error in errors.items():
        place = list(problem.priors).index(name)
        told = float(inverse[place, place])
        white = sqrt(max(told, 0.0)) * float(optimum.scales[place])
        reach = quantile * (error / white if white > 0 and error > 0 else 1.0)
        along = np.asarray(inverse[:, place] / (told or 1.0), dtype=float)
        ends = {}
        for side in (-1.0, 1.0):
            tell(f"{level:.0%} interval of {name}, {'lower' if side < 0 else 'upper'} end")
            ends[side] = _Side(problem, optimum, name, side, reach).end(reach * white, along)
        (low, below), (high, above) = ends.values()
        yield name, Interval(level, low, high, "; ".join(dict.fromkeys(filter(None, (below, above)))))


class _Side:
    """One side of a profile: by how much the cost rises where a parameter is held away from its estimate."""

    def __init__(self, problem: Problem, optimum: Optimum, name: str, side: float, reach: float) -> None:
        self.problem, self.optimum, self.name, self.side, self.reach = problem, optimum, name, side, reach
        self.place, self.center = list(problem.priors).index(name), optimum.values[name]
        self.scale = float(optimum.scales[self.place])
        prior = problem.priors[name]
        self.most = max(0.0, side * ((prior.max if side > 0 else prior.min) - self.center))
        self.note = ""

    def end(self, first: float, along: Array) -> tuple[float, str]:
        """Return where the root of the rise has come to `reach`, and a note; `first` is tried first.

        That root goes with the distance where the cost is a parabola, so that a secant finds it.
        """
        away = min(first if first > 0 else self.scale, self.most)
        moved = self.side * away / self.scale * along
        inside, outside = (0.0, 0.0), (inf, inf)
        for _ in range(MOST_REFITS):
            rise, moved = self._rise(away, moved)
            inside, outside = ((away, rise), outside) if rise < 1 else (inside, (away, rise))
            if abs(rise - 1) < END_TOLERANCE or (rise < 1 and away == self.most):
                return self.center + self.side * away, self.note
            further = self._next(inside, outside)
            moved, away = moved * (further / away), further
        away, rise = outside
        last = away if np.isfinite(rise) or away == inf else inside[0]
        return self.center + self.side * last, self.note

    def _next(self, inside: tuple[float, float], outside: tuple[float, float]) -> float:
        """Return the distance to try next, by the farthest that is inside and the nearest that is not."""
        (near, below), (far, above) = inside, outside
        if above < STEEP:
            return near + (far - near) * (1 - below) / (above - below)
        if np.isfinite(far):
            return 0.5 * (near + far)
        return min(near * min(1 / max(below, 1e-9), FURTHER_RATIO), self.most)

    def _rise(self, away: float, moved: Array) -> tuple[float, Array]:
        """Return the root of the rise of the cost, in `reach`, and how far all parameters have moved."""
        begin = self.optimum.vector + moved
        begin[self.place] = self.optimum.vector[self.place] + self.side * away / self.scale
        value = self.center + self.side * away
        try:
            found = self.problem.minimise(begin=begin, held=self.name)
        except InertanceError:
            self.note = f"the model cannot be run at {value:.6g}, so that the interval ends before it"
            return inf, moved
        rise = found.cost - self.optimum.cost
        if rise < -LOWER_COST:
            raise EndedEarlyError(found.values)
        return sqrt(max(rise, 0.0)) / self.reach, found.vector - self.optimum.vector
