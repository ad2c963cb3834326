"""Shocks of contacts in the energy book: each takes its impulse times the mean of its speeds around it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ...base import Array
from ..reduction.transitions import Change
from .events.switcher import Event, Switcher
from .point import Point

if TYPE_CHECKING:
    from ..results.result import Result

INSTANT_ULPS = 64
REST_SHARE = 1e-6  # of speeds, below which contacts have the speeds that their shocks want


@dataclass(frozen=True, eq=False)
class ContactShocks:
    """The shocks of contacts at one instant.

    Attributes:
        first, last: the points before and after them.
        during: the point before, with the modes that hold while they act.
        impulses: by the number of each impulse of the network, their sum [N.s, N.m.s].
        losses: what contacts took, by path [J].
    """

    first: int
    last: int
    during: Point
    impulses: Array
    losses: dict[str, float]


def contact_shocks(result: Result, clusters: list[tuple[int, int]]) -> Iterator[ContactShocks]:
    """Yield the shocks of contacts, instant by instant.

    Where a prescribed motion jumps, contacts pass that on as one body, which loses nothing.
    """
    switching = result.dae.switching
    striking = {
        (switching.mode_names[c.mode], switching.mode_values[c.mode][c.target]): c
        for c in switching.changes
        if c.impulse is not None
    }
    switcher: Switcher | None = None
    for first, last in clusters:
        events = shocks_at(result, first)
        contacts = [e for e in events if (e.mode, e.target) in striking]
        if not contacts:
            continue
        switcher = switcher or Switcher(result.closed)
        changes = [striking[event.mode, event.target] for event in contacts]
        points = result.points
        point = Point(float(points.t[first]), points.x[first], points.z[first], points.q[first])
        during = switcher.during(point)
        impulses = np.zeros(len(switching.impulse_names))
        np.add.at(impulses, [int(c.impulse or 0) for c in changes], [e.impulse or 0.0 for e in contacts])
        alone = len(contacts) == len(events)
        losses = _losses(switcher, point, during, contacts, changes) if alone else {}
        yield ContactShocks(first, last, during, impulses, losses)


def shocks_at(result: Result, point: int) -> list[Event]:
    """Return the events with an impulse at the instant of a point, which rounding may move."""
    time = float(result.time[point])
    slack = INSTANT_ULPS * np.spacing(abs(time))
    return [e for e in result.events if e.impulse is not None and abs(e.time - time) <= slack]


def _losses(
    switcher: Switcher, point: Point, during: Point, contacts: list[Event], changes: list[Change]
) -> dict[str, float]:
    """Return what each contact took.

    Shocks of one instant follow each other. Those act at once which bring their contacts to the speeds that
    they want together, by what impulses do to states.
    """
    functions = switcher.functions
    assert functions.shock is not None
    response = functions.shock(during.x, during.z, during.q, during.t)[0]
    response = response.reshape(len(switcher.switching.impulse_names), -1)
    velocities, wishes = [c.velocity for c in changes], [c.after for c in changes]
    pushes = (
        np.array([event.impulse for event in contacts])[:, None]
        * response[[int(c.impulse or 0) for c in changes]]
    )
    losses: dict[str, float] = {}
    together: list[int] = []
    x = point.x
    for k in range(len(contacts)):
        together.append(k)
        before = functions.everything(x, point.z, point.q, point.t)[0]
        moved = x + pushes[together].sum(axis=0)
        after = functions.everything(moved, point.z, point.q, point.t)[0][velocities]
        missed = np.abs(after - before[wishes])[together].max()
        if missed > REST_SHARE * np.abs(before[velocities]).max() and k + 1 < len(contacts):
            continue
        for other in together:
            path = contacts[other].mode.rpartition(".")[0]
            mean = float(before[velocities][other] + after[other]) / 2
            losses[path] = losses.get(path, 0.0) - (contacts[other].impulse or 0.0) * mean
        x, together = moved, []
    return losses
