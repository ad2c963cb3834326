"""The excitation by which two models that fit alike would part most."""

from __future__ import annotations

from collections.abc import Iterator
from copy import copy
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from ...components import SimulationError
from ...identification import Campaign, Experiment, Record
from .. import criteria
from ..effects.hypothesis import told
from ..models.study import Study
from ..search.joint_fit import JointFit
from ..search.model_comparison import Refit, rms


class _Sine(NamedTuple):
    """A sine on one input, the others at rest."""

    channel: str
    frequency: float
    amplitude: float


def separating(study: Study, one: Refit, other: Refit) -> str | None:
    """Return, in words, the sine within what was measured that parts two fitted models most.

    None if no sine parts them by more than twice the noise, or if one of them cannot be run.
    """
    campaign, tried = study.campaign, copy(study.campaign)
    trials = list(_trials(campaign))
    tried.training, tried.testing = [_experiment(campaign, sine) for sine in trials], []
    try:
        joints = [JointFit(replace(study, campaign=tried), f.parameters, f.effects) for f in (one, other)]
        runs = [joint.seen(joint.start).train for joint in joints]
    except SimulationError:
        return None
    apart = [rms([a[name] - b[name] for name in a]) for a, b in zip(*runs, strict=True)]
    if not apart or max(apart) < criteria.SEPARATING_MISFIT:
        return None
    best = trials[int(np.argmax(apart))]
    unit, both = campaign.measured[best.channel].si, (told(*f.effects[-1].key) for f in (one, other))
    return (
        f"A sine of {best.amplitude:.3g} {unit} at {best.frequency:.3g} Hz on '{best.channel}': there "
        f"{' and '.join(both)} part by {max(apart):.2g} times the noise."
    )


def _trials(campaign: Campaign) -> Iterator[_Sine]:
    """Yield sines in the band of each input, no larger, faster or harder than what was measured."""
    records = [e.record for e in campaign.training]
    for name in campaign.inputs:
        low, high = _band(records, name)
        peaks = [max(_peak(record, name, order) for record in records) for order in range(3)]
        moving = campaign.measured[name].si in ("m", "rad")
        for frequency in np.geomspace(low, high, criteria.TRIAL_FREQUENCIES):
            omega = 2 * np.pi * frequency
            largest = min(p / omega**k for k, p in enumerate(peaks)) if moving else peaks[0]
            for share in criteria.TRIAL_AMPLITUDE_SHARES:
                yield _Sine(name, float(frequency), float(share * largest))


def _band(records: list[Record], channel: str) -> tuple[float, float]:
    """Return between which frequencies the middle nine tenths of the energy of an input lie."""
    bands = []
    for record in records:
        power = np.abs(np.fft.rfft(record.values[channel] - record.values[channel].mean())) ** 2
        share = np.cumsum(power) / max(float(power.sum()), 1e-300)
        frequencies = np.fft.rfftfreq(len(record.time), 1 / record.rate)
        ends = np.searchsorted(share, criteria.INPUT_BAND_ENERGY_SHARES)
        bands.append(frequencies[np.minimum(ends, len(frequencies) - 1)])
    (low, _), (_, high) = np.min(bands, axis=0), np.max(bands, axis=0)
    low = max(float(low), 1 / criteria.TRIAL_SECONDS)
    return low, max(float(high), 2 * low)


def _peak(record: Record, channel: str, order: int) -> float:
    values = record.values[channel] - np.median(record.values[channel])
    for _ in range(order):
        values = np.gradient(values, record.time)
    return float(np.quantile(np.abs(values), criteria.PEAK_QUANTILE))


def _experiment(campaign: Campaign, sine: _Sine) -> Experiment:
    time = np.arange(round(criteria.TRIAL_SECONDS * criteria.TRIAL_RATE_HZ) + 1) / criteria.TRIAL_RATE_HZ
    rise = np.clip(time / criteria.TRIAL_FADE_SECONDS, 0, 1)
    fade = rise**3 * (10 - 15 * rise + 6 * rise**2)
    before = campaign.training[0].record.values
    values = {
        name: np.full(len(time), np.median(before[name]) if channel.driven else 0.0)
        for name, channel in campaign.measured.items()
    }
    values[sine.channel] += sine.amplitude * fade * np.sin(2 * np.pi * sine.frequency * time)
    every = round(criteria.TRIAL_RATE_HZ / criteria.COMPARISON_RATE_HZ)
    return Experiment(
        Record("trial", time, values), "trial", initial="rest", every=every, floors=campaign.floors
    )
