"""The size of an effect in series with a spring: with which short runs are nearest to the machine."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...base import Array
from ...components import SimulationError
from ..criteria import SIZED_BEGINS, SIZED_FAR, SIZED_FINENESS, SIZED_NEAR, SIZED_RANGE, SIZED_SAMPLES
from ..effects.hypothesis import Hypothesis
from ..models.study import Study
from ..search.score_test import Candidate
from .along import Beside
from .missing_force import MissingForce
from .pieces import Follower


def sized(study: Study, missing: MissingForce, likely: Sequence[Candidate]) -> list[Candidate]:
    """Return effects in series with their sizes, the one that brings short runs nearest to the machine first.

    The gain that they were likened with is told of what they take off the distance of those runs.
    """
    runs = _ShortRuns(study, missing)
    return sorted((runs.sized(one) for one in likely), key=lambda one: -one.gain)


@dataclass(frozen=True, eq=False)
class _ShortRuns:
    """Runs that begin as the machine did, all over its records.

    The cost along a play is a needle in runs that are lost after some impacts. Their distance by Cauchy's
    loss, the mean of log(1 + (r/r_0)^2), to which a run that is lost adds little more the farther it is off,
    is a valley.

    Source: P. W. Holland, R. E. Welsch, Robust regression using iteratively reweighted least-squares,
    Communications in Statistics A 6 (1977) 813-827.
    """

    study: Study
    missing: MissingForce

    def sized(self, likely: Candidate) -> Candidate:
        """Return an effect with the size that brings them nearest."""
        from scipy.optimize import minimize_scalar

        ((name, size),) = likely.values.items()

        def distance(exponent: float) -> float:
            return self.distance(replace(likely, values={name: size * float(np.exp(exponent))}))

        ends, options = np.log(SIZED_RANGE), {"xatol": SIZED_FINENESS}
        found = minimize_scalar(distance, bounds=ends, method="bounded", options=options)
        gain = likely.gain * max(0.0, 1 - float(found.fun) / distance(-np.inf))
        return replace(likely, values={name: size * float(np.exp(found.x))}, gain=gain, sized=True)

    def distance(self, one: Candidate) -> float:
        """Return how far they are from the machine with an effect."""
        placed = Hypothesis(one.effect, one.site, f"{one.effect.kind}_1", one.values)
        follower = Follower.of(self.study, self.missing, self.missing.by_position, placed, one.parameters)
        runs = self.missing.settled.runs
        missed = [each for run in runs for each in _missed(follower, run, -(-SIZED_BEGINS // len(runs)))]
        return float(np.mean(np.log1p((np.concatenate(missed) / SIZED_NEAR) ** 2)))


def _missed(follower: Follower, along: Beside, count: int) -> Iterator[Array]:
    bench, given = follower.bench, follower.given
    for _, part in follower.spread(along, count, SIZED_SAMPLES):
        try:
            yield bench.run(part, given, bench.begin(part, given, {})).left.ravel()
        except SimulationError:
            yield np.full(len(part.compared.time), SIZED_FAR)
