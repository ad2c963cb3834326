"""Passages: from one segment of a run to the next, and the transitions that fired in between."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from ...base import Array
from ..dae import DAE
from ..results.result import Result
from ..simulation.events.switcher import Event

Instant = tuple[Array, Array, Array, float]


@dataclass(frozen=True, eq=False)
class Passage:
    """The last point (x, z, q, t) of a segment, the first of the next, and what fired between.

    `changes` holds, for each event, the numbers of the transitions that look like it.
    """

    before: Instant
    after: Instant
    changes: list[list[int]]


def passages(result: Result) -> Iterator[Passage]:
    """Yield the passages of a run in order."""
    dae, segments, events = result.dae, result.segments, list(result.events)
    modes_at = slice(dae.p.numel(), dae.p.numel() + dae.modes.numel())
    for last, following in pairwise(segments):
        before = (last.states[-1][-1], last.algebraic[-1][-1], last.q, float(last.times[-1][-1]))
        after = (following.states[0][0], following.algebraic[0][0], following.q, float(following.times[0][0]))
        while events and events[0].time < after[3]:
            del events[0]
        modes, changes = before[2][modes_at].copy(), []
        while events and events[0].time == after[3]:
            alike = _alike(dae, events.pop(0))
            changes.append(alike)
            modes[dae.switching.changes[alike[0]].mode] = dae.switching.changes[alike[0]].target
            if np.array_equal(modes, after[2][modes_at]):
                break
        yield Passage(before, after, changes)


def _alike(dae: DAE, event: Event) -> list[int]:
    """Return the transitions of the mode, from and to the values, that an event tells of."""
    switching = dae.switching
    mode = switching.mode_names.index(event.mode)
    values = switching.mode_values[mode]
    wanted = (mode, values.index(event.source), values.index(event.target))
    return [n for n, c in enumerate(switching.changes) if (c.mode, c.source, c.target) == wanted]
