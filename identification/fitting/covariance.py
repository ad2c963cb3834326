"""The covariance of what a fit has found: by the noise where residuals are white, else by the records.

Where residuals are not white, noise is coloured, or the machine does what the model does not: then the fit is
held against itself, by the jackknife over stretches of the records. That asks neither for one spectrum at all
times nor for channels that have nothing to do with each other.

Sources: G. M. Ljung, G. E. P. Box, Biometrika 65 (1978) 297-303; J. Shao, C. F. J. Wu, Annals of Statistics
17 (1989) 1176-1197; A. C. Cameron, D. L. Miller, Journal of Human Resources 50 (2015) 317-372, section VI.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...base import Array
from .problem import Optimum

STRETCHES = 6, 12  # least and most of all records together, each left out once
STRETCH_RATIO = 3.0  # of the length of a stretch to the time over which a residual goes on
GOES_ON = 4.0  # [standard errors of the autocorrelation of white noise] above which it does
LAGS, WHITE_CHANCE = 40, 0.01  # of the autocorrelation, and below which a residual is not white


@dataclass(frozen=True)
class Rows:
    """The residuals of a record: samples of each channel, one below the other, then others."""

    channels: int
    samples: int
    total: int


def covariance(optimum: Optimum, blocks: Sequence[Rows]) -> tuple[Array, float]:
    """Return the covariance of parameters and nuisances, and the degrees of freedom by which it is known.

    Args:
        optimum: where the fit ended.
        blocks: the records.
    """
    correlations = [_correlation(optimum.residual[rows]) for rows in _channels(blocks)]
    known = _known(optimum, blocks)
    if _are_white(correlations):
        return _by_noise(optimum, blocks) + known, np.inf
    found, freedom = _by_stretches(optimum, _stretches(blocks, _lasting(correlations)))
    return found + known, freedom


def _channels(blocks: Sequence[Rows]) -> Iterator[slice]:
    """Yield the rows of each channel of each record."""
    begin = 0
    for block in blocks:
        count = block.samples
        for number in range(block.channels):
            yield slice(begin + number * count, begin + (number + 1) * count)
        begin += block.total


def _correlation(residual: Array) -> tuple[Array, int]:
    """Return the autocorrelation of a channel, to a quarter of its length, and how many samples it has."""
    count = len(residual)
    power = np.abs(np.fft.rfft(residual, 2 * count)) ** 2
    return np.fft.irfft(power)[: count // 4 + 1] / max(float(residual @ residual), 1e-300), count


def _are_white(correlations: Sequence[tuple[Array, int]]) -> bool:
    """Tell whether no channel of any record has a residual that goes on from sample to sample."""
    from scipy.stats import chi2

    found, lags = 0.0, 0
    for correlation, count in correlations:
        first = correlation[1 : LAGS + 1]
        found += count * (count + 2) * float((first**2 / (count - 1.0 - np.arange(len(first)))).sum())
        lags += len(first)
    return not lags or bool(found < chi2.isf(WHITE_CHANCE, lags))


def _lasting(correlations: Sequence[tuple[Array, int]]) -> float:
    """Return over how many samples the residual goes on that does so the longest."""
    beyond = (np.flatnonzero(np.abs(c) > GOES_ON / np.sqrt(count)) for c, count in correlations)
    return max((float(lags[-1]) for lags in beyond if len(lags)), default=0.0)


def _by_noise(optimum: Optimum, blocks: Sequence[Rows]) -> Array:
    """Return the covariance by the variance of each channel in each record."""
    residual, slopes, inverse = optimum.residual, optimum.slopes, optimum.inverse
    scatter = np.zeros_like(inverse)
    for rows in _channels(blocks):
        scatter += float(np.mean(residual[rows] ** 2)) * (slopes[rows].T @ slopes[rows])
    return np.asarray(inverse @ scatter @ inverse)


def _by_stretches(optimum: Optimum, records: Iterable[list[NDArray[np.intp]]]) -> tuple[Array, float]:
    """Return the covariance by how the optimum moves, to first order, where a stretch is left out.

    Variances are larger where neighbours in a record move it the same way.
    """
    residual, slopes = optimum.residual, optimum.slopes
    information = slopes.T @ slopes
    total, beside, count = np.zeros_like(information), np.zeros(len(information)), 0
    for record in records:
        moved = []
        for rows in record:
            own = slopes[rows]
            moved.append(np.linalg.lstsq(information - own.T @ own, own.T @ residual[rows], rcond=1e-12)[0])
        each = np.array(moved)
        total += each.T @ each
        beside += 2 * (each[1:] * each[:-1]).sum(axis=0)
        count += len(each)
    alone = np.maximum(np.diag(total), 1e-300)
    larger = np.sqrt(1 + np.maximum(beside, 0.0) / alone)
    return (count - 1) / count * total * np.outer(larger, larger), count - 1.0


def _stretches(blocks: Sequence[Rows], lasting: float) -> Iterator[list[NDArray[np.intp]]]:
    """Yield by record the rows of its stretches, of all channels."""
    total, begin = sum(block.samples for block in blocks), 0
    least, most = STRETCHES
    number = min(max(total / (STRETCH_RATIO * max(lasting, 1.0)), least), most)
    for block in blocks:
        count = block.samples
        parts = max(round(number * count / total), -(-2 // len(blocks)))
        channels = begin + count * np.arange(block.channels)[:, None]
        yield [(channels + part).ravel() for part in np.array_split(np.arange(count), parts)]
        begin += block.total


def _known(optimum: Optimum, blocks: Sequence[Rows]) -> Array:
    """Return the covariance by priors, and by what joins pieces of a record."""
    others = np.ones(len(optimum.slopes), dtype=bool)
    for rows in _channels(blocks):
        others[rows] = False
    apart = optimum.slopes[others] @ optimum.inverse
    return np.asarray(apart.T @ apart)
