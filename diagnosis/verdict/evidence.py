"""What a verdict rests on."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ...identification import Campaign
from ..criteria import MOVED_STANDARD_DEVIATIONS
from ..models.study import Study
from ..search.model_comparison import Refit
from ..search.score_test import Candidate


@dataclass(frozen=True, eq=False)
class Evidence:
    """The records, and the models held against them.

    Attributes:
        study: the campaign, and how its runs are computed.
        nominal: the model as given.
        refit: its parameters fitted.
        after: with the effects as well; the same as `refit` if none was accepted.
        screened: every effect at every site, with what it would explain.
    """

    study: Study
    nominal: Refit
    refit: Refit
    after: Refit
    screened: tuple[Candidate, ...] = ()

    @property
    def campaign(self) -> Campaign:
        """Records, channels, priors."""
        return self.study.campaign

    @property
    def judged(self) -> str:
        """Which runs the figures are of: without test runs, those that were fitted."""
        return "test runs" if self.campaign.testing else "training runs"


def moved_parameters(campaign: Campaign, parameters: Mapping[str, float]) -> list[str]:
    """Return the parameters that are further from what was assumed than a true one is likely to be."""
    return [
        name
        for name, value in parameters.items()
        if abs(value - campaign.priors[name].center) > MOVED_STANDARD_DEVIATIONS * campaign.priors[name].sd
    ]
