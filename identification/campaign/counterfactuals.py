"""Counterfactuals: records of the machine after a change, which are predicted and never fitted."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from ...networks import Network
from ..records.record import Channel
from . import change as changes
from .experiment import KINDS, Experiment, read_experiment
from .machine import Machine
from .priors import Prior
from .problems import Problems


def read_counterfactuals(
    entries: Sequence[Any],
    channels: Mapping[str, Channel],
    network: Network,
    machine: Machine,
    priors: Mapping[str, Prior],
    per_record: Mapping[str, Prior],
    base: Path,
    problems: Problems,
) -> list[Experiment]:
    """Return the records of [[counterfactual]], read and checked."""
    found = []
    for number, entry in enumerate(entries, start=1):
        where = f"[[counterfactual]] {number}"
        if not problems.sound(where, entry, KINDS | changes.KINDS):
            continue
        plain = {key: value for key, value in entry.items() if key in KINDS}
        change = changes.read_change(where, entry, network, machine, channels, per_record, base, problems)
        for experiment in read_experiment(where, plain, channels, machine, priors, base, problems):
            if change is not None:
                problems.none(where, _lost_values(experiment, change))
                found.append(replace(experiment, change=change))
    return found


def _lost_values(experiment: Experiment, change: changes.Change) -> list[str]:
    lost = [path for path in experiment.values if change.replaces(path)]
    return [f"values.\"{path}\": the change takes '{change.replaces(path)}' away" for path in lost]
