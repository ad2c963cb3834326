"""Laws that a missing force itself shows, along the motion that it makes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from ..effects.sites import Site
from .axes import Grid
from .drawing import Drawing
from .law import STATIC, Law
from .regression import Fitted, Tallies
from .search import Settled

LEAST_ERROR = 1e-3  # of the size of a force
SINGLE = tuple(variables for variables in STATIC if len(variables) == 1)


class Showing(Drawing):
    """Laws tried of a force by its course itself, and not by what it does to what is measured.

    Where a law is so steep that it holds the speed of its joint, or where a small error of it leads a machine
    elsewhere, what is linear along the motion foresees next to nothing of what is missing, and the force is a
    curve all the same. Its points count by their errors, at least by the median of these.
    """

    def __init__(self, site: Site, settled: Settled) -> None:
        super().__init__(site, settled)
        self.moved = self.runs[0].bench.away(settled.given)
        self.forces = settled.beside(self.moved)
        errors = [error.values for error in settled.errors]
        usual = max(float(np.median(np.concatenate(errors))), LEAST_ERROR * settled.rms)
        self.sizes = [np.hypot(error, usual) for error in errors]
        weights = np.concatenate([1 / size**2 for size in self.sizes])
        self.mean = float(np.average(np.concatenate(self.forces), weights=weights))
        self.left = 0.0

    def plainest(self) -> Law:
        """Return the law of one variable that foresees most, of two if that foresees too little."""
        one = self.law(among=SINGLE)
        return one if one.is_foreseen else self.law(among=STATIC)

    def tallies(self, grid: Grid | None) -> Tallies:
        """Return what there is to fit a law by; its mean is told by no law."""
        forces = [force - self.mean for force in self.forces]
        return Tallies.of_forces(self.motions, forces, self.sizes, grid)

    def _law(self, fit: Fitted, shares: Mapping[tuple[str, ...], float]) -> Law:
        """Return the law of a fit, beside the parameters as they are with the force."""
        fit = replace(fit, values=fit.values + self.mean, moved=self.moved)
        return replace(super()._law(fit, shares), shown=True)
