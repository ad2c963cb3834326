"""`FMUPort`: where other parts may be joined to an FMU, and the force of effects there.

It comes from the same laws by which effects are screened.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...base import Array, unit_of
from ...components import Domain, ModelError, nearest
from ...fmu import FMU, FMUError
from ..criteria import STICKING_SPEED_RATIO
from ..effects.effect import Motion
from ..effects.hypothesis import Hypothesis

NEEDED = ("force", "position", "velocity")


@dataclass(frozen=True)
class FMUPort:
    """Where other parts may be joined to an FMU.

    Attributes:
        force, position, velocity: its variables: of these the FMU takes either the force, or the motion.
        sign: of the force: 1 if what is taken acts on the FMU, and what is given pulls like a spring.
        takes_force: whether the force is what it takes.
        domain: whether it slides or turns.
    """

    force: str
    position: str
    velocity: str
    sign: float
    takes_force: bool
    domain: Domain

    @property
    def units(self) -> dict[str, str]:
        """The SI unit of each variable."""
        return dict(zip((self.force, self.position, self.velocity), _units(self.domain), strict=True))


def read_port(fmu: FMU, entries: Mapping[str, str]) -> FMUPort:
    """Return the port of an FMU by the names of its variables; a ModelError tells all that is wrong."""
    refused = f"the port of FMU '{fmu.name}' cannot be used"
    remedy = "; a port has force, position and velocity"
    problems = [
        f"port: there is no '{key}'{nearest(key, NEEDED) or remedy}" for key in entries if key not in NEEDED
    ]
    problems += [f'port: {key} = "name of a variable" must be given' for key in NEEDED if key not in entries]
    if problems:
        raise ModelError(f"{refused}:", problems)
    sign = -1.0 if entries["force"].startswith("-") else 1.0
    force, position, velocity = names = entries["force"].removeprefix("-"), *(entries[k] for k in NEEDED[1:])
    for key, name in zip(NEEDED, names, strict=True):
        try:
            variable = fmu.variable(name)
        except FMUError as error:
            problems.append(f"port: {key}: {error}")
            continue
        if not variable.real or variable.size != 1:
            told = f"{variable.type} of size {variable.size}, no real signal"
            problems.append(f"port: {key}: '{name}' is {told}")
    if problems:
        raise ModelError(f"{refused}:", problems)
    takes_force = force in fmu.inputs
    if not takes_force and position not in fmu.inputs:
        raise ModelError(
            f"{refused}: it takes neither '{force}' nor '{position}'; one of them must be an input (it has "
            f"{', '.join(fmu.inputs) or 'none'})"
        )
    domain = _domain(fmu, force, position)
    for name, unit in zip(names, _units(domain), strict=True):
        if fmu.unit(name) and not _measures(fmu, name, unit):
            problems.append(f"port: '{name}' is in {fmu.unit(name)}, where {unit} belongs")
    if problems:
        raise ModelError(f"{refused}:", problems)
    return FMUPort(force, position, velocity, sign, takes_force, domain)


def _units(domain: Domain) -> tuple[str, str, str]:
    """Return the SI units of force, position and velocity."""
    position, velocity, _ = domain.motion_units
    return domain.through_unit, position, velocity


def _domain(fmu: FMU, force: str, position: str) -> Domain:
    """Return the rotational one if a unit says so."""
    name, unit = (force, "N.m") if fmu.unit(force) else (position, "rad")
    turning = fmu.unit(name) and _measures(fmu, name, unit)
    return Domain.ROTATIONAL if turning else Domain.TRANSLATIONAL


def _measures(fmu: FMU, name: str, unit: str) -> bool:
    return fmu.measure(fmu.variables[name]).fits(unit_of(unit))


class _PortMotion:
    """How a port moves, at an instant or along a run, as a `Motion` tells; its usual speed is known."""

    def __init__(self, usual_speed: float) -> None:
        self._least = max(STICKING_SPEED_RATIO * usual_speed, 1e-12)
        self.elapsed = self.s = self.v = self.f = self.a = 0.0

    @property
    def direction(self) -> Any:
        """Sign of the speed, smooth near rest."""
        return np.tanh(self.v / self._least)


class Acting:
    """Effects at a port: their force, as a spring's, is the sum of size times basis; SI units.

    The run `began` at that instant [s].
    """

    def __init__(self, effects: Sequence[Hypothesis], began: float) -> None:
        self.effects, self._began = tuple(effects), began
        self.accelerating = any(placed.effect.place == "node" for placed in effects)
        self._terms = [_term(placed) for placed in effects]

    def force(self, t: Any, s: Any, v: Any, f: Any, a: Any) -> Any:
        """Return the force at an instant, or at all of them."""
        total = 0.0
        for basis, sizes, shape, origin, moving in self._terms:
            moving.elapsed, moving.s, moving.v, moving.f, moving.a = t - self._began, s - origin, v, f, a
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
    origin = placed.effect.origin(placed.site)
    return placed.effect.basis, sizes, shape, origin, _PortMotion(placed.site.speed)


class Reaction:
    """What effects add to the force that an FMU takes at its port, in the FMU's units."""

    def __init__(self, acting: Acting, port: FMUPort, fmu: FMU) -> None:
        self._acting, self.accelerating = acting, acting.accelerating
        names = port.force, port.position, port.velocity
        force, self._position, self._velocity = (fmu.measure(fmu.variables[n]) for n in names)
        self._size = -port.sign / force.factor

    def __call__(self, t: float, s: float, v: float, a: float) -> float:
        """Return the force at an instant."""
        position, velocity = self._position.to_si(s), self._velocity.to_si(v)
        return self._size * float(self._acting.force(t, position, velocity, 0.0, self._velocity.factor * a))
