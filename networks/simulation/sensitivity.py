"""Forward sensitivities: how states depend on parameters, beside CVODES and IDAS or along any run."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import casadi as ca
import numpy as np

from ...base import Array, Ints, ModelError, SimulationError, nearest
from ..dae import DAE
from ..evaluation.jacobians import Slopes
from ..evaluation.linearised import held, linearised
from ..evaluation.saltation import SaltationMatrices
from ..flattening.vectors import pick
from .bound_dae import BoundDAE
from .initialization import StartValues
from .integrator import Stepper
from .point import Point

if TYPE_CHECKING:
    from ..results.result import Result


class Sensitivities:
    """d(states)/d(parameters) along a smooth run by CVODES or IDAS, which go beside it.

    They begin with the start values that follow from fixed ones.
    """

    def __init__(self, closed: BoundDAE, names: tuple[str, ...], point: Point, wanted: StartValues) -> None:
        self.names, self._of_q = names, slopes_of_constants(closed.dae, point, names)
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


def check_followed(dae: DAE, names: Sequence[str]) -> None:
    """Refuse sensitivities that cannot be computed.

    Raises:
        ModelError: for unknown parameters, and for networks with shocks.
    """
    table = dae.parameters
    told = [f"there is no parameter '{n}'{nearest(n, table.index)}" for n in names if n not in table.index]
    if told:
        raise ModelError("sensitivities cannot be computed:", told)
    if names and dae.impulses.numel():
        raise ModelError(
            f"'{dae.name}' has shocks, through which sensitivities are not followed; compare runs instead, "
            "or use compliant stops"
        )


def slopes_of_constants(dae: DAE, point: Point, names: Sequence[str]) -> Array:
    """Return the slopes of what is constant in a segment in some parameters."""
    of_q = np.zeros((len(point.q), len(names)))
    of_q[[dae.parameters.index[n] for n in names], range(len(names))] = 1.0
    return of_q


def sensitivities_along(result: Result, names: Sequence[str], wanted: StartValues) -> dict[str, Array]:
    """Return d(states)/d(parameter) at the points of a run by any solver, events included, (points, states).

    From point to point by state-transition matrices, and over events by saltation matrices.

    Raises:
        SimulationError: where a prescribed motion jumps, or slopes are beyond what can be followed.
    """
    dae = result.dae
    for event in result.events:
        if event.mode not in dae.switching.mode_names:
            raise SimulationError(
                f"'{dae.name}': {event.component} jumps at t = {event.time:.9g} s, and sensitivities are not "
                "followed through its shock; give a ramp instead of the jump, or exact=False"
            )
    columns = pick(dae.p, [dae.parameters.index[name] for name in names])
    line = linearised(result, Slopes(dae, dae.ode, columns), SaltationMatrices(dae, columns))
    first = result.segments[0]
    point = Point(*first.point(0))
    moved = start_slopes(result.closed, point, wanted, slopes_of_constants(dae, point, names))
    states = line.steps.carry(held(dae, first, moved), line.steps.own)
    return {name: states[:, :, k] for k, name in enumerate(names)}


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
