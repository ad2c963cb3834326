"""The inputs of members: which share them, and what the C program needs to know of each choice."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
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

    def choices(self, count: int) -> tuple[list[dict[str, Any]], Integers]:
        """Return the different choices of signals by name, and which one each member has."""
        known: dict[SignalKey, int] = {}
        chosen, numbers = list[dict[str, Any]](), np.zeros(count, dtype=np.int64)
        for member in range(count if self._lists else 1):
            own = {path: s[member if len(s) > 1 else 0] for path, s in self._lists.items()}
            key = SignalKey(own)
            if key not in known:
                known[key] = len(chosen)
                chosen.append({**self._shared, **own})
            numbers[member] = known[key]
        return chosen, numbers


def closed_with(dae: DAE, given: Mapping[str, Any], settings: Settings) -> BoundDAE:
    """Return the equations with a choice of signals.

    Raises:
        ModelError: for unknown inputs, inputs without a signal, and data that do not cover the run.
    """
    closed = bound(dae, given)
    for path, signal in closed.signals.items():
        if isinstance(signal, Polynomial):
            raise ModelError(f"input '{path}': an ensemble takes no Polynomial; give a function of time")
    check_covered(dae.name, closed.signals, settings.begin, settings.stop)
    return closed


def formulas_of(closed: BoundDAE) -> dict[str, Any]:
    """Return the signals that are built into a program."""
    return {path: s for path, s in closed.signals.items() if not isinstance(s, Sampled | Real)}


def data_of(closed: BoundDAE, free: Sequence[tuple[str, int]]) -> Signals:
    """Return the others, for the inputs that a program has left free."""
    given = [(closed.signals[path], order) for path, order in free]
    constants = [float(s) if isinstance(s, Real) and not order else 0.0 for s, order in given]
    return Signals(np.array(constants), [record_table(s, order) for s, order in given])


def legs_of(closed: BoundDAE, parameters: Array, settings: Settings) -> tuple[list[list[Leg]], Integers]:
    """Return the different legs of members with some signals, and which ones each has, by its parameters."""
    own = ca.depends_on(closed.timed_rows, closed.dae.p)
    rows, which = np.unique(parameters, axis=0, return_inverse=True) if own else (parameters[:1], None)
    legs = []
    for row in rows:
        found = closed.legs(closed.blank(row), settings.begin, settings.stop)
        legs.append([replace(leg, max_step=min(leg.max_step, settings.max_step)) for leg in found])
    return legs, np.zeros(len(parameters), dtype=np.int64) if which is None else which.ravel()
