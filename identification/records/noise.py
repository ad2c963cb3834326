"""The noise floor of a channel: stated, from repeats, or from the top of its spectrum."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...base import Array
from .record import Record

NOISE_BAND = (0.6, 0.95)  # of the spectrum
LEAST_RANGE_SHARE = 1e-6


@dataclass(frozen=True)
class NoiseFloor:
    """Standard deviation of what is noise in a channel, as white noise, in SI units, and how it is known."""

    sigma: float
    source: str


def spectral_floor(values: Array) -> NoiseFloor:
    """Estimate white noise from the spectrum between 60 and 95 % of its top, where machines hardly move.

    Not below what the steps of a digital sensor make.
    """
    from scipy.signal import welch

    length = min(1024, max(16, len(values) // 8))
    density: Array = np.asarray(welch(np.asarray(values, dtype=np.float64), nperseg=length)[1], dtype=float)
    begin, end = (int(share * len(density)) for share in NOISE_BAND)
    sigma = float(np.sqrt(0.5 * np.median(density[begin:end])))
    quantum = _quantum(values) / np.sqrt(12)
    least = LEAST_RANGE_SHARE * float(np.ptp(values))
    return NoiseFloor(max(sigma, quantum, least), "steps of the sensor" if quantum > sigma else "spectrum")


def repeated_floor(record: Record, other: Record, channel: str) -> NoiseFloor:
    """Estimate noise from two runs under one excitation: their difference over the root of two."""
    count = min(len(record.time), len(other.time))
    difference = record.values[channel][:count] - other.values[channel][:count]
    least = LEAST_RANGE_SHARE * float(np.ptp(record.values[channel]))
    return NoiseFloor(max(float(difference.std() / np.sqrt(2)), least), "repeats")


def _quantum(values: Array) -> float:
    """Return the step of a digital sensor, 0 if values are not on a grid."""
    levels = np.unique(values)
    if len(levels) < 2 or len(levels) > len(values) / 4:
        return 0.0
    step = float(np.median(np.diff(levels)))
    steps = np.diff(levels) / step
    return step if float(np.abs(steps - np.round(steps)).max()) < 0.05 else 0.0
