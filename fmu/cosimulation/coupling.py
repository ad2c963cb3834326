"""Coupling: what passes between a network and an FMU in it, and what they did together."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import factorial
from typing import TYPE_CHECKING

import numpy as np

from ...base import Array
from ...networks import Event, Pieces, Result, Stepwise
from ..foreign.instance import Values
from ..foreign.time_stepping import Course
from .components import ForeignComponent
from .step_error import ExchangeRun

if TYPE_CHECKING:
    import pandas as pd

SAME_VELOCITY = 1e-9


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


class Coupling:
    """What passes between the network and one FMU in it.

    Args:
        path: of the component in the network.
        component: which has the FMU.
        order: of the extrapolation.
    """

    def __init__(self, path: str, component: ForeignComponent, order: int) -> None:
        self.path, self.component = path, component
        orders = [(taken, taken.order + i) for taken in component.taken for i in range(order + 1)]
        self._observed = [(f"{path}.{taken.name}", order) for taken, order in orders]
        self._factorials = [factorial(i) for i in range(order + 1)]
        fmu = component.fmu
        self._taken = [(one.sign, fmu.measure(fmu.variables[one.input])) for one in component.taken]
        self._given = {
            f"{path}.{one.name}": [(one.sign, fmu.measure(fmu.variables[name])) for name in one.variables]
            for one in component.given
        }

    def course(self, network: Stepwise, t: float) -> Course:
        """Return what the FMU takes as a function of time, extrapolated from where the network is, at t."""
        observed = network.observe(self._observed) if self._observed else np.zeros(0)
        table = observed.reshape(-1, len(self._factorials)) / self._factorials
        rows = [(*measured, row) for measured, row in zip(self._taken, table.tolist(), strict=True)]

        def at(time: float) -> Values:
            ahead = time - t
            return [
                unit.from_si(sign * sum(c * ahead**i for i, c in enumerate(row))) for sign, unit, row in rows
            ]

        return at

    def courses(self, gave: Array) -> dict[str, list[float]]:
        """Return values, or values and rates, of the inputs of the network, as the FMU gave them."""
        values = iter(gave.tolist())
        return {
            name: [sign * unit.to_si(next(values)) for sign, unit in measures]
            for name, measures in self._given.items()
        }

    def courses_between(self, gave: Array, gives: Array, duration: float) -> dict[str, list[float]]:
        """Return the polynomials from what it gave to what it gives a step later."""
        before, after = self.courses(gave), self.courses(gives)
        return {name: _between(before[name], after[name], duration) for name in before}

    def jumps(self, gave: Array, gives: Array) -> Iterator[tuple[str, list[float], float]]:
        """Yield the motions whose velocity is another than it was: name, course from now on, and the jump."""
        before, after = self.courses(gave), self.courses(gives)
        for name, course in after.items():
            was, now = before[name][-1], course[-1]
            if len(course) == 2 and abs(now - was) > SAME_VELOCITY * (abs(now) + abs(was)):
                yield name, course, now - was


def _between(before: list[float], after: list[float], duration: float) -> list[float]:
    """Return coefficients of the line, or with rates the cubic, from one end of a step to the other."""
    if len(before) == 1:
        return [before[0], (after[0] - before[0]) / duration]
    (s, v), (s1, v1) = before, after
    gap = (s1 - s) / duration
    return [s, v, (3 * gap - 2 * v - v1) / duration, (v + v1 - 2 * gap) / duration**2]
