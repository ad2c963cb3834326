"""Refit: uncertain parameters and effects fitted together to the training records."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import chain
from math import inf

import numpy as np

from ...base import Array, computing
from ...components import SimulationError
from ...identification import Ending, Experiment, Iterate, descent
from .. import criteria
from ..effects.hypothesis import Hypothesis, inserted
from ..effects.shaping import Bounds, Shapes
from ..models.driven_stand import stand_on
from ..models.study import Standing, Study
from .model_comparison import Refit, stretches
from .own_values import own_values
from .record_run import RecordRun
from .record_start import apart, begun, projected

FitStart = tuple[Mapping[str, float], Mapping[str, float]]
DESCENT = Ending(
    criteria.DESCENT_RELATIVE_DROP,
    criteria.DESCENT_CHI_SQUARED_DROP,
    criteria.DESCENT_LEAST_RADIUS,
    criteria.DESCENT_STEPS,
    reach=criteria.DESCENT_REACH,
)


@dataclass(frozen=True, eq=False)
class _Begin:
    """How far a record begins from where it seems to, and how that slopes, as they were last looked for."""

    moved: Array
    slopes: Array


@dataclass(frozen=True, eq=False)
class _Way:
    """A descent after its first step: how far it has come, how it goes on, where its records begin."""

    here: Iterate
    further: Iterator[Iterate]
    bounds: Bounds
    begins: Mapping[int, _Begin]


class JointFit:
    """Parameters and effects, with values to start from, as one vector in units of what they may be.

    Its records are first thought to begin where those of a model do that is `near`.
    """

    def __init__(
        self,
        study: Study,
        parameters: Mapping[str, float],
        effects: Sequence[Hypothesis] = (),
        near: Refit | None = None,
    ) -> None:
        study = study.displaced(effects)
        self.study, self.campaign, self.accuracy = study, study.campaign, study.accuracy_with(effects)
        self.effects, self.names = tuple(effects), list(parameters)
        priors = [self.campaign.priors[name] for name in self.names]
        self.center = np.array([prior.center for prior in priors])
        self.scale = np.array([prior.scale for prior in priors])
        self.limits = np.array([prior.min for prior in priors]), np.array([prior.max for prior in priors])
        self.pull = np.isfinite([prior.sd for prior in priors]).astype(float)
        self.sizes = [placed.scales for placed in self.effects]
        low, high = ((limit - self.center) / self.scale for limit in self.limits)
        least = [
            quantity.low / size
            for placed, sizes in zip(self.effects, self.sizes, strict=True)
            for quantity, size in zip(placed.quantities, sizes, strict=True)
        ]
        bounds = np.array([*low, *least]), np.array([*high, *[inf] * len(least)])
        self.shapes = Shapes(bounds, self.effects, self.sizes)
        self.start = self.vector(parameters, [placed.values for placed in self.effects])
        paths = [path for placed in self.effects for path in placed.network_parameters]
        self.predictor = study.predictor(effects, [*self.names, *paths])
        self.is_driven = any(placed.effect.drives for placed in self.effects)
        known = () if self.is_driven else self.campaign.experiments
        self.stands = {id(e): self.predictor.stand(e) for e in known}
        self.begins: dict[int, _Begin] = {}  # by record, unless all of it is known
        self.starts = {} if near is None else near.starts_of(self.campaign.experiments)
        self.own: dict[int, dict[str, float]] = {}  # by record, the values that it has of its own
        self._last: dict[int, tuple[object, RecordRun]] = {}  # by record, and from where
        self._sloped: tuple[Array, list[Array]] = self.start[:0], []  # the last, and its residuals

    def vector(self, parameters: Mapping[str, float], values: Sequence[Mapping[str, float]]) -> Array:
        """Return parameters and values of the effects as a vector."""
        own = (np.array([parameters[name] for name in self.names]) - self.center) / self.scale
        placed = zip(self.effects, self.sizes, values, strict=True)
        return np.concatenate([own, *([v[q.name] for q in p.quantities] / s for p, s, v in placed)])

    def unpacked(self, vector: Array) -> tuple[dict[str, float], tuple[Hypothesis, ...]]:
        """Return parameters and effects of a vector."""
        count = len(self.names)
        values = np.clip(self.center + vector[:count] * self.scale, *self.limits)
        own = np.split(vector[count:], np.cumsum([len(size) for size in self.sizes])[:-1])
        placed = zip(self.effects, own, self.sizes, strict=False)
        effects = tuple(effect.with_values(part * size) for effect, part, size in placed)
        return dict(zip(self.names, values.tolist(), strict=True)), effects

    def fitted(self, starts: Sequence[FitStart] = (), known: float = inf) -> Refit:
        """Return the model fitted to the training records, and held against the test records.

        Args:
            starts: parameters, and values of the last effect, to start from; a step is taken from each, and
                the one that comes out best is followed. The values that were given if there are none.
            known: cost of the best model that is known; what cannot come there in `DESCENT.reach` steps is
                left.
        """
        earlier = [placed.values for placed in self.effects[:-1]]
        begins = [self.vector(parameters, [*earlier, values]) for parameters, values in starts]
        way = self._best_begun(begins or [self.start], known)
        vector, cost = way.here.vector, way.here.cost
        for _ in range(1 + criteria.SHAPED_DESCENTS):
            for end in chain([way.here], way.further):
                vector, cost = end.vector, end.cost
                if self.study.late():
                    break
            if self.study.late() or not self.shapes.are_held(vector, way.bounds):
                break
            way = self._stepped(vector, known)
        far = cost > criteria.FAR_COST_RATIO * known
        return self.seen(vector, criteria.TRIED_START_DROP_RATIO if far else criteria.START_DROP_RATIO)

    def _best_begun(self, starts: Sequence[Array], known: float) -> _Way:
        """Return the descent that comes out best after a step, of those that can be run."""
        ways, told = list[_Way](), list[SimulationError]()
        for start in starts:
            try:
                ways.append(self._stepped(start, known))
            except SimulationError as error:
                told.append(error)
        if not ways:
            raise told[0]
        best = min(ways, key=lambda way: way.here.cost)
        self.begins = dict(best.begins)
        return best

    def _stepped(self, start: Array, known: float) -> _Way:
        """Return a descent from a start, after its first step."""
        bounds = self.shapes.bounds(start)
        further = descent(self.stacked, start, bounds, replace(DESCENT, known=known), learnt=True)
        next(further)
        return _Way(next(further), further, bounds, dict(self.begins))

    def seen(self, vector: Array, drop: float = criteria.START_DROP_RATIO) -> Refit:
        """Return the model with the values of a vector, held against all records; `drop` as for `begun`."""
        fitted, placed = self.unpacked(vector)
        at, train = self._sloped
        if not np.array_equal(at, vector) or self.own:
            train = [self.linearise(vector, e, False, drop)[0] for e in self.campaign.training]
        left = [*train, *(self.linearise(vector, e, False, drop)[0] for e in self.campaign.testing)]
        count, experiments = len(train), self.campaign.experiments
        cost = sum(float(r @ r) for r in train)
        found = list(map(self._by_channel, experiments, left))
        known = self.campaign.per_record
        own = [{n: v for n, v in self.own.get(id(e), {}).items() if n in known} for e in experiments]
        starts = [self.starts.get(id(e), {}) for e in experiments]
        prior = self.pull * vector[: len(self.names)]
        judged = self.study.judged
        independent = sum(experiment.independent for experiment in judged)
        cost += float(prior @ prior)
        blocks = stretches(judged)
        return Refit(fitted, placed, found[:count], found[count:], cost, blocks, independent, starts, own)

    def missed(self, parameters: Mapping[str, float], values: Mapping[str, float]) -> float:
        """Return the cost with values of the last effect; infinite if the model cannot be run so."""
        vector = self.vector(parameters, [*(placed.values for placed in self.effects[:-1]), values])
        try:
            left, _ = self.stacked(vector, False)
        except SimulationError:
            return inf
        return float(left @ left)

    def run_on(self, experiment: Experiment) -> RecordRun:
        """Return the run of a record with the values to start from, and from where it is thought to begin.

        Values of the record's own, and where it begins beside these, are looked for.
        """
        return self._run(self.start, experiment, criteria.START_DROP_RATIO if experiment.unknown else None)

    def predicted(self, experiment: Experiment) -> dict[str, Array]:
        """Return what the start leaves of a record that is not of the fit: weighted residuals by channel.

        Raises:
            InertanceError: if the model cannot be run as the machine of the record was changed.
        """
        return self._by_channel(experiment, self.linearise(self.start, experiment, False)[0])

    @computing("a trial of the parameters")
    def stacked(self, vector: Array, slopes: bool) -> tuple[Array, Array | None]:
        """Return residuals of all training records and of the priors, and their slopes if wanted."""
        drop = criteria.TRIED_START_DROP_RATIO if slopes else None
        found = [self.linearise(vector, e, slopes, drop) for e in self.campaign.training]
        count = len(self.names)
        if slopes:
            self._sloped = vector.copy(), [residual for residual, _ in found]
        stacked = np.concatenate([*(residual for residual, _ in found), self.pull * vector[:count]])
        if not slopes:
            return stacked, None
        prior = np.eye(count, len(vector)) * self.pull[:, None]
        return stacked, np.concatenate([*(-columns for _, columns in found), prior])

    def linearise(
        self,
        vector: Array,
        experiment: Experiment,
        slopes: bool,
        drop: float | None = criteria.START_DROP_RATIO,
    ) -> tuple[Array, Array]:
        """Return the weighted residual of a record, and its slopes in the vector if they are wanted.

        Channels stand one below the other, then the priors of the record's own values. Where the record
        begins is looked for as `begun` does by `drop`; if that is None, it begins as it was last found to,
        which saves slopes of the start.
        """
        known = self.begins.get(id(experiment))
        begins_as_known = experiment.initial == "rest" or (drop is None and known is not None)
        run = self._run(vector, experiment, drop)
        if known is not None and not slopes and not experiment.unknown and begins_as_known:
            residual, nuisances = run.missed, known.slopes
        else:
            residual, nuisances = run.weighed
        if experiment.unknown:
            self.own[id(experiment)] = own_values(experiment, run.given, residual, nuisances)
        columns = self._slopes(run) if slopes else np.zeros((len(residual), 0))
        columns = np.pad(columns, [(0, len(residual) - len(columns)), (0, 0)])
        left = projected(np.column_stack([residual, columns]), nuisances)
        return left[:, 0], left[:, 1:]

    def _run(self, vector: Array, experiment: Experiment, drop: float | None) -> RecordRun:
        """Return the run of a record; arguments as of `linearise`."""
        parameters, effects = self.unpacked(vector)
        given = parameters | inserted(effects)
        stand = self._driven(experiment, effects)

        def run_from(start: Array | None, own: Mapping[str, float]) -> RecordRun:
            key = vector.tobytes(), None if start is None else start.tobytes(), tuple(own.items())
            last = self._last.get(id(experiment))
            if last is not None and last[0] == key:
                return last[1]
            values = {**given, **own}
            run = RecordRun(experiment, effects, values, start, stand.run(values, start, self.accuracy))
            self._last[id(experiment)] = key, run
            return run

        return self._begun(stand, run_from, experiment, given, drop)

    def _by_channel(self, experiment: Experiment, residual: Array) -> dict[str, Array]:
        """Return the residual of each channel, without the priors below them."""
        names, count = self.campaign.outputs, len(experiment.compared.time)
        return dict(zip(names, residual[: len(names) * count].reshape(len(names), count), strict=True))

    def _begun(
        self,
        stand: Standing,
        run_from: Callable[[Array | None, Mapping[str, float]], RecordRun],
        experiment: Experiment,
        given: Mapping[str, float],
        drop: float | None,
    ) -> RecordRun:
        """Return the run of a record from where it begins, looked for at first, then as `begun` is told."""

        def rest() -> Array:
            return stand.rest(given)

        known = self.begins.get(id(experiment))
        start = self.starts.get(id(experiment), {})
        guess = apart(stand, start, rest, len(experiment.unknown)) if known is None else known.moved
        drop = criteria.START_DROP_RATIO if known is None and not start else drop
        run, moved = begun(experiment, rest, run_from, guess, drop, anew=known is None and bool(start))
        if moved is not None and drop is not None:
            self.begins[id(experiment)] = _Begin(moved, run.weighed[1])
            if run.start is not None:
                self.starts[id(experiment)] = dict(zip(stand.state_names, run.start.tolist(), strict=True))
        return run

    def _driven(self, experiment: Experiment, effects: Sequence[Hypothesis]) -> Standing:
        """Return the stand of a record, its inputs as the actuators pass them on."""
        if self.is_driven:
            return stand_on(self.predictor.stand, experiment, effects)
        return self.stands.get(id(experiment)) or self.predictor.stand(experiment)

    def foreseen(self, experiment: Experiment, slopes: bool = True) -> tuple[RecordRun, Array]:
        """Return what is to be seen in a planned experiment, from rest, and how that slopes in the vector."""
        parameters, effects = self.unpacked(self.start)
        given = parameters | inserted(effects)
        found = self._driven(experiment, effects).run(given, None, self.accuracy)
        run = RecordRun(experiment, effects, given, None, found)
        return run, self._slopes(run) if slopes else np.zeros((0, len(self.start)))

    def _slopes(self, run: RecordRun) -> Array:
        """Return d(weighted prediction)/d(vector), channels one below the other."""
        rows = {name: run.slopes(name) for name in run.found.values}
        at = len(self.names)
        parts = {name: [row[:, :at] * self.scale] for name, row in rows.items()}
        for placed, size in zip(run.effects, self.sizes, strict=True):
            paths = len(placed.network_parameters)
            if placed.effect.step:
                moved = self._differences(run, placed, size)
            else:
                inner = placed.slopes(size) * size
                moved = {name: row[:, at : at + paths] @ inner for name, row in rows.items()}
            for name, columns in moved.items():
                parts[name].append(columns)
            at += paths
        return np.concatenate([run.experiment.weights[name](np.hstack(parts[name])) for name in rows])

    def _differences(self, run: RecordRun, placed: Hypothesis, size: Array) -> dict[str, Array]:
        """Return how each channel changes with an effect, per unit of its sizes, by differences."""
        base = run.seen
        values = np.array([placed.values[q.name] for q in placed.quantities])
        columns: dict[str, list[Array]] = {name: [] for name in base}
        for i, scale in enumerate(size):
            step = placed.effect.step * max(abs(values[i]), scale)
            other = placed.with_values(values + step * np.eye(len(values))[i])
            effects = tuple(other if p is placed else p for p in run.effects)
            given, found = {**run.given, **other.network_parameters}, run.found
            if placed.effect.drives or placed.effect.change is None:
                found = self._driven(run.experiment, effects).run(given, run.start, self.accuracy)
            for name, now in replace(run, effects=effects, found=found).seen.items():
                columns[name].append((now - base[name]) / step * scale)
        return {name: np.column_stack(moved) for name, moved in columns.items()}
