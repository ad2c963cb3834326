"""Jacobi master: FMUs joined to each other advance side by side over the same communication step."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ...base import Array
from ..foreign.instance import Values
from ..foreign.time_stepping import Course
from .master import Master
from .participants import CommunicationPoints, Member, Participant


@dataclass(frozen=True)
class Link:
    """An output that goes to an input: input = factor * output + offset, in the units of the two."""

    source: tuple[str, str]
    target: tuple[str, str]
    factor: float = 1.0
    offset: float = 0.0


class JacobiMaster(Master):
    """Advances all FMUs over the same step at once, with inputs extrapolated from the last exchanges.

    Order 0 holds what was exchanged last, order 1 follows the line through the last two exchanges. After an
    event extrapolation begins anew.
    """

    def __init__(
        self, members: Mapping[str, Member], links: Sequence[Link], points: CommunicationPoints, rtol: float
    ) -> None:
        super().__init__(", ".join(map(repr, members)), points)
        self._members, self._links, self._rtol = members, links, rtol
        self._past: list[tuple[float, Array]] = []
        self._taken = {n: [k for k, link in enumerate(links) if link.target[0] == n] for n in members}
        self._outputs = {
            n: list(dict.fromkeys(link.source[1] for link in links if link.source[0] == n)) for n in members
        }

    def _begin(self) -> None:
        for name, member in self._members.items():
            inputs = [*(self._links[k].target[1] for k in self._taken[name]), *member.inputs]
            self.everyone[name] = Participant(member, inputs, self._outputs[name], self.points, self._rtol)
        self._exchange(self._leave_initialization(link.target for link in self._links))

    def _step(self, target: float) -> None:
        self._advance(target, {name: self._course(name) for name in self.everyone})
        self._exchange(self._ahead(self.time))

    def _course(self, name: str) -> Course:
        return lambda t: self._at(name, t, self._ahead(t))

    def _exchange(self, guess: Array) -> None:
        """Let all agree on what they exchange here; iterate the events that the step ended at."""
        self._close(self._agreed(guess))

    def _close(self, agreed: Array) -> None:
        """Record what all agree on, and iterate the events that the step ended at."""
        self._record()
        if self._settled(agreed, agreed) and not self._ended():
            self._past.clear()
            agreed = self._settled_jumps(agreed, agreed)
            self._record()
        self._past = [*self._past, (self.time, agreed)][-1 - self.points.order :]

    def _answered(self) -> Array:
        gave = {
            (name, output): value
            for name, outputs in self._outputs.items()
            for output, value in zip(outputs, self.given[name].tolist(), strict=True)
        }
        return np.array([link.factor * gave[link.source] + link.offset for link in self._links])

    def _shares(self, exchanged: Array) -> Iterator[tuple[str, Values]]:
        for name in self.everyone:
            yield name, self._at(name, self.time, exchanged)

    def _at(self, name: str, t: float, exchanged: Array) -> Values:
        signals = self._members[name].inputs.values()
        return [*exchanged[self._taken[name]].tolist(), *(float(signal(t)) for signal in signals)]

    def _ahead(self, t: float) -> Array:
        """Return what was exchanged last, or the line through the last two exchanges, at t."""
        (since, last), *before = reversed(self._past)
        for time, was in before:
            return last + (t - since) / (since - time) * (last - was)
        return last
