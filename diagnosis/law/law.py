"""`Law`: what the missing force at a site depends on, and how."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from ...base import Array
from ...components import Component, ModelError
from ..criteria import (
    LAW_FINER,
    LAW_FORESEEN_SHARE,
    LAW_MOST_POINTS,
    LAW_SHOWN_SHARE,
)
from ..effects.effect import Motion
from ..effects.sites import Site
from .along import Beside
from .axes import UNITS, Grid
from .regression import Fitted, moved
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
    each value of the other, are no machine's. A curve has one where it would push a machine away ever more.
    """
    axis, *rest = grid.axes
    if rest:
        wider = Grid(tuple(replace(axis, points=_wider(axis.points)) for axis in grid.axes))
        sizes = [len(axis.points) for axis in grid.axes]
        return _written(wider.places, np.pad(values.reshape(sizes), 1, mode="edge").ravel())
    points = axis.points
    if axis.smooth:
        points = np.linspace(points[0], points[-1], LAW_FINER * (len(points) - 1) + 1)
        values = axis.basis(points) @ values
    pushes = np.diff(values)[[0, -1]] < 0
    kept = slice(0 if pushes[0] else 1, None if pushes[1] else -1)
    further = np.pad(points, 1, mode="reflect", reflect_type="odd")
    return _written(further[kept, None], np.pad(values, 1, mode="edge")[kept])


def _wider(points: Array) -> Array:
    """Return points with one more as far beyond each end as they span."""
    span = points[-1] - points[0]
    return np.concatenate([[points[0] - span], points, [points[-1] + span]])


def _written(places: Array, values: Array) -> list[tuple[float, ...]]:
    """Return rows with the digits that count."""
    return [tuple(float(f"{x:.8g}") for x in row) for row in np.column_stack([places, values]).tolist()]
