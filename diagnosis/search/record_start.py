"""Where a record begins, and with what values of its own: found by Gauss-Newton, as nobody measured it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cached_property
from typing import Protocol, TypeVar

import numpy as np

from ...base import Array
from ...components import SimulationError
from ...identification import Experiment
from ..criteria import (
    START_DROP_RATIO,
    START_HALVINGS,
    START_SINGULAR_VALUE_RATIO,
    START_STEPS,
    START_WON_SHARE,
)
from ..models.study import Predicted, Standing


class Weighed(Protocol):
    """A run beside its record.

    Attributes:
        missed: the weighted residual.
        weighed: the same, and the slopes of the prediction, the unknowns first, then those of offsets.
        reach: how far each state gets, as of `reach_of`.
        opening: the same run, of which only what comes soon after the start counts.
    """

    @cached_property
    def missed(self) -> Array: ...

    @cached_property
    def weighed(self) -> tuple[Array, Array]: ...

    @property
    def reach(self) -> Array: ...

    @property
    def opening(self) -> Weighed: ...


Run = TypeVar("Run", bound=Weighed)


def nuisance_slopes(experiment: Experiment, found: Predicted) -> Array:
    """Return d(weighted prediction)/d(states at the start, own values, offsets), channels below each other.

    Own values count in units of what they may be expected to be.
    """
    rows, weighed = list(found.values), experiment.weights
    free = (
        []
        if experiment.initial == "rest"
        else [np.concatenate([weighed[n](found.start_slopes[n]) for n in rows])]
    )
    if experiment.unknown:
        scales = np.array([prior.scale for prior in experiment.unknown.values()])
        free.append(np.concatenate([weighed[n](found.own_slopes[n]) for n in rows]) * scales)
    for channel in experiment.offset:
        lifted = [weighed[n](np.full((len(found.values[n]), 1), float(n == channel))) for n in rows]
        free.append(np.concatenate(lifted))
    return np.hstack([np.zeros((sum(len(found.values[n]) for n in rows), 0)), *free])


def parted(experiment: Experiment, unknown: Array) -> tuple[Array | None, dict[str, float]]:
    """Return the states at the start, None of a record at rest, and the record's own values.

    They stand in one vector, own values by how far they are from what was assumed as in `nuisance_slopes`.
    """
    first = len(unknown) - len(experiment.unknown)
    shares = zip(experiment.unknown.items(), unknown[first:].tolist(), strict=True)
    own = {name: prior.at(share) for (name, prior), share in shares}
    return None if experiment.initial == "rest" else unknown[:first], own


def projected(columns: Array, nuisances: Array) -> Array:
    """Take off what nuisances, as start values and offsets, can explain (variable projection)."""
    return np.asarray(columns - nuisances @ solved(nuisances, columns))


def begun(
    experiment: Experiment,
    rest: Callable[[], Array],
    run_from: Callable[[Array | None, Mapping[str, float]], Run],
    known: Array | None = None,
    drop: float | None = START_DROP_RATIO,
    anew: bool = False,
) -> tuple[Run, Array | None]:
    """Return the run of a record from its start with its own values, and how far both are from the guess.

    Args:
        experiment: the record, and whether it begins at rest.
        rest: returns the states at the start, as they seem to be.
        run_from: makes a run from states at the start, of a record at rest from None, with own values.
        known: how far a record of the same model was found to be from the guess.
        drop: share of the squared residual that another start must promise to be looked for; None if what is
            known shall do.
        anew: whether what is known is of a model that lacks an effect. What comes soon after the start then
            tells first where that is, as no small step may miss less of all of a record from where what
            slides first slides the other way. A model that is wrong tells little by it.
    """
    at_rest, count = experiment.initial == "rest", len(experiment.unknown)
    if at_rest and not count:
        return run_from(None, {}), None
    guess = np.concatenate([rest() if not at_rest else np.zeros(0), np.zeros(count)])
    begin = guess if known is None else guess + known
    if known is not None and drop is None:
        return run_from(*parted(experiment, begin)), known
    bounds = np.tile([[-np.inf], [np.inf]], len(guess))
    bounds[:, len(guess) - count :] = np.reshape([p.range for p in experiment.unknown.values()], (-1, 2)).T
    least, near = START_DROP_RATIO if drop is None else drop, None if at_rest else guess

    def run_at(begin: Array) -> Run:
        return run_from(*parted(experiment, begin))

    if anew:
        begin, _ = settled(begin, lambda at: run_at(at).opening, bounds, least, near)
    begin, run = settled(begin, run_at, bounds, least, near)
    return run, begin - guess


def apart(stand: Standing, start: Mapping[str, float], rest: Callable[[], Array], own: int) -> Array | None:
    """Return how far a record that begins at some states, by name, is from where it seems to begin.

    It has so many values of its `own`, which are as assumed; None if no states are known.
    """
    if not start:
        return None
    seeming = dict(zip(stand.state_names, rest().tolist(), strict=True))
    moved = [start.get(name, value) - value for name, value in seeming.items()]
    return np.array([*moved, *[0.0] * own])


def settled(
    begin: Array,
    run_from: Callable[[Array], Run],
    bounds: Array,
    drop: float = START_DROP_RATIO,
    near: Array | None = None,
) -> tuple[Array, Run]:
    """Return with which unknowns a run fits its record best, and that run: Gauss-Newton in them alone.

    A linear answer to them, as `projected` takes it, holds for small corrections only. Offsets, to which
    any answer is linear, are taken off throughout.

    Args:
        begin: states at the start and own values, as they seem to be.
        run_from: makes a run with such unknowns.
        bounds: least and largest unknowns.
        drop: share of the squared residual that a step must promise to be worth a run; one that wins next to
            nothing of it is the last.
        near: what they seem to be. A state that leaves no trace, as the stretch of a stop that springs back
            at once, stays about as near as it gets in a run: as if it were known to.
    """

    def lifted(run: Run) -> tuple[Array, Array]:
        residual, slopes = run.weighed
        found = projected(np.column_stack([residual, slopes[:, : len(begin)]]), slopes[:, len(begin) :])
        return found[:, 0], found[:, 1:]

    run, tie, guess = run_from(begin), np.zeros(len(begin)), begin
    if near is not None:
        guess, reach = near, run.reach
        tie[: len(reach)] = ties_of(reach)
    offsets = run.weighed[1][:, len(begin) :]
    residual, slopes = lifted(run)
    for _ in range(START_STEPS):
        missed, rows = np.append(residual, tie * (guess - begin)), np.vstack([slopes, np.diag(tie)])
        step, before = solved(rows, missed), float(missed @ missed)
        left = missed - rows @ (np.clip(begin + step, *bounds) - begin)
        if before <= (1 + drop) * float(left @ left):
            break
        won = 0.0
        for halving in range(START_HALVINGS):
            moved = np.clip(begin + step / 2**halving, *bounds)
            try:
                tried = run_from(moved)
                after = np.append(projected(tried.missed[:, None], offsets), tie * (guess - moved))
                if float(after @ after) >= before:
                    continue
                residual, slopes = lifted(tried)
            except SimulationError:
                continue
            begin, run, won = moved, tried, before - float(after @ after)
            break
        if won <= START_WON_SHARE * drop * before:
            break
    return begin, run


def reach_of(experiment: Experiment, found: Predicted) -> Array:
    """Return how far each state gets in a run, or would if that moved as much as was measured; 0 at rest."""
    moved = [
        np.sqrt(sum(float(np.sum(experiment.weights[n](y - y.mean()) ** 2)) for n, y in values.items()))
        for values in ({n: experiment.compared.values[n] for n in found.values}, found.values)
    ]
    return found.reach * max(1.0, moved[0] / moved[1]) if moved[1] > 0 else np.zeros_like(found.reach)


def ties_of(reach: Array) -> Array:
    """Return weights that hold states about as near as they get in a run; 0 for those that stay at rest."""
    return np.divide(1.0, reach, out=np.zeros_like(reach), where=reach > 0)


def solved(slopes: Array, residual: Array) -> Array:
    """Return the shortest step of unknowns that suits a weighted residual best."""
    if not (np.isfinite(slopes).all() and np.isfinite(residual).all()):
        raise SimulationError("where the record begins leaves no trace in a run that grows beyond bounds")
    found = np.linalg.lstsq(slopes, residual, rcond=START_SINGULAR_VALUE_RATIO)[0]
    return np.asarray(found, dtype=float)
