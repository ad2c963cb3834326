"""A model on a record as actuators drive it, wherever these stood when the record began."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from functools import cache
from typing import Any, TypeVar

import numpy as np

from ...base import Array
from ...identification import Accuracy, Experiment, Prediction, RecordModel
from ..criteria import ACTUATOR_BEGIN_STEP
from ..effects.hypothesis import Hypothesis, driven

Stand = TypeVar("Stand")
Begins = tuple[float, ...]  # where actuators stood


@dataclass(frozen=True, eq=False)
class DrivenPrediction(Prediction):
    """A prediction with slopes in where actuators stood, behind those in the record's own values.

    Attributes:
        moved: returns them as columns, by channel.
    """

    moved: Callable[[], dict[str, Array]]

    @property
    def own_slopes(self) -> dict[str, Array]:
        """d(channel)/d(own values of the record, where actuators stood), (instants, values)."""
        own, moved = super().own_slopes, self.moved()
        return {name: np.hstack([own[name], moved[name]]) for name in own}


class DrivenStand:
    """A network on a record that some actuators, of which nobody knows where they stood, drive.

    Where they stood is looked for among the record's own values.
    """

    def __init__(
        self,
        stand: Callable[[Experiment], Any],
        experiment: Experiment,
        effects: Sequence[Hypothesis],
        unknown: Sequence[str],
    ) -> None:
        self._names = tuple(unknown)
        known = {name: prior for name, prior in experiment.unknown.items() if name not in unknown}
        bare = replace(experiment, unknown=known)

        def begun(begins: Begins) -> RecordModel:
            found: RecordModel = stand(driven(bare, effects, dict(zip(self._names, begins, strict=True))))
            return found

        self._begun = cache(begun)

    @property
    def state_names(self) -> list[str]:
        """The network's states, wherever actuators stood."""
        return self._begun(self._parted({})[1]).state_names

    def rest(self, parameters: Mapping[str, float]) -> Array:
        """Return the model's start values, as of a `RecordModel`."""
        given, begins = self._parted(parameters)
        return self._begun(begins).rest(given)

    def run(
        self, parameters: Mapping[str, float], start: Array | None, accuracy: Accuracy
    ) -> DrivenPrediction:
        """Run the record from states at the start, actuators from where `parameters` tell that they stood."""
        given, begins = self._parted(parameters)
        found = self._begun(begins).run(given, start, accuracy)

        def moved() -> dict[str, Array]:
            columns: dict[str, list[Array]] = {name: [] for name in found.values}
            for number, begin in enumerate(begins):
                step = -ACTUATOR_BEGIN_STEP if begin > 0 else ACTUATOR_BEGIN_STEP
                other = tuple(b + step * (n == number) for n, b in enumerate(begins))
                for name, now in self._begun(other).run(given, start, accuracy).values.items():
                    columns[name].append((now - found.values[name]) / step)
            return {name: np.column_stack(parts) for name, parts in columns.items()}

        return DrivenPrediction(**{f.name: getattr(found, f.name) for f in fields(found)}, moved=cache(moved))

    def pushed(self, found: Prediction, changes: Mapping[str, Array]) -> Array:
        """Return what small changes of inputs change, as of a `RecordModel`."""
        return found.stand.pushed(found, changes)

    def adjoint(self, found: Prediction, weights: Array, name: str) -> Array | None:
        """Return what a unit of an input adds to the weighted outputs, as of a `RecordModel`."""
        return found.stand.adjoint(found, weights, name)

    def _parted(self, parameters: Mapping[str, float]) -> tuple[dict[str, float], Begins]:
        """Return parameters of the network, and where actuators stood; in the middle if it is not told."""
        given = {name: value for name, value in parameters.items() if name not in self._names}
        return given, tuple(float(parameters.get(name, 0.0)) for name in self._names)


def stand_on(
    stand: Callable[[Experiment], Stand], experiment: Experiment, effects: Sequence[Hypothesis]
) -> Stand | DrivenStand:
    """Return a model, which `stand` puts on a record, on one as the actuators among effects drive it."""
    unknown = [name for placed in effects for name in placed.begins if name in experiment.unknown]
    if not unknown:
        return stand(driven(experiment, effects))
    return DrivenStand(stand, experiment, effects, unknown)
