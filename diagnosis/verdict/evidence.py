"""What a verdict rests on."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ...identification import Accuracy, Campaign
from ..criteria import MOVED_STANDARD_DEVIATIONS
from ..search.joint_fit import Refit
from ..search.score_test import Candidate


@dataclass(frozen=True, eq=False)
class Evidence:
    """The records, and the models held against them.

    Attributes:
        campaign: records, channels, priors.
        nominal: the model as given.
        refit: its parameters fitted.
        after: with the effects as well; the same as `refit` if none was accepted.
        screened: every effect at every site, with what it would explain.
        accuracy: solver and tolerances of all runs.
    """

    campaign: Campaign
    nominal: Refit
    refit: Refit
    after: Refit
    screened: tuple[Candidate, ...] = ()
    accuracy: Accuracy | None = None

    @property
    def judged(self) -> str:
        """Which runs the figures are of."""
        return judged(self.campaign)


def judged(campaign: Campaign) -> str:
    """Return which runs figures are of: without test runs, of those that were fitted."""
    return "test runs" if campaign.testing else "training runs"


def moved_parameters(campaign: Campaign, parameters: Mapping[str, float]) -> list[str]:
    """Return the parameters that are further from what was assumed than a true one is likely to be."""
    priors = campaign.priors
    return [
        name
        for name, value in parameters.items()
        if abs(value - priors[name].center) > MOVED_STANDARD_DEVIATIONS * priors[name].sd
    ]
