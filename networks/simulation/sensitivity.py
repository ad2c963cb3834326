"""Forward sensitivities of smooth runs: how states depend on parameters."""

from __future__ import annotations

import casadi as ca
import numpy as np

from ...base import Array, Ints, ModelError, nearest
from .bound_dae import BoundDAE
from .initialization import StartValues
from .integrator import Stepper
from .point import Point


class Sensitivities:
    """d(states)/d(parameters) along a run, from the start values that follow from fixed ones."""

    def __init__(self, closed: BoundDAE, names: tuple[str, ...], point: Point, wanted: StartValues) -> None:
        dae = closed.dae
        table = dae.parameters
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
        self._slopes: list[Array] = [start_slopes(closed, point, wanted, self._of_q)]

    def advance(
        self, stepper: Stepper, point: Point, span: float, max_step: float, nodes: Ints, begin: int = -1
    ) -> None:
        """Carry the sensitivities on from a point, by its number; some nodes of the stretch are points."""
        moved = stepper.sensitivity(point, span, max_step, (self._slopes[begin], self._of_q))
        del self._slopes[begin % len(self._slopes) + 1 :]
        self._slopes += [*moved.transpose(1, 0, 2)[nodes]]

    def repeat(self, points: int) -> None:
        """Give further points at this instant the same sensitivities."""
        self._slopes += [self._slopes[-1]] * (points - len(self._slopes))

    def collected(self, points: int) -> dict[str, Array]:
        """Return, for each parameter, d(states)/d(parameter) at the points recorded, (points, states).

        Of a run that came to no end there are none if more points were kept than could be followed.
        """
        if len(self._slopes) < points:
            return {}
        stacked = np.array(self._slopes[:points])
        return {name: stacked[:, :, k] for k, name in enumerate(self.names)}


def start_slopes(closed: BoundDAE, point: Point, wanted: StartValues, of_q: Array) -> Array:
    """Return how states start that are solved from fixed values of other variables; others stay."""
    dae = closed.dae
    slopes = np.zeros((len(point.x), of_q.shape[1]))
    others = [v for v in wanted.fixed if v not in dae.states]
    free = [i for i, s in enumerate(dae.states) if s not in wanted.fixed]
    if others:
        missed = closed.close(ca.vertcat(dae.variables[others], dae.alg))
        of = (ca.jacobian(missed, symbol) for symbol in (closed.x, closed.z, closed.q))
        function = closed.function("start", *of)
        to_x, to_z, to_q = (m.full() for m in function(point.x, point.z, point.q, point.t))
        moved = np.linalg.lstsq(np.hstack([to_x[:, free], to_z]), -to_q @ of_q, rcond=1e-12)[0]
        slopes[free] = moved[: len(free)]
    return slopes
