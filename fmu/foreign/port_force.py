"""An instance with a force of ours at its port: what acts there besides the inputs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

from ..errors import FMUError
from .description import FMUDescription
from .in_process import LocalInstance
from .instance import Values
from .unpacked import Unpacked


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


class LoadedInstance(LocalInstance):
    """An instance with a load at its port."""

    def __init__(
        self, fmu: FMUDescription, kind: str, files: Unpacked, inputs: Sequence[str], load: Load | None
    ) -> None:
        super().__init__(fmu.path, kind, files=files)
        self.load = load
        if load is not None:
            position, velocity = (fmu.variables[name].reference for name in (load.position, load.velocity))
            states = [fmu.variables[name].reference for name in fmu.states]
            self._place, self._port = list(inputs).index(load.force), self._reals([position, velocity])
            self._fast = states.index(velocity) if velocity in states else None
            self._before: float | None = None

    def moved(self) -> tuple[float, float]:
        """Return position and velocity of the port."""
        values, arguments = self._port
        self._call(self._names["get"], *arguments)
        position, velocity = values
        return position, velocity

    def extrapolated(self, t: float, step: float) -> tuple[float, float]:
        """Return the load at t, and a step later if the port goes on as it did in the step before."""
        if self.load is None:
            return 0.0, 0.0
        law, (s, v) = self.load.law, self.moved()
        a = 0.0 if self._before is None else (v - self._before) / step
        self._before = v
        return law(t, s, v, a), law(t + step, s + step * (v + 0.5 * step * a), v + step * a, a)

    def loaded(self, inputs: Values, force: float) -> Values:
        """Return inputs with a force added, if there is a load."""
        if self.load is None:
            return inputs
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
