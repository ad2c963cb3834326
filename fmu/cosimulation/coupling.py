"""Coupling: what passes between a network and an FMU in it, also in no time, and what they did together."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import factorial
from typing import TYPE_CHECKING

import numpy as np

from ...base import Array
from ...networks import Event, Pieces, Result, Stepwise
from ..errors import FMUError
from ..foreign.instance import Values
from ..foreign.time_stepping import Course
from .components import FMUBlock, ForeignComponent
from .step_error import ExchangeRun

if TYPE_CHECKING:
    import pandas as pd

SAME_VELOCITY = 1e-9
IMPULSE_REMEDY = (
    "FMI has no signal for impulses; put a spring between, or all that is struck together on one side, in "
    "the network or in the FMU"
)


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
    """What passes between the network and the FMU of one component in it, at `path`."""

    def __init__(self, path: str, component: ForeignComponent, order: int) -> None:
        self.component = component
        orders = [(taken, taken.order + i) for taken in component.taken for i in range(order + 1)]
        self._observed = [(f"{path}.{taken.name}", order) for taken, order in orders]
        self._factorials = [factorial(i) for i in range(order + 1)]
        fmu = component.fmu
        self._taken = [(one.sign, fmu.measure(fmu.variables[one.input])) for one in component.taken]
        self._given = {
            f"{path}.{one.name}": [(one.sign, fmu.measure(fmu.variables[name])) for name in one.variables]
            for one in component.given
        }
        self.exchanged = [*(f"{path}.{taken.name}" for taken in component.taken), *self._given]

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


class Impulses:
    """Refuses shocks that would act on both sides at once, of which one would know nothing."""

    def __init__(self, network: Stepwise, couplings: Mapping[str, Coupling]) -> None:
        self._network, self._couplings = network, couplings
        self._feels = [p for p, one in couplings.items() if not isinstance(one.component, FMUBlock)]
        self._answer = {
            shock: path
            for path in self._feels
            for taken in couplings[path].component.taken
            for shock in network.shocks(f"{path}.{taken.name}", taken.order)
        }

    def check_shocks(self, events: Sequence[Event]) -> None:
        """Refuse events of the network whose impulse would act on an FMU, by name."""
        for event in events:
            path = event.mode.rpartition(".")[0]
            if self._feels and event.mode not in self._network.modes:
                raise FMUError(
                    f"'{self._network.name}': {event.component} jumps at t = {event.time:.9g} s, and what "
                    f"that does to the FMU '{self._feels[0]}' cannot be told; give a ramp, or exact=False"
                )
            if event.impulse and path in self._answer:
                raise FMUError(
                    f"'{self._network.name}': the impulse of {event.component} at t = {event.time:.9g} s "
                    f"({event.impulse:.4g} N.s, or N.m.s) acts on the FMU '{self._answer[path]}', too, which "
                    f"cannot be told; {IMPULSE_REMEDY}"
                )

    def check_jumps(self, gave: Mapping[str, Array], give: Mapping[str, Array]) -> None:
        """Refuse jumps of velocity, from what an FMU gave to what it gives, that move inertia with it."""
        for path, one in self._couplings.items():
            for name, course, jump in one.jumps(gave[path], give[path]):
                wanted = [(f"{path}.{taken.name}", 0) for taken in one.component.taken]
                self._network.set({name: course})
                still = self._network.observe(wanted)
                self._network.set({name: [*course, 0.5]})
                inertia = float(np.abs(self._network.observe(wanted) - still).max())
                self._network.set({name: course})
                if inertia > 0:
                    raise FMUError(
                        f"'{self._network.name}': at t = {self._network.time:.9g} s an event of an FMU lets "
                        f"the velocity of '{name}' jump by {jump:.4g} m/s (or rad/s), and {inertia:.4g} kg "
                        "(or kg.m2) of the network with it, whose impulse the FMU cannot be told; "
                        + IMPULSE_REMEDY
                    )


def _between(before: list[float], after: list[float], duration: float) -> list[float]:
    """Return coefficients of the line, or with rates the cubic, from one end of a step to the other."""
    if len(before) == 1:
        return [before[0], (after[0] - before[0]) / duration]
    (s, v), (s1, v1) = before, after
    gap = (s1 - s) / duration
    return [s, v, (3 * gap - 2 * v - v1) / duration, (v + v1 - 2 * gap) / duration**2]
