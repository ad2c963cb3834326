"""`FitProblem`: priors of parameters and nuisances of records as rows and columns of least squares."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ...base import Array, computing
from ..campaign.priors import Prior
from .campaign_model import Accuracy, Values
from .least_squares import Ending, Iterate, descent
from .residual_block import Linearised, ResidualBlock

MOST_ITERATIONS = 40
LEAST_DROP = 1e-2  # of chi squared, by as much noise as there is, that an iteration must promise
LEAST_RADIUS = 1e-9  # of what parameters may be expected to be
STEPS_RATIO, LEAST_STEPS = 20, 50  # a trial may take so many times the start's steps, and so many a sample


@dataclass(frozen=True, eq=False)
class Optimum:
    """Where a fit ended; rows are those of the records, then of the priors and the nuisances."""

    values: dict[str, float]  # the fitted parameters
    nuisances: list[Array]  # of each record
    cost: float  # sum of squares of residuals over noise, priors included
    residual: Array
    slopes: Array  # columns in units of `scales`, then of the nuisances
    scales: Array  # units of the parameters
    vector: Array  # parameters, from where they were assumed in units of `scales`, then the nuisances
    iterations: int
    ended: str  # why, in words

    @cached_property
    def inverse(self) -> Array:
        """That of the information, over what the rows tell at all."""
        information = self.slopes.T @ self.slopes
        return np.asarray(np.linalg.pinv(information, rcond=1e-14, hermitian=True), dtype=float)


class FitProblem:
    """Parameters with priors and the records they are fitted to: the maximum a posteriori as least squares.

    Records are prepared for the values of all parameters; those with priors are fitted from there.
    """

    def __init__(
        self, blocks: Sequence[ResidualBlock], priors: Mapping[str, Prior], values: Values, accuracy: Accuracy
    ) -> None:
        for block in blocks:
            block.prepare(values, accuracy)
        self.blocks, self.priors, self.values, self.accuracy = blocks, priors, dict(values), accuracy
        self.scales, self._center, self._lower, self._upper = (
            np.array([getattr(prior, name) for prior in priors.values()])
            for name in ("scale", "center", "min", "max")
        )
        self._ends = np.cumsum([len(priors), *[block.nuisances for block in blocks]])
        known = [prior.scale / prior.sd for prior in priors.values()]
        self._weight = np.concatenate([known, *(block.weight for block in blocks)])

    def minimise(
        self,
        report: Callable[[Iterate], None] | None = None,
        most: int = MOST_ITERATIONS,
        interruptible: bool = False,
        begin: Array | None = None,
        held: str | None = None,
    ) -> Optimum:
        """Return the best parameters near where they start, after at most so many steps.

        Args:
            report: called with where the descent is, before each step.
            most: steps.
            interruptible: whether Ctrl-C ends it with what was found until then, once there is anything.
            begin: a vector, as of an `Optimum`, to start from instead of the values that were given.
            held: a parameter that stays where it begins.
        """
        given = np.array([self.values[name] for name in self.priors])
        own = [(np.zeros(block.nuisances), *block.bounds) for block in self.blocks]
        start, low, high = (
            np.concatenate([(entries - self._center) / self.scales, *free])
            for entries, *free in zip((given, self._lower, self._upper), *own, strict=True)
        )
        start = start if begin is None else np.clip(begin, low, high)
        if held is not None:
            place = list(self.priors).index(held)
            low[place] = high[place] = start[place]
        drop = LEAST_DROP / max(sum(block.samples for block in self.blocks), 1.0)
        ending = Ending(drop, LEAST_DROP, LEAST_RADIUS, most)
        at: Iterate | None = None
        try:
            for at in descent(self._stacked, start, (low, high), ending):
                if report is not None and not at.ended:
                    report(at)
        except KeyboardInterrupt:
            if at is None or not interruptible:
                raise
            at = replace(at, ended="interrupted")
        assert at is not None
        values, nuisances = self._parts(at.vector)
        return Optimum(
            values, nuisances, at.cost, at.residual, at.slopes, self.scales, at.vector, at.number, at.ended
        )

    def _parts(self, vector: Array) -> tuple[dict[str, float], list[Array]]:
        moved, *nuisances = np.split(vector, self._ends[:-1])
        p = np.clip(self._center + self.scales * moved, self._lower, self._upper)
        return dict(zip(self.priors, p.tolist(), strict=True)), nuisances

    @computing("a trial of the parameters")
    def _stacked(self, vector: Array, slopes: bool) -> tuple[Array, Array]:
        """Return residuals of all records, of priors and of nuisances, and their slopes."""
        values, nuisances = self._parts(vector)
        found = [
            block.linearise({**self.values, **values}, own, self.accuracy)
            for block, own in zip(self.blocks, nuisances, strict=True)
        ]
        self._grant(found)
        columns = [self.blocks[0].stand.variations.parameters.index(name) for name in values]
        rows = [np.zeros((len(one.residual), len(vector))) for one in found]
        for one, row, begin, end in zip(found, rows, self._ends[:-1], self._ends[1:], strict=True):
            row[:, : len(values)] = one.to_p[:, columns] * self.scales
            row[:, begin:end] = one.to_n
        residual = np.concatenate([*(one.residual for one in found), self._weight * vector])
        return residual, np.vstack([*rows, np.diag(self._weight)])

    def _grant(self, found: Sequence[Linearised]) -> None:
        """Bound the steps of trials: with parameters far off, a run may take for ever."""
        if self.accuracy.steps is None:
            runs = [prediction for one in found for prediction in one.predictions]
            each = max((run.run.stats["steps"] / len(run.time) for run in runs), default=0.0)
            self.accuracy = replace(self.accuracy, steps=LEAST_STEPS + round(STEPS_RATIO * each))
