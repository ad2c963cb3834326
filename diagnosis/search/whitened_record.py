"""A record as the nominal model sees it: residual, slopes, and the answer to small changes anywhere."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

from ...base import Array
from ...identification import Experiment
from ..criteria import DEPENDENT_EIGENVALUE_RATIO, START_SINGULAR_VALUE_RATIO
from ..effects.effect import Effect, Motion, Values
from ..effects.hypothesis import Hypothesis, acted
from ..effects.sites import Site
from ..models.driven_stand import stand_on
from ..models.force import Force, push_of
from ..models.network_predictor import NetworkPredictor
from ..models.study import Predictor, Study
from .record_run import RecordRun
from .record_start import apart, begun


@dataclass(frozen=True, eq=False)
class Forced:
    """A run of a record with a force at a site that makes up for what is missing there.

    Attributes:
        site: path of the site.
        force: over time.
        start: states at the start by name; none at rest.
        own: the record's own values.
    """

    site: str
    force: Force
    start: Mapping[str, float]
    own: Mapping[str, float]


class WhitenedRecord:
    """One record beside a prediction, whitened (in units of noise), less what nobody measured explains.

    It may stand for a `count` of records like it, and is thought to begin near `start`. The prediction may be
    `forced` at a site, by its number, so that the machine moves as it was measured; the residual is that
    without the force, along this motion.
    """

    def __init__(
        self,
        study: Study,
        predictor: Predictor,
        experiment: Experiment,
        parameters: Mapping[str, float],
        effects: Sequence[Hypothesis],
        count: float = 1.0,
        forced: tuple[int, Forced] | None = None,
        start: Mapping[str, float] | None = None,
    ) -> None:
        channels = study.campaign.measured.items()
        self.outputs = {name: c.path for name, c in channels if not c.driven}
        self.inputs = {name: c.path for name, c in channels if c.driven}
        self._channels = study.campaign.measured
        self.weights, self._count = experiment.weights, count
        self._predictor, self._experiment = predictor, experiment
        if forced is None:
            self._stand: Any = stand_on(predictor.stand, experiment, effects)
        else:
            assert isinstance(predictor, NetworkPredictor)
            put = partial(predictor.stand, number=forced[0], force=forced[1].force)
            self._stand = stand_on(put, experiment, effects)
        self.measured = experiment.compared
        accuracy = study.accuracy_with(effects)

        def run_from(start: Array | None, own: Mapping[str, float]) -> RecordRun:
            given = {**parameters, **own}
            found = self._stand.run(given, start, accuracy)
            return RecordRun(experiment, tuple(effects), given, start, found, count)

        def rest() -> Array:
            start: Array = self._stand.rest(parameters)
            return start

        if forced is None:
            run, _ = begun(
                experiment, rest, run_from, apart(self._stand, start or {}, rest, len(experiment.unknown))
            )
        else:
            run = run_from(self._begin(forced[1], experiment, rest), forced[1].own)
        self._found = found = run.found
        self.time = predictor.instants(found)  # at which changes of inputs are to be given [s]
        self.predicted = run.seen
        missed, free = run.weighed
        self._basis = _orthonormal(free)
        self.residual = self.off(missed)
        self.slopes = self.off(self._weighed(found.slopes))
        if forced is not None:
            number, force = forced[0], forced[1].force
            self.residual += self.to_inputs({push_of(number): force.at(self.time)[:, None]})[:, 0]

    def _begin(self, forced: Forced, experiment: Experiment, rest: Callable[[], Array]) -> Array | None:
        """Return where a run with a force begins."""
        if experiment.initial == "rest":
            return None
        pairs = zip(self._stand.state_names, rest().tolist(), strict=True)
        return np.array([forced.start.get(name, value) for name, value in pairs])

    def passed_on(self, effect: Effect, signal: Array, values: Values) -> Array:
        """Return a channel at the instants of the record as a sensor or an actuator passes it on."""
        assert effect.change is not None
        elapsed = self._experiment.elapsed(self.measured.time)
        if effect.drives:
            return acted(effect, self._experiment, elapsed, signal, values)
        return effect.change(elapsed, signal, values)

    def motion(self, number: int, site: Site) -> Motion:
        """Return how one of the predictor's sites moves."""
        return replace(self._predictor.motion(self._found, number, site), began=self._experiment.began)

    def off(self, columns: Array) -> Array:
        """Take off what start, own values and offsets can explain; priors of own values are further rows.

        Of what they explain wholly nothing is left, instead of what rounding leaves.
        """
        columns = np.pad(columns, [(0, len(self._basis) - len(columns)), *[(0, 0)] * (columns.ndim - 1)])
        left: Array = columns - self._basis @ (self._basis.T @ columns)
        own = (left**2).sum(axis=0) > DEPENDENT_EIGENVALUE_RATIO * (columns**2).sum(axis=0)
        return np.asarray(left * own)

    def to_inputs(self, changes: Mapping[str, Array]) -> Array:
        """Return what changes of inputs, given at the instants `time`, change in the outputs."""
        moved = self._stand.pushed(self._found, changes)
        return self.off(self._weighed({name: moved[:, n] for n, name in enumerate(self.outputs)}))

    def explained(self, residual: Array, name: str) -> Array | None:
        """Return how much of a residual a unit of an input at each of the instants `time` would explain.

        It is the product of the residual with what `to_inputs` gives; None where that is known by runs only.
        """
        missed = self.off(residual)[: len(self.outputs) * len(self.measured.time)]
        parts = np.split(missed, len(self.outputs))
        pairs = zip(self.outputs, parts, strict=True)
        weights = [self._count**0.5 * self.weights[output].back(part) for output, part in pairs]
        found: Array | None = self._stand.adjoint(self._found, np.column_stack(weights), name)
        return found

    def acting(self, channel: str, changes: Array) -> Array:
        """Return changes of an input channel, columns at instants of the record, at the instants `time`."""
        driving = self._channels[channel]
        begin = self.measured.time + driving.delay
        if not driving.held:
            return np.column_stack([np.interp(self.time, begin, change) for change in changes.T])
        return changes[np.maximum(np.searchsorted(begin, self.time, side="right") - 1, 0)]

    def to_output(self, channel: str, changes: Array) -> Array:
        """Return changes of one output channel, columns at the instants of the record, in all outputs."""
        nothing = np.zeros_like(changes)
        return self.off(self._weighed({n: changes if n == channel else nothing for n in self.outputs}))

    def _weighed(self, columns: Mapping[str, Array]) -> Array:
        """Return changes of the outputs in units of noise, one below the other."""
        weighed = np.concatenate([self.weights[n](columns[n]) for n in self.outputs])
        return np.asarray(self._count**0.5 * weighed)


def _orthonormal(columns: Array) -> Array:
    if not columns.shape[1]:
        return columns
    left, strength, _ = np.linalg.svd(columns / np.maximum(np.linalg.norm(columns, axis=0), 1e-300), False)
    kept: Array = left[:, strength > START_SINGULAR_VALUE_RATIO * strength.max()]
    return kept
