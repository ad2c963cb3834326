"""Coupling: what passes between a network and an FMU in it, and what they did together."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from math import factorial
from typing import TYPE_CHECKING

import numpy as np

from ...base import Array
from ...networks import Event, Pieces, Result
from ..foreign.communication_steps import Course
from ..foreign.instance import Values
from .components import ForeignComponent, Given, Taken
from .participants import Participant
from .step_error import ExchangeRun

if TYPE_CHECKING:
    import pandas as pd

SAME = 1e-9


@dataclass(eq=False)
class CoupledRun(ExchangeRun):
    """What a network and its FMUs did together.

    `run["body.s"]` is a signal of the network; `run.fmus["pump"]["flow"]` a variable of an FMU, in the unit
    that it declares. FMUs go by the path of their component.

    Attributes:
        network: the result of the network, at the communication points.
    """

    network: Result

    @property
    def name(self) -> str:
        """Name of the network."""
        return self.network.name

    @property
    def time(self) -> Array:
        """Instants of the network's points [s]."""
        return self.network.time

    def __getitem__(self, name: str) -> Array:
        """Return a signal of the network by its full name."""
        return self.network[name]

    def unit(self, name: str) -> str:
        """Return the unit of a signal of the network."""
        return self.network.unit(name)

    def _course(self, name: str, begin: float, end: float) -> Pieces:
        """Return a signal of the network between its points."""
        return self.network.course(name, begin, end)

    def values_of(self, name: str) -> tuple[str, ...]:
        """Return what the values of a mode of the network are called."""
        return self.network.values_of(name)

    def to_dataframe(self) -> pd.DataFrame:
        """Return the states of the network as a pandas DataFrame indexed by time."""
        return self.network.to_dataframe()

    def _own_events(self) -> list[Event]:
        return self.network.events


@dataclass(eq=False)
class Coupled:
    """One FMU in the network: its participant and how its variables convert."""

    path: str
    component: ForeignComponent
    fmu: Participant
    order: int
    was: Array = field(default_factory=lambda: np.zeros(0))

    def wanted(self) -> list[tuple[str, int]]:
        """Return what is to be observed in the network: values and rates of what the FMU takes."""
        return [
            (f"{self.path}.{taken.name}", taken.order + i)
            for taken in self.component.taken
            for i in range(self.order + 1)
        ]

    def course(self, observed: Array, t: float) -> Course:
        """Return what the FMU takes as a function of time, from observations at t."""
        table = observed.reshape(-1, self.order + 1) / [factorial(i) for i in range(self.order + 1)]
        pairs = list(zip(self.component.taken, table.tolist(), strict=True))

        def at(time: float) -> Values:
            return [self._foreign(taken, _polynomial(row, time - t)) for taken, row in pairs]

        return at

    def _foreign(self, taken: Taken, value: float) -> float:
        fmu = self.component.fmu
        return fmu.measure(fmu.variables[taken.input]).from_si(taken.sign * value)

    def start_inputs(self) -> Values:
        """Return the values that the FMU itself declares for its inputs."""
        variables = self.component.fmu.variables
        return [float(variables[taken.input].start or 0.0) for taken in self.component.taken]

    def courses(self, now: Array, duration: float | None = None) -> dict[str, Sequence[float]]:
        """Return the polynomials from what was to what is now; without duration, from what was on."""
        found: dict[str, Sequence[float]] = {}
        place = 0
        for given in self.component.given:
            width = 1 if given.rate is None else 2
            part = slice(place, place + width)
            place += width
            before, after = self._si(given, self.was[part]), self._si(given, now[part])
            course = before if duration is None else _between(before, after, duration)
            found[f"{self.path}.{given.name}"] = course
        return found

    def jumps(self, was: Array) -> Iterator[tuple[str, list[float], float]]:
        """Yield the motions whose velocity is another than it was: name, course from now on, and the jump."""
        place = 0
        for given in self.component.given:
            width = 1 if given.rate is None else 2
            part = slice(place, place + width)
            place += width
            before, now = self._si(given, was[part]), self._si(given, self.was[part])
            if width == 2 and abs(now[1] - before[1]) > SAME * (abs(now[1]) + abs(before[1])):
                yield f"{self.path}.{given.name}", now, now[1] - before[1]

    def _si(self, given: Given, values: Array) -> list[float]:
        fmu = self.component.fmu
        names = [given.value] if given.rate is None else [given.value, given.rate]
        measures = [fmu.measure(fmu.variables[name]) for name in names]
        return [given.sign * m.to_si(float(v)) for m, v in zip(measures, values, strict=True)]


def _polynomial(coefficients: list[float], x: float) -> float:
    value = 0.0
    for coefficient in reversed(coefficients):
        value = value * x + coefficient
    return value


def _between(before: list[float], after: list[float], duration: float) -> list[float]:
    """Return coefficients of the line, or with rates the cubic, from one end of a step to the other."""
    if len(before) == 1:
        return [before[0], (after[0] - before[0]) / duration]
    (s, v), (s1, v1) = before, after
    gap = (s1 - s) / duration
    return [s, v, (3 * gap - 2 * v - v1) / duration, (v + v1 - 2 * gap) / duration**2]
