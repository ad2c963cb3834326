"""A run beside its record, with what is known of the values that the record has of its own."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ...base import Array
from ...identification import Experiment, Prior
from ..criteria import BOUND_SCALE_TOLERANCE
from ..models.study import Predicted
from .record_start import nuisance_slopes, solved


def weighed(
    experiment: Experiment,
    found: Predicted,
    seen: Mapping[str, Array],
    own: Mapping[str, float],
    count: float = 1.0,
) -> tuple[Array, Array]:
    """Return the weighted residual of a run, and the slopes of its prediction in what nobody measured.

    Channels stand one below the other, then the priors of the record's own values. Slopes are zero of an own
    value that is held by a bound.

    Args:
        experiment: the record.
        found: the run.
        seen: its channels, as their sensors pass them on.
        own: with what values of its own it was run.
        count: of records that it stands for.
    """
    residual, priors = missed(experiment, seen, own, count), experiment.unknown
    slopes = count**0.5 * nuisance_slopes(experiment, found)
    if not priors:
        return residual, slopes
    at, weight = _own(priors, own, count)
    places = _places(experiment, slopes)
    slopes = np.vstack([slopes, np.zeros((len(at), slopes.shape[1]))])
    slopes[-len(at) :, places] = np.diag(weight)
    low, high = np.array([prior.range for prior in priors.values()]).T
    lowest, highest = at <= low + BOUND_SCALE_TOLERANCE, at >= high - BOUND_SCALE_TOLERANCE
    if (lowest | highest).any():
        step = solved(slopes, residual)[places]
        slopes[:, places] *= ~((lowest & (step < 0)) | (highest & (step > 0)))
    return residual, slopes


def missed(
    experiment: Experiment, seen: Mapping[str, Array], own: Mapping[str, float], count: float = 1.0
) -> Array:
    """Return the weighted residual alone; arguments and rows as above."""
    weights, measured = experiment.weights, experiment.compared.values
    rows = [count**0.5 * weights[n](measured[n] - seen[n]) for n in seen]
    at, weight = _own(experiment.unknown, own, count)
    return np.concatenate([*rows, -weight * at])


def _own(priors: Mapping[str, Prior], own: Mapping[str, float], count: float) -> tuple[Array, Array]:
    """Return how far own values are from what was assumed, and what that weighs, in units of their scales."""
    at = np.array([(own[name] - prior.center) / prior.scale for name, prior in priors.items()])
    return at, count**0.5 * np.array([prior.scale / prior.sd for prior in priors.values()])


def _places(experiment: Experiment, slopes: Array) -> slice:
    """Return which columns of `nuisance_slopes` are of own values."""
    end = slopes.shape[1] - len(experiment.offset)
    return slice(end - len(experiment.unknown), end)


def own_values(
    experiment: Experiment, own: Mapping[str, float], residual: Array, slopes: Array
) -> dict[str, float]:
    """Return which values of its own suit a record best, to first order beside a run; arguments as above."""
    steps = solved(slopes, residual)[_places(experiment, slopes)]
    moved = zip(experiment.unknown.items(), steps.tolist(), strict=True)
    return {name: prior.at((own[name] - prior.center) / prior.scale + step) for (name, prior), step in moved}
