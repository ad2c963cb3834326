"""An instance with a force of ours at its port: what acts there besides the inputs."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

from ..errors import FMUError
from .description import FMUDescription
from .in_process import LocalInstance
from .inputs import groups
from .instance import Group, Values


class Law(Protocol):
    """A force that answers to motion, in the units of the FMU."""

    @property
    def accelerating(self) -> bool:
        """Whether it depends on acceleration."""
        ...

    def __call__(self, t: float, s: float, v: float, a: float) -> float:
        """Return what it adds to the FMU's force input."""
        ...


@dataclass(frozen=True)
class Load:
    """What acts at a port besides the inputs: force = law(t, position, velocity, acceleration).

    Attributes:
        force: the FMU's input that takes it.
        position, velocity: the FMU's outputs that tell how the port moves.
        law: the force.
    """

    force: str
    position: str
    velocity: str
    law: Law


class _Reals:
    """Real variables of an instance, set and read together through arrays that are made once."""

    def __init__(self, instance: LocalInstance, references: Sequence[int]) -> None:
        slave, count = instance.instance, len(references)
        self._values = (ctypes.c_double * count)()
        place = (ctypes.c_uint32 * count)(*references)
        names = (
            ("fmi2SetReal", "fmi2GetReal") if instance.major == 2 else ("fmi3SetFloat64", "fmi3GetFloat64")
        )
        self._set, self._get = (getattr(slave, name) for name in names)
        more = () if instance.major == 2 else (count,)
        self._arguments = (slave.component, place, count, self._values, *more)

    def set(self, values: Values) -> None:
        """Set them."""
        self._values[:] = values
        self._set(*self._arguments)

    def get(self) -> Values:
        """Return them."""
        self._get(*self._arguments)
        return list(self._values)


class LoadedInstance(LocalInstance):
    """An instance with a load at its port."""

    load: Load | None = None

    def prepare(
        self, fmu: FMUDescription, inputs: Sequence[str], outputs: Sequence[str], load: Load | None
    ) -> None:
        """Look up what will be set and read."""
        self.load = load
        self.wanted: list[Group] = groups(fmu.variables[name] for name in outputs)
        self._given = _Reals(self, [fmu.variables[name].reference for name in inputs])
        if load is not None:
            self._place = list(inputs).index(load.force)
            names = load.position, load.velocity
            self._port = _Reals(self, [fmu.variables[name].reference for name in names])
            states = [fmu.variables[name].reference for name in fmu.states]
            speed = fmu.variables[load.velocity].reference
            self._fast = states.index(speed) if speed in states else None

    def moved(self) -> tuple[float, float]:
        """Return position and velocity of the port."""
        s, v = self._port.get()
        return s, v

    def drive(self, inputs: Values) -> None:
        """Set the inputs chosen at the start."""
        if inputs:
            self._given.set(inputs)

    def loaded(self, inputs: Values, force: float) -> Values:
        """Return inputs with a force added."""
        inputs = list(inputs)
        inputs[self._place] += force
        return inputs

    def _at(self, t: float, x: Values, inputs: Values) -> None:
        super()._at(t, x, inputs)
        if self.load is not None:
            self.drive(self.loaded(inputs, self._force(t, inputs)))

    def _force(self, t: float, inputs: Values) -> float:
        """Return the load; one that depends on acceleration a, which depends on it, is solved for.

        f = f_0 - m a,  a = a_0 + g f
        """
        assert self.load is not None
        law, (s, v) = self.load.law, self.moved()
        still = law(t, s, v, 0.0)
        if not law.accelerating:
            return still
        inertia, (first, second) = still - law(t, s, v, 1.0), (self._acceleration(inputs, f) for f in (0, 1))
        response = second - first
        return still - inertia * (first + response * still) / (1 + response * inertia)

    def _acceleration(self, inputs: Values, force: float) -> float:
        if self._fast is None:
            raise FMUError(
                f"FMU '{self.name}': its velocity is no state of it, so that an inertia cannot be joined"
            )
        self.drive(self.loaded(inputs, force))
        return float(self._rates()[self._fast])
