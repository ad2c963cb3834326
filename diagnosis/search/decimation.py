"""Records as often as machines need, and no more often."""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy
from dataclasses import replace

import numpy as np

from ...base import Array
from ...identification import Campaign, Experiment, Filter
from ..criteria import COMPARISON_RATE_HZ, NOISE_PEAK_STANDARD_DEVIATIONS


def thinned(campaign: Campaign) -> Campaign:
    """Return a campaign whose outputs are compared as often as machines need, and no more often.

    Inputs lose what is too fast to be compared where that is noise, which their second derivatives feel.
    """
    thin = copy(campaign)
    thin.training, thin.testing = (
        [_slowed(experiment, campaign.inputs) for experiment in experiments]
        for experiments in (campaign.training, campaign.testing)
    )
    return thin


def _slowed(experiment: Experiment, driven: Sequence[str]) -> Experiment:
    record = experiment.record
    every = max(1, int(record.rate / COMPARISON_RATE_HZ))
    if every > 1:
        smooth = Filter(cutoff=0.5 * record.rate / every)
        quiet = {name: _quiet(record.values[name], smooth, record.rate) for name in driven}
        record = replace(record, values=record.values | quiet)
    return replace(experiment, record=record, every=every)


def _quiet(values: Array, smooth: Filter, rate: float) -> Array:
    """Return a signal without its fast noise; as it is, if it has steps."""
    slow = smooth.apply(values, rate)
    fast = values - slow
    return slow if float(np.abs(fast).max()) < NOISE_PEAK_STANDARD_DEVIATIONS * float(fast.std()) else values
