"""Saltation matrices: what switching of modes does to small changes of the states."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Any
from weakref import WeakKeyDictionary

import casadi as ca
import numpy as np

from ...base import Array
from ..flattening.vectors import pick
from .jacobians import Points, Slopes

if TYPE_CHECKING:
    from ..dae import DAE
    from ..results.result import Result
    from ..simulation.bound_dae import BoundDAE

GRAZING_RATE = 1e-9
Instant = tuple[float, Array, Array, Array]


@dataclass(frozen=True, eq=False)
class Passage:
    """The last point (t, x, z, q) of a segment, the first of the next, and what fired between.

    `changes` holds, for each event, the numbers of the transitions that look like it.
    """

    before: Instant
    after: Instant
    changes: list[list[int]]


def passages(result: Result) -> Iterator[tuple[int, Passage]]:
    """Yield the passages of a run at which modes switch, in order, with the number of the segment before.

    Where inputs jump and nothing switches, changes of the states pass as they are.
    """
    dae, events = result.dae, deque(result.events)
    modes_at = slice(dae.p.numel(), dae.p.numel() + dae.modes.numel())
    transitions = _transitions(dae)
    for number, (last, following) in enumerate(pairwise(result.segments)):
        begin = following.begin
        while events and events[0].time < begin:
            events.popleft()
        modes, reached, changes = last.q[modes_at].tolist(), following.q[modes_at].tolist(), []
        while events and events[0].time == begin:
            event = events.popleft()
            alike = transitions[event.mode, event.source, event.target]
            changes.append(alike)
            modes[dae.switching.changes[alike[0]].mode] = dae.switching.changes[alike[0]].target
            if modes == reached:
                break
        if changes:
            yield number, Passage(last.point(-1), following.point(0), changes)


def _transitions(dae: DAE) -> dict[tuple[str, str, str], list[int]]:
    """Return the transitions by mode and by the values that they lead from and to."""
    switching = dae.switching
    found: dict[tuple[str, str, str], list[int]] = {}
    for number, change in enumerate(switching.changes):
        values = switching.mode_values[change.mode]
        key = switching.mode_names[change.mode], values[change.source], values[change.target]
        found.setdefault(key, []).append(number)
    return found


class SaltationMatrices:
    """The saltation matrices by which changes of states, parameters and inputs pass instants of switching.

    With g = 0 where modes switch, r what a transition resets, e what it is reset to, and ' along the motion,

        dt = -dg/g',   dx+ = dx + R^+ (de + e' dt - dr - r' dt) + (x'- - x'+) dt,

    R^+ being the pseudo-inverse of the slope of r in the states.
    """

    def __init__(self, dae: DAE, columns: Any) -> None:
        self.dae = dae
        first = dae.switching.expressions.numel()
        resets = sorted({reset[0] for change in dae.switching.changes for reset in change.resets})
        self._row = {root: first + n for n, root in enumerate(resets)}
        self._expressions = ca.vertcat(dae.switching.expressions, pick(dae.variables, resets))
        self._slopes = Slopes(dae, self._expressions, columns)
        self._instants: WeakKeyDictionary[BoundDAE, Any] = WeakKeyDictionary()

    def __call__(self, closed: BoundDAE, passages: Sequence[Passage]) -> Array:
        """Return, for each passage, the states after by (states, parameters, inputs) before."""
        before, after = (
            Points(closed, *map(np.array, zip(*ends, strict=True)))
            for ends in ([p.before for p in passages], [p.after for p in passages])
        )
        nx = self.dae.x.numel()
        wide = np.concatenate(self._slopes(before), axis=2)
        values, rates, motion = self._instant(closed, before)
        found = np.tile(np.eye(nx, wide.shape[2]), (len(passages), 1, 1))
        fired = [self._fired(p, own) for p, own in zip(passages, values, strict=True)]
        at = np.arange(len(passages)), [self.dae.switching.changes[own[0]].indicator for own in fired]
        rate = rates[at]
        per_rate = np.where(np.abs(rate) > GRAZING_RATE, -1 / np.where(rate == 0, 1.0, rate), 0.0)
        later = per_rate[:, None] * wide[at]
        moved = wide + rates[:, :, None] * later[:, None]
        slid = motion - self._instant(closed, after)[2]
        self._reset(found, wide[:, :, :nx], moved, fired)
        found += slid[:, :, None] * later[:, None]
        return found

    def _fired(self, passage: Passage, values: Array) -> list[int]:
        """Return the transitions that fired: of those that look like an event, the one at its zero."""
        indicator = [change.indicator for change in self.dae.switching.changes]
        return [min(alike, key=lambda n: abs(values[indicator[n]])) for alike in passage.changes]

    def _reset(self, found: Array, to_x: Array, moved: Array, fired: Sequence[Sequence[int]]) -> None:
        """Add what resets do, passages with as many of them together."""
        changes = self.dae.switching.changes
        resets = [{r[0]: r for n in numbers for r in changes[n].resets}.values() for numbers in fired]
        for count in {len(one) for one in resets} - {0}:
            which = np.array([n for n, one in enumerate(resets) if len(one) == count])
            rows, signs, places = (
                np.array([[entry[k] for entry in resets[n]] for n in which]) for k in range(3)
            )
            rows = np.vectorize(self._row.__getitem__)(rows)
            at = which[:, None]
            missed = signs[:, :, None] * moved[at, places] - moved[at, rows]
            found[which] += np.linalg.pinv(to_x[at, rows], rcond=1e-10) @ missed

    def _instant(self, closed: BoundDAE, points: Points) -> tuple[Array, Array, Array]:
        """Return the expressions, their rates and the rates of the states, each (points, rows)."""
        if closed not in self._instants:
            own, motion = closed.close(self._expressions), closed.close(self.dae.ode)
            self._instants[closed] = closed.function("instant", own, closed.rate(own), motion)
        found = self._instants[closed](points.x.T, points.z.T, points.q.T, points.t[None])
        values, rates, motion = (m.full().T for m in found)
        return values, rates, motion
