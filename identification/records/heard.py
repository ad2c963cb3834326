"""`Heard`: a channel in a record beside a model, and spectra of several of them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ...base import Array
from .noise import NoiseFloor, density_of

AVERAGES = 32  # stretches of all records, of which a channel's spectrum is the mean
STRETCH_SAMPLES = (64, 1024)
MOST_SHARE = 0.15  # of what a channel moves, that is noise; what is more is a motion that the model lacks
FOLLOWING_SHARE = 0.3  # of the power of noise that may be linear in an input; by chance 0.04 to 0.1 is


@dataclass(frozen=True, eq=False)
class Heard:
    """A channel in a record: what a model misses, what was measured, what drove it, the noise so far.

    All of it was sampled at one rate [Hz].
    """

    residual: Array
    measured: Array
    drives: Sequence[Array]
    floor: NoiseFloor
    rate: float


def mean_of(weights: Sequence[float], spectra: Sequence[Array]) -> Array:
    """Return the weighted mean of spectra up to where the shortest ends."""
    end = min(len(spectrum) for spectrum in spectra)
    return np.average([spectrum[:end] for spectrum in spectra], axis=0, weights=weights)


def lengths_of(records: Sequence[Heard]) -> dict[Heard, int]:
    """Return from how many samples at a time spectra are computed, of equal frequencies in all records.

    Those that are too short, or of which nothing is missed, are left out.
    """
    records = [record for record in records if _is_heard(record)]
    if not records:
        return {}
    seconds = [len(record.residual) / record.rate for record in records]
    slowest = min(record.rate for record in records)
    wanted = float(np.clip(slowest * sum(seconds) / AVERAGES, *STRETCH_SAMPLES)) / slowest
    return {record: round(min(wanted, *seconds) * record.rate) for record in records}


def follows(lengths: Mapping[Heard, int], band: slice) -> bool:
    """Tell whether what is missed in a band is linear in an input, in all records alike: it is no noise."""
    from scipy.signal import csd

    power = np.sum([density_of(record.residual, length)[band] for record, length in lengths.items()])

    def share(drives: Sequence[Array]) -> float:
        pairs = [
            (r.residual, drive, length) for (r, length), drive in zip(lengths.items(), drives, strict=True)
        ]
        crossed = np.abs(np.sum([csd(x, y, nperseg=length)[1][band] for x, y, length in pairs], axis=0)) ** 2
        driving = np.sum([density_of(drive, length)[band] for _, drive, length in pairs], axis=0)
        return float(np.divide(crossed, driving, out=np.zeros_like(crossed), where=driving > 0).sum() / power)

    return any(share(drives) > FOLLOWING_SHARE for drives in zip(*(r.drives for r in lengths), strict=True))


def is_too_much(power: float, records: Iterable[Heard]) -> bool:
    """Tell whether no sensor with noise of a mean power would be kept: it is a motion that a model lacks."""
    return bool(power > MOST_SHARE**2 * np.mean([np.var(record.measured) for record in records]))


def _is_heard(record: Heard) -> bool:
    return len(record.residual) >= STRETCH_SAMPLES[0] and bool(np.ptp(record.residual))
