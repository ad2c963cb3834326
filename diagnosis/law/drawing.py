"""`Drawing`: laws of a missing force, tried over what they may depend on."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property
from itertools import combinations

import numpy as np

from ...base import Array
from ..criteria import (
    CLEAR_STANDARD_ERRORS,
    LAW_LEAST_GAIN,
    LAW_MANY_TIMES,
    LAW_PAIR_SHARE,
    LAW_RESOLVED,
)
from ..effects.sites import Site
from .axes import VARIABLES, Axis, Grid
from .law import STATIC, Law
from .regression import NOTHING, Fitted, Tallies, fitted, moved
from .search import Settled


class Drawing:
    """Laws tried of a force at a site, along runs that it, or one at a site elsewhere, has made."""

    def __init__(self, site: Site, settled: Settled, number: int | None = None) -> None:
        self.site, self.settled = site, settled
        self.number = settled.number if number is None else number
        self.runs, self.left = settled.runs, settled.misfit
        runs, number = self.runs, self.number
        motions = [run.motion(number) for run in runs]
        resting = [m for m, run in zip(motions, runs, strict=True) if run.experiment.initial == "rest"]
        lasting = sum(float(np.ptp(m.t)) for m in motions)
        mean = sum(m.distance * float(np.ptp(m.t)) for m in motions) / lasting
        self.origin = float(resting[0].s[0]) if resting else mean
        self.motions = [moved(run, number, self.origin) for run in runs]

    @cached_property
    def nothing(self) -> Fitted:
        """What is left without a law."""
        return fitted(self._bare, None)

    @property
    def counts(self) -> Array:
        """By fold, how many samples count."""
        return self._bare.independent

    @cached_property
    def _bare(self) -> Tallies:
        """What there is to see what is missing by."""
        return self.tallies(None)

    def grid(self, variables: Sequence[str], finer: int = 1, even: bool = False) -> Grid:
        """Return the points of a law over variables."""
        pair = len(variables) > 1
        return Grid(tuple(Axis.over(name, self.motions, pair, finer, even) for name in variables))

    def tallies(self, grid: Grid | None) -> Tallies:
        """Return what there is to fit a law by, or to see what is missing without one."""
        return Tallies.of(self.runs, self.number, grid, self.origin)

    def fitted(self, variables: Sequence[str]) -> Fitted:
        """Return the law over variables.

        Of position it has as many points as its waves take; of speed points about rest if there is a step.
        """
        found = self._fitted(self.grid(variables))
        if tuple(variables) == ("speed",):
            even = self._fitted(self.grid(variables, even=True))
            return found if self._clearly(found, even) else even
        for finer in LAW_MANY_TIMES if tuple(variables) == ("position",) else ():
            if found.foreseen <= LAW_RESOLVED * self.left:
                break
            closer = self._fitted(self.grid(variables, finer))
            if not self._clearly(closer, found):
                break
            found = closer
        return found

    def _fitted(self, grid: Grid) -> Fitted:
        return fitted(self.tallies(grid), grid)

    def foreseen(self) -> float:
        """Return the most that a static law foresees of what is missing."""
        return max(self.share(self.fitted(variables)) for variables in STATIC)

    def share(self, law: Fitted) -> float:
        """Return the share of what is missing that a law foresees; none in a fold where it errs by more.

        Such a fold may hold the only motion through a part of the range.
        """
        floor, missing = self.left**2, self.nothing.squares
        all_of_it = float(self.counts @ np.maximum(missing - floor, 0.0))
        foreseen = float(self.counts @ np.maximum(missing - np.maximum(law.squares, floor), 0.0))
        return foreseen / all_of_it if all_of_it else 0.0

    def law(
        self, variables: Sequence[str] | None = None, among: Sequence[tuple[str, ...]] | None = None
    ) -> Law:
        """Return the law over variables, or over the fewest that foresee nearly as much as any."""
        found: dict[tuple[str, ...], Fitted] = {}
        best: tuple[str, ...]

        def likeness(one: tuple[str, ...]) -> float:
            return self.share(found[one])

        if variables is not None:
            best = tuple(variables)
            found = {best: self.fitted(best)}
        elif among is not None:
            found = {one: self.fitted(one) for one in among}
            best = max((one for one in found if len(one) == 1), key=likeness)
            better = [p for p in found if len(p) == 2 and self._pays(found[p], found[best])]
            best = max(better, key=likeness, default=best)
        else:
            found = {(name,): self.fitted((name,)) for name in VARIABLES}
            static = max((one for one in found if one in STATIC), key=likeness)
            other = max(found, key=likeness)
            best = other if self._pays(found[other], found[static]) else static
            known = best
            pairs: list[tuple[str, ...]] = [
                pair for pair in combinations(VARIABLES, 2) if pair in STATIC or set(known) & set(pair)
            ]
            found |= {pair: self.fitted(pair) for pair in pairs}
            for some in (STATIC, pairs):
                better = [p for p in some if len(p) == 2 and self._pays(found[p], found[best])]
                best = max(better, key=likeness, default=best)
        return self._law(found[best], {one: self.share(law) for one, law in found.items()})

    def _law(self, fit: Fitted, shares: Mapping[tuple[str, ...], float]) -> Law:
        """Return the law of a fit."""
        assert fit.grid is not None
        error, known = self._error(fit.grid, fit)
        return Law(
            self.site, fit.grid.variables, fit.grid.places, fit.values, error, self.origin, shares, fit,
            self.runs, self.number, tuple(self.settled.beside(fit.moved)), known,
        )  # fmt: skip

    def _error(self, grid: Grid, fit: Fitted) -> tuple[Array, bool]:
        """Return the standard error of a law at its points, and whether its level is known."""
        visited = np.mean([grid.basis(motion).mean(axis=0) for motion in self.motions], axis=0)
        covariance, known = fit.covariance, True
        if visited @ covariance @ visited > np.ptp(fit.values) ** 2:
            course = np.eye(len(visited)) - visited
            covariance, known = course @ covariance @ course.T, False
        return np.sqrt(np.maximum(np.diag(covariance), 0.0)), known

    def _pays(self, richer: Fitted, plain: Fitted) -> bool:
        """Tell whether a law takes away much of what a simpler one leaves, and clearly."""
        more, enough = self.share(richer), self.share(plain)
        less = 1 - more < LAW_PAIR_SHARE * (1 - enough)
        return less and more - enough > LAW_LEAST_GAIN and self._clearly(richer, plain)

    def _clearly(self, better: Fitted, worse: Fitted) -> bool:
        """Tell whether a law foresees clearly more than another one, by ratios fold by fold."""
        drop = np.log(np.maximum(worse.squares, NOTHING) / np.maximum(better.squares, NOTHING))
        return bool(drop.mean() > CLEAR_STANDARD_ERRORS * drop.std() / len(drop) ** 0.5)
