"""The excitation by which two models that fit alike would part most."""

from __future__ import annotations

from collections.abc import Iterator
from copy import copy
from dataclasses import dataclass

import numpy as np

from ...components import SimulationError
from ...identification import Accuracy, Campaign, Experiment, Record
from ..criteria import (
    COMPARISON_RATE_HZ,
    INPUT_BAND_ENERGY_SHARES,
    PEAK_QUANTILE,
    SEPARATING_MISFIT,
    TRIAL_AMPLITUDE_SHARES,
    TRIAL_FADE_SECONDS,
    TRIAL_FREQUENCIES,
    TRIAL_RATE_HZ,
    TRIAL_SECONDS,
)
from ..search.joint_fit import JointFit, Refit


@dataclass(frozen=True)
class _Sine:
    """A sine on one input, the others at rest."""

    channel: str
    frequency: float
    amplitude: float


def separating(campaign: Campaign, one: Refit, other: Refit, accuracy: Accuracy) -> str | None:
    """Return, in words, the sine within what was measured that parts two fitted models most.

    None if no sine parts them by more than twice the noise, or if one of them cannot be run.
    """
    trials = list(_trials(campaign))
    tried = copy(campaign)
    tried.training, tried.testing = [_experiment(campaign, sine) for sine in trials], []
    try:
        joints = [JointFit(tried, campaign.network, f.parameters, f.effects, accuracy) for f in (one, other)]
        runs = [joint.seen(joint.start).train for joint in joints]
    except SimulationError:
        return None
    apart = [
        float(np.sqrt(np.mean(np.concatenate([a[name] - b[name] for name in a]) ** 2)))
        for a, b in zip(*runs, strict=True)
    ]
    if not apart or max(apart) < SEPARATING_MISFIT:
        return None
    best = trials[int(np.argmax(apart))]
    unit = campaign.measured[best.channel].si
    return (
        f"A sine of {best.amplitude:.3g} {unit} at {best.frequency:.3g} Hz on '{best.channel}': there "
        f"{one.effects[-1].label.replace('_', ' ')} and {other.effects[-1].label.replace('_', ' ')} part by "
        f"{max(apart):.2g} times the noise."
    )


def _trials(campaign: Campaign) -> Iterator[_Sine]:
    """Yield sines in the band of each input, no larger, faster or harder than what was measured."""
    for name, channel in campaign.measured.items():
        if not channel.driven:
            continue
        records = [e.record for e in campaign.training]
        low, high = _band(records, name)
        peaks = [max(_peak(record, name, order) for record in records) for order in range(3)]
        moving = channel.si in ("m", "rad")
        for frequency in np.geomspace(low, high, TRIAL_FREQUENCIES):
            omega = 2 * np.pi * frequency
            largest = min(p / omega**k for k, p in enumerate(peaks)) if moving else peaks[0]
            for share in TRIAL_AMPLITUDE_SHARES:
                yield _Sine(name, float(frequency), float(share * largest))


def _band(records: list[Record], channel: str) -> tuple[float, float]:
    """Return between which frequencies the middle nine tenths of the energy of an input lie."""
    begins, ends = [], []
    for record in records:
        power = np.abs(np.fft.rfft(record.values[channel] - record.values[channel].mean())) ** 2
        share = np.cumsum(power) / max(float(power.sum()), 1e-300)
        frequencies = np.fft.rfftfreq(len(record.time), 1 / record.rate)
        first, last = np.searchsorted(share, INPUT_BAND_ENERGY_SHARES)
        begins.append(float(frequencies[first]))
        ends.append(float(frequencies[min(int(last), len(frequencies) - 1)]))
    low = max(min(begins), 1 / TRIAL_SECONDS)
    return low, max(max(ends), 2 * low)


def _peak(record: Record, channel: str, order: int) -> float:
    values = record.values[channel] - np.median(record.values[channel])
    for _ in range(order):
        values = np.gradient(values, record.time)
    return float(np.quantile(np.abs(values), PEAK_QUANTILE))


def _experiment(campaign: Campaign, sine: _Sine) -> Experiment:
    time = np.arange(round(TRIAL_SECONDS * TRIAL_RATE_HZ) + 1) / TRIAL_RATE_HZ
    rise = np.clip(time / TRIAL_FADE_SECONDS, 0, 1)
    fade = rise**3 * (10 - 15 * rise + 6 * rise**2)
    values = {name: np.zeros(len(time)) for name in campaign.measured}
    for name, channel in campaign.measured.items():
        if channel.driven:
            values[name] += float(np.median(campaign.training[0].record.values[name]))
    values[sine.channel] += sine.amplitude * fade * np.sin(2 * np.pi * sine.frequency * time)
    every = round(TRIAL_RATE_HZ / COMPARISON_RATE_HZ)
    return Experiment(Record("trial", time, values), "trial", initial="rest", every=every)
