"""`Envelope`: what an experiment may ask of an input, by the limits of a campaign or by its records."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf

import numpy as np

from ...base import Array
from ...identification import Campaign, Limit, Record
from .. import criteria


@dataclass(frozen=True)
class Envelope:
    """What an experiment may ask of an input, in SI units.

    Attributes:
        channel: the input.
        rest: where it rests.
        band: between which frequencies it may move [Hz].
        limit: its largest distance from rest, speed and acceleration.
    """

    channel: str
    rest: float
    band: tuple[float, float]
    limit: Limit

    def amplitude(self, frequency: float) -> float:
        """Return the largest amplitude of a sine at a frequency [Hz]."""
        omega = 2 * np.pi * frequency
        return float(min(peak / omega**k for k, peak in enumerate(self.limit.peaks)))

    def scaled(self, values: Array, rate: float) -> Array:
        """Return values about rest, at a rate [Hz], as large as they may be."""
        return values / max(self.limit.share(values, rate), 1e-300)


def envelopes(campaign: Campaign, lasting: float) -> list[Envelope]:
    """Return what may be asked of each input in an experiment of a length [s].

    An input that nothing limits, and nothing has moved, is left out.
    """
    records = [e.record for e in campaign.training]
    found = []
    for name in campaign.inputs:
        given = campaign.allowed.quantities.get(name)
        rest = rest_of(campaign, name)
        moved = any(np.ptp(record.values[name]) for record in records)
        if given is not None and (moved or given.band is not None):
            limit = given if min(given.peaks) < inf else _measured(campaign, name)
            band = given.band or band_of(records, name, lasting)
        elif given is None and moved:
            limit, band = _measured(campaign, name), band_of(records, name, lasting)
        else:
            continue
        found.append(Envelope(name, rest, band, limit))
    return found


def rest_of(campaign: Campaign, name: str) -> float:
    """Return where an input rests: at 0, or in the middle of what was measured if that is elsewhere."""
    if not campaign.training:
        return 0.0
    values = campaign.training[0].record.values[name]
    middle = float(np.median(values))
    return middle if abs(middle) > criteria.REST_SHARE * float(np.abs(values - middle).max()) else 0.0


def given_beside_inputs(campaign: Campaign) -> dict[str, Limit]:
    """Return the limits that are given of what is not driven."""
    given = campaign.allowed.quantities
    return {name: limit for name, limit in given.items() if name not in campaign.inputs}


def watched(campaign: Campaign) -> dict[str, Limit]:
    """Return the limits of what is not driven: as given; of other outputs, as far as was measured."""
    measured = {}
    if campaign.training:
        for name in campaign.outputs:
            peak = max(_peak(e.record, name, 0) for e in campaign.training)
            measured[name] = Limit(campaign.measured[name].path, (peak, inf, inf))
    return measured | given_beside_inputs(campaign)


def seconds(campaign: Campaign) -> float:
    """Return how long an experiment lasts: as limited, otherwise as the longest record that is fitted [s]."""
    if campaign.allowed.duration is not None:
        return campaign.allowed.duration
    return max(float(np.ptp(e.record.time)) for e in campaign.training)


def sampling_rate(campaign: Campaign) -> float:
    """Return at which rate an experiment is played: as limited, otherwise as what was measured [Hz]."""
    if campaign.allowed.rate is not None:
        return campaign.allowed.rate
    if campaign.training:
        return campaign.training[0].record.rate
    return criteria.TRIAL_RATE_HZ


def band_of(records: Sequence[Record], channel: str, lasting: float) -> tuple[float, float]:
    """Return between which frequencies the middle nine tenths of the energy of an input lie."""
    bands = []
    for record in records:
        power = np.abs(np.fft.rfft(record.values[channel] - record.values[channel].mean())) ** 2
        share = np.cumsum(power) / max(float(power.sum()), 1e-300)
        frequencies = np.fft.rfftfreq(len(record.time), 1 / record.rate)
        ends = np.searchsorted(share, criteria.INPUT_BAND_ENERGY_SHARES)
        bands.append(frequencies[np.minimum(ends, len(frequencies) - 1)])
    (low, _), (_, high) = np.min(bands, axis=0), np.max(bands, axis=0)
    low = max(float(low), 1 / lasting)
    return low, max(float(high), 2 * low)


def _measured(campaign: Campaign, name: str) -> Limit:
    """Return as a limit how far, how fast and how hard an input was measured to move; a force how far."""
    channel = campaign.measured[name]
    orders = range(3 if channel.si in ("m", "rad") else 1)
    peaks = [max(_peak(e.record, name, order) for e in campaign.training) for order in orders]
    return Limit(channel.path, (*peaks, *[inf] * (3 - len(peaks))))


def _peak(record: Record, channel: str, order: int) -> float:
    values = record.values[channel] - np.median(record.values[channel])
    for _ in range(order):
        values = np.gradient(values, record.time)
    return float(np.quantile(np.abs(values), criteria.PEAK_QUANTILE))
