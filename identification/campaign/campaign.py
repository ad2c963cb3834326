"""`Campaign`: what was measured on which machine, and what is uncertain about its model."""

from __future__ import annotations

import pickle
import tomllib
from collections.abc import Callable, Iterator, Mapping, Sequence
from copy import copy
from dataclasses import dataclass, field, fields, replace
from pathlib import Path
from typing import Any, Self

import numpy as np

from ...base import boolean, demand, function, instance, optional, path_of, shown, text_of, there_is_file
from ...components import ModelError
from ...networks import DAE, Network
from ..records.noise import STATED, NoiseFloor, repeated_floor, spectral_floor
from ..records.record import Channel, outputs_of
from .channels import read_channels, read_noise
from .checks import (
    EXPERIMENTS,
    dead_sensors,
    floors_of,
    noise_beside_signals,
    noise_needed,
    notes_of_records,
    rates_that_differ,
    records_fitted_twice,
    resting_inputs,
    starts_of_an_fmu,
    tests_that_are_fitted,
)
from .counterfactuals import read_counterfactuals
from .experiment import Experiment, read_experiments, repeat_problems, strange
from .limits import Limits, exceeded, needed, read_limits
from .machine import Machine, Reader, read_network
from .priors import Prior, is_per_record, read_priors
from .problems import TABLE, TEXT, Kind, Problems
from .runs import since_their_runs_began
from .stages import Stage, read_stages
from .ties import changes, limits_of, read_ties, shares, tied

REQUIRED_KEYS = ("model", "channels", "parameters", "train")
TABLES = ("port", "channels", "parameters", "noise", "limits")
LISTS = ("train", "test", "stage", "counterfactual")
KINDS = {
    "model": TEXT,
    **{key: Kind(f"a table [{key}]", TABLE.takes) for key in TABLES},
    **{key: Kind(f"tables [[{key}]]", lambda v: isinstance(v, list | tuple)) for key in LISTS},
}


@dataclass(eq=False)
class Campaign:
    """Measurements of one machine and the model they are held against.

    Made by `Campaign.load("campaign.toml")`, or from the same entries in Python:

    Args:
        model: the network, "path/to/file.py:function" that returns it, or "path/to/file.fmu".
        channels: column of the data -> {"input" or "output": path, "unit": unit}.
        parameters: path -> {"rel": relative standard deviation} or {"min": ..., "max": ...}; or
            {"share": path of another one, "ratio": times that}. With "per": "record" each record has a value
            of its own.
        train: records to fit, each {"file": path} or {"record": `Record`}, with what may be added: "initial"
            ("fit", the default, or "rest"), "window" [s], "repeat_of", "temperature", "offset",
            "shooting" [s], "values" (parameters that were other than in the model).
        test: records never fitted.
        noise: standard deviation of an output channel, in its unit.
        counterfactual: records of the machine after a change, predicted and never fitted, each as those above
            with "set" or "scale" (parameters), "remove" or "exchange" (components).
        stage: stages of the fit, each {"parameters", "channels", "train", "filter"}; one of everything if
            empty.
        port: of an FMU: {"force", "position", "velocity"} -> its variables where other parts may act on it.
        base: folder that relative paths start from.
        validate: whether to refuse an FMU whose description its schema does not allow.
        reader: what reads the model; `inertance.diagnosis.read_model` for an FMU, or a network with one in
            it, which only `diagnose` takes.
        limits: what a designed experiment may ask of the rig: {"duration": s, "rate": Hz}, and by channel or
            quantity of the model {"travel", "speed", "acceleration", "force", "torque", "amplitude", "band"}.
        planned: whether there may be no records yet, as before any rig exists; noise and limits are needed
            then.

    Raises:
        ModelError: telling everything that is wrong at once, with file and key.

    Example:
        >>> import numpy as np
        >>> import inertance as ia
        >>> net = ia.Network("swing", push=ia.Force(), mass=ia.Mass(m=1.0))
        >>> _ = net.add(spring=ia.Spring(k=90.0), wall=ia.Fixed())
        >>> _ = net.connect(net.wall.flange, net.spring.flange_a)
        >>> _ = net.connect(net.spring.flange_b, net.mass.flange, net.push.flange)
        >>> t = np.linspace(0, 10, 1001)
        >>> run = ia.identification.Record("chirp", t, {"F": np.sin(t**2), "x": 1e-3 * np.sin(9 * t)})
        >>> campaign = ia.identification.Campaign(
        ...     net,
        ...     channels={"F": {"input": "push.f", "unit": "N"}, "x": {"output": "mass.s", "unit": "m"}},
        ...     parameters={"spring.k": {"rel": 0.2}},
        ...     train=[{"record": run}],
        ... )
        >>> campaign.outputs
        ['x']
    """

    model: Network | str
    channels: Mapping[str, Mapping[str, Any]]
    parameters: Mapping[str, Mapping[str, float]]
    train: Sequence[Mapping[str, Any]]
    test: Sequence[Mapping[str, Any]] = ()
    noise: Mapping[str, float] = field(default_factory=dict)
    stage: Sequence[Mapping[str, Any]] = ()
    port: Mapping[str, str] = field(default_factory=dict)
    base: Path = field(default_factory=Path)
    counterfactual: Sequence[Mapping[str, Any]] = ()
    source: str = "campaign"
    validate: bool = True
    reader: Reader = read_network
    limits: Mapping[str, Any] = field(default_factory=dict)
    planned: bool = False
    network: Network = field(init=False, repr=False)
    machine: Machine = field(init=False, repr=False)
    measured: dict[str, Channel] = field(init=False, repr=False)
    priors: dict[str, Prior] = field(init=False, repr=False)
    per_record: dict[str, Prior] = field(init=False, repr=False)
    training: list[Experiment] = field(init=False, repr=False)
    testing: list[Experiment] = field(init=False, repr=False)
    changed: list[Experiment] = field(init=False, repr=False)
    stages: list[Stage] = field(init=False, repr=False)
    floors: dict[str, NoiseFloor] = field(init=False, repr=False)
    allowed: Limits = field(init=False, repr=False)
    notes: list[str] = field(init=False, repr=False)

    def __post_init__(self) -> None:
        demand("Campaign", reader=(self.reader, function), planned=(self.planned, boolean))
        self.source = str(self.source)
        problems = Problems(self.source)
        entries = {key: getattr(self, key) for key in KINDS}
        kinds = {**KINDS, "model": Kind("a Network or a text in quotes", lambda v: True)}
        problems.sound("", entries, kinds)
        if instance(str, Path)(self.base):
            problems.add(f"base must be the folder that relative paths start from, got {shown(self.base)}")
        problems.stop()
        self.base = Path(self.base)
        with problems.of("model"):
            try:
                self.network, self.machine = self.reader(self.model, self.port, self.base, self.validate)
            except TypeError as error:
                told = f"{type(error).__name__}: {error}"
                raise ModelError(f"the reader {shown(self.reader)} cannot read it ({told})") from error
        problems.stop()
        self.measured = channels = read_channels(self.channels, self.machine, problems)
        notes = self._tie(problems)
        self.allowed = read_limits(self.limits, channels, self.machine, problems)
        self.training = self._read("train", self.train, problems) if self.train or not self.planned else []
        self.testing = self._read("test", self.test, problems)
        known = channels, self.network, self.machine, self.priors, self.per_record
        changed = read_counterfactuals(self.counterfactual, *known, self.base, problems)
        self.changed = [self._own(experiment) for experiment in changed]
        problems.add(*tests_that_are_fitted(self.training, self.testing, "test"))
        problems.add(*tests_that_are_fitted(self.training, self.changed, "counterfactual"))
        if not isinstance(self.machine, DAE):
            problems.add(*starts_of_an_fmu(self.all_records))
        problems.add(*repeat_problems(self.all_records, channels))
        if len(self.training) == len(self.train):
            problems.add(*dead_sensors(channels, self.training))
        stated = read_noise(self.noise, channels, self.channels, problems)
        problems.add(*noise_beside_signals(stated, channels, self.training))
        if self.planned and not self.train and not problems.found:
            problems.add(*needed(self.allowed, channels), *noise_needed(stated, self.outputs))
            problems.add(*(["test: without [[train]] there is nothing to test"] if self.test else []))
        self.stages = []
        if self.training and len(self.training) == len(self.train):
            self.stages = read_stages(self.stage, self.priors, self.outputs, self.training, problems)
            problems.add(*records_fitted_twice(self.stages, self.training))
        problems.stop()
        self.notes = [*notes, *notes_of_records(self.all_records)]
        self.notes += exceeded(self.allowed, channels, self.experiments)
        self.notes += [*rates_that_differ(self.all_records), *resting_inputs(channels, self.training)]
        self.notes += [note for e in self.all_records for note in strange(e, channels, self.machine.inputs)]
        since, count = since_their_runs_began(self.experiments), len(self.training)
        self.training, self.testing = since[:count], since[count:]
        self.changed = since_their_runs_began(self.changed)
        self.floors = {name: NoiseFloor(sigma, STATED) for name, sigma in stated.items()}
        if self.training:
            floors = [*self._noise(stated)]
            pairs = zip(self.changed, floors[len(self.experiments) :], strict=True)
            self.changed = [replace(e, floors=own) for e, own in pairs]
            self._weigh(floors[: len(self.experiments)])

    def __reduce__(self) -> tuple[Any, ...]:
        return Campaign, tuple(getattr(self, entry.name) for entry in fields(self) if entry.init)

    def __copy__(self) -> Campaign:
        """Return one that shares what was read."""
        other = object.__new__(type(self))
        vars(other).update(vars(self))
        return other

    def pickled(self) -> bytes:
        """Return what other processes make the same campaign of.

        Raises:
            ModelError: for a model that lives in this process only.
        """
        try:
            return pickle.dumps(self)
        except (pickle.PicklingError, TypeError, AttributeError) as error:
            raise ModelError(
                f"{self.source}: the model cannot be sent to other processes ({error}); give it as "
                "model = 'path/to/file.py:function'"
            ) from error

    @classmethod
    def load(
        cls,
        path: str | Path,
        *,
        validate: bool = True,
        reader: Reader = read_network,
        planned: bool = False,
    ) -> Self:
        """Read a campaign from a TOML file; `validate`, `reader` and `planned` as above.

        Raises:
            ModelError: telling everything that is wrong at once.
        """
        path = path_of(path, "a campaign")
        there_is_file(path)
        try:
            entries = tomllib.loads(text_of(path))
        except tomllib.TOMLDecodeError as error:
            raise ModelError(f"{path}: this is not TOML ({error})") from error
        problems = Problems(str(path))
        problems.sound("", entries, KINDS)
        wanted = [key for key in REQUIRED_KEYS if not (planned and key == "train")]
        missing = [key for key in wanted if key not in entries]
        problems.add(*(f"{key}: {KINDS[key].told} must be given" for key in missing))
        problems.stop()
        given = {"base": path.parent, "source": str(path), "train": entries.pop("train", ())}
        return cls(**entries, **given, validate=validate, reader=reader, planned=planned)

    @classmethod
    def of(
        cls, given: Campaign | str | Path, reader: Reader = read_network, planned: bool = False
    ) -> Campaign:
        """Return a campaign that was given as one, or as the path of its TOML file.

        `reader` and `planned` as above.

        Raises:
            ModelError: for anything else, and telling everything that is wrong at once.
        """
        if isinstance(given, Campaign):
            if not (given.training or planned):
                raise ModelError(f"{given.source}: train: at least one record is needed")
            return given
        if isinstance(given, str | Path):
            return cls.load(given, reader=reader, planned=planned)
        raise ModelError(f"a Campaign or the path of its TOML file is needed, got {shown(given)}")

    def with_floors(self, floors: Sequence[Mapping[str, NoiseFloor]]) -> Campaign:
        """Return the campaign with other noise: of each experiment, of each output."""
        demand("with_floors()", floors=(floors, floors_of(self.outputs, len(self.experiments))))
        other = copy(self)
        other._weigh(floors)
        return other

    def with_records(
        self,
        training: Sequence[Experiment] | None = None,
        testing: Sequence[Experiment] | None = None,
        changed: Sequence[Experiment] | None = None,
    ) -> Campaign:
        """Return the campaign with other records; with its own where none are given.

        Raises:
            ModelError: for what is no list of experiments.
        """
        own = {"training": training, "testing": testing, "changed": changed}
        demand("with_records()", **{name: (given, optional(EXPERIMENTS)) for name, given in own.items()})
        other = copy(self)
        vars(other).update({name: [*records] for name, records in own.items() if records is not None})
        return other

    def with_each(self, changed: Callable[[Experiment], Experiment]) -> Campaign:
        """Return the campaign with each of its records changed.

        Raises:
            ModelError: for what makes no experiment of one.
        """
        demand("with_each()", changed=(changed, function))
        own = self.training, self.testing, self.changed
        try:
            return self.with_records(*([changed(experiment) for experiment in records] for records in own))
        except TypeError as error:
            raise ModelError(
                f"{shown(changed)} changes no record ({type(error).__name__}: {error})"
            ) from error

    def _weigh(self, floors: Sequence[Mapping[str, NoiseFloor]]) -> None:
        count, before = len(self.training), getattr(self, "floors", {})
        given = [replace(e, floors=floor) for e, floor in zip(self.experiments, floors, strict=True)]
        self.training, self.testing = given[:count], given[count:]
        self.floors = {name: _median([e.floors[name] for e in self.training]) for name in self.outputs}
        other = {name: floor for name, floor in self.floors.items() if before and floor != before[name]}
        self.changed = [replace(e, floors={**e.floors, **other}) for e in self.changed]

    @property
    def dae(self) -> DAE:
        """The equations of the network.

        Raises:
            ModelError: for an FMU, whose equations nobody knows.
        """
        if not isinstance(self.machine, DAE):
            raise ModelError(
                f"{self.source}: '{self.machine.name}' is an FMU, whose equations are not known; "
                "`inertance diagnose` fits its parameters, too"
            )
        return self.machine

    @property
    def inputs(self) -> list[str]:
        """Channels that drive the network."""
        return [name for name, channel in self.measured.items() if channel.driven]

    @property
    def outputs(self) -> list[str]:
        """Channels that the network predicts."""
        return outputs_of(self.measured)

    @property
    def sigma(self) -> dict[str, float]:
        """Noise of each output, standard deviation in SI units."""
        return {name: floor.sigma for name, floor in self.floors.items()}

    @property
    def experiments(self) -> list[Experiment]:
        """All records of the model as it is, those to fit first."""
        return [*self.training, *self.testing]

    @property
    def all_records(self) -> list[Experiment]:
        """All records, those of the model as it is first, then those of `changed` machines."""
        return [*self.experiments, *self.changed]

    @property
    def start(self) -> dict[str, float]:
        """Values of the uncertain parameters that all records share, before any fit."""
        values = self.machine.parameter_values
        return {name: values[name] for name in self.priors}

    def _tie(self, problems: Problems) -> list[str]:
        """Let parameters follow those that they share, and read what is known of the others; tell changes."""
        plain, ties = self.machine, read_ties(self.parameters, self.machine, problems)
        if ties:
            self.network = tied(self.network, ties)
            self.machine = self.network.dae()
        free = {path: e for path, e in self.parameters.items() if not shares(e)}
        known = read_priors(free, self.machine, limits_of(ties, plain), problems)
        self.per_record = {path: prior for path, prior in known.items() if is_per_record(free[path])}
        self.priors = {path: prior for path, prior in known.items() if path not in self.per_record}
        return list(changes(ties, plain))

    def _read(self, kind: str, entries: Sequence[Mapping[str, Any]], problems: Problems) -> list[Experiment]:
        known = self.measured, self.machine, self.priors
        return [self._own(e) for e in read_experiments(kind, entries, *known, self.base, problems)]

    def _own(self, experiment: Experiment) -> Experiment:
        """Return an experiment that knows of which parameters it has a value of its own."""
        left = experiment.given({path: prior.center for path, prior in self.per_record.items()})
        fixed = {*experiment.values, *(experiment.change.values if experiment.change else ())}
        own = {path: p for path, p in self.per_record.items() if path in left and path not in fixed}
        return replace(experiment, unknown=own)

    def _noise(self, stated: Mapping[str, float]) -> Iterator[dict[str, NoiseFloor]]:
        """Yield the noise of each experiment, of each output: as stated, by repeats, or by its spectrum."""
        by_source = {str(e.source): e.record for e in self.all_records}
        pairs = [(e.record, by_source[e.repeat_of]) for e in self.all_records if e.repeat_of in by_source]
        told = {name: NoiseFloor(sigma, STATED) for name, sigma in stated.items()}

        def spectrum(e: Experiment, name: str) -> Iterator[NoiseFloor]:
            if np.ptp(values := e.record.values[name]):
                yield spectral_floor(values, e.record.rate)

        if pairs:
            repeats = {name: _median([repeated_floor(*p, name) for p in pairs]) for name in self.outputs}
            told = repeats | told
        usual = {
            name: _median([f for e in self.training for f in spectrum(e, name)]) for name in self.outputs
        }
        for e in self.all_records:
            floors = {name: next(spectrum(e, name), usual[name]) for name in self.outputs}
            yield floors | {name: replace(floor, band=floors[name].band) for name, floor in told.items()}


def _median(floors: Sequence[NoiseFloor]) -> NoiseFloor:
    return sorted(floors, key=lambda floor: floor.sigma)[len(floors) // 2]
