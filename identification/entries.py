"""The entries of a campaign, read and checked."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from numbers import Real
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..components import InertanceError, ModelError, nearest
from ..networks import DAE
from .filters import Filter
from .records import Channel, Record, read_record
from .units import factor

if TYPE_CHECKING:
    from .campaign import Campaign

INITIALS = ("fit", "rest")
EXPERIMENT_KEYS = ("file", "record", "initial", "window", "repeat_of", "temperature", "offset", "shooting")


@dataclass(frozen=True)
class Prior:
    """What is known of a parameter before the fit.

    Args:
        center: the value in the model.
        sd: standard deviation; infinite if only bounds are given.
        min, max: bounds.
    """

    center: float
    sd: float
    min: float
    max: float

    @property
    def scale(self) -> float:
        """A change of the parameter that counts."""
        if np.isfinite(self.sd):
            return self.sd
        width = self.max - self.min
        return 0.25 * width if np.isfinite(width) else abs(self.center) or 1.0


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
        every: outputs are compared at every so many samples; inputs keep all of theirs.
    """

    record: Record
    source: str
    initial: str = "fit"
    window: tuple[float, float] | None = None
    repeat_of: str | None = None
    offset: tuple[str, ...] = ()
    shooting: float | None = None
    every: int = 1

    @property
    def name(self) -> str:
        """What it is called in reports."""
        return self.record.name


@dataclass(frozen=True)
class Stage:
    """One step of a staged fit: these parameters, on these channels of these records, through this filter."""

    parameters: tuple[str, ...]
    channels: tuple[str, ...]
    train: tuple[int, ...]
    filter: Filter | None = None


class Problems:
    """Everything that is wrong, told at once."""

    def __init__(self, source: str) -> None:
        self.source = source
        self.found: list[str] = []

    def add(self, problem: str) -> None:
        """Note a problem."""
        self.found.append(problem)

    def unknown(self, where: str, entries: Mapping[str, Any], known: Iterable[str]) -> None:
        """Note keys that mean nothing."""
        known = list(known)
        for key in entries:
            if key not in known:
                told = nearest(key, known) or f"; known are {', '.join(known)}"
                self.add(f"{where}there is no key '{key}'{told}")

    @contextmanager
    def of(self, where: str) -> Iterator[None]:
        """Note what the library refuses within, as a problem of an entry."""
        try:
            yield
        except InertanceError as error:
            listed = getattr(error, "problems", None) or [str(error)]
            prefix = "" if str(listed[0]).startswith(where) else f"{where}: "
            self.found += [f"{prefix}{problem}" for problem in listed]
        except KeyError as error:
            self.add(f"{where}: {error.args[0]}")

    def stop(self) -> None:
        """Raise if there are any problems."""
        if self.found:
            raise ModelError(f"{self.source} cannot be used:", self.found)


def read_channels(entries: Mapping[str, Any], dae: DAE, problems: Problems) -> dict[str, Channel]:
    """Return the channels; every input that has no signal needs one."""
    channels: dict[str, Channel] = {}
    for name, entry in entries.items():
        where = f"channels.{name}"
        if not isinstance(entry, Mapping) or ("input" in entry) == ("output" in entry):
            problems.add(f'{where}: give either input = "path" or output = "path"')
            continue
        problems.unknown(f"{where}: ", entry, ("input", "output", "unit"))
        driven = "input" in entry
        path = entry["input"] if driven else entry["output"]
        if driven and path not in dae.input_names:
            told = (
                nearest(path, dae.input_names) or f"; the inputs are {', '.join(dae.input_names) or 'none'}"
            )
            problems.add(f"{where}: the network has no input '{path}'{told}")
            continue
        with problems.of(where):
            dae.expression(path)
            si = dae.unit(path)
            factor(entry.get("unit", si) or "1", si)
            channels[name] = Channel(path, driven, entry.get("unit", si), si)
    given = {channel.path for channel in channels.values() if channel.driven}
    for declared in dae.inputs:
        if declared.order == 0 and declared.signal is None and declared.path not in given:
            problems.add(
                f"channels: input '{declared.path}' [{declared.unit}] has no signal; measure it or bind it"
            )
    if not any(not channel.driven for channel in channels.values()) and not problems.found:
        problems.add("channels: no output is measured, so there is nothing to compare")
    return channels


def read_parameters(entries: Mapping[str, Any], dae: DAE, problems: Problems) -> dict[str, Prior]:
    """Return what is known of the uncertain parameters."""
    values = dae.parameter_values
    priors: dict[str, Prior] = {}
    for path, entry in entries.items():
        where = f'parameters."{path}"'
        if path not in values:
            problems.add(f"{where}: the network has no parameter '{path}'{nearest(path, values)}")
            continue
        if not isinstance(entry, Mapping) or not set(entry) & {"rel", "min", "max"}:
            problems.add(f"{where}: give rel (relative standard deviation), or min and max")
            continue
        problems.unknown(f"{where}: ", entry, ("rel", "min", "max"))
        wrong = [
            key
            for key, value in entry.items()
            if not isinstance(value, Real) or not np.isfinite(float(value))
        ]
        if wrong:
            problems.add(f"{where}: {wrong[0]} must be a finite number, got {entry[wrong[0]]!r}")
            continue
        prior = _prior(dae, path, values[path], entry)
        problems.found += [f"{where}: {problem}" for problem in _prior_problems(prior, entry)]
        priors[path] = prior
    return priors


def _prior(dae: DAE, path: str, value: float, entry: Mapping[str, float]) -> Prior:
    declared = dae.field(path)
    sd = entry["rel"] * abs(value) if "rel" in entry else np.inf
    tiny = 1e-9 * (abs(value) or 1.0)
    lowest = declared.min if declared.min is not None else -np.inf
    lowest = declared.above + tiny if declared.above is not None else lowest
    highest = declared.max if declared.max is not None else np.inf
    least, most = entry.get("min", -np.inf), entry.get("max", np.inf)
    return Prior(value, sd, max(least, lowest), min(most, highest))


def _prior_problems(prior: Prior, entry: Mapping[str, float]) -> Iterator[str]:
    if entry.get("rel", 1.0) <= 0:
        yield f"rel must be above 0, got {entry['rel']:g}"
    elif "rel" in entry and prior.center == 0:
        yield "rel of a value that is 0 leaves no freedom; give min and max"
    if not prior.min < prior.max:
        yield f"min {prior.min:g} must be below max {prior.max:g}"
    elif not prior.min <= prior.center <= prior.max:
        yield f"the model's value {prior.center:g} is outside {prior.min:g} to {prior.max:g}"


def read_experiments(
    kind: str, entries: Sequence[Any], channels: Mapping[str, Channel], base: Path, problems: Problems
) -> list[Experiment]:
    """Return the records of [[train]] or [[test]], read and checked."""
    if kind == "train" and not entries:
        problems.add("train: at least one record is needed")
    experiments = []
    for number, entry in enumerate(entries, start=1):
        where = f"[[{kind}]] {number}"
        problems.unknown(f"{where}: ", entry, EXPERIMENT_KEYS)
        if ("file" in entry) == ("record" in entry):
            problems.add(f'{where}: file = "..." must be given')
            continue
        before = len(problems.found)
        problems.found += [f"{where}: {problem}" for problem in _experiment_problems(entry, channels)]
        if len(problems.found) == before:
            with problems.of(where):
                experiments.append(_experiment(entry, channels, base))
    return experiments


def _experiment_problems(entry: Mapping[str, Any], channels: Mapping[str, Channel]) -> Iterator[str]:
    initial = entry.get("initial", "fit")
    if initial not in INITIALS:
        yield f"initial is 'fit' or 'rest', got '{initial}'{nearest(str(initial), INITIALS)}"
    window = entry.get("window")
    if window is not None and (len(window) != 2 or not window[0] < window[1]):
        yield f"window is [from, to] in s, from before to, got {window}"
    shooting = entry.get("shooting")
    if shooting is not None and not shooting > 0:
        yield f"shooting is the length of a piece, above 0 s, got {shooting}"
    if shooting is not None and initial == "rest":
        yield "shooting needs initial = 'fit', since only the first piece starts from rest"
    outputs = [name for name, channel in channels.items() if not channel.driven]
    for name in entry.get("offset", ()):
        if name not in outputs:
            yield f"offset: there is no output channel '{name}'{nearest(name, outputs)}"


def _experiment(entry: Mapping[str, Any], channels: Mapping[str, Channel], base: Path) -> Experiment:
    window = tuple(entry["window"]) if entry.get("window") is not None else None
    if "file" in entry:
        path = base / entry["file"]
        source = str(path)
        record = read_record(path, channels, window, entry.get("temperature"))
    else:
        record = entry["record"]
        source = record.name
        missing = [name for name in channels if name not in record.values]
        if missing:
            raise ModelError(
                f"record '{source}' has no channel '{missing[0]}'{nearest(missing[0], record.values)}"
            )
        record = record.window(*window) if window else record
    repeat = entry.get("repeat_of")
    if repeat is not None and "file" in entry:
        repeat = str(base / repeat)
    return Experiment(
        record, source, entry.get("initial", "fit"), window, repeat, tuple(entry.get("offset", ())),
        entry.get("shooting"),
    )  # fmt: skip


def read_noise(
    entries: Mapping[str, Any], channels: Mapping[str, Channel], problems: Problems
) -> dict[str, float]:
    """Return the stated noise of output channels in SI units."""
    outputs = [name for name, channel in channels.items() if not channel.driven]
    stated = {}
    for name, value in entries.items():
        if name not in outputs:
            problems.add(f"noise.{name}: there is no output channel '{name}'{nearest(name, outputs)}")
        elif not isinstance(value, Real) or not 0 < float(value) < np.inf:
            problems.add(
                f"noise.{name}: the standard deviation must be above 0 {channels[name].unit}, got {value!r}"
            )
        else:
            stated[name] = float(value) * factor(channels[name].unit or "1", channels[name].si)
    return stated


def read_stages(entries: Sequence[Any], campaign: Campaign, problems: Problems) -> list[Stage]:
    """Return the stages of the fit; one of everything if none are given."""
    known: dict[str, list[Any]] = {
        "parameters": list(campaign.priors),
        "channels": [name for name, channel in campaign.measured.items() if not channel.driven],
        "train": list(range(1, len(campaign.train) + 1)),
    }
    stages = []
    for number, entry in enumerate(entries or [{}], start=1):
        where = f"[[stage]] {number}"
        problems.unknown(f"{where}: ", entry, (*known, "filter"))
        for key, names in known.items():
            for name in entry.get(key, ()):
                if name not in names:
                    told = nearest(str(name), map(str, names)) or f"; there are {', '.join(map(str, names))}"
                    problems.add(f"{where}: {key}: there is no '{name}'{told}")
        chosen = {key: tuple(entry.get(key, names)) for key, names in known.items()}
        with problems.of(where):
            filtered = Filter(**_filter_entries(entry["filter"])) if "filter" in entry else None
            train = tuple(n - 1 for n in chosen["train"])
            stages.append(Stage(chosen["parameters"], chosen["channels"], train, filtered))
    return stages


def _filter_entries(entry: Mapping[str, Any]) -> dict[str, Any]:
    known = ("cutoff", "order", "kind")
    for key in entry:
        if key not in known:
            raise ModelError(f"filter: there is no key '{key}'{nearest(key, known)}")
    if "cutoff" not in entry:
        raise ModelError("filter: cutoff [Hz] must be given")
    cutoff = entry["cutoff"]
    return {**entry, "cutoff": tuple(cutoff) if isinstance(cutoff, list) else float(cutoff)}
