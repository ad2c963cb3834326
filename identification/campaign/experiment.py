"""`Experiment`: a record and how it is simulated."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from math import inf
from pathlib import Path
from typing import Any

import numpy as np

from ...base import Array, Flags, is_number
from ...components import ModelError, nearest
from ...networks import Input, between_samples, jump_remedy
from ..records.columns import stuck
from ..records.noise import NoiseFloor
from ..records.reading import read_record
from ..records.record import Channel, Record, outputs_of
from ..records.weighing import Weighing
from .change import Change
from .machine import Machine
from .priors import Prior
from .problems import FILE, INTERVAL, NUMBER, TABLE, TEXT, TEXTS, Kind, Problems

INITIALS = ("fit", "rest")
SHORTEST_PIECE = 10  # samples
REPEAT_TOLERANCE = 0.1  # of the scatter of an input
KINDS = {
    "file": FILE,
    "record": Kind("a Record, which only Python can give", lambda v: isinstance(v, Record)),
    "initial": TEXT,
    "window": INTERVAL,
    "repeat_of": FILE,
    "temperature": TEXT,
    "offset": TEXTS,
    "shooting": NUMBER,
    "values": TABLE,
}


@dataclass(frozen=True, eq=False)
class Experiment:
    """A record and how it is simulated.

    Attributes:
        record: what was measured.
        source: the file, or the name of a record given in Python.
        initial: "fit" for a start to be estimated, "rest" for the start values of the model.
        window: the part of the file that is used [s].
        repeat_of: the file that this one repeats.
        offset: outputs whose zero is unknown.
        shooting: length of the pieces of multiple shooting [s]; None for one run.
        values: parameters that were other than in the model, such as a mass that was added.
        unknown: parameters of which it has a value of its own that nobody knows, and what is known of that.
        began: when the run began that it was cut from, on the record's clock [s].
        every: outputs are compared at every so many samples; inputs keep all of theirs.
        floors: noise of its outputs.
        omitted: at which instants outputs are not compared; none if not given.
        change: of a counterfactual, how its machine had been changed.
        motion: how the machine moves where it begins, by path in the model, as far as that is known.
    """

    record: Record
    source: str
    initial: str = "fit"
    window: tuple[float, float] | None = None
    repeat_of: str | None = None
    offset: tuple[str, ...] = ()
    shooting: float | None = None
    values: Mapping[str, float] = field(default_factory=dict)
    unknown: Mapping[str, Prior] = field(default_factory=dict)
    began: float = 0.0
    every: int = 1
    floors: Mapping[str, NoiseFloor] = field(default_factory=dict)
    omitted: Flags | None = None
    change: Change | None = None
    motion: Mapping[str, float] = field(default_factory=dict)

    def given(self, parameters: Mapping[str, float]) -> dict[str, float]:
        """Return parameters of the model as they were in this record."""
        before = parameters if self.change is None else self.change.given(parameters)
        return {**before, **self.values}

    @property
    def name(self) -> str:
        """What it is called in reports."""
        return self.record.name

    @cached_property
    def compared(self) -> Record:
        """The record at the instants at which outputs are compared."""
        return self.record.thinned(self.every)

    def part(self, begin: int, end: int, motion: Mapping[str, float]) -> Experiment:
        """Return the part between two of the instants at which outputs are compared, begun in a motion."""
        return replace(self._between(begin, end), initial="fit", repeat_of=None, motion=motion)

    def until(self, end: int) -> Experiment:
        """Return the part up to one of the instants at which outputs are compared, begun as the whole."""
        return self._between(0, end)

    def omitting(self, more: Flags) -> Experiment:
        """Return it with more of the instants omitted at which outputs are compared."""
        return replace(self, omitted=more if self.omitted is None else self.omitted | more)

    def _between(self, begin: int, end: int) -> Experiment:
        window = float(self.compared.time[begin]), float(self.compared.time[end])
        omitted = None if self.omitted is None else self.omitted[begin : end + 1]
        return replace(self, record=self.record.window(*window), window=window, omitted=omitted)

    def elapsed(self, time: Array) -> Array:
        """Return how long the run it was cut from has lasted at instants of its clock [s]."""
        return time - self.began

    @cached_property
    def rate(self) -> float:
        """At which outputs are compared [Hz]."""
        return self.record.rate / self.every

    @cached_property
    def sigma(self) -> dict[str, float]:
        """What a sample of each output weighs: the noise that it has, as white noise, in SI units."""
        return {name: weighing.sigma for name, weighing in self.weights.items()}

    @cached_property
    def weights(self) -> dict[str, Weighing]:
        """What the samples of each output weigh, where they are not omitted."""
        counted = np.ones(len(self.compared.time), dtype=bool) if self.omitted is None else ~self.omitted
        return {name: Weighing(floor, counted, self.rate) for name, floor in self.floors.items()}

    @cached_property
    def whole(self) -> Experiment:
        """The same, of which what filters have changed is compared, too; itself if there is no such thing."""
        if all(weighing.is_whole for weighing in self.weights.values()):
            return self
        return replace(self, floors={name: replace(floor, passed=inf) for name, floor in self.floors.items()})

    def passed(self, name: str) -> Array:
        """Return what was measured of an output, as far as it is compared, in SI units."""
        return self.sigma[name] * self.weights[name](self.compared.values[name])

    def counted(self, values: Array) -> Array:
        """Return of values at the instants of `compared` those that are not omitted."""
        return values if self.omitted is None else values[~self.omitted]

    @cached_property
    def independent(self) -> float:
        """The number of independent samples that are compared."""
        count = len(self.counted(self.compared.time))
        return sum(count * weighing.share for weighing in self.weights.values())

    def overlaps(self, other: Experiment) -> bool:
        """Return whether both hold the same measurement, or parts of it that overlap."""
        if self.source != other.source:
            mine, theirs = self.record.values, other.record.values
            return all(name in theirs and np.array_equal(mine[name], theirs[name]) for name in mine)
        mine_from, mine_to = self.window or (-np.inf, np.inf)
        other_from, other_to = other.window or (-np.inf, np.inf)
        return mine_from < other_to and other_from < mine_to


def read_experiments(
    kind: str,
    entries: Sequence[Any],
    channels: Mapping[str, Channel],
    machine: Machine,
    priors: Mapping[str, Prior],
    base: Path,
    problems: Problems,
) -> list[Experiment]:
    """Return the records of [[train]] or [[test]], read and checked."""
    if kind == "train" and not entries:
        problems.add("train: at least one record is needed")
    experiments = []
    for number, entry in enumerate(entries, start=1):
        where = f"[[{kind}]] {number}"
        if problems.sound(where, entry, KINDS):
            experiments += read_experiment(where, entry, channels, machine, priors, base, problems)
    return experiments


def read_experiment(
    where: str,
    entry: Mapping[str, Any],
    channels: Mapping[str, Channel],
    machine: Machine,
    priors: Mapping[str, Prior],
    base: Path,
    problems: Problems,
) -> list[Experiment]:
    """Return the record of an entry with sound keys; nothing if anything is wrong, which is noted."""
    told = [*_experiment_problems(entry, channels), *_value_problems(entry, machine, priors)]
    if problems.none(where, told):
        with problems.of(where):
            return [_experiment(entry, channels, base)]
    return []


def _experiment_problems(entry: Mapping[str, Any], channels: Mapping[str, Channel]) -> Iterator[str]:
    if ("file" in entry) == ("record" in entry):
        yield 'file = "..." must be given'
    initial = entry.get("initial", "fit")
    if initial not in INITIALS:
        yield f"initial is 'fit' or 'rest', got '{initial}'{nearest(initial, INITIALS)}"
    if "shooting" in entry and initial == "rest":
        yield "shooting needs initial = 'fit', since only the first piece starts from rest"
    outputs = outputs_of(channels)
    for name in entry.get("offset", ()):
        if name not in outputs:
            yield f"offset: there is no output channel '{name}'{nearest(name, outputs)}"


def _value_problems(entry: Mapping[str, Any], machine: Machine, priors: Mapping[str, Prior]) -> Iterator[str]:
    known = machine.parameter_values
    for path, value in entry.get("values", {}).items():
        where = f'values."{path}"'
        if path not in known:
            yield f"{where}: the model has no parameter '{path}' that can be set{nearest(path, known)}"
        elif path in priors:
            yield f"{where}: it is in [parameters], and one for all records; leave it out of one of both"
        elif not is_number(value):
            yield f"{where} must be a number [{machine.unit(path)}], got {value!r}"
        elif wrong := machine.field(path).problem(float(value)):
            yield f"{where}: {wrong}"


def _experiment(entry: Mapping[str, Any], channels: Mapping[str, Channel], base: Path) -> Experiment:
    window = (float(entry["window"][0]), float(entry["window"][1])) if "window" in entry else None
    repeat, shooting = entry.get("repeat_of"), entry.get("shooting")
    if "file" in entry:
        path = base / entry["file"]
        source, record = str(path), read_record(path, channels, window, entry.get("temperature"))
        repeat = None if repeat is None else str(base / repeat)
    else:
        source, record = entry["record"].name, _given(entry["record"], channels, window)
    if shooting is not None and shooting * record.rate < SHORTEST_PIECE:
        raise ModelError(
            f"shooting: pieces of {shooting:g} s hold {max(0.0, shooting * record.rate):.3g} samples at "
            f"{record.rate:g} Hz; at least {SHORTEST_PIECE} are needed"
        )
    length = float(record.time[-1] - record.time[0])
    for name, channel in channels.items():
        if abs(channel.delay) >= length:
            raise ModelError(f"'{name}': delay = {channel.delay:g} s is longer than the record, {length:g} s")
    initial, offset = entry.get("initial", "fit"), tuple(entry.get("offset", ()))
    values = {path: float(value) for path, value in entry.get("values", {}).items()}
    return Experiment(record, source, initial, window, repeat, offset, shooting, values)


def _given(record: Record, channels: Mapping[str, Channel], window: tuple[float, float] | None) -> Record:
    """Return what counts of a record given in Python, once all its channels are seen to be there."""
    missing = [name for name in channels if name not in record.values]
    if missing:
        told = nearest(missing[0], record.values)
        raise ModelError(f"record '{record.name}' has no channel '{missing[0]}'{told}")
    return record.window(*window) if window else record


def strange(
    experiment: Experiment, channels: Mapping[str, Channel], inputs: Sequence[Input]
) -> Iterator[str]:
    """Yield inputs of which splines make something else, and outputs that stand still as no sensor does."""
    record = experiment.record
    for name, channel in channels.items():
        where = f"{experiment.name}: '{name}'"
        others = [record.values[other] for other in channels if other != name]
        if channel.driven:
            told = between_samples(record.sampled(name, channel.interpolation, channel.delay))
            if told:
                yield f"{where}: {told}; {jump_remedy(inputs, channel.path)}"
        elif (span := stuck(record.values[name], others)) is not None:
            yield (
                f"{where} repeats one value from {record.time[span[0]]:g} to {record.time[span[1]]:g} s, and "
                "hardly ever elsewhere; if the sensor was stuck, cut the record with window = [from, to]"
            )


def repeat_problems(experiments: list[Experiment], channels: Mapping[str, Channel]) -> Iterator[str]:
    """Yield repeats that do not repeat what they say."""
    by_source = {experiment.source: experiment for experiment in experiments}
    for experiment in experiments:
        if experiment.repeat_of is None:
            continue
        other = by_source.get(experiment.repeat_of)
        if other is None:
            told, known = Path(experiment.repeat_of).name, [Path(source).name for source in by_source]
            near = nearest(told, known) or f"; there are {', '.join(known)}"
            yield f"{experiment.name}: repeat_of: no record of the campaign is '{told}'{near}"
        elif other is experiment:
            yield f"{experiment.name}: repeat_of names the record itself; name the other run"
        else:
            yield from _unlike(experiment, other, channels)


def _unlike(one: Experiment, other: Experiment, channels: Mapping[str, Channel]) -> Iterator[str]:
    if abs(one.record.rate / other.record.rate - 1) > 1e-3:
        rates = f"{one.record.rate:g} and {other.record.rate:g} Hz"
        yield f"{one.name}: repeat_of: sampled otherwise than '{other.name}' ({rates}); resample one of them"
        return
    if one.values != other.values or repr(one.change) != repr(other.change):
        yield f"{one.name}: repeat_of: its values differ from those of '{other.name}'; repeats have the same"
        return
    count = min(len(one.record.time), len(other.record.time))
    for name in (name for name, channel in channels.items() if channel.driven):
        mine, theirs = one.record.values[name][:count], other.record.values[name][:count]
        apart = float(np.std(mine - theirs)) / max(float(np.std(theirs)), 1e-300)
        if apart > REPEAT_TOLERANCE:
            yield (
                f"{one.name}: repeat_of: input '{name}' differs from that of '{other.name}' by {apart:.0%}; "
                "repeats have one excitation and begin at the same instant of it"
            )
