"""Who does what can be done side by side, such as fits of effects: this process, or others."""

from __future__ import annotations

import pickle
from collections.abc import Callable, Sequence
from functools import lru_cache, partial
from typing import Any, TypeVar

from ...identification import Accuracy, Campaign
from ..models.study import Study, study_of
from .fit import Fit, made
from .model_comparison import Refit

Done = TypeVar("Done")
Outcome = Callable[[], Refit | str]  # of a fit: the model, or why there is none


class Crew:
    """Who does the work of a study: its executor, or whoever asks for what comes of it."""

    def __init__(self, study: Study) -> None:
        self.study = study
        self.payload = b"" if study.executor is None else _sent(study.campaign)

    def begin(self, fit: Fit) -> Outcome:
        """Return what gives the fitted model, or why there is none, once it is called."""
        return self.ask(made, fit)

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
