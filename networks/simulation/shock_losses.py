"""Shocks of contacts in the energy book: each takes its impulse times the mean of its speeds around it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ...base import Array
from ..reduction.transitions import Change, Switching
from .events.switcher import Event, Switcher
from .point import Point

if TYPE_CHECKING:
    from ..results.result import Result

REST_SHARE = 1e-9  # of what impulses do to speeds, below which a contact rests


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
    striking = {switching.mode_names[c.mode]: c for c in switching.changes if c.impulse is not None}
    switcher: Switcher | None = None
    for first, last in clusters:
        events = [e for e in result.events if e.impulse is not None and e.time == result.time[first]]
        contacts = [e for e in events if e.mode in striking]
        if not contacts:
            continue
        switcher = switcher or Switcher(result.closed)
        changes = [striking[event.mode] for event in contacts]
        points = result.points
        point = Point(float(points.t[first]), points.x[first], points.z[first], points.q[first])
        during = switcher.during(point)
        impulses = np.zeros(len(switching.impulse_names))
        np.add.at(impulses, [int(c.impulse or 0) for c in changes], [e.impulse or 0.0 for e in contacts])
        alone = len(contacts) == len(events)
        losses = _losses(switcher, point, during, contacts, changes) if alone else {}
        yield ContactShocks(first, last, during, impulses, losses)


def _losses(
    switcher: Switcher, point: Point, during: Point, contacts: list[Event], changes: list[Change]
) -> dict[str, float]:
    """Return what each contact took.

    Shocks of one instant follow each other, so that the speeds between them are found from what impulses do
    to speeds. Contacts that share a shock, so that all of them end up held, act at once.
    """
    speeds, effect = _speeds(switcher, point, during, changes)
    losses: dict[str, float] = {}
    together: list[int] = []
    for k, event in enumerate(contacts):
        together.append(k)
        impulses = np.zeros(len(contacts))
        impulses[together] = [contacts[other].impulse for other in together]
        after = speeds + effect @ impulses
        held = event.target in _held(switcher.switching, changes[k].mode)
        if held and np.abs(after[together]).max() > REST_SHARE * np.abs(effect @ np.abs(impulses)).max():
            continue
        for other in together:
            path = contacts[other].mode.rpartition(".")[0]
            lost = -float(impulses[other] * (speeds[other] + after[other]) / 2)
            losses[path] = losses.get(path, 0.0) + lost
        speeds, together = after, []
    return losses


def _held(switching: Switching, mode: int) -> set[str]:
    """Return the values of a mode in which a contact holds, which shocks are shared by."""
    return {switching.mode_values[mode][value] for value in switching.in_shock[mode]}


def _speeds(switcher: Switcher, point: Point, during: Point, changes: list[Change]) -> tuple[Array, Array]:
    """Return the speeds of contacts before a shock, and by how much impulses change them."""
    functions = switcher.functions
    everything = functions.everything(point.x, point.z, point.q, point.t)[0]
    assert functions.shock is not None
    response, slopes = functions.shock(during.x, during.z, during.q, during.t)
    response = response.reshape(len(switcher.switching.impulse_names), -1)
    slopes = slopes.reshape(-1, len(everything)).T
    places = [change.velocity for change in changes]
    return everything[places], slopes[places] @ response[[change.impulse for change in changes]].T
