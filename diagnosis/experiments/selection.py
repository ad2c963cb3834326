"""Selection: the excitations with the largest merit, of candidates within the limits and near the best."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

from ...components import ModelError
from .. import criteria
from ..models.study import Study
from .candidates import Candidate, candidates, refined
from .envelope import envelopes, sampling_rate, seconds
from .forecast import Forecast, Planned, planned

NO_INPUT = "no input may move: none was moved in a record, and [limits] gives none a band"


@dataclass(frozen=True, eq=False)
class Rated:
    """An experiment and its merit."""

    made: Planned
    merit: float


def selected(study: Study, models: Sequence[Forecast], merit: Callable[[Planned], float]) -> list[Rated]:
    """Return experiments that the rig bears, the best first.

    Raises:
        ModelError: if no input may move, or if no excitation can be run within the limits.
    """
    campaign = study.campaign
    rate, lasting = sampling_rate(campaign), seconds(campaign)
    inputs = envelopes(campaign, lasting)
    if not inputs:
        raise ModelError(f"{campaign.source}: {NO_INPUT}")

    def rated(tried: Iterable[Candidate], of: int, what: str) -> list[Rated]:
        found = list[Rated]()
        for number, candidate in enumerate(tried, start=1):
            study.tell(f"{what} {number} of {of}: {candidate.told}")
            made = planned(campaign, candidate, models, rate)
            if made is not None:
                found = _best([*found, Rated(made, merit(made))])
        return found

    first = list(candidates(inputs, lasting, rate))
    found = rated(first, len(first), "excitation")
    if not found:
        raise ModelError(
            f"{campaign.source}: none of {len(first)} excitations can be run within the limits: allow more, "
            "or correct the model"
        )
    near = list(refined(found[0].made.candidate, inputs, lasting, rate))
    return _best([*found, *rated(near, len(near), "near the best")])


def _best(found: Sequence[Rated]) -> list[Rated]:
    return sorted(found, key=lambda one: -one.merit)[: criteria.DESIGN_CHECKS]
