"""The noise that a filter has left, and the band that it passes: seen beside a model."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from math import inf

import numpy as np

from ...base import Array
from .heard import Heard, follows, is_too_much, lengths_of, mean_of
from .noise import (
    COMPARED_BAND,
    FEWEST_DENSITIES,
    LEAST_RANGE_SHARE,
    LEFT_BY_FIT,
    QUIETEST_INSTANTS,
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
from .uncovered_noise import uncovered_floors

UNSURE = SPECTRUM, SENSOR_STEPS, LEFT_BY_FIT  # that filters may have left
OVERTAKEN_RATIO = 2.0  # of what a model foresees over what was measured, from which on that was taken away
CUT_RATIO = 20.0  # the same in the upper half of what was taken away
OVERRATED_RATIO = 1.2  # of noise, or a band, over what shows, from which on it is corrected


def passed_band(records: Sequence[Heard]) -> float:
    """Return up to which frequency a channel passes what a model foresees [Hz], infinite if as far as told.

    Above, and all the way up, less was measured than the model foresees, and far less at the top: what
    friction makes has steps, and a filter has rounded them. A wrong gain takes away as much everywhere, and a
    model that misses what follows an input, or more than any sensor's noise, as a shaft gives, tells of no
    filter. If what is missed falls from within an octave below, the filter begins there; so it does at the
    cut-off that rounds the steps of the model, where that is known.

    Args:
        records: of one channel.
    """
    lengths = lengths_of(records)
    if not lengths:
        return inf
    foreseen = [density_of(record.measured - record.residual, length) for record, length in lengths.items()]
    measured = [density_of(record.measured, length) for record, length in lengths.items()]
    weights = [1 / (np.median(density) or inf) for density in foreseen]
    last = _taken_from(*(smoothed(mean_of(weights, spectra)) for spectra in (foreseen, measured)))
    if last is None:
        return inf
    missed = [density_of(record.residual, length) for record, length in lengths.items()]
    fallen = last_level(mean_of(weights, missed), last)
    last = fallen if 2 * fallen > last else last
    passed = min(min(record.rate * last / length, record.floor.cutoff) for record, length in lengths.items())
    powers = [passed_floor(r.residual, r.rate, passed, 0.0).white(r.rate) ** 2 for r in lengths]
    wrong = follows(lengths, slice(*(round(edge * last) for edge in COMPARED_BAND)))
    return inf if wrong or is_too_much(float(np.mean(powers)), lengths) else passed


def _taken_from(foreseen: Array, measured: Array) -> int | None:
    """Return from which place in a spectrum on far less was measured than foreseen; None if there is none."""
    told, seen = foreseen[:-1], measured[:-1]
    passes = np.flatnonzero(told <= OVERTAKEN_RATIO * seen)
    last, top = int(passes.max(initial=0)) + 1, len(told)
    if last < FEWEST_DENSITIES or top - last < FEWEST_DENSITIES:
        return None
    upper = slice(top - (top - last) // 2, top)
    return last if np.median(told[upper]) >= CUT_RATIO * np.median(seen[upper]) else None


def floors_beside(records: Sequence[Heard]) -> list[NoiseFloor]:
    """Return the noise of a channel in each record, as it shows beside a model.

    Args:
        records: of one channel.
    """
    passed = passed_band(records)
    return (uncovered_floors(records) if passed == inf else None) or filtered_floors(records, passed)


def filtered_floors(records: Sequence[Heard], passed: float = inf) -> list[NoiseFloor]:
    """Return the noise of a channel in each record: what a model leaves, where filters leave nothing fast.

    A filter that shows in one record is that of the channel: in others it may hide behind the steps of the
    sensor. What a poorer model has left gives way to what a better one leaves.

    Args:
        records: of one channel.
        passed: up to which it passes what a model foresees [Hz].
    """
    bands = [record.floor.band for record in records if _is_unsure(record.floor)]
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
    if not _is_unsure(floor) or band == inf:
        return floor
    if floor.source == LEFT_BY_FIT:
        steps = replace(spectral_floor(record.measured), band=band)
        left = residual_floor(record.residual, record.rate, steps)
        return left if _is_quieter(left, record) else floor
    return residual_floor(record.residual, record.rate, replace(floor, band=min(floor.band, band)))


def _is_unsure(floor: NoiseFloor) -> bool:
    """Tell whether a filter may have left it, as it has if it is known to have smoothed quiet instants."""
    return floor.source in UNSURE or (floor.source == QUIETEST_INSTANTS and floor.cutoff < inf)


def _is_quieter(left: NoiseFloor, record: Heard) -> bool:
    """Tell whether noise is less by far than was thought."""
    return OVERRATED_RATIO * left.white(record.rate) < record.floor.white(record.rate)
