"""Members: what the runs of an ensemble are given, and what comes of them, as arrays that may travel."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

from ...base import Array
from ..simulation.legs import Leg

Integers = NDArray[np.int64]


class Status(IntEnum):
    """What came of a member, as in ensemble.h."""

    WAITING = 0
    ARRIVED = 1
    UNSTARTED = 2
    STUCK = 3
    FAILED = 4


@dataclass(eq=False)
class Signals:
    """What members share of inputs: constants, and instants and powers of data, for each free input."""

    constants: Array
    tables: Sequence[tuple[Array, Array] | None]


@dataclass(eq=False)
class Members:
    """What differs between members, a row for each.

    Attributes:
        parameters: (members, parameters).
        guesses, aims: where starts are sought from, (members, states), and what is aimed at.
        signals, legs: those that there are; `signals_of` and `legs_of` say which are whose.
        found: points (members, unknowns) and constants where members start, if that is known.
    """

    parameters: Array
    guesses: Array
    aims: Array
    signals: Sequence[Signals]
    legs: Sequence[Sequence[Leg]]
    signals_of: Integers
    legs_of: Integers
    found: tuple[Array, Array] | None = None

    def __len__(self) -> int:
        return len(self.parameters)

    def some(self, places: Integers | slice) -> Members:
        """Return some of the members, with the signals and legs that they need."""
        signals, signals_of = np.unique(self.signals_of[places], return_inverse=True)
        legs, legs_of = np.unique(self.legs_of[places], return_inverse=True)
        found = None if self.found is None else (self.found[0][places], self.found[1][places])
        return Members(
            self.parameters[places],
            self.guesses[places],
            self.aims[places],
            [self.signals[k] for k in signals],
            [self.legs[k] for k in legs],
            signals_of.astype(np.int64),
            legs_of.astype(np.int64),
            found,
        )


@dataclass(eq=False)
class Told:
    """What came of members.

    Attributes:
        values: (members, outputs, signals), NaN beyond where each member has `ended`.
        status, steps, rejected: of each member.
        lanes: how many members go side by side.
        rounds: how often they stepped together; tried: their steps, at most `lanes` a round.
        messages: why members failed.
        events: rows of member, instant, change, whether it stays, impulse, those of a member in their order.
        crossings: rows of member, whether a segment begins, instant, constants, signals: where members begin,
            and before and after what happens on their way; None if that is not wanted.
    """

    values: Array
    ended: Array
    status: Integers
    steps: Integers
    rejected: Integers
    lanes: int
    rounds: int = 0
    tried: int = 0
    messages: dict[int, str] = field(default_factory=dict)
    events: list[Array] = field(default_factory=list)
    crossings: list[Array] | None = None

    @classmethod
    def blank(cls, members: int, outputs: Array, signals: int, lanes: int, crossings: bool = False) -> Told:
        """Return what is told of members that have not begun."""
        status, steps, rejected = np.zeros((3, members), dtype=np.int64)
        values = np.full((members, len(outputs), signals), np.nan)
        told = cls(values, np.full(members, outputs[0]), status, steps, rejected, lanes)
        return replace(told, crossings=[]) if crossings else told

    def take_over(self, places: Integers | range, other: Told) -> None:
        """Take over what is told of the members at those places."""
        for name in ("values", "ended", "status", "steps", "rejected"):
            getattr(self, name)[places] = getattr(other, name)
        self.rounds += other.rounds
        self.tried += other.tried
        self.messages |= {int(places[k]): text for k, text in other.messages.items()}
        of_member = np.asarray(places)
        for own, rows in ((self.events, other.events), (self.crossings, other.crossings)):
            if own is not None:
                own += [np.column_stack([of_member[r[:, 0].astype(int)], r[:, 1:]]) for r in rows or ()]
