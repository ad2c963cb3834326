"""`Fit`: how an effect is fitted together with a model so far."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ...base import computing
from ...components import InertanceError
from .. import criteria
from ..effects.effect import Values
from ..effects.hypothesis import Hypothesis
from ..effects.plausibility import refused
from ..models.study import Study
from .joint_fit import FitStart, JointFit
from .model_comparison import Refit
from .openings import led_by_openings
from .score_test import Candidate

LATE = "the time that was granted had passed"


@dataclass(frozen=True, eq=False)
class Fit:
    """What a fit of an effect needs: the model so far, and values to start from."""

    placed: Hypothesis
    base: Refit
    starts: Sequence[FitStart]
    known: float  # cost of the best model of the round so far, or of that without the effect
    anew: bool = False  # whether nobody knows where a fit of it leads

    @classmethod
    def of(
        cls, candidate: Candidate, base: Refit, fitted: Sequence[Refit], before: Refit | None = None
    ) -> Fit:
        """Return that of a candidate by what is known now, whoever makes it, and when.

        Where it was fitted `before`, with other noise in mind, it begins as screened and where that ended.
        """
        name = f"{candidate.effect.kind}_{len(base.effects) + 1}"
        placed = Hypothesis(candidate.effect, candidate.site, name, candidate.values)
        known = min((model.cost for model in fitted), default=base.cost)
        if before is None:
            return cls(placed, base, _starts(candidate, fitted), known, anew=True)
        return cls(placed, base, [before.values, (candidate.parameters, candidate.values)], known)


def made(study: Study, fit: Fit) -> Refit | str:
    """Return the model with a candidate, fitted, or why there is none."""
    if study.late():
        return LATE
    try:
        with computing(fit.placed.label):
            found = _fitted(study, fit)
    except InertanceError as error:
        return f"its fit ended early: {error.headline}"
    return refused(found.effects[-1], study.campaign) or found


def _fitted(study: Study, fit: Fit) -> Refit:
    """Return the model with a candidate, fitted from its starts and from where openings of records lead."""
    base, effects, starts = fit.base, [*fit.base.effects, fit.placed], [*fit.starts]
    if fit.anew and fit.placed.effect.rough:
        led = led_by_openings(study, effects, base, fit.starts)
        starts += [] if led is None else [led.values]
    return JointFit(study, base.parameters, effects, base).fitted(starts, fit.known)


def in_several_sizes(values: Values) -> list[dict[str, float]]:
    """Return values of an effect in series to begin at, as screening tells little of its size."""
    return [{name: size * value for name, value in values.items()} for size in criteria.SERIES_START_SIZES]


def _starts(candidate: Candidate, fitted: Sequence[Refit]) -> list[FitStart]:
    """Return parameters and values to fit a candidate from: as screened, or as its best special case."""
    effect, site = candidate.effect, candidate.site
    unsure = effect.place == "series" and not candidate.sized
    begins = in_several_sizes(candidate.values) if unsure else [candidate.values]
    starts: list[FitStart] = [(candidate.parameters, values) for values in begins]
    special = [model for model in fitted if candidate.generalises(model.effects[-1])]
    if special:
        plain = min(special, key=lambda model: model.cost)
        last = plain.effects[-1]
        widened = effect.widened(site.domain, site, last.effect, last.values)
        starts += [(plain.parameters, values) for values in widened]
    return starts
