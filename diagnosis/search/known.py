"""How well the parameters and effects of a model are known that a diagnosis fitted: errors and intervals."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from math import inf, nan

import numpy as np

from ...base import Array, computing
from ...identification import (
    EndedEarlyError,
    Ending,
    Interval,
    Iterate,
    Optimum,
    Prior,
    Rows,
    covariance,
    descent,
    profiled,
    tied,
)
from ..criteria import (
    DESCENT_STEPS,
    PROFILE_CHI_SQUARED_DROP,
    PROFILE_LEAST_RADIUS,
    PROFILE_RESTARTS,
)
from ..models.study import Study
from .joint_fit import JointFit
from .model_comparison import Refit


@dataclass(frozen=True, eq=False)
class Known:
    """What the training records tell of the parameters and the effects of a fitted model.

    Quantities of an effect are told by its name and theirs, as "coulomb_friction_1.f_c".

    Attributes:
        study: the records.
        model: what was fitted to them.
    """

    study: Study
    model: Refit

    @cached_property
    def errors(self) -> dict[str, float]:
        """Standard errors, in SI units.

        By the noise where residuals are white, else by the jackknife over stretches of the records: what they
        would scatter if the runs were measured again, if the model is right.
        """
        scales = [prior.scale for prior in self._problem.priors.values()]
        return dict(zip(self._problem.priors, (self._deviations * scales).tolist(), strict=True))

    @property
    def ties(self) -> list[str]:
        """What the records hardly tell apart, in words."""
        apart = np.where(self._deviations > 0, self._deviations, 1.0)
        return [*tied(self.errors, self._scatter[0] / np.outer(apart, apart))]

    def intervals(self, level: float, tell: Callable[[str], None]) -> dict[str, Interval]:
        """Return profile-likelihood intervals; see `profiled`."""
        optimum, (_, freedom) = self._problem.minimise(), self._scatter
        for _ in range(PROFILE_RESTARTS):
            try:
                return dict(profiled(self._problem, optimum, self.errors, level, freedom, tell))
            except EndedEarlyError as better:
                tell("a profile has led to a lower misfit: going on from there")
                optimum = self._problem.minimise(begin=self._problem.vector(better.values))
        unknown = Interval(level, nan, nan, "profiles lead to ever lower misfits")
        return dict.fromkeys(self.errors, unknown)

    @cached_property
    def _problem(self) -> EffectsProblem:
        return EffectsProblem(self.study, self.model)

    @property
    def _deviations(self) -> Array:
        """Standard deviations, in units of the scales."""
        return np.sqrt(np.maximum(np.diag(self._scatter[0]), 0.0))

    @cached_property
    @computing("standard errors")
    def _scatter(self) -> tuple[Array, float]:
        """The covariance, and by how many degrees of freedom it is known."""
        return covariance(self._problem.at(self._problem.joint.start), self._problem.rows)


class EffectsProblem:
    """Parameters and effects fitted together, as what can be profiled."""

    def __init__(self, study: Study, model: Refit) -> None:
        self.joint = JointFit(study, model.parameters, model.effects, model)
        campaign = self.joint.campaign
        self.priors = {name: campaign.priors[name] for name in self.joint.names}
        self.priors |= dict(_of_effects(self.joint))
        outputs = len(campaign.outputs)
        self.rows = [
            Rows(outputs, len(e.compared.time), outputs * len(e.compared.time) + len(e.unknown))
            for e in campaign.training
        ]

    def vector(self, values: Mapping[str, float]) -> Array:
        """Return values by name as a vector."""
        placed = [{q.name: values[f"{p.name}.{q.name}"] for q in p.quantities} for p in self.joint.effects]
        return self.joint.vector(values, placed)

    def at(self, vector: Array) -> Optimum:
        """Return a vector as where a fit ended."""
        residual, slopes = self.joint.stacked(vector, True)
        assert slopes is not None
        return self._optimum(Iterate(vector, residual, slopes, 0))

    def minimise(self, *, begin: Array | None = None, held: str | None = None) -> Optimum:
        """Return the best near a vector, with one entry held."""
        start = self.joint.start if begin is None else begin
        low, high = (np.array(bound) for bound in self.joint.shapes.bounds(start))
        start = np.clip(start, low, high)
        if held is not None:
            place = [*self.priors].index(held)
            low[place] = high[place] = start[place]
        ending = Ending(0.0, PROFILE_CHI_SQUARED_DROP, PROFILE_LEAST_RADIUS, DESCENT_STEPS)
        *_, last = descent(self.joint.stacked, start, (low, high), ending)
        return self._optimum(last)

    def _optimum(self, last: Iterate) -> Optimum:
        parameters, effects = self.joint.unpacked(last.vector)
        values = parameters | {f"{p.name}.{name}": v for p in effects for name, v in p.values.items()}
        scales = np.array([prior.scale for prior in self.priors.values()])
        told = last.residual, last.slopes, scales, last.vector, last.number, last.ended
        return Optimum(values, [], last.cost, *told)


def _of_effects(joint: JointFit) -> Iterator[tuple[str, Prior]]:
    """Yield the quantities of effects, of which nothing is known but what they may be at least."""
    for placed, sizes in zip(joint.effects, joint.sizes, strict=True):
        for quantity, size in zip(placed.quantities, sizes.tolist(), strict=True):
            yield f"{placed.name}.{quantity.name}", Prior(size, inf, quantity.low, inf)
