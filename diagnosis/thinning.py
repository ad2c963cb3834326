"""Records as often as machines need, and no more often."""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy
from dataclasses import replace

from ..identification import Campaign, Experiment, Filter

ENOUGH = 250.0  # Hz, at which outputs are compared


def thinned(campaign: Campaign) -> Campaign:
    """Return a campaign whose outputs are compared as often as machines need, and no more often.

    Inputs lose what is too fast to be compared: there it is noise, and their second derivatives feel it.
    """
    thin = copy(campaign)
    driven = [name for name, channel in campaign.measured.items() if channel.driven]
    for name in ("training", "testing"):
        setattr(thin, name, [_slowed(experiment, driven) for experiment in getattr(campaign, name)])
    return thin


def _slowed(experiment: Experiment, driven: Sequence[str]) -> Experiment:
    record = experiment.record
    every = max(1, int(record.rate / ENOUGH))
    if every > 1:
        smooth = Filter(cutoff=0.5 * record.rate / every)
        slow = {name: smooth.apply(record.values[name], record.rate) for name in driven}
        record = replace(record, values={**record.values, **slow})
    return replace(experiment, record=record, every=every)
