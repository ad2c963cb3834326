"""`Recast`: models in records that are compared otherwise than they were measured."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ..models.study import Study
from .joint_fit import FitStart, JointFit
from .model_comparison import Refit


@dataclass(frozen=True, eq=False)
class Recast:
    """Models in records that are compared otherwise than they were measured, as an effect asks for it.

    Attributes:
        study: with these records.
        start: the model as it was given.
        base: the same, its parameters fitted.
        model: that with the effect.
        told: how they are compared, and why, in words.
    """

    study: Study
    start: Refit
    base: Refit
    model: Refit
    told: str

    @classmethod
    def of(
        cls,
        study: Study,
        start: Refit,
        base: Refit,
        model: Refit,
        told: str,
        starts: Sequence[FitStart] = (),
    ) -> Recast:
        """Return what models come to in the records of a study; that with the effect begins at `starts`.

        Raises:
            SimulationError: if one cannot be run there.
        """
        refit = JointFit(study, base.parameters, near=base)
        given = refit.seen(refit.vector(start.parameters, []))
        found = JointFit(study, model.parameters, model.effects, model).fitted(starts)
        return cls(study, given, refit.fitted(), found, told)
