"""Forward sensitivities of smooth runs: how states depend on parameters."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ..components.base import ModelError, nearest

if TYPE_CHECKING:
    from .dae import DAE
    from .events import Point
    from .stepper import Stepper

Array = NDArray[np.float64]


class Sensitivities:
    """d(states)/d(parameters) along a run; start values do not depend on the parameters."""

    def __init__(self, dae: DAE, names: tuple[str, ...], point: Point) -> None:
        table = dae.system.flat.table
        unknown = [n for n in names if n not in table.index]
        if unknown:
            told = [f"there is no parameter '{n}'{nearest(n, table.index)}" for n in unknown]
            raise ModelError("sensitivities cannot be computed:", told)
        if dae.hybrid:
            raise ModelError(
                f"'{dae.name}' switches modes; forward sensitivities are for smooth networks "
                "(use the regularised friction elements)"
            )
        self.names = names
        self._of_q = np.zeros((len(point.q), len(names)))
        self._of_q[[table.index[n] for n in names], range(len(names))] = 1.0
        self._slopes: list[Array] = [np.zeros((len(point.x), len(names)))]

    def advance(self, stepper: Stepper, point: Point, span: float, begin: int) -> None:
        """Carry the sensitivities over one chunk that starts at output number `begin`."""
        seeds = self._slopes[begin], self._of_q
        moved = stepper.sensitivity(point.t, point.x, point.z, point.q, span, seeds)
        new = [moved[:, :, k] for k in range(moved.shape[2])]
        self._slopes = [*self._slopes[: begin + 1], *new]

    def collected(self) -> dict[str, Array]:
        """Return, for each parameter, d(states)/d(parameter), (outputs, states)."""
        stacked = np.array(self._slopes)
        return {name: stacked[:, :, k] for k, name in enumerate(self.names)}
