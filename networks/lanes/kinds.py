"""Kinds of runs that may go side by side: alike in all that is compiled, and different in numbers."""

from __future__ import annotations

import time as clock
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from numbers import Real
from typing import Any

import numpy as np

from ...base import Array, InertanceError, interruptible, is_number
from ...components.language import Sampled
from ..csource.crew import CrewProgram
from ..csource.members import Members, Status, Told
from ..dae import DAE
from ..results.result import Result
from ..simulation.bound_dae import bound
from ..simulation.input_signals import SignalKey
from ..simulation.run_asked import RunAsked
from ..simulation.settings import Tolerance
from ..simulation.solver_choice import against_compiling, compiled_tolerance
from .asked import Asked
from .signals import Inputs
from .starts import Starts
from .whole import MemberResult

WRITE_SECONDS = 0.3  # twice what it takes to write a small program for lanes, and to look whether it is kept
LANES_SECONDS = 2.0  # to compile one
FEWEST = 2  # runs that go side by side
BLOCK, LEAST_BLOCK, BLOCK_SECONDS = 64, 16, 30.0  # runs at once; fewer where alone they take longer [s]
MOST_VALUES = 8_000_000  # of all of them

Rows = tuple[Array, Array, Array]


class Unlike(Exception):  # noqa: N818 - a reason, no error
    """Why a run goes alone."""


@dataclass(frozen=True)
class Likeness:
    """What runs share that go side by side."""

    dae: DAE
    settings: Any
    formulas: SignalKey
    inputs: tuple[str, ...]
    starts: tuple[str, ...]


def likeness(asked: RunAsked) -> Likeness:
    """Return what a run shares with those that it may go beside.

    Raises:
        Unlike: if it goes alone, saying why.
    """
    settings = asked.settings
    if settings.solver not in ("auto", "compiled"):
        raise Unlike(f"solver '{settings.solver}' is asked for")
    if asked.sensitivities:
        raise Unlike("sensitivities are followed")
    if asked.guess or settings.max_steps is not None:
        raise Unlike(f"{'guess' if asked.guess else 'max_steps'}= is given")
    formulas = {path: s for path, s in asked.inputs.items() if not _is_data(s)}
    return Likeness(asked.dae, settings, SignalKey(formulas), tuple(asked.inputs), tuple(asked.start))


def _is_data(signal: Any) -> bool:
    return isinstance(signal, Sampled | Real | tuple)


@dataclass(eq=False)
class Kind:
    """Runs that are alike, what they have cost, and the program by which they go side by side.

    Attributes:
        spent: what those took that went alone [s], `runs` of them.
        signals: what was asked of them.
        against: what speaks against going side by side.
    """

    like: Likeness
    spent: float = 0.0
    runs: int = 0
    signals: set[str] = field(default_factory=set)
    against: str = ""
    _program: CrewProgram | None = None
    _begun: bool = False
    _ready: bool = False
    _wanted: tuple[str, ...] = ()

    @contextmanager
    def paying(self) -> Iterator[None]:
        """Count what goes on as a run that went alone."""
        began = clock.thread_time()
        try:
            yield
        finally:
            self.spent += clock.thread_time() - began
            self.runs += 1

    def ready(self, asked: RunAsked, left: int) -> bool:
        """Tell whether runs like this one go side by side from now on, `left` of them being foreseen.

        That is so once the program is there; it is compiled beside what goes on if runs will take longer.
        """
        if self._ready or self.against or self.runs < FEWEST:
            return self._ready
        seconds = left * self.spent / self.runs
        with self._noting():
            if self._program is None and seconds >= WRITE_SECONDS:
                self._write(asked)
            if self._program is not None and not self._begun and seconds >= LANES_SECONDS:
                self._program.best.begin()
                self._begun = True
            self._ready = self._begun and self._program is not None and self._program.best.is_ready()
        return self._ready

    @property
    def at_once(self) -> int:
        """How many such runs go at once: a few for each lane, fewer where they are long or large."""
        width = self._program.width if self._program is not None else 1
        soon = int(BLOCK_SECONDS * self.runs / max(self.spent, 1e-9))
        return min(
            BLOCK, max(LEAST_BLOCK, soon), MOST_VALUES // (width * len(self.like.settings.outputs)) or 1
        )

    def _write(self, asked: RunAsked) -> None:
        """Write the program, and see whether it is kept."""
        reason = against_compiling(bound(asked.dae, asked.inputs), asked.settings)
        if reason:
            raise Unlike(reason)
        own = {*_unknowns(asked.dae), "time"}
        self._wanted = tuple(sorted(self.signals - own))
        self._program = self._gathered([asked]).program
        if not self._program.goes_wide:
            raise Unlike("its equations are too many for lanes")
        self._begun = self._program.best.is_ready()

    @contextmanager
    def _noting(self) -> Iterator[None]:
        try:
            yield
        except (InertanceError, Unlike, OSError, RuntimeError) as error:
            self.against = str(error).partition("\n")[0]

    def _gathered(self, runs: Sequence[RunAsked]) -> Asked:
        """Return what several runs ask for together."""
        dae, first = self.like.dae, runs[0]
        inputs = {
            path: [run.inputs[path] for run in runs] if _is_data(signal) else signal
            for path, signal in first.inputs.items()
        }
        starts = {name: np.array([float(run.start[name]) for run in runs]) for name in self.like.starts}
        parameters = np.array([dae.parameters.values(run.parameters) for run in runs])
        signals = (*_unknowns(dae), *self._wanted)
        return Asked(
            dae, self.like.settings, signals, len(runs), parameters, Starts(dae, starts), Inputs(inputs)
        )

    def results(self, runs: Sequence[RunAsked]) -> list[Result | None]:
        """Return what came of runs side by side; None for those that have to go alone."""
        found: list[Result | None] = [None] * len(runs)
        sound = [place for place, run in enumerate(runs) if _is_sound(run)]
        if len(sound) >= FEWEST:
            for place, result in zip(sound, self._together([runs[k] for k in sound]), strict=True):
                found[place] = result
        return found

    def _together(self, runs: Sequence[RunAsked]) -> list[Result | None]:
        began = clock.perf_counter()
        tolerance = compiled_tolerance(self.like.dae, self.like.settings)
        try:
            with interruptible():
                asked = self._gathered(runs)
                task = asked.task_to(tolerance)
                members, told = asked.members(), task.blank(len(runs), crossings=True)
            asked.run(members, told, task.run)
        except InertanceError:
            return [None] * len(runs)  # each by itself says what is wrong
        seconds = (clock.perf_counter() - began) / len(runs)
        return self._whole(runs, asked, members, told, tolerance, seconds)

    def _whole(
        self,
        runs: Sequence[RunAsked],
        asked: Asked,
        members: Members,
        told: Told,
        tolerance: Tolerance,
        seconds: float,
    ) -> list[Result | None]:
        """Return whole results of the members that came to their ends."""
        closed = [bound(asked.dae, choice) for choice in asked.choices]
        outputs, constants, signs = asked.settings.outputs, asked.dae.constants.numel(), asked.signs
        told.values[:, :, : len(signs)] *= signs
        for crossing in told.crossings or []:
            crossing[:, 3 + constants : 3 + constants + len(signs)] *= signs
        happened, crossed = (_by_member(rows, len(runs)) for rows in (told.events, told.crossings or []))
        why = f"beside {len(runs) - 1} others that are like it"
        found: list[Result | None] = []
        for member, run in enumerate(runs):
            if told.status[member] != Status.ARRIVED:
                found.append(None)
                continue
            figures = {
                "solver": "compiled", "why": why, "rtol": run.settings.rtol, "atol": run.settings.atol,
                "steps": int(told.steps[member]), "integrator calls": 1, "seconds": seconds,
            }  # fmt: skip
            rows, begins = _rows(outputs, constants, crossed[member], told.values[member])
            legs = list(members.legs[members.legs_of[member]])
            own = closed[asked.chosen[member]]
            found.append(
                MemberResult(
                    run, own, legs, rows, begins, self._wanted, happened[member][:, 1:], figures, tolerance
                )
            )
        return found


def _is_sound(asked: RunAsked) -> bool:
    """Tell whether the numbers of a run are such as a run can have; if not, it says so by itself."""
    try:
        asked.dae.parameters.values(asked.parameters)
    except InertanceError:
        return False
    return all(is_number(value) for value in asked.start.values())


def _unknowns(dae: DAE) -> tuple[str, ...]:
    """Return names of the states and of the algebraic unknowns."""
    return tuple(dae.name_of(v) for v in (*dae.states, *dae.algebraic))


def _by_member(told: Sequence[Array], count: int) -> list[Array]:
    """Return rows that begin with the number of a member by member, in their order."""
    rows = np.concatenate(told) if told else np.zeros((0, 1))
    order = np.argsort(rows[:, 0], kind="stable")
    rows = rows[order]
    return np.split(rows, np.searchsorted(rows[:, 0], np.arange(1, count)))


def _rows(outputs: Array, constants: int, crossed: Array, values: Array) -> tuple[Rows, list[int]]:
    """Return instants, constants of segments, and values of a member, and the rows where segments begin.

    At an instant with an event stand the points before and after, and no output.
    """
    begins, t = crossed[:, 1] > 0, crossed[:, 2]
    q, at_events = crossed[begins, 3 : 3 + constants], crossed[:, 3 + constants :]
    if len(t) == 1:
        return (outputs, q, values), [0]
    near = np.searchsorted(outputs, t)
    kept = np.ones(len(outputs), dtype=bool)
    kept[near[outputs[np.minimum(near, len(outputs) - 1)] == t]] = False
    times = np.concatenate([t, outputs[kept]])
    order = np.argsort(times, kind="stable")
    place = np.empty(len(order), dtype=np.int64)
    place[order] = np.arange(len(order))
    joined = np.concatenate([at_events, values[kept]])[order]
    return (times[order], q, joined), place[: len(t)][begins].tolist()
