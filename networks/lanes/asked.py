"""What is asked of members: the program they share, what differs, and how those go that it cannot start."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any
from weakref import WeakKeyDictionary

import numpy as np

from ...base import Array, heed, interruptible
from ..csource.crew import CrewProgram, crew_program
from ..csource.members import Integers, Members, Signals, Status, Told
from ..dae import DAE
from ..flattening.flat import Flat
from ..simulation.bound_dae import BoundDAE
from ..simulation.input_signals import SignalKey
from ..simulation.legs import Leg
from ..simulation.settings import Settings, Tolerance
from ..simulation.starting import Start
from .signals import Inputs, closed_with, data_of, formulas_of, legs_of
from .starts import Starts
from .task import Task

_PROGRAMS: WeakKeyDictionary[Flat, dict[Any, CrewProgram]] = WeakKeyDictionary()
MOST_PROGRAMS = 8  # of one network that are kept


@dataclass(eq=False)
class Asked:
    """What is asked of members."""

    dae: DAE
    settings: Settings
    signals: tuple[str, ...]
    count: int
    parameters: Array
    starts: Starts
    inputs: Inputs

    def __post_init__(self) -> None:
        self.choices, self.chosen = self.inputs.choices(self.count)
        first = self._closed(0)
        self.start = self.starts.sought(first, self.parameters[0], self.settings.begin)
        self.formulas = formulas_of(first)

    def _closed(self, choice: int) -> BoundDAE:
        return closed_with(self.dae, self.choices[choice], self.settings)

    @cached_property
    def program(self) -> CrewProgram:
        """The program that all members share."""
        nothing = np.zeros(0)
        start = self.start or Start(self.dae, nothing, nothing, nothing, nothing, [], [], [], [])
        known = _PROGRAMS.setdefault(self.dae.flat, {})
        key = SignalKey(self.formulas), self.signals, self._form(start)
        if key not in known:
            known[key] = crew_program(self.dae, self.formulas, self.signals, start)
            if len(known) > MOST_PROGRAMS:
                del known[next(iter(known))]
        return known[key]

    @staticmethod
    def _form(start: Start) -> tuple[Any, ...]:
        aims = tuple((aim.name, aim.fixed) for aim in start.aims)
        return aims, tuple(start.led), tuple(start.free), start.z.tobytes()

    @cached_property
    def task(self) -> Task:
        """What is done with members, to the tolerance that is asked for."""
        return self.task_to(self.settings.tolerance)

    def task_to(self, tolerance: Tolerance) -> Task:
        """Return what is done with members, to some tolerance."""
        return Task(self.program, self.settings.outputs, (tolerance.rtol, tolerance.atol))

    @cached_property
    def signs(self) -> Array:
        """By which signals that are named after unknowns differ from them."""
        dae = self.dae
        return np.array([dae.root(dae.name_of(v))[1] for v in (*dae.states, *dae.algebraic)])

    def members(self) -> Members:
        """Return what differs between members."""
        signals, rows, legs = list[Signals](), list[tuple[Array, Array]](), list[list[Leg]]()
        of_member, begin = np.zeros(self.count, dtype=np.int64), self.settings.begin
        for choice in range(len(self.choices)):
            heed()
            closed, here = self._closed(choice), np.flatnonzero(self.chosen == choice)
            signals.append(data_of(closed, self.program.free))
            rows.append(self.starts.row(closed, self.parameters[0], begin))
            found, which = legs_of(closed, self.parameters[here], self.settings)
            of_member[here] = len(legs) + which
            legs += found
        guesses, aims = (np.array(column)[self.chosen] for column in zip(*rows, strict=True))
        self.starts.fill(guesses, aims, self.start.aims if self.start else [])
        return Members(self.parameters, guesses, aims, signals, legs, self.chosen, of_member)

    def run(self, members: Members, told: Told, go: Callable[[Members, Told], None]) -> None:
        """Run all members; `go` runs those that the program may start."""
        if self.start is None:
            told.status[:] = Status.UNSTARTED
        else:
            go(members, told)
        unstarted = np.flatnonzero(told.status == Status.UNSTARTED)
        if len(unstarted):
            with interruptible():
                self._run_otherwise_started(members, unstarted, told)

    def _run_otherwise_started(self, members: Members, places: Integers, told: Told) -> None:
        """Run those for which the program finds no start from where Python does, if it does."""
        found = dict[int, tuple[Array, Array]]()
        for member in places.tolist():
            heed()
            closed = self._closed(int(self.chosen[member]))
            run = self.starts.found(member, closed, self.parameters[member], self.settings)
            if isinstance(run, str):
                told.messages[member] = run
            else:
                point = run.point
                found[member] = np.concatenate([point.x, point.z]), point.q[: self.dae.constants.numel()]
        if not found:
            return
        there = np.array([*found], dtype=np.int64)
        points, constants = map(np.array, zip(*found.values(), strict=True))
        again = self.task.blank(len(found), told.crossings is not None)
        self.task.run(replace(members.some(there), found=(points, constants)), again)
        told.take_over(there, again)
