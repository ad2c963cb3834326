"""Which other quantity would part models that no input parts, if it were measured."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from copy import copy
from dataclasses import replace

import numpy as np

from ...components import InertanceError
from ...identification import Channel, NoiseFloor
from .. import criteria
from ..models.study import FMUStudy, Study
from .forecast import Forecast, Planned, Seen
from .separation import all_odds
from .trial import trial

ANOTHER = "measure another quantity, or drive another input"
NONE_PARTS = (
    "no motion of its sites and no force through them would part them either, if it were measured: to this "
    "model they are one, and either corrects it"
)


def telling_sensor(study: Study, models: Sequence[Forecast], made: Planned) -> str:
    """Return which one more quantity would part all models most, in words, or that none does."""
    if isinstance(study, FMUStudy):
        return ANOTHER
    study.tell("what other sensors would tell")
    campaign, channels = copy(study.campaign), {c.path: c for c in _unmeasured(study)}
    campaign.measured = {**campaign.measured, **channels}
    floors = {**campaign.floors, **{path: NoiseFloor(1.0, "stated") for path in channels}}
    experiment = replace(trial(campaign, made.candidate.drives, made.experiment.record.rate), floors=floors)
    try:
        watched = [model.watching(campaign) for model in models]
        seen = [model.seen(experiment) for model in watched]
    except InertanceError:
        return ANOTHER
    parted = {path: _least_odds(watched, seen, path, list(channels)) for path in channels}
    best = max(parted, key=lambda path: parted[path], default="")
    if parted.get(best, 0.0) < criteria.DECISIVE_LOG_ODDS:
        return NONE_PARTS
    share, unit = f"{criteria.NEW_SENSOR_NOISE_SHARE:.1%}", channels[best].si
    return f"measure '{best}' [{unit}], too: with noise of {share} of its range it parts them"


def _least_odds(models: Sequence[Forecast], seen: Sequence[Seen], path: str, others: Sequence[str]) -> float:
    """Return the least logarithm of odds of any pair of models, with one more output."""
    names = list(seen[0].run.seen)
    span = max(float(np.ptp(one.run.seen[path])) for one in seen)
    if not span:
        return 0.0
    weights = [float(name not in others) for name in names]
    weights[names.index(path)] = 1 / (criteria.NEW_SENSOR_NOISE_SHARE * span)
    rows = np.repeat(weights, len(seen[0].values) // len(names))
    weighed = [replace(s, values=rows * s.values, slopes=rows[:, None] * s.slopes) for s in seen]
    return min(pair.log_odds for pair in all_odds(models, weighed))


def _unmeasured(study: Study) -> Iterator[Channel]:
    """Yield how flanges of sites move, and the forces through them, as far as nothing measures them."""
    machine, measured = study.campaign.machine, study.campaign.measured
    taken, names = {channel.path for channel in measured.values()}, set(machine.names())
    for site in study.sites:
        for name in (site.mechanics.across, site.mechanics.through):
            path = f"{site.moving}.{name}"
            if path not in taken and path in names:
                taken.add(path)
                yield Channel(path, False, machine.unit(path), machine.unit(path))
