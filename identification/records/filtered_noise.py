"""The noise that a filter has left, and the band that it passes: seen beside a model."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from math import inf

import numpy as np

from .heard import Heard, lengths_of, mean_of
from .noise import (
    FEWEST_DENSITIES,
    LEAST_RANGE_SHARE,
    LEFT_BY_FIT,
    SENSOR_STEPS,
    SPECTRUM,
    NoiseFloor,
    density_of,
    last_level,
    passed_floor,
    residual_floor,
    smoothed,
    spectral_floor,
)

UNSURE = SPECTRUM, SENSOR_STEPS, LEFT_BY_FIT  # that filters may have left
OVERTAKEN_RATIO = 2.0  # of what a model foresees over what was measured, from which on that was taken away
CUT_RATIO = 20.0  # the same in the upper half of what was taken away
OVERRATED_RATIO = 1.2  # of noise, or a band, over what shows, from which on it is corrected


def passed_band(records: Sequence[Heard]) -> float:
    """Return up to which frequency a channel passes what a model foresees [Hz], infinite if as far as told.

    Above, and all the way up, less was measured than the model foresees, and far less at the top: what
    friction makes has steps, and a filter has rounded them. A wrong gain takes away as much everywhere. If
    what is missed falls from within an octave below, the filter begins there.

    Args:
        records: of one channel.
    """
    lengths = lengths_of(records)
    if not lengths:
        return inf
    foreseen = [density_of(record.measured - record.residual, length) for record, length in lengths.items()]
    measured = [density_of(record.measured, length) for record, length in lengths.items()]
    weights = [1 / (np.median(density) or inf) for density in foreseen]
    told, seen = (smoothed(mean_of(weights, spectra))[:-1] for spectra in (foreseen, measured))
    passes = np.flatnonzero(told <= OVERTAKEN_RATIO * seen)
    last, top = int(passes.max(initial=0)) + 1, len(told)
    if last < FEWEST_DENSITIES or top - last < FEWEST_DENSITIES:
        return inf
    upper = slice(top - (top - last) // 2, top)
    if np.median(told[upper]) < CUT_RATIO * np.median(seen[upper]):
        return inf
    missed = [density_of(record.residual, length) for record, length in lengths.items()]
    fallen = last_level(mean_of(weights, missed), last)
    return 0.5 * min(record.rate for record in lengths) * (fallen if 2 * fallen > last else last) / top


def filtered_floors(records: Sequence[Heard]) -> list[NoiseFloor]:
    """Return the noise of a channel in each record: what a model leaves, where filters leave nothing fast.

    A filter that shows in one record is that of the channel: in others it may hide behind the steps of the
    sensor. What a poorer model has left gives way to what a better one leaves.
    """
    passed = passed_band(records)
    bands = [record.floor.band for record in records if record.floor.source in UNSURE]
    band = max((band for band in bands if band < inf), default=inf)
    return [_filtered(record, band, passed) for record in records]


def _filtered(record: Heard, band: float, passed: float) -> NoiseFloor:
    floor = record.floor
    narrower = OVERRATED_RATIO * passed < floor.passed
    passed = passed if narrower else floor.passed
    if floor.is_stated:
        return replace(floor, passed=passed)
    if passed < inf:
        least = LEAST_RANGE_SHARE * float(np.ptp(record.measured)) or floor.sigma
        left = passed_floor(record.residual, record.rate, passed, least)
        return left if narrower or _is_quieter(left, record) else floor
    if floor.source not in UNSURE or band == inf:
        return floor
    if floor.source == LEFT_BY_FIT:
        steps = replace(spectral_floor(record.measured), band=band)
        left = residual_floor(record.residual, record.rate, steps)
        return left if _is_quieter(left, record) else floor
    return residual_floor(record.residual, record.rate, replace(floor, band=min(floor.band, band)))


def _is_quieter(left: NoiseFloor, record: Heard) -> bool:
    """Tell whether noise is less by far than was thought."""
    return OVERRATED_RATIO * left.white(record.rate) < record.floor.white(record.rate)
