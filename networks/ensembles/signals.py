"""The inputs of members: which share them, and what the C program needs to know of each choice."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from numbers import Real
from typing import Any

import casadi as ca
import numpy as np

from ...base import Array, ModelError, named
from ...components.language import Sampled
from ..csource.members import Integers, Signals
from ..csource.native import record_table
from ..dae import DAE
from ..simulation.bound_dae import BoundDAE, bound
from ..simulation.coverage import check_covered
from ..simulation.input_signals import Polynomial, SignalKey
from ..simulation.legs import Leg
from ..simulation.settings import Settings
from .table import check_data, several_signals


@dataclass(eq=False)
class Choice:
    """Signals by name, and the equations with them."""

    given: dict[str, Any]
    closed: BoundDAE

    def formulas(self) -> dict[str, Any]:
        """Return the signals that are built into the program."""
        return {path: s for path, s in self.closed.signals.items() if not isinstance(s, Sampled | Real)}

    def data(self, free: Sequence[tuple[str, int]]) -> Signals:
        """Return the others, for the inputs that a program has left free."""
        given = [(self.closed.signals[path], order) for path, order in free]
        constants = [float(s) if isinstance(s, Real) and not order else 0.0 for s, order in given]
        return Signals(np.array(constants), [record_table(s, order) for s, order in given])


class Inputs:
    """What is given for inputs, by name: a signal, or a list of signals, one for each member."""

    def __init__(self, given: Any) -> None:
        told = named("inputs", given)
        self._lists = {
            path: several for path, s in told.items() if (several := several_signals(s)) is not None
        }
        self._shared = {path: s for path, s in told.items() if path not in self._lists}
        for path, signals in self._lists.items():
            check_data(path, signals)

    @property
    def lengths(self) -> dict[str, int]:
        """How many members each list is for."""
        return {f"inputs '{path}'": len(signals) for path, signals in self._lists.items()}

    def choices(self, dae: DAE, settings: Settings, count: int) -> tuple[list[Choice], Integers]:
        """Return the different choices of signals, and which one each member has.

        Raises:
            ModelError: for unknown inputs, inputs without a signal, and data that do not cover the run.
        """
        known: dict[SignalKey, int] = {}
        chosen, numbers = list[Choice](), np.zeros(count, dtype=np.int64)
        for member in range(count if self._lists else 1):
            own = {path: s[member if len(s) > 1 else 0] for path, s in self._lists.items()}
            key = SignalKey(own)
            if key not in known:
                known[key] = len(chosen)
                chosen.append(_choice(dae, {**self._shared, **own}, settings))
            numbers[member] = known[key]
        return chosen, numbers


def _choice(dae: DAE, given: Mapping[str, Any], settings: Settings) -> Choice:
    closed = bound(dae, given)
    for path, signal in closed.signals.items():
        if isinstance(signal, Polynomial):
            raise ModelError(f"input '{path}': an ensemble takes no Polynomial; give a function of time")
    check_covered(dae.name, closed.signals, settings.begin, settings.stop)
    return Choice(dict(given), closed)


def legs_of_members(
    choices: Sequence[Choice], chosen: Integers, parameters: Array, settings: Settings
) -> tuple[list[list[Leg]], Integers]:
    """Return the different legs of runs, and which ones each member has: they may depend on parameters."""
    legs, numbers, known = list[list[Leg]](), np.zeros(len(chosen), dtype=np.int64), dict[Any, int]()
    own = [ca.depends_on(choice.closed.timed_rows, choice.closed.dae.p) for choice in choices]
    for member, number in enumerate(chosen.tolist()):
        closed = choices[number].closed
        key = number, parameters[member].tobytes() if own[number] else b""
        if key not in known:
            known[key] = len(legs)
            found = closed.legs(closed.blank(parameters[member]), settings.begin, settings.stop)
            legs.append([replace(leg, max_step=min(leg.max_step, settings.max_step)) for leg in found])
        numbers[member] = known[key]
    return legs, numbers
