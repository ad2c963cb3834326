"""Jacobi master: FMUs joined to each other advance side by side over the same communication step."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ...base import Array
from ..errors import FMUError
from ..foreign.communication_steps import Course
from ..foreign.instance import Values
from ..foreign.run import ForeignRun
from .algebraic_loop import unchanged
from .communication_points import CommunicationPoints
from .participants import Member, Participant, jumped

ROUNDS = 100


@dataclass(frozen=True)
class Link:
    """An output that goes to an input: input = factor * output + offset, in the units of the two."""

    source: tuple[str, str]
    target: tuple[str, str]
    factor: float = 1.0
    offset: float = 0.0


class JacobiMaster:
    """Advances all FMUs over the same step at once, with inputs extrapolated from the last exchanges.

    Order 0 holds what was exchanged last, order 1 follows the line through the last two exchanges. After an
    event extrapolation begins anew.
    """

    def __init__(
        self, members: Mapping[str, Member], links: Sequence[Link], points: CommunicationPoints, rtol: float
    ) -> None:
        self.links, self.points, self.steps = links, points, 0
        self._members, self._rtol, self.notes = members, rtol, list[str]()
        self._all: dict[str, Participant] = {}
        self._was: dict[str, Array] = {}
        self._past: list[tuple[float, Array]] = []
        names = {name: list(member.inputs) for name, member in members.items()}
        self._taken = {n: [k for k, link in enumerate(links) if link.target[0] == n] for n in members}
        self._inputs = {n: [links[k].target[1] for k in self._taken[n]] + names[n] for n in members}
        self._given = {
            n: list(dict.fromkeys(link.source[1] for link in links if link.source[0] == n)) for n in members
        }

    def run(self) -> dict[str, ForeignRun]:
        """Run from the first point to the last; return the run of every FMU by name."""
        try:
            self._instantiate()
            self._begin()
            for target in self.points.times[1:].tolist():
                while self._time < target and not self._ended():
                    self._step(target)
        finally:
            for one in self._all.values():
                one.close()
        self.notes = [note for one in self._all.values() for note in one.conclude()]
        return {name: one.run for name, one in self._all.items()}

    def _instantiate(self) -> None:
        for name, member in self._members.items():
            inputs, outputs = self._inputs[name], self._given[name]
            self._all[name] = Participant(member, inputs, outputs, self.points, self._rtol)

    def _begin(self) -> None:
        self._time = self.points.begin
        declared = [self._members[link.target[0]].fmu.variables[link.target[1]].start for link in self.links]
        u = self._agreed(Participant.initial, np.array([float(value or 0.0) for value in declared]))
        for name, one in self._all.items():
            self._was[name] = one.begin(self._at(name, self._time, u))
        self._exchange(u)

    def _step(self, target: float) -> None:
        courses = {name: self._course(name) for name in self._all}
        self._time = advance_together(self._all, target, courses)
        self.steps += 1
        self._exchange(self._ahead(self._time))

    def _exchange(self, guess: Array) -> None:
        """Let all agree on what they exchange here; iterate the events that the step ended at."""
        u = self._agreed(Participant.outputs, guess)
        self._record()
        if self._settled(u, u) and not self._ended():
            self._past.clear()
            u = self._after_event(u)
            self._record()
        self._past = [*self._past, (self._time, u)][-1 - self.points.order :]

    def _after_event(self, before: Array) -> Array:
        """Iterate the events that jumps of what is exchanged bring about; return what is exchanged then."""
        for _ in range(ROUNDS):
            u = self._agreed(Participant.outputs, before)
            if not self._settled(before, u) or self._ended():
                return u
            before = u
        told = ", ".join(map(repr, self._all))
        raise FMUError(f"events of {told} at t = {self._time:.9g} s bring about each other without end")

    def _settled(self, before: Array, u: Array) -> bool:
        """Iterate the events that are due, also as inputs were others before; tell whether there were any."""
        happened = False
        for name, one in self._all.items():
            was, now = (self._at(name, self._time, values) for values in (before, u))
            happened |= one.settle(now, jumped(was, now))
        return happened

    def _ended(self) -> bool:
        return any(one.ended for one in self._all.values())

    def _record(self) -> None:
        for one in self._all.values():
            one.record()

    def _agreed(self, outputs: Callable[[Participant, Values], Array], guess: Array) -> Array:
        """Return inputs that the outputs, which may depend on them at once, return unchanged."""

        def answer(u: Array) -> Array:
            for name, one in self._all.items():
                self._was[name] = outputs(one, self._at(name, self._time, u))
            return np.array([self._passed(link) for link in self.links])

        names = ", ".join(map(repr, self._all))
        return unchanged(answer, guess, f"{names} find no common values at t = {self._time:g} s")

    def _passed(self, link: Link) -> float:
        name, output = link.source
        return link.factor * float(self._was[name][self._given[name].index(output)]) + link.offset

    def _at(self, name: str, t: float, u: Array) -> Values:
        signals = self._members[name].inputs.values()
        return [*u[self._taken[name]].tolist(), *(float(signal(t)) for signal in signals)]

    def _course(self, name: str) -> Course:
        return lambda t: self._at(name, t, self._ahead(t))

    def _ahead(self, t: float) -> Array:
        """Return what was exchanged last, or the line through the last two exchanges, at t."""
        (since, u), *before = reversed(self._past)
        for time, was in before:
            return u + (t - since) / (since - time) * (u - was)
        return u


def advance_together(
    everyone: Mapping[str, Participant], target: float, courses: Mapping[str, Course]
) -> float:
    """Advance all to `target` or the first event before it; who went beyond goes back. Return where.

    Raises:
        FMUError: if one that went beyond cannot go back.
    """
    for one in everyone.values():
        if len(everyone) > 1 and one.reversible:
            one.stepper.save()
    reached = target
    for name, one in everyone.items():
        one.stepper.advance(reached, courses[name])
        reached = min(reached, one.t)
    for name, one in everyone.items():
        if one.t > reached + 1e-12 * abs(reached):
            if not one.reversible:
                raise FMUError(
                    f"FMU '{one.fmu.name}' ({name}) stands at {one.t:g} s and cannot go back to the event of "
                    f"another at {reached:g} s: it does not save its state; couple it in a run of its own"
                )
            one.stepper.restore()
            one.stepper.advance(reached, courses[name])
    return reached
