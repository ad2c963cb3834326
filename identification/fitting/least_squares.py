"""Weighted least squares with priors and bounds: damped Gauss-Newton on all records at once."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ...components import InertanceError, SimulationError
from ..campaign.priors import Prior
from .campaign_model import Accuracy
from .residual_block import Block, Linearised

Array = NDArray[np.float64]
MOST_ITERATIONS = 40
ENOUGH = 1e-2
SMALLEST, LARGEST = 1e-9, 1e9
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
        linearised: residuals and slopes there.
        matrix: the compressed slopes, priors included: cost = |matrix d + rest|^2, d in `scales`.
        iterations: steps taken.
        ended: why, in words.
    """

    values: dict[str, float]
    nuisances: list[Array]
    cost: float
    linearised: list[Linearised]
    matrix: Array
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
        self._weight = np.array([prior.scale / prior.sd for prior in priors.values()])

    def minimise(
        self,
        values: Mapping[str, float],
        nuisances: Sequence[Array] | None = None,
        report: Callable[[Iteration], None] | None = None,
        most: int = MOST_ITERATIONS,
    ) -> Optimum:
        """Return the best parameters near `values`, after at most so many iterations.

        Raises:
            SimulationError: if the network cannot be run with `values`.
        """
        p = np.clip([values[name] for name in self.priors], self.lower, self.upper)
        n = list(nuisances or [np.zeros(block.nuisances) for block in self.blocks])
        found = self._linearised(p, n)
        self._grant(found)
        damping, cost, ended = 1e-3, self._cost(found, p, n), "iterations used up"
        number = 0
        matrix, rest = self._compressed(found, p, n)
        slopes = found
        try:
            for number in range(1, most + 1):
                if report is not None:
                    report(Iteration(number, cost, self._named(p)))
                step, promised = self._step(matrix, rest, p, damping)
                if promised <= ENOUGH * max(1.0, cost / max(self._samples(), 1.0)):
                    ended = "converged"
                    break
                p_next, n_next = self._moved(p, n, step)
                trial = self._tried(p_next, n_next)
                gained = cost - (self._cost(trial, p_next, n_next) if trial is not None else np.inf)
                if trial is None or not gained > 1e-4 * promised:
                    damping *= 8.0
                    if damping > LARGEST:
                        ended = "no further descent"
                        break
                    if trial is not None:
                        slopes = self._corrected(slopes, trial, step)
                        matrix, rest = self._compressed(slopes, p, n)
                    continue
                p, n, found, cost = p_next, n_next, trial, cost - gained
                slopes = found
                matrix, rest = self._compressed(found, p, n)
                damping = max(damping / 5, SMALLEST)
        except KeyboardInterrupt:
            ended = "interrupted"
        matrix = self._compressed(found, p, n)[0]
        return Optimum(self._named(p), n, cost, found, matrix, self.scales, number, ended)

    def _grant(self, found: Sequence[Linearised]) -> None:
        """Bound the steps of trials: with parameters far off, a run may take for ever."""
        if self.accuracy.steps is None:
            runs = [prediction for one in found for prediction in one.predictions]
            each = max((run.run.stats["steps"] / len(run.time) for run in runs), default=0.0)
            self.accuracy = replace(self.accuracy, steps=LEAST_STEPS + round(SLOWER * each))

    def _named(self, p: Array) -> dict[str, float]:
        return {name: float(value) for name, value in zip(self.priors, p, strict=True)}

    def _samples(self) -> float:
        return sum(block.samples for block in self.blocks)

    def _linearised(self, p: Array, n: Sequence[Array]) -> list[Linearised]:
        parameters = {**self.fixed, **self._named(p)}
        return [
            block.linearise(parameters, own, self.accuracy) for block, own in zip(self.blocks, n, strict=True)
        ]

    def _tried(self, p: Array, n: Sequence[Array]) -> list[Linearised] | None:
        try:
            return self._linearised(p, n)
        except (SimulationError, InertanceError):
            return None

    def _cost(self, found: Sequence[Linearised], p: Array, n: Sequence[Array]) -> float:
        prior = self._weight * (p - self._center) / self.scales
        cost = sum(one.cost for one in found) + float(prior @ prior) + sum(float(own @ own) for own in n)
        return cost if np.isfinite(cost) else np.inf

    def _compressed(self, found: Sequence[Linearised], p: Array, n: Sequence[Array]) -> tuple[Array, Array]:
        """Return a small matrix and vector with the same least-squares solutions as all residuals."""
        count, sizes = len(p), [len(own) for own in n]
        width = count + sum(sizes)
        rows, begin = [], count
        for one, size in zip(found, sizes, strict=True):
            own = np.column_stack([one.to_p[:, self.columns] * self.scales, one.to_n, one.residual])
            small = triangular(own)
            wide = np.zeros((len(small), width + 1))
            wide[:, :count], wide[:, -1] = small[:, :count], small[:, -1]
            wide[:, begin : begin + size] = small[:, count : count + size]
            rows.append(wide)
            begin += size
        prior = np.zeros((width, width + 1))
        prior[:, :width] = np.diag(np.concatenate([self._weight, np.ones(width - count)]))
        prior[:count, -1] = self._weight * (p - self._center) / self.scales
        prior[count:, -1] = np.concatenate([np.zeros(0), *n])
        both = triangular(np.vstack([*rows, prior]))
        return both[:, :width], both[:, width]

    def _corrected(self, found: list[Linearised], trial: list[Linearised], step: Array) -> list[Linearised]:
        """Return slopes that agree with what a step really did (Broyden's update)."""
        count, length = len(self.priors), float(step @ step)
        begin, corrected = count, []
        for one, other in zip(found, trial, strict=True):
            own = step[begin : begin + one.to_n.shape[1]]
            begin += len(own)
            expected = one.to_p[:, self.columns] @ (self.scales * step[:count]) + one.to_n @ own
            missed = (other.residual - one.residual - expected) / length
            to_p = one.to_p.copy()
            to_p[:, self.columns] += np.outer(missed, step[:count] / self.scales)
            corrected.append(replace(one, to_p=to_p, to_n=one.to_n + np.outer(missed, own)))
        return corrected

    def _step(self, matrix: Array, rest: Array, p: Array, damping: float) -> tuple[Array, float]:
        """Return the step within bounds that the slopes promise most from, and how much they promise."""
        from scipy.optimize import lsq_linear

        size = np.sqrt((matrix**2).sum(axis=0))
        size[size == 0] = 1.0
        tall = np.vstack([matrix, np.sqrt(damping) * np.diag(size)])
        aim = -np.concatenate([rest, np.zeros(len(size))])
        free = np.full(len(size) - len(p), np.inf)
        lower = np.concatenate([(self.lower - p) / self.scales, -free])
        upper = np.concatenate([(self.upper - p) / self.scales, free])
        lower, upper = np.minimum(lower, -1e-12), np.maximum(upper, 1e-12)
        step: Array = (
            lsq_linear(tall / np.r_[size], aim, bounds=(lower * size, upper * size), method="bvls").x / size
        )
        after = rest + matrix @ step
        return step, float(rest @ rest - after @ after)

    def _moved(self, p: Array, n: Sequence[Array], step: Array) -> tuple[Array, list[Array]]:
        moved = np.clip(p + self.scales * step[: len(p)], self.lower, self.upper)
        ends = np.cumsum([len(own) for own in n])
        parts = np.split(step[len(p) :], ends[:-1])
        return moved, [own + part for own, part in zip(n, parts, strict=True)]


def triangular(matrix: Array) -> Array:
    """Return R of the QR decomposition: as many rows as columns, the same least-squares solutions."""
    R: Array = np.asarray(np.linalg.qr(matrix, mode="r"), dtype=np.float64)
    return R
