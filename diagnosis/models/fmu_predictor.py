"""Runs of an FMU on records: what it predicts, and what changes when a little else does."""

from __future__ import annotations

import re
import weakref
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from ...base import Array
from ...components import SimulationError
from ...fmu import FMUError, Load, Replay
from ...identification import Accuracy, Campaign, Experiment
from ...networks import sampled_at
from ..criteria import (
    FMU_PROBE_SHARE,
    FMU_RELATIVE_TOLERANCE,
    FMU_STEP_DEVIATIONS,
    FMU_STEP_ERROR_OVER_NOISE,
    FMU_STEPS_PER_SAMPLE,
    FMU_TRIAL_FORCE,
)
from ..effects.effect import Motion
from ..effects.hypothesis import Hypothesis
from ..effects.sites import Site
from .fmu_model import FMUModel
from .fmu_port import Acting, FMUPort, Reaction

ROUNDING_SHARE = 1e-6  # of the time between samples, by which a held one is asked for late


@dataclass(frozen=True, eq=False)
class FMUPrediction:
    """What a run shows: the output channels, and how the port moves, in SI units.

    Slopes of the channels, as of `Prediction`, take further runs once they are asked for.
    """

    stand: ReplayedStand
    time: Array
    values: dict[str, Array]
    given: Mapping[str, float]
    port: Motion | None

    @property
    def slopes(self) -> dict[str, Array]:
        """d(channel)/d(parameters)."""
        own = len(self.stand.experiment.unknown)
        return {name: moved[:, : moved.shape[1] - own] for name, moved in self._moved.items()}

    @property
    def own_slopes(self) -> dict[str, Array]:
        """d(channel)/d(parameters of which the record has an unknown value of its own)."""
        own = len(self.stand.experiment.unknown)
        return {name: moved[:, moved.shape[1] - own :] for name, moved in self._moved.items()}

    @property
    def start_slopes(self) -> dict[str, Array]:
        """d(channel)/d(states at the start): there are none."""
        return {name: np.zeros((len(self.time), 0)) for name in self.values}

    @cached_property
    def _moved(self) -> dict[str, Array]:
        return self.stand.differences(self.given, self.values)

    @property
    def reach(self) -> Array:
        """How far states get whose start is looked for: there are none."""
        return np.zeros(0)


class FMUPredictor:
    """An FMU with effects at its port; slopes in parameters, also of effects, are differences of runs."""

    def __init__(
        self, box: FMUModel, campaign: Campaign, effects: Sequence[Hypothesis], parameters: Sequence[str]
    ) -> None:
        self.box, self.channels = box, campaign.measured
        self.effects = [placed for placed in effects if placed.effect.basis is not None]
        priors, self.own = campaign.priors | campaign.per_record, list(campaign.per_record)
        scales = {name: prior.scale for name, prior in priors.items()}
        for placed in self.effects:
            scales |= dict(zip(placed.network_parameters, placed.scales.tolist(), strict=True))
        self.steps = {name: FMU_STEP_DEVIATIONS * scales[name] for name in [*parameters, *self.own]}
        self.highest = {name: prior.max for name, prior in priors.items()}
        self.driven = {c.path: box.wired(c.path) for c in self.channels.values() if c.driven}
        self.outputs = {name: box.wired(c.path) for name, c in self.channels.items() if not c.driven}
        self.taken = [variable for variable, _ in self.driven.values()]
        self.follows = _follows(box, self.taken)
        self.taken += self.follows
        read, port = [variable for variable, _ in self.outputs.values()], box.port
        if port is not None:
            read += port.units
            if port.takes_force and port.force not in self.taken:
                self.taken.append(port.force)
        self.read = list(dict.fromkeys(read))
        self.measures = {n: box.fmu.measure(box.fmu.variables[n]) for n in {*self.taken, *self.read}}
        self.place = {name: column for column, name in enumerate(self.taken)}
        held = [self.driven[c.path][0] for c in self.channels.values() if c.driven and c.held]
        self.replay = Replay(box.fmu, box.kind, self.taken, self.read, held)
        weakref.finalize(self, self.replay.close)
        self.refined = _refined(self, campaign)

    def stand(self, experiment: Experiment) -> ReplayedStand:
        """Return the FMU on a record."""
        return ReplayedStand(self, experiment, self.refined)

    def instants(self, found: Any) -> Array:
        """Return the instants of the record [s]."""
        time: Array = found.time
        return time

    def motion(self, found: Any, number: int, site: Site) -> Motion:
        """Return how the port moves."""
        assert isinstance(found.port, Motion)
        return found.port


def _follows(box: FMUModel, taken: Sequence[str]) -> dict[str, tuple[str, int]]:
    """Return inputs that are derivatives of others that are driven: name -> (of which, order)."""
    found = {}
    for name in box.fmu.inputs:
        match = re.fullmatch(r"der\((.+?)(?:,\s*(\d+))?\)", name)
        if match is not None and match[1] in taken and name not in taken:
            found[name] = match[1], int(match[2] or 1)
    port = box.port
    if port is not None and not port.takes_force and port.position in taken and port.velocity not in taken:
        found[port.velocity] = port.position, 1
    return found


def _refined(model: FMUPredictor, campaign: Campaign) -> int:
    """Return how many communication steps there must be between compared instants, effects included."""
    box = model.box
    if box.kind == "ME":
        return 1
    if box.refined and not model.effects:
        return box.refined
    first, start = campaign.training[0], campaign.start
    count = box.refined or FMU_STEPS_PER_SAMPLE[0]
    coarse = ReplayedStand(model, first, count).predicted(start)
    while count < FMU_STEPS_PER_SAMPLE[1]:
        fine = ReplayedStand(model, first, 2 * count).predicted(start)
        errors = {name: float((fine[name] - coarse[name]).std()) for name in fine}
        if all(error < FMU_STEP_ERROR_OVER_NOISE * first.sigma[name] for name, error in errors.items()):
            break
        count, coarse = 2 * count, fine
    if not model.effects:
        box.refined = count
    return count


class ReplayedStand:
    """An FMU on one record, whose states nobody knows."""

    state_names: Sequence[str] = ()

    def __init__(self, model: FMUPredictor, experiment: Experiment, refined: int) -> None:
        self.model, self.experiment, self.refined = model, experiment, refined
        record = experiment.record
        self.time = experiment.compared.time
        self.fine = np.linspace(self.time[0], self.time[-1], refined * (len(self.time) - 1) + 1)
        self.given = np.zeros((len(self.fine), len(model.taken)))
        for name, channel in model.channels.items():
            if channel.driven:
                signal = record.sampled(name, channel.interpolation, channel.delay)
                late = channel.held * ROUNDING_SHARE * (self.fine[1] - self.fine[0])
                smooth = sampled_at(signal, self.fine + late)
                variable, sign = model.driven[channel.path]
                self.given[:, model.place[variable]] = model.measures[variable].from_si(sign * smooth)
        self._follow(self.given)

    def _follow(self, given: Array) -> None:
        """Set the inputs that are derivatives of others."""
        from scipy.interpolate import CubicSpline

        model = self.model
        for name, (source, order) in model.follows.items():
            rates = CubicSpline(self.fine, given[:, model.place[source]])(self.fine, order)
            given[:, model.place[name]] = model.measures[source].factor / model.measures[name].factor * rates

    def rest(self, parameters: Mapping[str, float]) -> Array:
        """Return the states at the start: those of the FMU are its own."""
        return np.zeros(0)

    def run(
        self,
        parameters: Mapping[str, float],
        start: Array | None = None,
        accuracy: Accuracy | None = None,
    ) -> FMUPrediction:
        """Run the record; see `RecordModel.run`."""
        port = self.model.box.port
        table = self._table(parameters, self.given)
        motion = self._motion(port, table) if port is not None else None
        return FMUPrediction(self, self.time, self._channels(table), dict(parameters), motion)

    def differences(self, parameters: Mapping[str, float], values: Mapping[str, Array]) -> dict[str, Array]:
        """Return d(channel)/d(parameters, own ones) beside a run that gave `values`."""
        model = self.model
        columns = {name: [np.zeros((len(self.time), 0))] for name in values}
        shared = [name for name in model.steps if name not in model.own]
        for name in (*shared, *self.experiment.unknown):
            step = model.steps[name]
            step = step if parameters[name] + step <= model.highest.get(name, np.inf) else -step
            moved = self.predicted({**parameters, name: parameters[name] + step})
            for channel, column in columns.items():
                column.append(((moved[channel] - values[channel]) / step)[:, None])
        return {name: np.hstack(column) for name, column in columns.items()}

    def predicted(
        self, parameters: Mapping[str, float], given: Array | None = None, push: Array | float = 0.0
    ) -> dict[str, Array]:
        """Return the output channels; the arguments as below."""
        return self._channels(self._table(parameters, self.given if given is None else given, push))

    def _channels(self, table: Mapping[str, Array]) -> dict[str, Array]:
        return {name: sign * table[variable] for name, (variable, sign) in self.model.outputs.items()}

    def _motion(self, port: FMUPort, table: Mapping[str, Array]) -> Motion:
        v, force = table[port.velocity], port.sign * table[port.force]
        return Motion(self.time, table[port.position], v, force, np.gradient(v, self.time))

    def _table(
        self, parameters: Mapping[str, float], given: Array, push: Array | float = 0.0
    ) -> dict[str, Array]:
        """Return all that is read, in SI units, for inputs in the FMU's.

        At a port whose motion is given, `push` is a further force, as a spring's [N or N.m].
        """
        model, box = self.model, self.model.box
        effects = [_valued(placed, parameters) for placed in model.effects]
        port, acting = box.port, Acting(effects, self.experiment.began)
        load = None
        if port is not None and port.takes_force and acting.effects:
            load = Load(port.force, port.position, port.velocity, Reaction(acting, port, box.fmu))
        try:
            rows = model.replay.run(
                self.fine,
                given,
                box.own(self.experiment.given(parameters)),
                box.started,
                load,
                self.refined,
                FMU_RELATIVE_TOLERANCE,
            )
        except FMUError as error:
            raise SimulationError(str(error)) from error
        table: dict[str, Array] = {
            name: model.measures[name].to_si(rows[:, k]) for k, name in enumerate(model.read)
        }
        if port is not None and not port.takes_force:
            table[port.force] += port.sign * (acting.along(self._motion(port, table)) + push)
        return table

    def pushed(self, found: FMUPrediction, changes: Mapping[str, Array]) -> Array:
        """Return what small changes of an input, or of the force "push_0.u" at the port, change in outputs.

        Changes are columns at the record's instants. Communication steps are as long as the samples, here and
        in the run that it is compared to.
        """
        if self.refined > 1 and self.model.box.kind == "CS":
            return ReplayedStand(self.model, self.experiment, 1).pushed(found, changes)
        ((name, columns),) = changes.items()
        before, moved = self.predicted(found.given), list[Array]()
        size = self._size(name, found, columns, before)
        for column in columns.T:
            width = float(np.sqrt(np.mean(column**2)))
            scale = size / width if width else 1.0
            after = self._changed(found, name, scale * column) if width else before
            moved.append(np.column_stack([(after[n] - before[n]) / scale for n in before]))
        return np.stack(moved, axis=2)

    def adjoint(self, found: FMUPrediction, weights: Array, name: str) -> None:
        """Return None: what pushes would change is not known without making them."""

    def _size(self, name: str, found: FMUPrediction, columns: Array, before: Mapping[str, Array]) -> float:
        """Return by how much, root mean square, something is pushed: a little of what is there already.

        Where there is nothing, as at a port that is free, so much that outputs change a little.
        """
        if name in self.model.driven:
            variable, _ = self.model.driven[name]
            given = self.given[:, self.model.place[variable]]
            return FMU_PROBE_SHARE * self.model.measures[variable].factor * float(given.std())
        assert found.port is not None
        force = FMU_PROBE_SHARE * float(np.sqrt(np.mean(found.port.f**2)))
        if force:
            return force
        width = max(float(np.sqrt(np.mean(columns[:, 0] ** 2))), 1e-300)
        after = self._changed(found, name, FMU_TRIAL_FORCE * columns[:, 0] / width)
        size = max(float((after[n] - v).std()) / max(float(v.std()), 1e-300) for n, v in before.items())
        return FMU_TRIAL_FORCE * FMU_PROBE_SHARE / size if size else FMU_TRIAL_FORCE

    def _changed(self, found: FMUPrediction, name: str, change: Array) -> dict[str, Array]:
        model, port = self.model, self.model.box.port
        fine = np.interp(self.fine, self.time, change)
        if name in model.driven:
            name, sign = model.driven[name]
            fine = sign * fine
        else:
            assert port is not None
            if not port.takes_force:
                return self.predicted(found.given, push=change)
            name, fine = port.force, -port.sign * fine
        given = self.given.copy()
        given[:, model.place[name]] += fine / model.measures[name].factor
        self._follow(given)
        return self.predicted(found.given, given)


def _valued(placed: Hypothesis, parameters: Mapping[str, float]) -> Hypothesis:
    """Return an effect with the values that parameters have for it."""
    values = [parameters.get(f"{placed.name}.{q.name}", placed.values[q.name]) for q in placed.quantities]
    return placed.with_values(np.array(values))
