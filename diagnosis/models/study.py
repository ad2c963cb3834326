"""`Study`: the campaign that is diagnosed, how its runs are computed, and what predicts them."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from functools import cached_property
from math import ceil, inf
from time import monotonic

import numpy as np

from ...base import Array, Flags
from ...identification import (
    Accuracy,
    Campaign,
    Experiment,
    Filter,
    Prediction,
    Prior,
    RecordModel,
    spectral_floor,
)
from ..criteria import (
    ACTIVE_POWER_SHARE,
    COMPARISON_RATE_HZ,
    END_SHARE,
    FAST_NOISE_RATIO,
    IMPACT_STEPS_RATIO,
    LIVELY_RATIO,
    NOISE_PEAK_STANDARD_DEVIATIONS,
    SOLVER_STEPS_PER_SAMPLE,
    SOLVER_STEPS_RATIO,
)
from ..effects.hypothesis import Hypothesis
from ..effects.sites import Site, sites_of
from .driven_stand import DrivenStand
from .fmu_model import FMUModel
from .fmu_predictor import FMUPrediction, FMUPredictor, ReplayedStand
from .network_predictor import NetworkPredictor
from .prescribed import moving

Report = Callable[[str], None]


Predictor = NetworkPredictor | FMUPredictor
Standing = RecordModel | ReplayedStand | DrivenStand  # a model on one record
Predicted = Prediction | FMUPrediction  # outputs in a run, with their slopes in parameters and start values


@dataclass(frozen=True, eq=False)
class Study:
    """What is diagnosed and how: a campaign, how runs are computed, who fits, and who hears of progress.

    Its model is a network, of an `FMUStudy` an FMU. Nothing is begun after `deadline` [s, monotonic].
    Its records may be `pieces` of the measured ones, so long at most [s].
    """

    campaign: Campaign
    accuracy: Accuracy
    executor: Executor | None = None
    report: Report | None = None
    deadline: float = inf
    pieces: float | None = None

    def late(self) -> bool:
        """Whether the time that was granted has passed."""
        return monotonic() > self.deadline

    def tell(self, line: str) -> None:
        """Report a line of progress."""
        if self.report is not None:
            self.report(line)

    @property
    def judged(self) -> list[Experiment]:
        """The records that models are judged by: those of the test, or without any those that are fitted."""
        return self.campaign.testing or self.campaign.training

    @property
    def noise_is_sure(self) -> bool:
        """Whether noise is known apart from what a model leaves."""
        return all(floor.is_sure for e in self.campaign.experiments for floor in e.floors.values())

    def predictor(
        self, effects: Sequence[Hypothesis] = (), parameters: Sequence[str] = (), sites: Sequence[Site] = ()
    ) -> Predictor:
        """Return what predicts the outputs: slopes are in parameters, also of effects, probes at sites."""
        return NetworkPredictor(self.campaign, effects, parameters, sites)

    @property
    def sites(self) -> list[Site]:
        """Where in the model effects may hide."""
        return sites_of(self.campaign.network)

    @cached_property
    def is_led(self) -> bool:
        """Whether inputs prescribe all motion, so that the model as given has no states."""
        return not self.campaign.network.dae().state_names

    def screened(self) -> tuple[list[Experiment], float]:
        """Return the records by which effects are screened, and how many a sample of theirs stands for."""
        return self.campaign.training, 1.0

    def displaced(self, effects: Sequence[Hypothesis]) -> Study:
        """Return the study of a model with effects, which may begin elsewhere than the model without them.

        Where it rests elsewhere, records that begin at rest begin at states that are estimated. So is, in
        records that begin in motion, where actuators stood.
        """
        study = self.unsettled if any(placed.effect.displaces for placed in effects) else self
        begins = {name: prior for placed in effects for name, prior in placed.begins.items()}
        return replace(study, campaign=begun_with(study.campaign, begins)) if begins else study

    @cached_property
    def unsettled(self) -> Study:
        """The study with records that begin at states that are estimated, also those that begin at rest."""
        return replace(self, campaign=begun_anywhere(self.campaign))

    def accuracy_with(self, effects: Sequence[Hypothesis]) -> Accuracy:
        """Return how runs of the model with effects are computed: stops that are hit take more steps."""
        steps = self.accuracy.steps
        if steps is None or not any(placed.effect.place == "series" for placed in effects):
            return self.accuracy
        return replace(self.accuracy, steps=IMPACT_STEPS_RATIO * steps)

    def steps_per_sample(self) -> float:
        """Return how many steps of the integrator the model, as it was given, takes for a sample at most.

        Raises:
            SimulationError: for a model far faster than its records.
        """
        given, whole = self.campaign.start, replace(self.accuracy, steps=SOLVER_STEPS_PER_SAMPLE)
        model, taken = self.predictor(), list[float]()
        for experiment in self.campaign.training:
            stand = model.stand(experiment)
            found = stand.run(given, stand.rest(given), whole)
            assert isinstance(found, Prediction)
            taken.append(found.run.stats["steps"] / len(found.time))
        return max(taken)

    def granting_steps(self) -> Study:
        """Return the study with as many steps of the integrator a sample as are granted to what is tried.

        Raises:
            SimulationError: for a model far faster than its records.
        """
        steps = max(SOLVER_STEPS_PER_SAMPLE, round(SOLVER_STEPS_RATIO * self.steps_per_sample()))
        return replace(self, accuracy=replace(self.accuracy, steps=steps))

    def part(self, path: str) -> str:
        """Return the component of the network that a variable or parameter belongs to."""
        return path.rpartition(".")[0]

    def limits(self) -> list[str]:
        """Return what the kind of model keeps a diagnosis from seeing, in words."""
        return []


class FMUStudy(Study):
    """A study of an FMU, alone or between sources and sensors; each signature takes a run of it."""

    @property
    def box(self) -> FMUModel:
        """The FMU."""
        assert isinstance(self.campaign.machine, FMUModel)
        return self.campaign.machine

    def predictor(
        self, effects: Sequence[Hypothesis] = (), parameters: Sequence[str] = (), sites: Sequence[Site] = ()
    ) -> FMUPredictor:
        """Return its runs."""
        return FMUPredictor(self.box, self.campaign, effects, parameters)

    def displaced(self, effects: Sequence[Hypothesis]) -> Study:
        """Return the study as it is: an FMU begins from its own start values."""
        return self

    @property
    def sites(self) -> list[Site]:
        """Its port."""
        return self.box.sites

    @cached_property
    def is_led(self) -> bool:
        """Whether inputs prescribe all motion: nobody knows."""
        return False

    def screened(self) -> tuple[list[Experiment], float]:
        """Return the first record, which has to do."""
        return self.campaign.training[:1], float(len(self.campaign.training))

    def steps_per_sample(self) -> float:
        """Return 0: whoever made the FMU decides."""
        return 0.0

    def part(self, path: str) -> str:
        """Return the FMU's component, or the one beside it."""
        return self.box.part(path)

    def limits(self) -> list[str]:
        """Tell that its inside is not looked at, and when its port gives energy off."""
        box, model = self.box, self.predictor()
        told = box.limits(model.taken)
        port = model.stand(self.campaign.training[0]).run(self.campaign.start).port
        if box.port is None or port is None:
            return told
        power = float(np.trapezoid(port.f * port.v, port.t))
        if power < -ACTIVE_POWER_SHARE * float(np.trapezoid(np.abs(port.f * port.v), port.t)):
            told.append(
                f"at the port the FMU gives energy off; if it should take it, '{box.port.force}' counts the "
                "other way: put a minus before it"
            )
        return told


def study_of(
    campaign: Campaign,
    accuracy: Accuracy,
    executor: Executor | None = None,
    report: Report | None = None,
    deadline: float = inf,
) -> Study:
    """Return the study of a campaign by the kind of its model."""
    kind = FMUStudy if isinstance(campaign.machine, FMUModel) else Study
    return kind(campaign, accuracy, executor, report, deadline)


def thinned(campaign: Campaign, rate: float = COMPARISON_RATE_HZ) -> Campaign:
    """Return a campaign whose outputs are compared as often as machines need, and no more often.

    Inputs lose what is too fast to be compared where that is noise, which their second derivatives feel. Held
    ones have none. At the ends nothing is compared: an input that acts late, and a sensor that is early, ask
    for what nobody recorded.
    """
    smooth = [name for name in campaign.inputs if not campaign.measured[name].held]
    thin = campaign.with_each(lambda experiment: _slowed(experiment, smooth, rate))
    return thin if isinstance(thin.machine, FMUModel) else moving(thin)


def begun_anywhere(campaign: Campaign) -> Campaign:
    """Return a campaign in which the states where records begin are estimated."""
    return campaign.with_each(lambda e: e if e.initial == "fit" else replace(e, initial="fit"))


def begun_with(campaign: Campaign, begins: Mapping[str, Prior]) -> Campaign:
    """Return a campaign in which records in motion have own values that tell where actuators stood."""

    def changed(experiment: Experiment) -> Experiment:
        if experiment.initial == "rest":
            return experiment
        return replace(experiment, unknown={**experiment.unknown, **begins})

    return campaign.with_each(changed)


def _slowed(experiment: Experiment, driven: Sequence[str], rate: float) -> Experiment:
    record = experiment.record
    every = max(1, int(record.rate / rate))
    if every > 1:
        smooth = Filter(cutoff=0.5 * record.rate / every)
        calm = {name: quiet(record.values[name], smooth, record.rate) for name in driven}
        record = replace(record, values=record.values | calm)
    slow = replace(experiment, record=record, every=every)
    return replace(slow, omitted=at_ends(slow))


def at_ends(experiment: Experiment) -> Flags:
    """Tell which instants are at an end of a record.

    What was before a start at rest is known, and what is let go may be over soon after.
    """
    count = len(experiment.compared.time)
    few, at = ceil(END_SHARE * count), np.arange(count)
    known = experiment.initial == "rest" or _is_let_go(experiment, few)
    return np.asarray((at >= count - few) | (at < (0 if known else few)))


def _is_let_go(experiment: Experiment, few: int) -> bool:
    """Tell whether a channel is far livelier in its first samples than in all."""
    channels = [experiment.compared.values[name] for name in experiment.floors]
    return any(np.mean((x[:few] - x.mean()) ** 2) > LIVELY_RATIO * np.var(x) for x in channels)


def quiet(values: Array, smooth: Filter, rate: float) -> Array:
    """Return a signal without its fast noise; as it is, if what is fast has steps or is more than noise.

    The filter's transients at both ends do not count.
    """
    slow = smooth.apply(values, rate)
    settling = min(round(3 * rate / float(np.min(smooth.cutoff))), len(values) // 4)
    fast = (values - slow)[settling : len(values) - settling]
    size, noise = float(fast.std()), spectral_floor(values).sigma
    steps = float(np.abs(fast).max()) >= NOISE_PEAK_STANDARD_DEVIATIONS * size
    return values if steps or size > FAST_NOISE_RATIO * noise else slow
