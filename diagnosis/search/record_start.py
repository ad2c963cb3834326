"""Where a record begins: states at its first instant and offsets of channels, which nobody measured."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TypeVar

import numpy as np

from ...base import Array
from ...components import SimulationError
from ...identification import Experiment
from ..criteria import START_DROP_RATIO, START_HALVINGS, START_SINGULAR_VALUE_RATIO, START_STEPS
from ..models.study import Predicted

Run = TypeVar("Run")


def nuisance_slopes(experiment: Experiment, found: Predicted, sigma: Mapping[str, float]) -> Array:
    """Return d(weighted prediction)/d(states at the start, offsets), channels one below the other."""
    rows = {name: len(values) for name, values in found.values.items()}
    free = (
        []
        if experiment.initial == "rest"
        else [np.concatenate([found.start_slopes[n] / sigma[n] for n in rows])]
    )
    for channel in experiment.offset:
        if channel in rows:
            lifted = [np.full(count, (n == channel) / sigma[n]) for n, count in rows.items()]
            free.append(np.concatenate(lifted)[:, None])
    return np.hstack([np.zeros((sum(rows.values()), 0)), *free])


def projected(columns: Array, nuisances: Array) -> Array:
    """Take off what start values and offsets can explain (variable projection)."""
    return np.asarray(columns - nuisances @ _solved(nuisances, columns))


def begun(
    experiment: Experiment,
    rest: Callable[[], Array],
    run_from: Callable[[Array | None], Run],
    weighed: Callable[[Run], tuple[Array, Array]],
    known: Array | None = None,
) -> tuple[Run, Array | None]:
    """Return the run of a record from where it begins, and how far that is from where it seems to.

    Args:
        experiment: the record, and whether it begins at rest.
        rest: returns the states at the start, as they seem to be.
        run_from: makes a run from states at the start, of a record at rest from None.
        weighed: as of `settled`.
        known: how far a record of the same model was found to begin from where it seemed to.
    """
    if experiment.initial == "rest":
        return run_from(None), None
    seeming = rest()
    begin, run = settled(seeming if known is None else seeming + known, run_from, weighed)
    return run, begin - seeming


def settled(
    begin: Array, run_from: Callable[[Array], Run], weighed: Callable[[Run], tuple[Array, Array]]
) -> tuple[Array, Run]:
    """Return the start from which a run fits its record best, and that run: Gauss-Newton in the start alone.

    A linear answer to the start, as `projected` takes it, holds for small corrections only.

    Args:
        begin: states at the start, as they seem to be.
        run_from: makes a run from a start.
        weighed: returns of a run its weighted residual and the slopes of its prediction, the start first.
    """
    run = run_from(begin)
    residual, slopes = weighed(run)
    for _ in range(START_STEPS):
        step = _solved(slopes, residual)
        left, before = residual - slopes @ step, float(residual @ residual)
        if before <= (1 + START_DROP_RATIO) * float(left @ left):
            break
        for halving in range(START_HALVINGS):
            moved = begin + step[: len(begin)] / 2**halving
            try:
                tried = run_from(moved)
            except SimulationError:
                continue
            missed, rates = weighed(tried)
            if float(missed @ missed) < before:
                break
        else:
            break
        begin, run, residual, slopes = moved, tried, missed, rates
    return begin, run


def _solved(slopes: Array, residual: Array) -> Array:
    if not (np.isfinite(slopes).all() and np.isfinite(residual).all()):
        raise SimulationError("where the record begins leaves no trace in a run that grows beyond bounds")
    found = np.linalg.lstsq(slopes, residual, rcond=START_SINGULAR_VALUE_RATIO)[0]
    return np.asarray(found, dtype=float)
