"""How large an effect must be for a gap-to-noise ratio, and which other answers are as good."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from assembly import Rig, Values
from effects import Effect, Sized, Typical
from excitations import STEP
from second.effects import guess, signals
from second.excitations import PREROLL
from second.recording import Logger
from second.rigs import MASSES
from severity import COARSE, Scale
from stepper import Array, Drive

EVERY = 80  # coarse steps, so that a gap is measured at 125 Hz
LARGEST = {"sensor_gain": 0.4, "sensor_delay": 0.04, "actuator_delay": 0.04, "actuator_lag": 0.1}  # 1, s


class Bench(Scale):
    """Measures gaps in records that begin at PREROLL, zeros of their own taken off where that is declared.

    Args:
        rig, values, drives, typical, noise: as of a Scale.
        rel: how uncertain each parameter is.
        logger: takes the records.
    """

    def __init__(
        self,
        rig: Rig,
        values: Values,
        drives: list[Drive],
        typical: Mapping[str, Typical],
        noise: float,
        rel: Mapping[str, float],
        logger: Logger,
    ) -> None:
        self.logger = logger
        weight = logger.rate * COARSE * STEP * EVERY
        super().__init__(rig, values, drives, typical, noise, rel, weight)
        self.signal = float(1 / np.hypot(noise, logger.grain))

    def size(self, effect: Effect, severity: float) -> float | None:
        """Return the size that makes a gap of `severity`, None if none does, or if it were too large."""
        size = super().size(effect, severity)
        largest = MASSES.get(effect.place) if effect.kind == "added_inertia" else LARGEST.get(effect.kind)
        return None if size is None or size > (largest or np.inf) else size

    def _guess(self, effect: Effect) -> float:
        return guess(effect, self.rig, self.drives[0], COARSE * STEP)

    def _noise(self, clean: list[Array], noise: float) -> Array:
        return super()._noise(clean, float(np.hypot(noise, self.logger.grain)))

    def _seen(self, values: Values, effects: list[Sized], rest: float = 0.0) -> list[Array]:
        """Return what is seen; every run begins long before its record, so that none need `rest` first."""
        step, seen = COARSE * STEP, []
        for drive in self.drives:
            fine = signals(self.rig, values, drive, effects, self.typical, step, self.logger.duration)
            seen.append(fine[round(PREROLL / step) :: EVERY, 1:])
        return seen

    def _explained(self) -> Array:
        """Return what maps a change to parameters and zeros that explain it best, and keep their slopes."""
        super()._explained()
        count = len(self._clean) // (len(self.drives) * len(self.rig.outputs))
        columns = []
        for record in range(len(self.drives)):
            for output in map(self.rig.outputs.index, self.logger.offset):
                column = np.zeros((len(self.drives), count, len(self.rig.outputs)))
                column[record, :, output] = 1.0
                columns.append(column.ravel())
        known = np.array([*1 / self.rel**2, *[0.0] * len(columns)])
        return self._mapped(np.column_stack([self._slopes, *columns]), known)
