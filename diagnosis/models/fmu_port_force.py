"""The force of effects at the port of an FMU, from the same laws by which effects are screened."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from ...base import Array
from ..criteria import STICKING_SPEED_RATIO
from ..effects.effect import Motion
from ..effects.hypothesis import Hypothesis
from .fmu_model import FMUModel
from .fmu_port import FMUPort


class _PortMotion:
    """How a port moves, at one instant or along a run, as effects are told by a `Motion`.

    What is usual there comes from a run before, since one instant does not tell.
    """

    def __init__(self, usual_speed: float) -> None:
        self._least = max(STICKING_SPEED_RATIO * usual_speed, 1e-12)
        self.t = self.s = self.v = self.f = self.a = 0.0

    @property
    def direction(self) -> Any:
        """Sign of the speed, smooth near rest."""
        return np.tanh(self.v / self._least)


class Acting:
    """Effects at a port: their force, as a spring's, is the sum of size times basis; SI units."""

    def __init__(self, effects: Sequence[Hypothesis]) -> None:
        self.effects = tuple(effects)
        self.accelerating = any(placed.effect.place == "node" for placed in effects)
        self._terms = [_term(placed) for placed in effects]

    def force(self, t: Any, s: Any, v: Any, f: Any, a: Any) -> Any:
        """Return the force at an instant, or at all of them."""
        total = 0.0
        for basis, sizes, shape, rest, moving in self._terms:
            moving.t, moving.s, moving.v, moving.f, moving.a = t, s - rest, v, f, a
            for size, part in zip(sizes, basis(moving, shape), strict=True):
                total = total + size * part
        return total

    def along(self, motion: Motion) -> Array:
        """Return the force at every instant of a motion."""
        force: Array = self.force(motion.t, motion.s, motion.v, motion.f, motion.a) + np.zeros(len(motion.t))
        return force


def _term(placed: Hypothesis) -> tuple[Any, list[float], dict[str, float], float, _PortMotion]:
    shape = {q.name: placed.values[q.name] for q in placed.quantities if q.shape}
    sizes = [placed.values[q.name] for q in placed.effect.sizes(placed.site.domain)]
    rest = 0.0 if placed.effect.absolute else placed.site.rest
    return placed.effect.basis, sizes, shape, rest, _PortMotion(placed.site.speed)


class Reaction:
    """What effects add to the force that an FMU takes at its port, in the FMU's units."""

    def __init__(self, acting: Acting, port: FMUPort, box: FMUModel) -> None:
        self._acting, self.accelerating = acting, acting.accelerating
        names = port.force, port.position, port.velocity
        force, self._position, self._velocity = (box.fmu.measure(box.fmu.variables[n]) for n in names)
        self._size = -port.sign / force.factor

    def __call__(self, t: float, s: float, v: float, a: float) -> float:
        """Return the force at an instant."""
        position, velocity = self._position.to_si(s), self._velocity.to_si(v)
        return self._size * float(self._acting.force(t, position, velocity, 0.0, self._velocity.factor * a))
