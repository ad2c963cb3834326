"""The master of a co-simulation: points, agreement and events, for FMUs alone and with a network."""

from __future__ import annotations

import time as clock
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any

import numpy as np

from ...base import Array
from ..errors import FMUError
from ..foreign.instance import Values
from ..foreign.run import ForeignRun
from ..foreign.time_stepping import Course
from .participants import CommunicationPoints, Participant, jumped

MOST_ROUNDS, MOST_BROYDEN_STEPS = 100, 30
LOOP_TOLERANCE = 1e-9


class Master(ABC):
    """Advances participants from communication point to communication point.

    At each they agree on what they exchange, and iterate the events that the step ended at until there is
    none, as each can bring about others.

    Attributes:
        who: what is run, for messages.
        time: where all stand [s].
        given: what each gave last.
    """

    def __init__(self, who: str, points: CommunicationPoints) -> None:
        self.who, self.points, self.time = who, points, points.begin
        self.everyone: dict[str, Participant] = {}
        self.given: dict[str, Array] = {}
        self.notes: list[str] = []
        self.stats: dict[str, Any] = {"communication steps": 0}
        self._initializing = True

    def march(self) -> dict[str, ForeignRun]:
        """Run from the first point to the last; return the run of every FMU by name."""
        began = clock.perf_counter()
        try:
            self._begin()
            for target in self.points.times[1:].tolist():
                while self.time < target and not self._ended():
                    self._step(target)
                    self.stats["communication steps"] += 1
        finally:
            for one in self.everyone.values():
                one.instance.close()
        self.notes += [note for one in self.everyone.values() for note in one.conclude()]
        self.stats["seconds"] = clock.perf_counter() - began
        return {name: one.run for name, one in self.everyone.items()}

    @abstractmethod
    def _begin(self) -> None:
        """Instantiate all, let them begin and record."""

    @abstractmethod
    def _step(self, target: float) -> None:
        """Go to `target` or the first event before it, and exchange there."""

    @abstractmethod
    def _shares(self, exchanged: Array) -> Iterator[tuple[str, Values]]:
        """Yield the inputs of each participant, from what all exchange."""

    @abstractmethod
    def _answered(self) -> Array:
        """Return what all exchange, as what they gave has it."""

    def _ended(self) -> bool:
        return any(one.stepper.ended for one in self.everyone.values())

    def _record(self) -> None:
        for one in self.everyone.values():
            one.record()

    def _leave_initialization(self, inputs: Iterable[tuple[str, str]]) -> Array:
        """Let all begin with values they agree on, from declared starts of the inputs on; return these."""
        starts = (self.everyone[name].fmu.variables[variable].start for name, variable in inputs)
        agreed = self._agreed(np.array([float(start or 0.0) for start in starts]))
        self._initializing = False
        for name, values in self._shares(agreed):
            self.given[name] = self.everyone[name].begin(values)
        return agreed

    def _agreed(self, guess: Array) -> Array:
        """Return what all exchange where they stand, as they answer to it at once (an algebraic loop)."""

        def answer(exchanged: Array) -> Array:
            for name, values in self._shares(exchanged):
                one = self.everyone[name]
                self.given[name] = one.initial(values) if self._initializing else one.outputs(values)
            return self._answered()

        what = "start" if self._initializing else "values"
        return _unchanged(answer, guess, f"{self.who} find no common {what} at t = {self.time:.9g} s")

    def _settled(self, before: Array, now: Array) -> bool:
        """Iterate the events that are due, also as inputs were others before; tell whether there were any."""
        pairs = zip(self._shares(before), self._shares(now), strict=True)
        return any([self.everyone[name].settle(new, jumped(old, new)) for (_, old), (name, new) in pairs])

    def _settled_jumps(self, before: Array, now: Array) -> Array:
        """Iterate the events that jumps of what is exchanged bring about; return what is exchanged then."""
        for _ in range(MOST_ROUNDS):
            now = self._agreed(now)
            if not self._settled(before, now) or self._ended():
                return now
            before = now
        raise FMUError(f"{self.who}: events at t = {self.time:.9g} s bring about each other without end")

    def _advance(self, target: float, courses: Mapping[str, Course]) -> None:
        """Advance all to `target` or the first event before it; who went beyond goes back, or is refused."""
        for one in self.everyone.values():
            if len(self.everyone) > 1 and one.reversible:
                one.stepper.save()
        everyone = sorted(self.everyone.items(), key=lambda item: not item[1].reversible)
        reached = target
        for name, one in everyone:
            if one.stepper.t < reached:
                one.stepper.advance(reached, courses[name])
            reached = min(reached, one.stepper.t)
        for name, one in everyone:
            t = one.stepper.t
            if t <= reached + 1e-12 * abs(reached):
                continue
            if not one.reversible:
                raise FMUError(
                    f"FMU '{one.fmu.name}' ({name}) stands at {t:g} s and cannot go back to the event of "
                    f"another at {reached:g} s: it does not save its state; couple it in a run of its own"
                )
            one.stepper.restore()
            if one.stepper.t < reached:
                one.stepper.advance(reached, courses[name])
        self.time = reached


def _unchanged(answer: Callable[[Array], Array], guess: Array, problem: str) -> Array:
    """Return u = answer(u) of an algebraic loop, by Broyden's method from plain repetition on.

    If there is none, the error begins with the `problem`.
    """
    u, leap = guess, np.eye(len(guess))
    rest = answer(u) - u
    for _ in range(MOST_BROYDEN_STEPS + len(guess)):
        if (np.abs(rest) <= LOOP_TOLERANCE * np.abs(u) + LOOP_TOLERANCE**2).all():
            return u
        move = leap @ rest
        u = u + move
        change = answer(u) - u - rest
        rest = rest + change
        weight = move @ leap
        if abs(weight @ change) > 0:
            leap = leap - np.outer(move + leap @ change, weight) / (weight @ change)
    raise FMUError(
        f"{problem}, as one answers to the other at once and they contradict; put a state (a mass, a lag) "
        "between them"
    )
