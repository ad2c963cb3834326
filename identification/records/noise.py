"""The noise floor of a channel: stated, from repeats, from its spectrum, or from what a fit leaves."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import inf, sqrt

import numpy as np

from ...base import Array
from .record import Record

NOISE_BAND = (0.6, 0.95)  # of the spectrum
LEAST_RANGE_SHARE = 1e-6
ROUNDING_SHARE = 1e-9  # of a range, up to which differences are none
EVENTFUL_RATIO = 1.5  # of what the quietest instants have, above which a signal has events; noise has 1
LEAST_QUIET_SHARE = 5e-5  # of a range, below which they are no noise, but a coarse sensor that stands still
QUIETEST = 0.25  # of the instants
FEWEST_INSTANTS = 200  # of which some are known to be quiet
MOST_UNLIKE = 3.0, 20.0  # that these have over the quieter half of them, and half of all over them; noise: 1
NORMAL_SCATTER = 1.4826  # standard deviations of a normal distribution in its median absolute deviation


STATED, REPEATS = "stated", "repeats"
SPECTRUM, SENSOR_STEPS, LEFT_BY_FIT = "spectrum", "steps of the sensor", "what a fit leaves"
QUIETEST_INSTANTS = "quietest instants"  # as impacts or steps make the rest
LEVEL_RATIO = 0.6  # of the density in the octave below, at which a spectrum does not fall
FEWEST_DENSITIES = 8  # of a spectrum that are looked at
PASSED_BAND = (0.3, 0.7)  # of what a filter has left
COMPARED_BAND = (0.2, 0.5)  # of what it passes of what a model foresees
FLAT_RATIO = 1.2  # of the density in that band, up to which there is no more elsewhere
WEAK_POWER_SHARE = 0.02  # of a signal's power that may lie, beyond what is missed, in the upper half of that
MEAN_POWER_SHARE = 0.02  # of what is missed that may lie in its mean
EVEN_DEVIATIONS = 2.0  # of the scatter that the power of noise has from stretch to stretch
STEADY_STRETCHES = 10  # of a record, of which the powers are compared
QUIET_RANGE_SHARE = 1e-5  # below which no sensor's noise lies: the top of the spectrum was filtered away
NORMAL_RATIO = 1.25  # of scatter over what it mostly is, up to which nothing strikes
STEEP_BANDS = (0.6, 0.7), (0.85, 0.95)  # of the spectrum, by which it is told how steeply it falls
STEEP_RATIO = 6.0  # of the density in the first; at 12 dB an octave there are 4
FILTERED_DENSITY_RATIO = 100.0  # of the density at the top, above which a channel passes what it measures


@dataclass(frozen=True)
class NoiseFloor:
    """Noise of a channel: its standard deviation in SI units, how it is known, and its band.

    Attributes:
        sigma: standard deviation of a sample.
        source: how it is known, in words.
        band: up to which a channel whose spectrum is empty above passes what it measures [Hz].
        passed: up to which it passes what a model foresees [Hz].
        cutoff: of the filter that rounds the steps which a model foresees [Hz].
    """

    sigma: float
    source: str
    band: float = inf
    passed: float = inf
    cutoff: float = inf

    @property
    def is_sure(self) -> bool:
        """Whether it does not rest on what a filter, and a model, have left."""
        return self.source != LEFT_BY_FIT

    @property
    def is_stated(self) -> bool:
        """Whether it was told, or measured by repeats, and rests on no spectrum."""
        return self.source in (STATED, REPEATS)

    @property
    def is_filtered(self) -> bool:
        """Whether it was read off where a filter has left nothing."""
        return self.band < inf and self.source in (SPECTRUM, SENSOR_STEPS)

    def share(self, rate: float) -> float:
        """Return the number of independent samples over that of samples taken at a rate [Hz]."""
        return min(1.0, 2 * self.band / rate)

    def white(self, rate: float) -> float:
        """Return the standard deviation of white noise of the density that this noise has in its band."""
        return self.sigma / float(np.sqrt(self.share(rate)))

    def behind(self, cutoff: float) -> NoiseFloor:
        """Return it behind a filter that rounds steps, above whose cut-off [Hz] next to none is left."""
        return replace(self, cutoff=cutoff, band=self.band if self.is_stated else min(self.band, cutoff))

    def to_dict(self) -> dict[str, float | str | None]:
        """Return it as plain values, as in JSON files; no band, where none is known."""
        return {"sigma": self.sigma, "source": self.source, "band": self.band if self.band < inf else None}


def spectral_floor(values: Array, rate: float | None = None) -> NoiseFloor:
    """Estimate white noise from the spectrum between 60 and 95 % of its top, where machines hardly move.

    Where the quietest instants have much less than that, steps and impacts of the signal make it, and what
    those instants have is taken. Not below what the steps of a digital sensor make. What lies far below any
    sensor's noise, or falls as no machine's answer does, was left by a filter: at a rate [Hz] that is given,
    the band is told that it has left.
    """
    density = density_of(values)
    level = _level(density, NOISE_BAND)
    quiet = _quiet_noise(values)
    eventful = level > EVENTFUL_RATIO * quiet
    sigma = quiet if eventful else level
    quantum = _quantum(values) / np.sqrt(12)
    span = float(np.ptp(values))
    source = SENSOR_STEPS if quantum > sigma else QUIETEST_INSTANTS if eventful else SPECTRUM
    floor = max(sigma, quantum, LEAST_RANGE_SHARE * span)
    passed = np.flatnonzero(density > FILTERED_DENSITY_RATIO * 2 * level**2)
    cut = floor <= QUIET_RANGE_SHARE * span or (source == SPECTRUM and _falls_steeply(density))
    if rate is None or not cut or not len(passed):
        return NoiseFloor(floor, source)
    return NoiseFloor(floor, source, 0.5 * rate * float(passed[-1] + 1) / (len(density) - 1))


def _falls_steeply(density: Array) -> bool:
    """Tell whether a spectrum falls up to its top as filters make it fall, not machines."""
    low, high = (_level(density, part) for part in STEEP_BANDS)
    return low**2 > STEEP_RATIO * high**2


def residual_floor(residual: Array, rate: float, floor: NoiseFloor) -> NoiseFloor:
    """Estimate the noise of a filtered channel from what a fit leaves in the upper part of its band."""
    density = density_of(residual)
    top = len(density) - 1
    last = last_level(density, round(floor.share(rate) * top))
    above = 0.5 * float(density[last + 1 :].sum()) / top
    power = _level_up_to(density, last) ** 2 * last / top + above
    return NoiseFloor(max(sqrt(power), floor.sigma), LEFT_BY_FIT, min(floor.band, 0.5 * rate * last / top))


def _level_up_to(density: Array, last: int) -> float:
    """Return the standard deviation of white noise of the density in the upper part of a band."""
    return _level(density, [edge * last / (len(density) - 1) for edge in PASSED_BAND])


def passed_floor(residual: Array, rate: float, passed: float, least: float) -> NoiseFloor:
    """Estimate the noise, `least` if not more, of a channel that passes what is below `passed` [Hz]."""
    share = min(1.0, 2 * passed / rate)
    level = _level(density_of(residual), [edge * share for edge in COMPARED_BAND])
    return NoiseFloor(max(level * sqrt(share), least), LEFT_BY_FIT, passed, passed)


def is_steady(values: Array, low: float, high: float) -> bool:
    """Tell whether what lies in a band, in shares of the spectrum, is as strong at all times."""
    fast = _banded(values, (low, min(high, NOISE_BAND[1])))
    steady = _is_even(fast, STEADY_STRETCHES, high - low)
    return steady and float(fast.std()) < NORMAL_RATIO * _usual_scatter(fast)


def _is_even(values: Array, stretches: int, share: float) -> bool:
    """Tell whether the power of noise, a share of whose samples is independent, is that in all stretches."""
    power = np.array([float(np.mean(part**2)) for part in np.array_split(values, stretches)])
    samples = share * len(values) / stretches
    return bool(power.std() <= EVEN_DEVIATIONS * np.sqrt(2 / samples) * power.mean())


def _usual_scatter(values: Array) -> float:
    """Return the standard deviation that most of the values have about 0."""
    return NORMAL_SCATTER * float(np.median(np.abs(values)))


def is_noise(residual: Array, signal: Array, rate: float, stretches: int, known: float = 0.0) -> bool:
    """Tell whether something is as strong at all frequencies that a filter may have left, and at all times.

    Its mean is small. If it is weak above a frequency, it must be strong where the signal is weak, too. If it
    is weak above none, it is as strong in the quietest instants: impacts are at all frequencies as well. A
    coarse sensor that stands still, or takes a step a sample, seems quieter than the noise that is known.

    Args:
        residual: what a model misses.
        signal: what was measured.
        rate: samples a second [Hz].
        stretches: of time, that are compared with each other.
        known: standard deviation of the noise that is known.
    """
    density = density_of(residual)
    last = last_level(density, len(density) - 1)
    share, level = last / (len(density) - 1), _level_up_to(density, last)
    end = round(share * len(density))
    moving = density_of(signal)
    told = np.maximum(moving - density, 0.0)[end // 2 :].sum()
    follows = end < len(density) and told > WEAK_POWER_SHARE * moving.sum()
    if follows or 0.5 * float(np.mean(density[1:end])) > FLAT_RATIO * level**2:
        return False
    if np.mean(residual) ** 2 > MEAN_POWER_SHARE * np.mean(residual**2):
        return False
    if share == 1 and level > EVENTFUL_RATIO * max(known, _quietest(residual)):
        return False
    return _is_even(residual, stretches, share)


def last_level(density: Array, last: int) -> int:
    """Return the last place, up to one that is given, above which a filter takes off more and more."""
    smooth = smoothed(density)
    level = (
        place
        for place in range(last, FEWEST_DENSITIES, -1)
        if smooth[place] >= LEVEL_RATIO * np.median(smooth[place // 2 : place])
    )
    return next(level, last)


def smoothed(density: Array) -> Array:
    """Return a density without single peaks."""
    from scipy.ndimage import median_filter

    return np.asarray(median_filter(density, 5), dtype=float)


def density_of(values: Array, length: int | None = None) -> Array:
    """Return the power density of values that are 1 s apart, from stretches of a length."""
    from scipy.signal import welch

    length = length or _stretch_length(values)
    return np.asarray(welch(np.asarray(values, dtype=np.float64), nperseg=length)[1], dtype=float)


def _stretch_length(values: Array) -> int:
    """Return how many samples a spectrum is computed from at a time."""
    return min(1024, max(16, len(values) // 8), len(values))


def _level(density: Array, band: Sequence[float]) -> float:
    """Return the standard deviation of white noise of the density in a band, in shares of the spectrum."""
    begin, end = (int(share * len(density)) for share in band)
    return float(np.sqrt(0.5 * np.median(density[begin : max(end, begin + 1)])))


def repeated_floor(record: Record, other: Record, channel: str) -> NoiseFloor:
    """Estimate noise from two runs under one excitation: their difference over the root of two."""
    count = min(len(record.time), len(other.time))
    difference = record.values[channel][:count] - other.values[channel][:count]
    least = LEAST_RANGE_SHARE * float(np.ptp(record.values[channel]))
    return NoiseFloor(max(float(difference.std() / np.sqrt(2)), least), REPEATS)


def _quietest(values: Array) -> float:
    """Return the standard deviation of white noise with the third differences of the quietest instants.

    Infinite for few instants.
    """
    return _by_instants(values)[1]


def _quiet_noise(values: Array) -> float:
    """Return that of the quietest instants; infinite where these are no noise.

    They are what interpolation has left between the steps of a sensor, if others have far more, or they have
    next to nothing. A sensor that is as quiet, on a machine that rattles, looks the same: state its noise.
    """
    quieter, quiet, half = _by_instants(values)
    like = quiet < MOST_UNLIKE[0] * quieter and half < MOST_UNLIKE[1] * quiet
    return quiet if like and quiet > LEAST_QUIET_SHARE * np.ptp(values) else inf


def _by_instants(values: Array) -> tuple[float, float, float]:
    """Return what third differences tell of the quieter of the quiet instants, of these, and of half of all.

    Each is the standard deviation of white noise that has as much there. Neighbours that were held or
    interpolated tell of no noise, and do not count.
    """
    from scipy.stats import halfnorm

    change = np.abs(np.diff(values, 3)) / np.sqrt(1 + 9 + 9 + 1)
    change = change[change > ROUNDING_SHARE * np.ptp(values)]
    if len(change) < FEWEST_INSTANTS:
        return inf, inf, inf
    shares = np.array([0.5 * QUIETEST, QUIETEST, 0.5])
    quieter, quiet, half = (np.quantile(change, shares) / halfnorm.ppf(shares)).tolist()
    return quieter, quiet, half


def _banded(values: Array, band: tuple[float, float]) -> Array:
    """Return what lies in a band, in shares of the spectrum, without what the ends of the record leave."""
    from scipy.signal import butter, sosfiltfilt

    fast = sosfiltfilt(butter(8, band, "bandpass", output="sos"), values, padlen=min(50, len(values) - 1))
    settled = len(fast) // 20
    return np.asarray(fast[settled : len(fast) - settled], dtype=float)


def _quantum(values: Array) -> float:
    """Return the step of a digital sensor, 0 if values are not on a grid."""
    levels = np.unique(values)
    if len(levels) < 2 or len(levels) > len(values) / 4:
        return 0.0
    step = float(np.median(np.diff(levels)))
    steps = np.diff(levels) / step
    return step if float(np.abs(steps - np.round(steps)).max()) < 0.05 else 0.0
