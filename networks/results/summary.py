"""A run in words: where it started and why, how it went, what it wants to be known."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from ...base import aligned

if TYPE_CHECKING:
    from .result import Result

MOST_STATES = 20
MOST_EVENTS = 12
STATE_HEADERS = ("state", "unit", "start", "decided", "least", "largest", "last")
EVENT_HEADERS = ("time [s]", "component", "event")


def summary(result: Result) -> str:
    """Return a run's states, events, statistics and notes as text."""
    stats = result.stats
    lines = [
        f"{result.name}: {result.time[0]:g} to {result.time[-1]:g} s, {len(result.time)} points",
        f"{stats['solver']}: {stats['steps']} steps in {stats['integrator calls']} calls, "
        f"{stats['events']} events, {stats['seconds']:.3g} s",
        *_states(result),
        *_events(result),
        *(f"note: {note}" for note in result.notes),
    ]
    return "\n".join(lines)


def state_rows(result: Result) -> list[tuple[str, ...]]:
    """Return name, unit, start, how it was decided, least, largest and last value of the states."""
    rows: list[tuple[str, ...]] = []
    for decision in result.initial[:MOST_STATES]:
        values = result[decision.name]
        numbers = (f"{v:.5g}" for v in (decision.value, values.min(), values.max(), values[-1]))
        start, least, largest, last = numbers
        rows.append((decision.name, decision.unit, start, decision.reason, least, largest, last))
    return rows


def event_rows(result: Result) -> list[tuple[str, str, str]]:
    """Return time, component and what changed, of the first events."""
    return [
        (
            f"{event.time:.6g}",
            event.component,
            f"{event.source} → {event.target}"
            + (f", impulse {event.impulse:.5g}" if event.impulse is not None else ""),
        )
        for event in result.events[:MOST_EVENTS]
    ]


def _states(result: Result) -> Iterator[str]:
    rows = state_rows(result)
    if not rows:
        return
    yield ""
    yield from aligned([STATE_HEADERS, *rows], right={2, 4, 5, 6})
    yield from _more(len(result.initial) - len(rows), "states")


def _events(result: Result) -> Iterator[str]:
    rows = event_rows(result)
    if not rows:
        return
    yield ""
    yield from aligned([EVENT_HEADERS, *rows], right={0})
    yield from _more(len(result.events) - len(rows), "events")


def _more(count: int, what: str) -> Iterator[str]:
    if count > 0:
        yield f"and {count} more {what}"
