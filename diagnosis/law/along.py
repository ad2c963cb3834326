"""A record beside a run of the model with a force at a site, and the linear machine along it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from ...base import Array, Flags
from ...identification import Experiment, Prediction
from ..criteria import LOST_GAP_SHARE, LOST_LEAST, LOST_SAMPLES, LOST_SHARE, LOST_STANDARD_DEVIATIONS
from ..effects.effect import Motion
from ..effects.hypothesis import Hypothesis, sensed
from ..models.driven_stand import stand_on
from ..models.force import Force, push_of
from ..models.network_predictor import NetworkPredictor
from ..models.probes import motion_at
from ..models.study import Study
from ..search.record_run import RecordRun
from ..search.record_start import begun, nuisance_slopes, reach_of, ties_of
from .course import Course


@dataclass(frozen=True, eq=False)
class Begin:
    """Where a record begins: its states, None at rest, and the values that it has of its own."""

    start: Array | None
    own: Mapping[str, float]


class Bench:
    """A model, with effects in it, with a force at one of its sites, on the records of a study."""

    def __init__(self, study: Study, parameters: Sequence[str], effects: Sequence[Hypothesis] = ()) -> None:
        self.study, self.effects, self.names = study, tuple(effects), list(parameters)
        self.accuracy = study.accuracy_with(effects)
        self.sites = [site for site in study.sites if "across" in site.places]
        self.predictor = NetworkPredictor(study.campaign, effects, self.names, self.sites)
        self.scales = np.array([study.campaign.priors[name].scale for name in self.names])
        self.centers = np.array([study.campaign.priors[name].center for name in self.names])

    def away(self, given: Mapping[str, float]) -> Array:
        """Return how far parameters are from the centers of their priors, over the scales of these."""
        return np.asarray((np.array([given[name] for name in self.names]) - self.centers) / self.scales)

    def begin(self, experiment: Experiment, given: Mapping[str, float], known: Mapping[str, float]) -> Begin:
        """Return where a record seems to begin; states by name that are `known` to begin elsewhere, do."""
        own = {name: prior.center for name, prior in experiment.unknown.items()}
        if experiment.initial == "rest":
            return Begin(None, own)
        stand = stand_on(self.predictor.stand, experiment, self.effects)
        rest = stand.rest({**given, **own})
        pairs = zip(stand.state_names, rest.tolist(), strict=True)
        return Begin(np.array([known.get(name, value) for name, value in pairs]), own)

    def run(
        self,
        experiment: Experiment,
        given: Mapping[str, float],
        begin: Begin,
        number: int = 0,
        force: Force | None = None,
    ) -> Beside:
        """Run a record with a force at a site."""
        experiment = experiment.whole
        put = partial(self.predictor.stand, number=number, force=force)
        stand = stand_on(put, experiment, self.effects)
        found = stand.run({**given, **begin.own}, begin.start, self.accuracy)
        return Beside(self, experiment, given, begin, number, force, found)

    def nearest(self, experiment: Experiment, given: Mapping[str, float]) -> Beside:
        """Run a record from where it begins nearest to it."""
        experiment = experiment.whole
        stand = stand_on(self.predictor.stand, experiment, self.effects)

        def run_from(start: Array | None, own: Mapping[str, float]) -> RecordRun:
            values = {**given, **own}
            return RecordRun(experiment, self.effects, values, start, stand.run(values, start, self.accuracy))

        run, _ = begun(experiment, lambda: stand.rest(dict(given)), run_from)
        assert isinstance(run.found, Prediction)
        own = {name: run.given[name] for name in experiment.unknown}
        return Beside(self, experiment, given, Begin(run.start, own), 0, None, run.found)


@dataclass(frozen=True, eq=False)
class Beside:
    """A run of a record, with what it began and was computed with; what is missed counts `until` a sample."""

    bench: Bench
    experiment: Experiment
    given: Mapping[str, float]
    begin: Begin
    number: int
    force: Force | None
    found: Prediction
    until: int | None = None

    @property
    def t(self) -> Array:
        """The points of the run [s]."""
        return self.found.run.time

    def motion(self, number: int) -> Motion:
        """Return how a site moved."""
        moved = motion_at(self.found.run, number, self.bench.sites[number])
        return replace(moved, began=self.experiment.began)

    @property
    def residual(self) -> Array:
        """What was measured less what was predicted where it counts, in noise, (instants, outputs)."""
        elapsed, measured = self.experiment.elapsed(self.found.time), self.experiment.compared.values
        columns = [
            (measured[n] - sensed(elapsed, n, v, self.bench.effects)) * self.experiment.weights[n].alone
            for n, v in self.found.values.items()
        ]
        return np.column_stack(columns) * self._counts

    @property
    def left(self) -> Array:
        """The residual less offsets, (instants, outputs)."""
        residual, names = self.residual, list(self.found.values)
        counts = self._weights[:, :, 0] > 0
        for name in self.experiment.offset:
            at = counts[:, names.index(name)], names.index(name)
            if at[0].any():
                residual[at] -= residual[at].mean()
        return residual

    @property
    def squares(self) -> float:
        """The sum of their squares."""
        return float((self.left**2).sum())

    def followed(self, whole: Experiment, missed: Array | None = None) -> int:
        """Return the samples before it strays by a good part of what is seen in the record that it is of.

        Or by some of what another model has `missed` of each output, in units of noise.
        """
        moved = np.array(
            [whole.compared.values[name] * whole.weights[name].alone for name in self.found.values]
        )
        allowed = np.maximum(LOST_SHARE * moved.std(axis=1), LOST_STANDARD_DEVIATIONS)
        if missed is not None:
            allowed = np.minimum(allowed, np.maximum(LOST_GAP_SHARE * missed, LOST_LEAST))
        return samples_before(np.asarray((np.abs(self.left) > allowed).any(axis=1)))

    def answers(self, number: int, forces: Array) -> Array:
        """Return what forces at a site change, in units of noise.

        From (points, columns) to (instants, outputs, columns).
        """
        moved = self.bench.predictor.variations.pushed(self.found.run, {push_of(number): forces})
        return np.asarray(moved[self.found.at] * self._weights)

    @property
    def _weights(self) -> Array:
        """What samples count, (instants, outputs, 1)."""
        weights = np.column_stack([self.experiment.weights[name].alone for name in self.found.values])
        return (weights * self._counts)[:, :, None]

    @property
    def _counts(self) -> Array:
        """1 where what is missed counts, 0 elsewhere, (instants, 1)."""
        counts = np.zeros((len(self.found.time), 1))
        counts[: self.until] = 1.0
        return counts

    def columns(self, fixed: bool = False) -> tuple[Array, int, Array]:
        """Return the columns of a `Course` at the instants of the record, how many are shared, and priors.

        The first is what would be left without the force, with the parameters at the centers of their priors.
        Where parameters are `fixed`, none are shared. A state at the start that leaves no trace stays about
        as near to where it is as it gets in the run.
        """
        found, experiment, bench = self.found, self.experiment, self.bench
        names = list(found.values)
        shape = len(found.time), len(names)
        missed = self.residual
        shared = np.zeros((*shape, 0))
        if not fixed:
            shared = np.stack([found.slopes[n][:, : len(bench.names)] for n in names], axis=1)
            shared = shared * self._weights * bench.scales
            missed = missed + shared @ bench.away(self.given)
        free = nuisance_slopes(experiment, found)
        own = np.swapaxes(free.reshape(shape[1], shape[0], -1), 0, 1) * self._counts[:, :, None]
        weights = np.zeros(own.shape[2])
        if self.begin.start is not None:
            weights[: len(self.begin.start)] = ties_of(reach_of(experiment, found))
        if experiment.unknown:
            end = own.shape[2] - len(experiment.offset)
            place = slice(end - len(experiment.unknown), end)
            priors = experiment.unknown.items()
            weights[place] = [prior.scale / prior.sd for _, prior in priors]
            at = [(self.begin.own[name] - prior.center) / prior.scale for name, prior in priors]
            missed = missed + own[:, :, place] @ np.array(at)
        if self.force is not None:
            missed = missed + self.answers(self.number, self.force.at(self.t)[:, None])[:, :, 0]
        return np.concatenate([missed[:, :, None], shared, own], axis=2), shared.shape[2], weights

    def course(self, numbers: Sequence[int], fixed: bool = False) -> Course:
        """Return the machine along the run, for forces at some of the sites."""
        found, bench = self.found, self.bench
        line = bench.predictor.variations.forced(found.run, [push_of(n) for n in numbers])
        columns, shared, priors = self.columns(fixed)
        points = len(self.t)
        spread = np.zeros((points, *columns.shape[1:]))
        to_x, to_f = np.zeros_like(line.to_x), np.zeros_like(line.to_u)
        spread[found.at] = columns
        to_x[found.at] = line.to_x[found.at] * self._weights
        to_f[found.at] = line.to_u[found.at] * self._weights
        return Course(self.t, line.map, line.here, line.there, to_x, to_f, spread, shared, priors)

    def began(self, unknown: Array, shared: int) -> Begin:
        """Return where the record begins by what a smoother found of it."""
        own = unknown[shared:]
        first = len(self.begin.start) if self.begin.start is not None else 0
        start = None if self.begin.start is None else self.begin.start + own[:first]
        parts = zip(self.experiment.unknown.items(), own[first:].tolist(), strict=False)
        return Begin(start, {name: prior.at(part) for (name, prior), part in parts})


def samples_before(away: Flags) -> int:
    """Return the number of samples before a run is away for some of them in a row, not just a late impact."""
    later = len(away) - LOST_SAMPLES + 1
    lost = np.all([away[number : number + later] for number in range(LOST_SAMPLES)], axis=0)
    return int(lost.argmax()) if lost.any() else len(away)
