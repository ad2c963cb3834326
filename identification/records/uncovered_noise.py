"""Noise that filters let through, though the top of the spectrum tells of less: seen beside a model."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from ...base import Array
from .heard import Heard, follows, is_too_much, lengths_of, mean_of
from .noise import (
    FEWEST_DENSITIES,
    LEFT_BY_FIT,
    LEVEL_RATIO,
    SENSOR_STEPS,
    SPECTRUM,
    NoiseFloor,
    density_of,
    is_steady,
    smoothed,
)

UNKNOWN_SHARE = 0.95  # of the measured power from a frequency on, above which a model says nothing of it
LEAST_SPAN = 2.5  # times that frequency, up to where noise is level at least; a machine's answer falls
EVEN_RATIO = 6.0  # of the densities there, that noise keeps to though a filter has begun
STEADY_SHARE = 0.5  # of the records, in which it is as strong at all times
UNLIKE_RATIO = 2.0  # of powers between records, up to which they are alike
UNDERRATED_RATIO = 1.1  # of noise over what was thought, from which on that is corrected


def uncovered_floors(records: Sequence[Heard]) -> list[NoiseFloor] | None:
    """Return the noise of a channel in each record if filters let more through than was thought, else None.

    From some frequency on, in the mean spectrum of all records, a model says nothing of what was measured.
    Where that is level from there, or from a higher one, up to a multiple of it, and as strong at all times,
    it is noise: what a machine does on its own falls with frequency. It is taken to be as strong below, and
    above as strong as was measured. What follows an input is none: a random drive has an even and steady
    answer, too. Nor is what differs from record to record though their noise did not, as a machine's motion
    does, nor what no sensor would be kept with.

    Args:
        records: of one channel; too short ones, and those of which nothing is missed, have the noise of the
            others.
    """
    if any(record.floor.source not in (SPECTRUM, SENSOR_STEPS) for record in records):
        return None
    lengths = lengths_of(records)
    missed = {record: density_of(record.residual, length) for record, length in lengths.items()}
    band = _level_band(missed, [density_of(record.measured, length) for record, length in lengths.items()])
    if band is None or follows(lengths, band):
        return None
    shares = {
        record: [2 * place / length for place in (band.start, band.stop)]
        for record, length in lengths.items()
    }
    if np.mean([is_steady(record.residual, *share) for record, share in shares.items()]) < STEADY_SHARE:
        return None
    powers = {
        record: float(np.median(density[band]) * band.stop + density[band.stop + 1 :].sum()) / lengths[record]
        for record, density in missed.items()
    }
    if _are_alike([record.floor.sigma**2 for record in lengths]) and not _are_alike([*powers.values()]):
        return None
    mean = float(np.mean([*powers.values()]))
    if mean < UNDERRATED_RATIO**2 * np.mean([record.floor.sigma**2 for record in lengths]):
        return None
    if is_too_much(mean, lengths):
        return None
    sigmas = [max(powers.get(record, mean) ** 0.5, record.floor.sigma) for record in records]
    highest = float(np.mean([0.5 * record.rate * share[1] for record, share in shares.items()]))
    return [NoiseFloor(sigma, LEFT_BY_FIT, highest) for sigma in sigmas]


def _are_alike(powers: Sequence[float]) -> bool:
    return max(powers) <= UNLIKE_RATIO * min(powers)


def _level_band(missed: Mapping[Heard, Array], measured: Sequence[Array]) -> slice | None:
    """Return where in the spectrum a model says nothing and noise is level, None if nowhere far enough.

    Each record counts by what its densities mostly are.
    """
    if not missed:
        return None
    weights = [1 / (np.median(density) or np.inf) for density in missed.values()]
    left, whole = mean_of(weights, [*missed.values()]), mean_of(weights, measured)
    unknown = np.cumsum(left[::-1])[::-1] >= UNKNOWN_SHARE * np.cumsum(whole[::-1])[::-1]
    if not unknown.any():
        return None
    smooth, first = smoothed(left), max(1, int(np.argmax(unknown)))
    bands = (slice(begin, _falls(smooth, begin)) for begin in range(first, len(left)))
    return next((band for band in bands if _is_level(smooth, band)), None)


def _falls(smooth: Array, begin: int) -> int:
    """Return the first place in a spectrum, well after one, where it falls; its top if it does not."""
    top = len(smooth) - 1
    places = range(max(2 * begin, begin + FEWEST_DENSITIES), top + 1)
    before = ((place, smooth[max(begin, place // 2) : place]) for place in places)
    return next((place for place, level in before if smooth[place] < LEVEL_RATIO * np.median(level)), top)


def _is_level(smooth: Array, band: slice) -> bool:
    """Tell whether a spectrum is level over a band, and this is wide."""
    if band.stop < max(LEAST_SPAN * band.start, band.start + FEWEST_DENSITIES + 1):
        return False
    low, high = np.percentile(smooth[band], [5, 95])
    return bool(high <= EVEN_RATIO * low)
