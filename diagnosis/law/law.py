"""`Law`: what the missing force at a site depends on, and how."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import combinations
from typing import Any

import numpy as np

from ...base import Array
from ...components import Component, ModelError
from ..criteria import (
    CLEAR_STANDARD_ERRORS,
    LAW_FINER,
    LAW_FORESEEN_SHARE,
    LAW_LEAST_GAIN,
    LAW_MANY_TIMES,
    LAW_MOST_POINTS,
    LAW_PAIR_SHARE,
    LAW_RESOLVED,
    LAW_SHOWN_SHARE,
)
from ..effects.effect import Motion
from ..effects.sites import Site
from .along import Beside
from .axes import UNITS, VARIABLES, Axis, Grid
from .regression import NOTHING, Fitted, Tallies, fitted, moved
from .search import Settled
from .traits import traits_of

STATIC = (("position",), ("speed",), ("position", "speed"))  # what a component's law may be over


@dataclass(frozen=True, eq=False)
class Law:
    """What the missing force at a site depends on, and how.

    Attributes:
        site: where it acts.
        variables: one or two of "position", "speed", "acceleration", "load" and "time".
        points: their values at the points of the law, (points, variables), SI units; positions count from
            `origin`.
        values, standard_error: the force there; the error is of its course alone if its level is unknown.
        origin: where the site rests.
        shares: by variables that were tried, the share of what is missing that a law of them foresees in
            stretches that it was not fitted to.
        fit: how it was fitted.
        runs: the motion along which it was.
        forces: the missing force along them, beside the parameters of the law.
        level_known: whether records tell a constant in it from zeros of sensors and from where they begin.
        shown: whether the shares are of the force itself along the motion, as where records do not tell it.
    """

    site: Site
    variables: tuple[str, ...]
    points: Array
    values: Array
    standard_error: Array
    origin: float
    shares: Mapping[tuple[str, ...], float]
    fit: Fitted = field(repr=False)
    runs: Sequence[Beside] = field(repr=False)
    number: int = field(repr=False)
    forces: Sequence[Array] = field(repr=False)
    level_known: bool = True
    shown: bool = False

    @property
    def grid(self) -> Grid:
        """Its axes."""
        assert self.fit.grid is not None
        return self.fit.grid

    @property
    def explained(self) -> float:
        """The share of what is missing that it foresees in stretches that it was not fitted to."""
        return self.shares[self.variables]

    @property
    def is_foreseen(self) -> bool:
        """Whether it foresees enough to be tried in runs."""
        return self.explained >= (LAW_SHOWN_SHARE if self.shown else LAW_FORESEEN_SHARE)

    @property
    def unit(self) -> str:
        """That of the force."""
        return UNITS[self.site.domain]["load"]

    @property
    def units(self) -> tuple[str, ...]:
        """Those of the variables."""
        return tuple(UNITS[self.site.domain][variable] for variable in self.variables)

    @property
    def of_what(self) -> str:
        """What its shares are of, in words."""
        return "the missing force" if self.shown else "what is missing"

    @property
    def told(self) -> str:
        """Where it acts and over what, in words."""
        return f"a law of {' and '.join(self.variables)} at {self.site.path}"

    @property
    def is_static(self) -> bool:
        """Whether a component can have it: a law of position, of speed, or of both."""
        return self.variables in STATIC

    def along(self, motion: Motion) -> Array:
        """Return its force along a motion, whose distances count from the origin."""
        return np.asarray(self.grid.basis(motion) @ self.values)

    @property
    def length(self) -> float:
        """Over which distance its force changes by its size; infinite unless it is of position alone."""
        if self.variables != ("position",):
            return np.inf
        places = np.concatenate([motion.s for motion in self.motions])
        force, step = self.grid.axes[0], 1e-3 * float(np.ptp(places))
        there, beyond = (force.basis(places + way) @ self.values for way in (0.0, step))
        slope = float(np.sqrt(np.mean((beyond - there) ** 2))) / step
        return float(np.std(there)) / slope if slope else np.inf

    @property
    def given(self) -> dict[str, float]:
        """The parameters beside it."""
        return self.beside(self.fit.moved)

    def beside(self, moved: Array) -> dict[str, float]:
        """Return parameters that are so far from the centers of their priors."""
        bench = self.runs[0].bench
        priors = bench.study.campaign.priors
        return {name: priors[name].at(share) for name, share in zip(bench.names, moved.tolist(), strict=True)}

    @property
    def motions(self) -> list[Motion]:
        """How the site moved in each record, distances from the origin."""
        return [moved(run, self.number, self.origin) for run in self.runs]

    @property
    def traits(self) -> list[str]:
        """Its symmetry, steps, waves and direction, in words."""
        return traits_of(self)

    @property
    def table(self) -> list[tuple[float, ...]]:
        """Rows for a `TabulatedForce`."""
        return rows_of(self.grid, self.values)

    def finer(self) -> Law:
        """Return the same law of one variable with a point more between any two; itself if too many."""
        axis, *rest = self.grid.axes
        if rest or 2 * len(axis.points) - 1 > LAW_MOST_POINTS:
            return self
        between = 0.5 * (axis.points[1:] + axis.points[:-1])
        grid = Grid((replace(axis, points=np.union1d(axis.points, between)),))
        values, error = (axis.basis(grid.axes[0].points) @ f for f in (self.values, self.standard_error))
        fit = replace(self.fit, grid=grid, values=values)
        return replace(self, points=grid.places, values=values, standard_error=error, fit=fit)

    def component(self) -> Component:
        """Return a `TabulatedForce` that has this law.

        Raises:
            ModelError: for a law of anything but position and speed.
        """
        return element_of(self.site, self.grid, self.values, self.origin)

    def to_dict(self) -> dict[str, Any]:
        """Return it as in the JSON file of a verdict."""
        return {
            "site": self.site.path,
            "variables": list(self.variables),
            "units": [*self.units, self.unit],
            "origin": self.origin,
            "table": [
                [*place, value]
                for place, value in zip(self.points.tolist(), self.values.tolist(), strict=True)
            ],
            "standard_error": self.standard_error.tolist(),
            "foreseen": self.explained,
            "traits": self.traits,
        }

    def plot(self, path: Any = None) -> Any:
        """Draw it, and return the figure; given a path, save it as PNG, SVG or PDF."""
        from .pictures import drawn_law

        return drawn_law(self, path)

    def __str__(self) -> str:
        """Say what the force depends on, and how."""
        over = " and ".join(self.variables)
        told = f"force at {self.site.path} over {over}: {self.explained:.1%} of {self.of_what} foreseen"
        others = sorted(self.shares.items(), key=lambda one: -one[1])
        rest = ", ".join(f"{' and '.join(v)} {share:.0%}" for v, share in others if v != self.variables)
        return "; ".join([f"{told} ({rest})" if rest else told, *self.traits])


def element_of(site: Site, grid: Grid, values: Array, origin: float) -> Component:
    """Return a `TabulatedForce` with values at the points of a grid."""
    if grid.variables not in STATIC:
        told = " and ".join(grid.variables)
        raise ModelError(
            f"a law over {told} is no component; draw one over position, speed, or both: "
            "law(variables=('position', 'speed'))"
        )
    over: dict[str, Any] = {"over": grid.variables[0]} if len(grid.axes) == 1 else {}
    if grid.axes[0].smooth:
        over["interpolation"] = "smooth"
    rest = {f"{site.mechanics.across}_rel0": origin} if "position" in grid.variables else {}
    element: Component = site.family.TabulatedForce(table=rows_of(grid, values), **over, **rest)
    return element


def rows_of(grid: Grid, values: Array) -> list[tuple[float, ...]]:
    """Return rows of a table; of a smooth law so many that what is between them does not matter.

    A map has one point more beyond each end, where it is as at that end: its slopes there, in one variable at
    each value of the other, are no machine's.
    """
    if len(grid.axes) > 1:
        wider = Grid(tuple(replace(axis, points=_wider(axis.points)) for axis in grid.axes))
        sizes = [len(axis.points) for axis in grid.axes]
        return _written(wider.places, np.pad(values.reshape(sizes), 1, mode="edge").ravel())
    axis = grid.axes[0]
    if not axis.smooth:
        return _written(grid.places, values)
    fine = np.linspace(axis.points[0], axis.points[-1], LAW_FINER * (len(axis.points) - 1) + 1)
    return _written(fine[:, None], axis.basis(fine) @ values)


def _wider(points: Array) -> Array:
    """Return points with one more as far beyond each end as they span."""
    span = points[-1] - points[0]
    return np.concatenate([[points[0] - span], points, [points[-1] + span]])


def _written(places: Array, values: Array) -> list[tuple[float, ...]]:
    """Return rows with the digits that count."""
    return [tuple(float(f"{x:.8g}") for x in row) for row in np.column_stack([places, values]).tolist()]


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
        return fitted(self.tallies(None), None)

    @cached_property
    def counts(self) -> Array:
        """By fold, how many samples count."""
        return self.tallies(None).independent

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
