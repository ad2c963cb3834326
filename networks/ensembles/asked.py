"""What is asked of an ensemble, and how its members go: together here, in blocks elsewhere, as they start."""

from __future__ import annotations

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
from ..simulation.blame import with_remedies
from ..simulation.bound_dae import BoundDAE
from ..simulation.input_signals import SignalKey
from ..simulation.legs import Leg
from ..simulation.progress import Progress
from ..simulation.settings import Settings
from ..simulation.starting import Start
from ..sweeps.design import Design
from .blocks import Task
from .result import Ensemble
from .signals import Inputs, closed_with, data_of, formulas_of, legs_of
from .starts import Starts
from .table import Columns, check_no_options, columns_of, member_count, spread

_PROGRAMS: WeakKeyDictionary[Flat, dict[Any, CrewProgram]] = WeakKeyDictionary()
UNFINISHED = "not done when the ensemble was interrupted"
MOST_PROGRAMS = 8  # of one network that are kept


@dataclass(eq=False)
class Asked:
    """What is asked of an ensemble."""

    dae: DAE
    settings: Settings
    signals: tuple[str, ...]
    count: int
    varied: Design | Columns
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
        """What is done with members."""
        settings = self.settings
        return Task(self.program, settings.outputs, (settings.rtol, settings.atol))

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

    def run(self, members: Members, told: Told, executor: Any, workers: int | None, bar: Progress) -> None:
        """Run all members."""
        if self.start is None:
            told.status[:] = Status.UNSTARTED
        elif executor is None and workers == 0:
            with interruptible():
                self.task.run(members, told, bar.at)
        else:
            self.task.spread(members, told, executor, workers, bar.at)
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
        again = self.task.blank(len(found))
        self.task.run(replace(members.some(there), found=(points, constants)), again)
        told.take_over(there, again)

    def result(self, told: Told, seconds: float) -> Ensemble:
        """Return what came of members so far."""
        open_ = np.flatnonzero(told.status == Status.WAITING).tolist()
        failed = {member: self._told(member, text) for member, text in told.messages.items()}
        errors = dict(sorted({**dict.fromkeys(open_, UNFINISHED), **failed}.items()))
        stats = {
            "members": self.count,
            "failed": len(errors),
            "lanes": told.lanes,
            "lane efficiency": told.tried / max(1, told.rounds * told.lanes),
            "steps": int(told.steps.sum()),
            "rejected": int(told.rejected.sum()),
            "seconds": seconds,
        }
        events = np.concatenate([np.zeros((0, 5)), *told.events])
        events = events[np.argsort(events[:, 0], kind="stable")]
        return Ensemble(
            self.dae, self.settings.outputs, self.signals, told.values, errors, stats, events, self.varied
        )

    def _told(self, member: int, text: str) -> str:
        named = f"'{self.dae.name}': "
        return f"{named}member {member}: {with_remedies(self.dae, text.removeprefix(named))}"


def asked_of(
    dae: DAE, settings: Settings, signals: tuple[str, ...], parameters: Any, starts: Any, inputs: Any
) -> Asked:
    """Check what is given for members, and gather it."""
    changed, begun, fed = columns_of("parameters", parameters), columns_of("starts", starts), Inputs(inputs)
    check_no_options(dae, changed)
    lengths = {f"parameters '{name}'": len(values) for name, values in changed.items()}
    lengths |= {f"starts '{name}'": len(values) for name, values in begun.items()}
    count = member_count(lengths | fed.lengths)
    rows = dae.parameters.rows(spread(changed, count), count)
    varied = parameters if isinstance(parameters, Design) else changed
    return Asked(dae, settings, signals, count, varied, rows, Starts(dae, spread(begun, count)), fed)
