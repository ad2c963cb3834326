"""`RecordRun`: a run of a model beside the record that it stands for."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ...base import Array
from ...identification import Experiment
from ..criteria import OPENING_SAMPLES, OPENING_SHARE
from ..effects.hypothesis import Hypothesis, sensed
from ..models.study import Predicted
from .own_values import missed, weighed
from .record_start import reach_of


@dataclass(frozen=True, eq=False)
class RecordRun:
    """A run on a record, and what it was computed with: effects, parameters and states at the start.

    It may stand for a `count` of records like it.
    """

    experiment: Experiment
    effects: tuple[Hypothesis, ...]
    given: Mapping[str, float]
    start: Array | None
    found: Predicted
    count: float = 1.0

    @cached_property
    def seen(self) -> dict[str, Array]:
        """The channels as their sensors pass them on."""
        elapsed, values = self.experiment.elapsed(self.found.time), self.found.values
        return {name: sensed(elapsed, name, values[name], self.effects) for name in values}

    @cached_property
    def weighed(self) -> tuple[Array, Array]:
        """The weighted residual, and the slopes of the prediction in what nobody measured."""
        return weighed(self.experiment, self.found, self.seen, self.given, self.count)

    @property
    def reach(self) -> Array:
        """How far each state gets, as of `reach_of`."""
        return reach_of(self.experiment, self.found)

    @property
    def opening(self) -> RecordRun:
        """The same run, of which only what comes soon after the start counts."""
        count = len(self.experiment.compared.time)
        later = np.arange(count) >= max(OPENING_SAMPLES, OPENING_SHARE * count)
        return replace(self, experiment=self.experiment.omitting(later))

    @cached_property
    def missed(self) -> Array:
        """The weighted residual alone, which takes no slopes."""
        return missed(self.experiment, self.seen, self.given, self.count)

    def slopes(self, name: str) -> Array:
        """Return slopes of a channel as its sensor passes them on; sensors are linear but for a constant."""
        slopes, elapsed = self.found.slopes[name], self.experiment.elapsed(self.found.time)
        if not any(placed.site.path == name for placed in self.effects):
            return slopes
        nothing = sensed(elapsed, name, np.zeros(len(elapsed)), self.effects)
        return np.column_stack([sensed(elapsed, name, column, self.effects) - nothing for column in slopes.T])
