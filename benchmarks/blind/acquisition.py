"""How signals become a record: zero-phase anti-alias filter, clock jitter, 1 kHz, noise, quantisation."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from excitations import DURATION, RATE
from scipy.signal import firwin, upfirdn
from stepper import Array

SAMPLING = 1000
FACTOR = RATE // SAMPLING
JITTER = 1e-7
BITS = 16
TAPS = firwin(321, 400.0, fs=RATE, window=("kaiser", 7.0))


@dataclass(frozen=True)
class Instrument:
    """Noise [rms] and resolution of each column."""

    noise: Array
    resolution: Array


def decimated(fine: Array, jitter: Array | None = None) -> Array:
    """Return columns at 1 kHz: filtered without delay, taken at instants that jitter [s]."""
    count = round(DURATION * SAMPLING) + 1
    sampled = np.column_stack([filtered(column, TAPS, count) for column in fine.T])
    if jitter is None:
        return sampled
    slopes = np.column_stack([filtered(column, np.gradient(TAPS) * RATE, count) for column in fine.T])
    return sampled + jitter[:, None] * slopes


def record(fine: Array, instrument: Instrument, rng: np.random.Generator) -> Array:
    """Return what the data logger writes."""
    jitter = rng.normal(0, JITTER, round(DURATION * SAMPLING) + 1)
    sampled = decimated(fine, jitter)
    sampled = sampled + instrument.noise * rng.normal(size=sampled.shape)
    return instrument.resolution * np.round(sampled / instrument.resolution)


def filtered(column: Array, taps: Array, count: int) -> Array:
    half = len(taps) // 2
    padded = np.concatenate([np.full(half, column[0]), column, np.full(half, column[-1])])
    whole = upfirdn(taps, padded, down=FACTOR)
    first = (len(taps) - 1) // FACTOR
    return whole[first : first + count]
