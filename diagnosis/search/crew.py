"""Who does what can be done side by side, such as fits of effects: this process, or others."""

from __future__ import annotations

import pickle
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import lru_cache, partial
from typing import Any, TypeVar

from ...base import computing
from ...components import InertanceError
from ...identification import Accuracy, Campaign
from .. import criteria
from ..effects.effect import Values
from ..effects.hypothesis import Hypothesis
from ..effects.plausibility import implausible
from ..models.study import Study, study_of
from .joint_fit import FitStart, JointFit
from .model_comparison import Refit
from .openings import led_by_openings
from .score_test import Candidate

LATE = "the time that was granted had passed"
Done = TypeVar("Done")
Outcome = Callable[[], Refit | str]  # of a fit: the model, or why there is none


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
        ended = before.parameters, before.effects[-1].values
        return cls(placed, base, [ended, (candidate.parameters, candidate.values)], known)


class Crew:
    """Who does the work of a study: its executor, or whoever asks for what comes of it."""

    def __init__(self, study: Study) -> None:
        self.study = study
        self.payload = b"" if study.executor is None else _sent(study.campaign)

    def begin(self, fit: Fit) -> Outcome:
        """Return what gives the fitted model, or why there is none, once it is called."""
        return self.ask(_made, fit)

    def ask(self, work: Callable[..., Done], *given: Any) -> Callable[[], Done]:
        """Return what gives the result of work on the study, once it is called."""
        study = self.study
        if study.executor is None:
            return partial(work, study, *given)
        return study.executor.submit(_job, self.payload, study.accuracy, study.deadline, work, given).result


def _job(
    payload: bytes, accuracy: Accuracy, deadline: float, work: Callable[..., Done], given: Sequence[Any]
) -> Done:
    return work(study_of(_received(payload), accuracy, deadline=deadline), *given)


def _sent(campaign: Campaign) -> bytes:
    """Return a campaign for other processes, with its records as they are compared here, and their noise."""
    records = campaign.training, campaign.testing
    return pickle.dumps((campaign.pickled(), campaign.measured, campaign.floors, records))


@lru_cache(maxsize=1)
def _received(payload: bytes) -> Campaign:
    """Return a campaign in the process that it was sent to, as it was sent."""
    read, measured, floors, records = pickle.loads(payload)
    campaign: Campaign = pickle.loads(read).with_records(*records)
    campaign.measured, campaign.floors = measured, floors
    return campaign


def _made(study: Study, fit: Fit) -> Refit | str:
    """Return the model with a candidate, fitted, or why there is none."""
    if study.late():
        return LATE
    placed = fit.placed
    try:
        with computing(placed.label):
            effects = [*fit.base.effects, placed]
            rough = placed.effect.rough and fit.anew
            led = led_by_openings(study, effects, fit.base, fit.starts) if rough else ()
            joint = JointFit(study, fit.base.parameters, effects, fit.base)
            found = joint.fitted([*fit.starts, *led], fit.known)
    except InertanceError as error:
        return f"its fit ended early: {error.headline}"
    return refused(found.effects[-1], study.campaign) or found


def refused(placed: Hypothesis, campaign: Campaign) -> str:
    """Return why no machine has an effect as it was fitted; nothing if one may."""
    values = placed.values
    if not placed.effect.credible(values):
        return f"no such machine: {', '.join(f'{name} = {value:.3g}' for name, value in values.items())}"
    odd = implausible(placed, campaign)
    return "" if odd is None else f"no such machine: {odd}"


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
