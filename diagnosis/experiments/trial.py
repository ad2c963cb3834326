"""A trial: an excitation as an experiment from rest, and whether the rig would bear it."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ...base import Array
from ...identification import Campaign, Experiment, Limit, Prediction, Record
from .. import criteria
from ..search.record_run import RecordRun
from .envelope import rest_of


def trial(campaign: Campaign, drives: Mapping[str, Array], rate: float) -> Experiment:
    """Return an experiment that drives inputs, about where they rest, with samples at a rate [Hz].

    Outputs have offsets of their own, if those of the first record that is fitted have.
    """
    time = np.arange(len(next(iter(drives.values())))) / rate
    values = {name: np.full(len(time), rest_of(campaign, name)) for name in campaign.inputs}
    values |= {name: np.zeros(len(time)) for name in campaign.outputs}
    for name, moved in drives.items():
        values[name] = values[name] + moved
    every = max(1, int(rate / criteria.COMPARISON_RATE_HZ))
    record = Record("trial", time, values)
    offset = campaign.training[0].offset if campaign.training else ()
    return Experiment(record, "trial", initial="rest", offset=offset, every=every, floors=campaign.floors)


def taken(limits: Mapping[str, Limit], run: RecordRun) -> float:
    """Return the largest share that a run takes of the limits of channels and quantities, 0 without any."""
    shares = [0.0]
    for name, limit in limits.items():
        if name in run.seen:
            values = run.seen[name]
        else:
            assert isinstance(run.found, Prediction)
            values = run.found.run[limit.path][run.found.at]
        shares.append(limit.share(values - values[0], run.experiment.rate))
    return max(shares)
