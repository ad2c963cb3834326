"""`CampaignModel`: a network run on the records of a campaign, with the slopes of what it predicts."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from math import inf
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from ...base import Array
from ...components import ModelError, Sampled, SimulationError
from ...networks import (
    ATOL,
    DAE,
    RTOL,
    Network,
    Result,
    Variations,
    dae_of,
    foresee,
    simulate,
    states_at_start,
)
from ..campaign.experiment import Experiment
from ..records.noise import spectral_floor
from ..records.record import Channel
from .steps import Steps

MOST_STEPS = 5000  # of the integrator for a sample: a model that takes more is far faster than its record
START_SAMPLES = 20  # through which, at first, a parabola tells how a record begins
FEWEST_START_SAMPLES = 5
PARABOLA_MISFIT = 1.5  # [noise] up to which a record follows a parabola
Values = Mapping[str, float]  # of parameters, or standard deviations of channels, by name


@dataclass(frozen=True)
class Accuracy:
    """How runs are computed.

    Attributes:
        solver: as for `simulate`.
        rtol, atol: tolerances.
        steps: most steps a sample, 5000 if None.
        foreseen: samples to which all runs of a model come, by which "auto" chooses.
    """

    solver: str = "auto"
    rtol: float = RTOL
    atol: float = ATOL
    steps: int | None = None
    foreseen: int = 0


@dataclass(frozen=True, eq=False)
class Prediction:
    """What a network predicts for one stretch of a record; slopes are computed once they are asked for.

    Attributes:
        time: instants of the record [s].
        at: the points of the run at these instants.
        values: output channels at these instants, steps rounded where a filter is known, SI units.
        run: the whole run, with its events and every other signal.
        stand: the network on the record.
        begins_anywhere: whether the states at the start were given, and do not follow from parameters.
    """

    time: Array
    at: NDArray[np.intp]
    values: dict[str, Array]
    run: Result = field(repr=False)
    stand: RecordModel = field(repr=False)
    begins_anywhere: bool

    @property
    def start(self) -> Array:
        """The states at the first instant."""
        return np.asarray(self.run.points.x[0])

    @property
    def end(self) -> Array:
        """The states at the last instant."""
        return np.asarray(self.run.points.x[-1])

    @cached_property
    def steps(self) -> Steps:
        """Where the channels jump, as no logger's filter shows it."""
        before = np.flatnonzero(np.diff(self.run.time) == 0)
        sides = (self.stand.variations.values(self.run, before + n) for n in (0, 1))
        sizes = dict(zip(self.stand.outputs, np.subtract(*reversed([*sides])).T, strict=False))
        return Steps(self.time, self.run.time[before], np.searchsorted(self.at, before + 1), sizes)

    @property
    def slopes(self) -> dict[str, Array]:
        """d(channel)/d(parameters), (instants, parameters)."""
        return self._part(0)

    @property
    def own_slopes(self) -> dict[str, Array]:
        """d(channel)/d(parameters of which the record has an unknown value of its own), as above."""
        return self._part(1)

    @property
    def start_slopes(self) -> dict[str, Array]:
        """d(channel)/d(states at the start), (instants, states)."""
        return self._part(2)

    @property
    def end_slopes(self) -> Array:
        """d(states at the end)/d(parameters, own ones, states at the start)."""
        return self._moved[1]

    def _part(self, number: int) -> dict[str, Array]:
        shared, own = self.stand.shared, len(self.stand.own)
        columns = (slice(shared), slice(shared, shared + own), slice(shared + own, None))[number]
        return {name: self._moved[0][:, n, columns] for n, name in enumerate(self.values)}

    @cached_property
    def _moved(self) -> tuple[Array, Array]:
        """Slopes of channels at the instants, and of states at the end: shared, own, states at the start."""
        variations, outputs = self.stand.variations, len(self.values)
        began = None if self.begins_anywhere else variations.start_slopes(self.run, {})
        moved, count = variations.along(self.run, began), len(variations.parameters)
        kept = [*range(self.stand.shared), *self.stand.own, *range(count, moved.shape[2])]
        return moved[self.at[:, None, None], np.arange(outputs)[:, None], kept], moved[-1, outputs:][:, kept]

    @property
    def reach(self) -> Array:
        """How far from zero each state gets, once what springs back at once has done so."""
        begun = len(self.run.points.x) // 100 + 1
        return np.asarray(np.abs(self.run.points.x[begun:]).max(axis=0, initial=0.0))


class RecordModel:
    """A network on one record: its own equations with the record's inputs, compiled once.

    Of the parameters of `variations`, the last may be `own`: those of which records have values of their own.
    Inputs may have signals that were not recorded, by their paths.
    """

    def __init__(
        self,
        dae: DAE,
        experiment: Experiment,
        channels: Mapping[str, Channel],
        variations: Variations,
        own: Sequence[str] = (),
        signals: Mapping[str, Sampled] = MappingProxyType({}),
    ) -> None:
        self.dae, self.variations = replace(dae, bindings={}), variations
        self.experiment, self.record = experiment, experiment.compared
        self.outputs = {name: c.path for name, c in channels.items() if not c.driven}
        self.shared = len(variations.parameters) - len(own)
        self.own = [self.shared + list(own).index(name) for name in experiment.unknown]
        whole, driven = experiment.record, [(name, c) for name, c in channels.items() if c.driven]
        recorded = {c.path: whole.sampled(name, c.interpolation, c.delay) for name, c in driven}
        self.inputs = {**recorded, **signals}
        self.state_names = dae.state_names
        self._simulate = partial(simulate, self.dae, inputs=self.inputs, progress=False)
        self._measured_starts: dict[float, dict[str, float]] = {}  # by instant

    def rest(self, parameters: Values, at: float | None = None) -> Array:
        """Return the model's start values; motions that are measured or known start where they were."""
        begin = float(self.record.time[0]) if at is None else at
        guess: dict[str, float] = {}
        if self.experiment.motion and at is None:
            guess = dict(self.experiment.motion)
        elif self.experiment.initial == "fit":
            if begin not in self._measured_starts:
                self._measured_starts[begin] = self._measured_start(begin)
            guess = self._measured_starts[begin]
        values = self.experiment.given(parameters)
        return states_at_start(self.dae, inputs=self.inputs, parameters=values, guess=guess, time=begin)

    def _measured_start(self, begin: float) -> dict[str, float]:
        record = self.experiment.record
        first = int(np.searchsorted(record.time, begin - 0.5 / record.rate))
        t = record.time[first:] - begin
        guess = {}
        for name, path in self.outputs.items():
            if self.dae.unit(path) in ("m", "rad") and len(t) > 3:
                speed, guess[path] = start_of(t, record.values[name][first:])
                with suppress(KeyError):
                    self.dae.root(f"der({path})")
                    guess[f"der({path})"] = speed
        return guess

    def run(
        self,
        parameters: Values,
        start: Array | None,
        accuracy: Accuracy,
        span: tuple[int, int] | None = None,
    ) -> Prediction:
        """Run the record, or the samples from `span[0]` to `span[1]` of it.

        Args:
            parameters: changed parameters by name.
            start: states at the start; the model's own if None.
            accuracy: solver and tolerances.
            span: first and last sample.
        """
        first, last = span or (0, len(self.record.time) - 1)
        time = self.record.time[first : last + 1]
        step = float(time[-1] - time[0]) / (len(time) - 1)
        given = {} if start is None else dict(zip(self.dae.state_names, map(float, start), strict=True))
        steps = accuracy.steps or MOST_STEPS
        foresee(self.dae, accuracy.foreseen)
        try:
            run = self._simulate(
                float(time[-1]), begin=float(time[0]), step=step, start=given,
                parameters=self.experiment.given(parameters),
                solver=accuracy.solver, rtol=accuracy.rtol, atol=accuracy.atol, max_steps=steps * len(time),
            )  # fmt: skip
        except SimulationError as error:
            taken = error.result.stats["steps"] if isinstance(error.result, Result) else 0
            if taken <= steps * len(time):
                raise
            raise SimulationError(
                f"{self.record.name}: '{self.dae.name}' moves far faster than the record: more than {steps} "
                f"steps of the integrator for each sample of {step:g} s; correct the unit of time, or what "
                "is stiff in the model, or take a record at a higher rate",
                error.result,
            ) from error
        # An event at a sample ends a hair's breadth after it: what holds from there on is taken.
        at = np.searchsorted(run.time, time + 1e-3 * step, side="right") - 1
        values = dict(zip(self.outputs, self.variations.values(run, at).T, strict=False))
        found = Prediction(time, at, values, run, self, start is not None)
        for name, floor in self.experiment.floors.items():
            if floor.cutoff < inf:
                values[name] = values[name] + found.steps.rounding(name, floor.cutoff)
        return found

    def pushed(self, found: Prediction, changes: Mapping[str, Array]) -> Array:
        """Return what small changes of inputs change in the outputs: (instants, outputs, changes).

        Args:
            found: the run.
            changes: columns of changes by input, at the points of the run.
        """
        return self.variations.pushed(found.run, changes)[found.at]

    def adjoint(self, found: Prediction, weights: Array, name: str) -> Array | None:
        """Return what a unit of an input at each point of the run adds to the weighted sum of the outputs.

        Args:
            found: the run.
            weights: of the outputs at the instants of the record, (instants, outputs).
            name: of the input; None is returned for one whose derivatives the network uses.
        """
        spread = np.zeros((len(found.run.time), weights.shape[1]))
        np.add.at(spread, found.at, weights)
        return self.variations.adjoint(found.run, spread, name)


def start_of(t: Array, signal: Array) -> tuple[float, float]:
    """Return rate and value of a signal at t = 0, by a parabola through as much of it as follows one."""
    allowed = PARABOLA_MISFIT * spectral_floor(signal).sigma

    def parabola(count: int) -> tuple[Array, bool]:
        found = np.polyfit(t[:count], signal[:count], 2)
        missed = np.polyval(found, t[:count]) - signal[:count]
        return found, float(np.sqrt(np.mean(missed**2))) <= allowed

    count = START_SAMPLES
    found, follows = parabola(count)
    while not follows and count >= 2 * FEWEST_START_SAMPLES:
        count //= 2
        found, follows = parabola(count)
    while follows and count < len(t):
        count *= 2
        wider, follows = parabola(count)
        found = wider if follows else found
    return float(found[1]), float(found[2])


class CampaignModel:
    """A network on the records of several experiments, ready to run again and again.

    Args:
        network: the machine, or its `DAE`; with or without further effects in it.
        channels: what is measured.
        experiments: records and how they are run.
        parameters: in which slopes are wanted; any parameter of the network.

    Example:
        >>> def slopes(campaign, k):
        ...     bench = CampaignModel(campaign.dae, campaign.measured, campaign.training, ["spring.k"])
        ...     return [prediction.slopes["F"] for prediction in bench.simulate({"spring.k": k})]
    """

    def __init__(
        self,
        network: Network | DAE,
        channels: Mapping[str, Channel],
        experiments: Sequence[Experiment],
        parameters: Sequence[str] = (),
    ) -> None:
        self.dae = dae_of(network)
        self.channels = dict(channels)
        self.parameters = list(parameters)
        outputs = [c.path for c in channels.values() if not c.driven]
        if self.dae.impulses.numel():
            raise ModelError(
                f"'{self.dae.name}' has shocks, through which slopes are not computed; replace its stops "
                "by ElastoGap to fit it"
            )
        own = list(dict.fromkeys(name for e in experiments for name in e.unknown))
        variations = Variations(self.dae, [*outputs, *self.dae.state_names], [*self.parameters, *own])
        self.stands = [RecordModel(self.dae, e, channels, variations, own) for e in experiments]

    def simulate(
        self,
        parameters: Values,
        starts: Sequence[Array | None] | None = None,
        accuracy: Accuracy | None = None,
    ) -> list[Prediction]:
        """Return what is predicted for each record, each in one run."""
        pairs = zip(self.stands, starts or [None] * len(self.stands), strict=True)
        return [stand.run(parameters, start, accuracy or Accuracy()) for stand, start in pairs]
