"""What is wrong with the records of a campaign beside each other, and what of them is worth a note."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations
from typing import Any

import numpy as np

from ...base import unit_for
from ...base.checks import Check, must
from ..records.noise import NoiseFloor
from ..records.record import Channel
from .experiment import Experiment
from .stages import Stage

LEAST_NOISE_SHARE = 1e-12  # of the largest value measured: numbers resolve it 4000 times


def tests_that_are_fitted(
    training: Sequence[Experiment], testing: Sequence[Experiment], kind: str
) -> Iterator[str]:
    """Yield tests, or other records of a kind, that share samples with a record that is fitted."""
    for number, experiment in enumerate(testing, start=1):
        twins = [n for n, e in enumerate(training, start=1) if experiment.overlaps(e)]
        if twins:
            yield (
                f"[[{kind}]] {number}: '{experiment.name}' is also [[train]] {twins[0]}; what was "
                "fitted tests nothing: give a record of another excitation, or another window"
            )


def records_fitted_twice(stages: Sequence[Stage], training: Sequence[Experiment]) -> Iterator[str]:
    """Yield records that one stage would count twice."""
    pairs = {pair for stage in stages for pair in combinations(sorted(stage.train), 2)}
    for one, other in sorted(pairs):
        experiment = training[other]
        if experiment.overlaps(training[one]):
            yield (
                f"[[train]] {other + 1}: '{experiment.name}' is also [[train]] {one + 1}; what is fitted "
                "twice seems known better than it is: keep one of them, or windows that do not overlap"
            )


def starts_of_an_fmu(experiments: Sequence[Experiment]) -> Iterator[str]:
    """Yield records whose start an FMU cannot be given."""
    for experiment in experiments:
        if experiment.initial != "rest":
            yield (
                f'{experiment.name}: initial = "rest" is needed, as an FMU begins from its own start '
                "values; give a record that begins at rest"
            )


def noise_beside_signals(
    stated: Mapping[str, float], channels: Mapping[str, Channel], training: Sequence[Experiment]
) -> Iterator[str]:
    """Yield noise that is stated, and too little or too much beside what was measured."""
    for name, sigma in stated.items() if training else ():
        channel, values = channels[name], [e.record.values[name] for e in training]
        largest, size = max(map(np.std, values)), unit_for(channel.unit, channel.si).factor
        highest = max(float(np.abs(v).max()) for v in values)
        if sigma < LEAST_NOISE_SHARE * highest:
            yield (
                f"noise.{name}: {sigma / size:g} {channel.unit} is less than any sensor's beside the "
                f"{highest / size:.3g} {channel.unit} that were measured; give what scatters in repeats"
            )
        if sigma > largest > 0:
            yield (
                f"noise.{name}: {sigma / size:g} {channel.unit} is more than all that was measured "
                f"({largest / size:.3g} {channel.unit}, standard deviation); correct it or its unit"
            )


def noise_needed(stated: Mapping[str, float], outputs: Sequence[str]) -> Iterator[str]:
    """Yield outputs whose noise nothing tells, where there are no records."""
    for name in outputs:
        if name not in stated:
            yield f"noise.{name}: the standard deviation must be given: there are no records to tell it"


def dead_sensors(channels: Mapping[str, Channel], training: Sequence[Experiment]) -> Iterator[str]:
    """Yield outputs that never move."""
    for name, value in _constant(channels, training, driven=False):
        yield f"channels.{name}: it is {value} throughout all training records; is the sensor connected?"


def resting_inputs(channels: Mapping[str, Channel], training: Sequence[Experiment]) -> Iterator[str]:
    """Yield inputs that never move."""
    for name, value in _constant(channels, training, driven=True):
        yield f"'{name}' is {value} throughout all training records; what it excites, they do not show"


def _constant(
    channels: Mapping[str, Channel], training: Sequence[Experiment], driven: bool
) -> Iterator[tuple[str, str]]:
    """Yield the inputs, or the outputs, that are one value in all training records, and which."""
    for name, channel in channels.items() if training else ():
        seen = [e.record.values[name] for e in training]
        if channel.driven == driven and np.ptp([(np.min(v), np.max(v)) for v in seen]) == 0:
            value = unit_for(channel.unit, channel.si).from_si(float(seen[0][0]))
            yield name, f"{value:.6g} {channel.unit}"


def notes_of_records(experiments: Sequence[Experiment]) -> Iterator[str]:
    """Yield the notes that records carry, each once with the names of its records."""
    names: dict[str, list[str]] = {}
    for experiment in experiments:
        for note in experiment.record.notes:
            names.setdefault(note, []).append(experiment.name)
    yield from (f"{', '.join(those)}: {note}" for note, those in names.items())


def rates_that_differ(experiments: Sequence[Experiment]) -> Iterator[str]:
    """Yield a note if records were not all sampled alike."""
    rates = {e.name: e.record.rate for e in experiments}
    if rates and max(rates.values()) > 1.01 * min(rates.values()):
        told = ", ".join(f"{name} {rate:g} Hz" for name, rate in rates.items())
        yield f"sampling rates differ ({told}); each record is simulated at its own"


def _are_experiments(given: Any) -> bool:
    return isinstance(given, list | tuple) and all(isinstance(one, Experiment) for one in given)


EXPERIMENTS = must("be a list of experiments, such as campaign.training", _are_experiments)


def floors_of(outputs: Sequence[str], count: int) -> Check:
    """Return the check that a noise floor of each output is given for each of so many records."""

    def are_given(floors: Any) -> bool:
        listed = isinstance(floors, list | tuple) and len(floors) == count
        return listed and all(_names(floor, outputs) for floor in floors)

    return must(f"be {count} mappings from {', '.join(outputs)} to a NoiseFloor", are_given)


def _names(floor: Any, outputs: Sequence[str]) -> bool:
    return isinstance(floor, Mapping) and all(isinstance(floor.get(n), NoiseFloor) for n in outputs)
