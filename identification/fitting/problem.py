"""`Problem`: priors of parameters and nuisances of records as rows and columns of a least-squares problem."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...base import Array
from ..campaign.priors import Prior
from .campaign_model import Accuracy
from .least_squares import Ending, Point, descent
from .residual_block import Block, Linearised

MOST_ITERATIONS = 40
LEAST_DROP = 1e-2  # of chi squared, by as much noise as there is, that an iteration must promise
LEAST_RADIUS = 1e-9  # of what parameters may be expected to be
SLOWER, LEAST_STEPS = 20, 50  # a trial may take so many times the steps of the start, and so many a sample


@dataclass(frozen=True)
class Iteration:
    """How far a fit has come."""

    number: int
    cost: float
    values: dict[str, float]


@dataclass(frozen=True, eq=False)
class Optimum:
    """Where a fit ended.

    Attributes:
        values: the fitted parameters.
        nuisances: those of each record.
        cost: sum of squares of residuals over noise, priors included.
        residual, slopes: there; rows of the records, then of the priors and the nuisances, columns in units
            of `scales` and of the nuisances.
        scales: units of the parameters.
        iterations: steps taken.
        ended: why, in words.
    """

    values: dict[str, float]
    nuisances: list[Array]
    cost: float
    residual: Array
    slopes: Array
    scales: Array
    iterations: int
    ended: str


class Problem:
    """Parameters with priors, and the records they are fitted to.

    Args:
        blocks: the records.
        priors: of the parameters to be fitted.
        columns: their places among the slopes of the predictions.
        fixed: values of further parameters.
        accuracy: how runs are computed.
    """

    def __init__(
        self,
        blocks: Sequence[Block],
        priors: Mapping[str, Prior],
        columns: Sequence[int],
        fixed: Mapping[str, float],
        accuracy: Accuracy,
    ) -> None:
        self.blocks, self.priors, self.columns = blocks, dict(priors), list(columns)
        self.fixed, self.accuracy = dict(fixed), accuracy
        self.scales = np.array([prior.scale for prior in priors.values()])
        self.lower = np.array([prior.min for prior in priors.values()])
        self.upper = np.array([prior.max for prior in priors.values()])
        self._center = np.array([prior.center for prior in priors.values()])
        weight = [prior.scale / prior.sd for prior in priors.values()]
        self._ends = np.cumsum([len(priors), *[block.nuisances for block in blocks]])
        self._weight = np.concatenate([weight, np.ones(self._ends[-1] - len(priors))])

    def minimise(
        self,
        values: Mapping[str, float],
        report: Callable[[Iteration], None] | None = None,
        most: int = MOST_ITERATIONS,
    ) -> Optimum:
        """Return the best parameters near `values`, after at most so many iterations.

        Raises:
            InertanceError: if the network cannot be run with `values`.
        """
        start = np.zeros(self._ends[-1])
        low, high = np.full(len(start), -np.inf), np.full(len(start), np.inf)
        given = np.array([values[name] for name in self.priors])
        for vector, entries in ((start, given), (low, self.lower), (high, self.upper)):
            vector[: len(given)] = (entries - self._center) / self.scales
        drop = LEAST_DROP / max(sum(block.samples for block in self.blocks), 1.0)
        ending = Ending(drop, LEAST_DROP, LEAST_RADIUS, most)
        point: Point | None = None
        try:
            for point in descent(self._stacked, start, (low, high), ending):
                if report is not None and not point.ended:
                    report(Iteration(point.number, point.cost, self._parts(point.vector)[0]))
        except KeyboardInterrupt:
            if point is None:
                raise
            point = replace(point, ended="interrupted")
        assert point is not None
        found, nuisances = self._parts(point.vector)
        ended = point.ended
        return Optimum(
            found, nuisances, point.cost, point.residual, point.slopes, self.scales, point.number, ended
        )

    def _parts(self, vector: Array) -> tuple[dict[str, float], list[Array]]:
        """Return parameters, and the nuisances of each record."""
        moved, *nuisances = np.split(vector, self._ends[:-1])
        p = np.clip(self._center + self.scales * moved, self.lower, self.upper)
        return dict(zip(self.priors, p.tolist(), strict=True)), nuisances

    def _stacked(self, vector: Array, slopes: bool) -> tuple[Array, Array]:
        """Return residuals of all records, of priors and of nuisances, and their slopes."""
        values, nuisances = self._parts(vector)
        parameters = {**self.fixed, **values}
        found = [
            block.linearise(parameters, own, self.accuracy)
            for block, own in zip(self.blocks, nuisances, strict=True)
        ]
        self._grant(found)
        rows = [np.zeros((len(one.residual), len(vector))) for one in found]
        for one, row, begin, end in zip(found, rows, self._ends[:-1], self._ends[1:], strict=True):
            row[:, : len(self.priors)] = one.to_p[:, self.columns] * self.scales
            row[:, begin:end] = one.to_n
        residual = np.concatenate([*(one.residual for one in found), self._weight * vector])
        return residual, np.vstack([*rows, np.diag(self._weight)])

    def _grant(self, found: Sequence[Linearised]) -> None:
        """Bound the steps of trials: with parameters far off, a run may take for ever."""
        if self.accuracy.steps is None:
            runs = [prediction for one in found for prediction in one.predictions]
            each = max((run.run.stats["steps"] / len(run.time) for run in runs), default=0.0)
            self.accuracy = replace(self.accuracy, steps=LEAST_STEPS + round(SLOWER * each))
