"""How well a fit knows its parameters: standard errors, correlations, and what cannot be told apart."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from ...base import Array
from ..campaign.priors import Prior
from .problem import Optimum
from .residual_block import ResidualBlock

UNTOLD_SHARE = 0.7  # of a prior's standard deviation, above which records say next to nothing
TIED_CORRELATION = 0.95
BOUND_TOLERANCE = 1e-6
STRETCHES = 6, 12  # least and most of all records together, each left out once
STRETCH_RATIO = 3.0  # of the length of a stretch to the time over which a residual goes on
GOES_ON = 4.0  # [standard errors of the autocorrelation of white noise] above which it does
LAGS, WHITE_CHANCE = 40, 0.01  # of the autocorrelation, and below which a residual is not white


@dataclass(frozen=True, eq=False)
class Uncertainty:
    """Standard errors and correlations of fitted parameters, and warnings in words.

    `own` are standard errors of the values that each record has of its own.

    Where residuals are white, the covariance is H^-1 G H^-1, with H the information and G its scatter by the
    variance of each channel. Where they are not, noise is coloured, or the machine does what the model does
    not: then the fit is held against itself. The covariance is that of the jackknife over STRETCHES of the
    records, as long as what residuals do goes on, and of neighbours that move the fit the same way. It asks
    neither for one spectrum at all times nor for channels that have nothing to do with each other. `freedom`
    is one less than the number of stretches, otherwise infinite.

    Sources: G. M. Ljung, G. E. P. Box, Biometrika 65 (1978) 297-303; J. Shao, C. F. J. Wu, Annals of
    Statistics 17 (1989) 1176-1197; A. C. Cameron, D. L. Miller, Journal of Human Resources 50 (2015) 317-372,
    section VI.
    """

    errors: dict[str, float]
    correlation: Array
    warnings: list[str]
    own: list[dict[str, float]]
    freedom: float


def uncertainty(optimum: Optimum, blocks: list[ResidualBlock], priors: Mapping[str, Prior]) -> Uncertainty:
    """Return what is known of the parameters at an optimum."""
    count = len(priors)
    information = optimum.slopes.T @ optimum.slopes
    inverse: Array = np.asarray(np.linalg.pinv(information, rcond=1e-14, hermitian=True), dtype=float)
    are_white = _are_white(_correlations(optimum.residual, blocks))
    covariance, freedom = (_plain if are_white else _jackknife)(optimum, blocks, inverse)
    sd, white = (np.sqrt(np.maximum(np.diag(known), 0.0)) for known in (covariance, inverse))
    own, told = _own(optimum, blocks, sd, white)
    covariance, sd = covariance[:count, :count], sd[:count]
    safe = np.where(sd > 0, sd, 1.0)
    correlation = covariance / np.outer(safe, safe)
    np.fill_diagonal(correlation, 1.0)
    errors = dict(zip(priors, (sd * optimum.scales).tolist(), strict=True))
    each = zip(priors, optimum.values.values(), priors.values(), white[:count] * optimum.scales, strict=True)
    warnings = [line for one in each for line in _untold(*one)]
    return Uncertainty(errors, correlation, [*warnings, *told, *_tied(errors, correlation)], own, freedom)


def _own(
    optimum: Optimum, blocks: Sequence[ResidualBlock], sd: Array, white: Array
) -> tuple[list[dict[str, float]], list[str]]:
    """Return standard errors of the values that records have of their own, and what is not told of them."""
    begin, errors, told = len(optimum.scales), list[dict[str, float]](), list[str]()
    for block, nuisances in zip(blocks, optimum.nuisances, strict=True):
        places = range(begin, begin + len(nuisances))[block.own]
        errors.append({})
        for (name, value), place in zip(block.own_values(nuisances).items(), places, strict=True):
            prior = block.unknown[name]
            errors[-1][name] = float(sd[place]) * prior.scale
            told += _untold(f"{name} of {block.record.name}", value, prior, float(white[place]) * prior.scale)
        begin += len(nuisances)
    return errors, told


def _are_white(correlations: Sequence[tuple[Array, int]]) -> bool:
    """Tell whether no channel of any record has a residual that goes on from sample to sample."""
    from scipy.stats import chi2

    found, lags = 0.0, 0
    for correlation, count in correlations:
        first = correlation[1 : LAGS + 1]
        found += count * (count + 2) * float((first**2 / (count - 1.0 - np.arange(len(first)))).sum())
        lags += len(first)
    return not lags or bool(found < chi2.isf(WHITE_CHANCE, lags))


def _correlations(residual: Array, blocks: Sequence[ResidualBlock]) -> list[tuple[Array, int]]:
    """Return the autocorrelation of each channel in each record, to a quarter of it, and how many samples."""
    found, begin = list[tuple[Array, int]](), 0
    for block in blocks:
        count = len(block.record.time)
        for first in range(begin, begin + len(block.channels) * count, count):
            channel = residual[first : first + count]
            power = np.abs(np.fft.rfft(channel, 2 * count)) ** 2
            found.append(
                (np.fft.irfft(power)[: count // 4 + 1] / max(float(channel @ channel), 1e-300), count)
            )
        begin += block.rows
    return found


def _plain(optimum: Optimum, blocks: Sequence[ResidualBlock], inverse: Array) -> tuple[Array, float]:
    """Return the covariance by the variance of each channel in each record."""
    residual, slopes = optimum.residual, optimum.slopes
    scatter, begin = np.zeros_like(inverse), 0
    for block in blocks:
        count = len(block.record.time)
        for first in range(begin, begin + len(block.channels) * count, count):
            rows = slice(first, first + count)
            scatter += float(np.mean(residual[rows] ** 2)) * (slopes[rows].T @ slopes[rows])
        begin += block.rows
    scatter += _known(slopes, blocks)
    return inverse @ scatter @ inverse, np.inf


def _jackknife(optimum: Optimum, blocks: Sequence[ResidualBlock], inverse: Array) -> tuple[Array, float]:
    """Return the covariance by how the optimum moves, to first order, where a stretch is left out.

    Variances are larger where neighbours move it the same way.
    """
    residual, slopes = optimum.residual, optimum.slopes
    information = slopes.T @ slopes
    total, beside, count = np.zeros_like(inverse), np.zeros(len(inverse)), 0
    for record in _stretches(residual, blocks):
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
    covariance = (count - 1) / count * total * np.outer(larger, larger)
    return covariance + inverse @ _known(slopes, blocks) @ inverse, count - 1.0


def _known(slopes: Array, blocks: Sequence[ResidualBlock]) -> Array:
    """Return the scatter of the scores of priors, and of what joins pieces of a record."""
    total, begin = np.zeros((slopes.shape[1], slopes.shape[1])), 0
    for block in blocks:
        joints = slopes[begin + len(block.channels) * len(block.record.time) : begin + block.rows]
        total += joints.T @ joints
        begin += block.rows
    return total + slopes[begin:].T @ slopes[begin:]


def _stretches(residual: Array, blocks: Sequence[ResidualBlock]) -> Iterator[list[NDArray[np.intp]]]:
    """Yield by record the rows of its stretches, of all channels."""
    lasting = 0.0
    for correlation, count in _correlations(residual, blocks):
        beyond = np.flatnonzero(np.abs(correlation) > GOES_ON / np.sqrt(count))
        lasting = max(lasting, float(beyond[-1]) if len(beyond) else 0.0)
    total, begin = sum(len(block.record.time) for block in blocks), 0
    least, most = STRETCHES
    number = min(max(total / (STRETCH_RATIO * max(lasting, 1.0)), least), most)
    for block in blocks:
        count = len(block.record.time)
        parts = max(round(number * count / total), -(-2 // len(blocks)))
        channels = begin + count * np.arange(len(block.channels))[:, None]
        yield [(channels + part).ravel() for part in np.array_split(np.arange(count), parts)]
        begin += block.rows


def _tied(errors: Mapping[str, float], correlation: Array) -> Iterator[str]:
    """Yield pairs of parameters that the records hardly tell apart."""
    for (j, first), (i, second) in combinations(enumerate(errors), 2):
        if abs(correlation[i, j]) > TIED_CORRELATION and errors[second] > 0:
            how = "together" if correlation[i, j] > 0 else "against each other"
            yield (
                f"{first} and {second} move {how} (correlation {correlation[i, j]:.3f}): the records know a "
                "combination of them better than each"
            )


def _untold(name: str, value: float, prior: Prior, own: float) -> Iterator[str]:
    """Yield what records do not tell of a parameter; `own` is its standard error if residuals were white."""
    width = prior.max - prior.min
    if np.isfinite(prior.sd):
        if own > UNTOLD_SHARE * prior.sd:
            led = f"it went from {prior.center:.4g} to {value:.4g} all the same, which means nothing"
            if abs(value - prior.center) <= prior.sd:
                led = f"it stays near the {prior.center:.4g} that was assumed"
            yield (
                f"{name}: the records say next to nothing about it; {led}. Measure a motion in which it "
                "matters, or leave it out of the fit"
            )
    elif np.isfinite(width) and own > 0.25 * width:
        yield f"{name}: the records cannot tell it between {prior.min:.4g} and {prior.max:.4g}"
    elif own > abs(value) > 0:
        yield f"{name}: the records do not tell {value:.4g} from 0; it is known to within {own:.2g}"
    for side in (prior.min, prior.max):
        if np.isfinite(side) and abs(value - side) <= BOUND_TOLERANCE * max(prior.scale, abs(side)):
            yield f"{name}: ends at its bound {side:.6g}; the model lacks something or the bound is wrong"
