"""When the run began that a record was cut from."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from .experiment import Experiment

PAUSE_SHARE = 0.25  # of the shorter of two records, up to which one goes on where the other ended
LONGEST_PAUSE = 0.5  # [s] likewise: nobody begins another run so soon
LONGEST_PAUSE_SAMPLES = 2.5  # likewise, of slow records: two samples from the last


def since_their_runs_began(experiments: Sequence[Experiment]) -> list[Experiment]:
    """Return experiments that know when their runs began.

    Windows of one file are of one run, which began where the file does, and so is a record that begins, on
    the clock that both have, shortly after another has ended. Any other record is a run of its own.
    """
    began: dict[int, float] = {}
    for this in sorted(experiments, key=_begin):
        before = (other for other in experiments if id(other) in began and _is_followed(other, this))
        began[id(this)] = min((began[id(other)] for other in before), default=_first(this))
    return [replace(experiment, began=began[id(experiment)]) for experiment in experiments]


def _is_followed(one: Experiment, other: Experiment) -> bool:
    if one.source == other.source:
        return True
    lasting = [float(e.record.time[-1] - e.record.time[0]) for e in (one, other)]
    longest = max(LONGEST_PAUSE, LONGEST_PAUSE_SAMPLES / one.record.rate)
    return 0 <= _begin(other) - float(one.record.time[-1]) <= min(PAUSE_SHARE * min(lasting), longest)


def _first(experiment: Experiment) -> float:
    """Return where what a record was cut from begins."""
    began = experiment.record.began
    return _begin(experiment) if began is None else began


def _begin(experiment: Experiment) -> float:
    return float(experiment.record.time[0])
