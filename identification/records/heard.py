"""`Heard`: a channel in a record beside a model, and spectra of several of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...base import Array
from .noise import NoiseFloor

AVERAGES = 32  # stretches of all records, of which a channel's spectrum is the mean
STRETCH_SAMPLES = (64, 1024)


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


def _is_heard(record: Heard) -> bool:
    return len(record.residual) >= STRETCH_SAMPLES[0] and bool(np.ptp(record.residual))
