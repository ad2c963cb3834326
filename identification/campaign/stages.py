"""`Stage`: one step of a staged fit."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...components import ModelError, nearest
from ..records.filters import Filter
from .experiment import Experiment
from .problems import COUNT, COUNTS, NUMBERS, TABLE, TEXT, TEXTS, Problems

KINDS = {"parameters": TEXTS, "channels": TEXTS, "train": COUNTS, "filter": TABLE}
FILTER_KINDS = {"cutoff": NUMBERS, "order": COUNT, "kind": TEXT}


@dataclass(frozen=True)
class Stage:
    """One step of a staged fit: these parameters, on these channels of these records, through this filter."""

    parameters: tuple[str, ...]
    channels: tuple[str, ...]
    train: tuple[int, ...]
    filter: Filter | None = None


def read_stages(
    entries: Sequence[Any],
    parameters: Iterable[str],
    channels: Iterable[str],
    training: Sequence[Experiment],
    problems: Problems,
) -> list[Stage]:
    """Return the stages of the fit; one of everything if none are given."""
    numbers = range(1, len(training) + 1)
    known: dict[str, list[Any]] = {"parameters": [*parameters], "channels": [*channels], "train": [*numbers]}
    stages = []
    for number, entry in enumerate(entries or [{}], start=1):
        where = f"[[stage]] {number}"
        if problems.sound(where, entry, KINDS) and problems.none(where, _unknown(entry, known)):
            chosen = {key: tuple(entry.get(key, names)) for key, names in known.items()}
            train = tuple(n - 1 for n in chosen["train"])
            with problems.of(where):
                filtered = _filter(entry, where, problems, [training[n] for n in train])
                stages.append(Stage(chosen["parameters"], chosen["channels"], train, filtered))
    return stages


def _unknown(entry: Mapping[str, Any], known: Mapping[str, list[Any]]) -> Iterator[str]:
    for key, names in known.items():
        for name in entry.get(key, ()):
            if name not in names:
                told = nearest(str(name), map(str, names)) or f"; there are {', '.join(map(str, names))}"
                yield f"{key}: there is no '{name}'{told}"


def _filter(
    stage: Mapping[str, Any], where: str, problems: Problems, training: Sequence[Experiment]
) -> Filter | None:
    entry = stage.get("filter")
    if entry is None or not problems.sound(f"{where}: filter", entry, FILTER_KINDS):
        return None
    if "cutoff" not in entry:
        raise ModelError("filter: cutoff [Hz] must be given")
    cutoff = entry["cutoff"]
    filtered = Filter(**{**entry, "cutoff": tuple(cutoff) if isinstance(cutoff, list) else cutoff})
    highest = float(np.max(filtered.cutoff))
    for experiment in training:
        filtered.check(experiment.record.rate)
        length = len(experiment.record.time) / experiment.record.rate
        if highest * length < 1:
            raise ModelError(
                f"filter: cutoff {highest:g} Hz has no whole cycle in the {length:g} s of "
                f"{experiment.name}; raise it or take a longer record"
            )
    return filtered
