"""How well a fit knows its parameters: standard errors, correlations, and what cannot be told apart."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from ...base import Array
from ..campaign.priors import Prior
from .covariance import Rows, covariance
from .problem import Optimum
from .residual_block import ResidualBlock

UNTOLD_SHARE = 0.7  # of a prior's standard deviation, above which records say next to nothing
TIED_CORRELATION = 0.95
BOUND_TOLERANCE = 1e-6


@dataclass(frozen=True, eq=False)
class Uncertainty:
    """Standard errors and correlations of fitted parameters, and warnings in words.

    `own` are standard errors of the values that each record has of its own.

    `freedom` is the number of degrees of freedom of the errors; see `covariance`.
    """

    errors: dict[str, float]
    correlation: Array
    warnings: list[str]
    own: list[dict[str, float]]
    freedom: float


def uncertainty(optimum: Optimum, blocks: list[ResidualBlock], priors: Mapping[str, Prior]) -> Uncertainty:
    """Return what is known of the parameters at an optimum."""
    count = len(priors)
    rows = [Rows(len(block.channels), len(block.record.time), block.rows) for block in blocks]
    scatter, freedom = covariance(optimum, rows)
    sd, white = (np.sqrt(np.maximum(np.diag(known), 0.0)) for known in (scatter, optimum.inverse))
    own, told = _own(optimum, blocks, sd, white)
    scatter, sd = scatter[:count, :count], sd[:count]
    safe = np.where(sd > 0, sd, 1.0)
    correlation = scatter / np.outer(safe, safe)
    np.fill_diagonal(correlation, 1.0)
    errors = dict(zip(priors, (sd * optimum.scales).tolist(), strict=True))
    each = zip(priors, optimum.values.values(), priors.values(), white[:count] * optimum.scales, strict=True)
    warnings = [line for one in each for line in _untold(*one)]
    return Uncertainty(errors, correlation, [*warnings, *told, *tied(errors, correlation)], own, freedom)


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


def tied(errors: Mapping[str, float], correlation: Array) -> Iterator[str]:
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
