"""A law fitted to records along the motion that the missing force has made, without a run."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...base import Array, SimulationError
from ..criteria import LAW_FOLDS, LAW_STIFFNESSES, LAW_WEAKEST_PRIOR
from ..effects.effect import Motion
from .along import Beside
from .axes import Grid

NOTHING = 1e-300  # of a fold that no run reaches
Parts = tuple[Array, Array, Array, int]  # of a run: see `beside`


@dataclass(frozen=True, eq=False)
class Tallies:
    """Products of what records miss, of slopes of the parameters and of what a law would add, by fold.

    Attributes:
        gram: (folds, 1 + parameters + points, the same); what is known of one record alone is taken off.
        independent: by fold, how many samples count.
        shared: the number of parameters.
    """

    gram: Array
    independent: Array
    shared: int

    @classmethod
    def of(
        cls,
        runs: Sequence[Beside],
        number: int,
        grid: Grid | None,
        origin: float = 0.0,
        within: Array | None = None,
    ) -> Tallies:
        """Return those of runs with a force at a site, or with a law with values `within` the model.

        Raises:
            SimulationError: if the model is unstable with it.
        """
        return cls.of_parts(runs, number, (beside(run, number, grid, origin, within) for run in runs))

    @classmethod
    def of_parts(cls, runs: Sequence[Beside], number: int, parts: Iterable[Parts]) -> Tallies:
        """Return those of runs whose parts are known.

        Raises:
            SimulationError: if the model is unstable with what is at the site.
        """
        grams, counts, shared = [], [], 0
        for run, part in zip(runs, parts, strict=True):
            stacked, own, priors, shared = part
            for piece in np.array_split(apart(stacked, own, priors), LAW_FOLDS):
                flat = piece.reshape(-1, piece.shape[2])
                grams.append(flat.T @ flat)
                counts.append(run.experiment.independent / LAW_FOLDS)
        if not np.isfinite(grams).all():
            raise SimulationError(f"a force at {runs[0].bench.sites[number].path} makes the model unstable")
        return cls(np.array(grams), np.array(counts), shared)

    @classmethod
    def of_forces(
        cls, motions: Sequence[Motion], forces: Sequence[Array], sizes: Sequence[Array], grid: Grid | None
    ) -> Tallies:
        """Return those of forces along motions themselves, each over the size of its error."""
        grams, counts = [], []
        for motion, force, size in zip(motions, forces, sizes, strict=True):
            parts = [force[:, None], *([] if grid is None else [grid.basis(motion)])]
            for fold in np.array_split(np.hstack(parts) / size[:, None], LAW_FOLDS):
                grams.append(fold.T @ fold)
                counts.append(len(fold))
        return cls(np.array(grams), np.array(counts, dtype=float), 0)

    def held(self, near: Array, share: float) -> Tallies:
        """Return them with parameters tied to where they are, by a share of what the records tell of each.

        What a law can do as well is told by next to nothing else, and stays.
        """
        gram, own = self.gram.copy(), slice(1, 1 + self.shared)
        place = np.arange(1, 1 + self.shared)
        size = share * gram[:, place, place]
        gram[:, place, place] += size
        gram[:, own, 0] += size * near
        gram[:, 0, own] += size * near
        gram[:, 0, 0] += size @ near**2
        return replace(self, gram=gram)


def beside(run: Beside, number: int, grid: Grid | None, origin: float, within: Array | None) -> Parts:
    """Return what a run misses without a law, slopes, what points add; own slopes, their priors."""
    columns, shared, priors = run.columns()
    parts = [columns[:, :, : 1 + shared]]
    if grid is not None:
        parts.append(run.answers(number, grid.basis(moved(run, number, origin))))
        if within is not None:
            parts[0][:, :, 0] += parts[1] @ within
    return np.concatenate(parts, axis=2), columns[:, :, 1 + shared :], priors, shared


def moved(run: Beside, number: int, origin: float) -> Motion:
    """Return how a site moved, distances from an origin."""
    motion = run.motion(number)
    return replace(motion, s=motion.s - origin)


def own_of(left: Array, own: Array, priors: Array) -> Array:
    """Return what nobody measured of one record, by what is left of it."""
    flat, free = left.reshape(-1), own.reshape(left.size, -1)
    size = np.maximum(np.linalg.norm(free, axis=0), 1e-300)
    basis = np.vstack([free / size, np.diag(priors / size)])
    return np.asarray(np.linalg.lstsq(basis, np.append(flat, np.zeros(len(priors))), rcond=1e-8)[0] / size)


def apart(columns: Array, own: Array, priors: Array) -> Array:
    """Return columns without what is known of one record alone explains."""
    flat = columns.reshape(-1, columns.shape[2])
    free = own.reshape(len(flat), -1)
    if not free.shape[1]:
        return columns
    size = np.maximum(np.linalg.norm(free, axis=0), 1e-300)
    basis = np.vstack([free / size, np.diag(priors / size)])
    padded = np.vstack([flat, np.zeros((len(priors), flat.shape[1]))])
    away = np.linalg.lstsq(basis, padded, rcond=1e-8)[0]
    return np.asarray((flat - (free / size) @ away).reshape(columns.shape))


@dataclass(frozen=True, eq=False)
class Fitted:
    """A law by values at the points of a grid.

    Attributes:
        grid: its points; None for no law.
        values: at them.
        covariance: of the values beside the parameters as they are, for what is left.
        moved: how far the parameters are from the centers of their priors.
        misfit: root mean square of what is left of what was fitted, in units of noise.
        foreseen: the same of what was left out, one fold after another.
        squares: of that by fold, for each sample.
        stiffness: against bending.
    """

    grid: Grid | None
    values: Array
    covariance: Array
    moved: Array
    misfit: float
    foreseen: float
    squares: Array
    stiffness: float


def fitted(
    tallies: Tallies, grid: Grid | None, tie: Array | None = None, stiffness: float | None = None
) -> Fitted:
    """Return the law that foresees best what it was not fitted to.

    Args:
        tallies: of the records.
        grid: the points of the law; None for the parameters alone.
        tie: values at the points for each free one, where the law has a symmetry.
        stiffness: against bending; the one that foresees best if not given.
    """
    shared, size = tallies.shared, 0 if grid is None else grid.size
    tie = np.eye(size) if tie is None else tie
    whole = np.zeros((1 + shared + size, 1 + shared + tie.shape[1]))
    whole[: 1 + shared, : 1 + shared] = np.eye(1 + shared)
    whole[1 + shared :, 1 + shared :] = tie
    grams = whole.T @ tallies.gram @ whole
    bends = np.zeros((0, tie.shape[1])) if grid is None else grid.unevenness @ tie
    choices = LAW_STIFFNESSES if stiffness is None and grid is not None else (stiffness or 0.0,)
    count = float(tallies.independent.sum())
    rough, _ = _solved(grams.sum(axis=0), shared, bends, choices[0])
    weight = max(_left(grams.sum(axis=0), rough) / count, 1.0)
    tried = [_foreseen(grams, tallies, bends, mu, weight) for mu in choices]
    best = _stiffest(np.array(tried))
    mu = choices[best]
    squares = tried[best] / tallies.independent
    total = grams.sum(axis=0)
    solution, inverse = _solved(total, shared, bends, mu, weight)
    left = max(_left(total, solution), 0.0) / count
    of_both, of_parameters = inverse[shared:, :shared], inverse[:shared, :shared]
    beside = inverse[shared:, shared:] - of_both @ np.linalg.inv(of_parameters) @ of_both.T
    values, covariance = tie @ solution[shared:], tie @ beside @ tie.T
    foreseen = float(np.sqrt(max(tried[best].sum() / count, 0.0)))
    return Fitted(
        grid,
        values,
        covariance * max(left, 1.0),
        solution[:shared],
        float(np.sqrt(left)),
        foreseen,
        squares,
        mu,
    )


def _stiffest(squares: Array) -> int:
    """Return the stiffest of the laws that foresee as well as the best, within a standard error.

    They are compared by ratios: in what goes from valley to valley one fold can outweigh all others.
    """
    logarithms = np.log(np.maximum(squares, NOTHING))
    worse = logarithms - logarithms[int(np.argmin(logarithms.sum(axis=1)))]
    allowed = worse.std(axis=1) / worse.shape[1] ** 0.5
    return int(np.flatnonzero(worse.mean(axis=1) <= allowed).max())


def through(grid: Grid, motions: Sequence[Motion], forces: Sequence[Array], stiffness: float) -> Array:
    """Return values at the points of a grid through forces along motions."""
    columns = np.concatenate([grid.basis(motion) for motion in motions])
    inner, bends = columns.T @ columns, grid.unevenness
    size = float(np.trace(inner)) / len(inner)
    inner += stiffness * size * bends.T @ bends + LAW_WEAKEST_PRIOR * size * np.eye(len(inner))
    return np.asarray(np.linalg.solve(inner, columns.T @ np.concatenate(forces)), dtype=float)


def _foreseen(grams: Array, tallies: Tallies, bends: Array, mu: float, weight: float) -> Array:
    """Return the squares that are left in each fold by what the others tell."""
    total = grams.sum(axis=0)
    found = []
    for gram in grams:
        solution, _ = _solved(total - gram, tallies.shared, bends, mu, weight)
        found.append(_left(gram, solution))
    return np.array(found)


def _left(gram: Array, solution: Array) -> float:
    signed = np.concatenate([[1.0], -solution])
    return float(signed @ gram @ signed)


def _solved(gram: Array, shared: int, bends: Array, mu: float, weight: float = 1.0) -> tuple[Array, Array]:
    """Return parameters and values of least squares, and the inverse of their matrix.

    Priors of the parameters have the weight of what the law leaves: it is no reason to move them.
    """
    inner = gram[1:, 1:].copy()
    inner[:shared, :shared] += weight * np.eye(shared)
    points = slice(shared, len(inner))
    size = float(np.trace(inner[points, points])) / max(len(inner) - shared, 1)
    inner[points, points] += mu * size * bends.T @ bends
    inner[points, points] += LAW_WEAKEST_PRIOR * size * np.eye(len(inner) - shared)
    inverse: Array = np.asarray(np.linalg.inv(inner), dtype=float)
    return inverse @ gram[1:, 0], inverse
