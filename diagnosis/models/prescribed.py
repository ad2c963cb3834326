"""Motion that inputs prescribe, in a model without states, and where it stands still."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...base import Array, Flags
from ...identification import Campaign
from ..criteria import STANDSTILL_RANGE_SHARE, STANDSTILL_SECONDS


def moving(campaign: Campaign) -> Campaign:
    """Return a campaign that omits what is measured while all motion is prescribed and none is left.

    Dry friction may then hold any force below its break-away, and no model tells which.
    """
    records = campaign.all_records
    still = [standing([e.compared.values[name] for name in campaign.inputs], e.rate) for e in records]
    if not any(found.any() for found in still) or campaign.network.dae().state_names:
        return campaign
    count, end = len(campaign.training), len(campaign.experiments)
    left = [
        experiment if found.all() else experiment.omitting(found)
        for experiment, found in zip(records, still, strict=True)
    ]
    return campaign.with_records(left[:count], left[count:end], left[end:])


def standing(inputs: Sequence[Array], rate: float) -> Flags:
    """Tell at which samples no input changes, for a while.

    Args:
        inputs: at common instants.
        rate: samples a second [Hz].
    """
    count = len(inputs[0]) if inputs else 0
    length = max(2, round(STANDSTILL_SECONDS * rate))
    if count < length:
        return np.zeros(count, dtype=bool)
    windows = [np.lib.stride_tricks.sliding_window_view(values, length) for values in inputs]
    least = [STANDSTILL_RANGE_SHARE * np.ptp(values) for values in inputs]
    still = np.all([np.ptp(w, axis=1) <= most for w, most in zip(windows, least, strict=True)], axis=0)
    return np.asarray(np.convolve(still, np.ones(length)) > 0)
