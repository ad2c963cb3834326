"""A run in words: where it started and why, how it went, what it wants to be known."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

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
        *_table("states", STATE_HEADERS, state_rows(result), {2, 4, 5, 6}, len(result.initial)),
        *_table("events", EVENT_HEADERS, event_rows(result), {0}, len(result.events)),
        *(f"note: {note}" for note in result.notes),
    ]
    return "\n".join(lines)


def figures(result: Result, names: Iterable[str]) -> dict[str, Any]:
    """Return what a run's summary tells as plain values, of the signals of some names, too."""
    decided = {decision.name: decision.reason for decision in result.initial}
    signals = {name: _extremes(result, name) for name in dict.fromkeys([*decided, *names])}
    for name, reason in decided.items():
        signals[name]["decided"] = reason
    return {
        "network": result.name,
        "begin": float(result.time[0]),
        "end": float(result.time[-1]),
        "points": len(result.time),
        "signals": signals,
        "events": [asdict(event) for event in result.events],
        "statistics": result.stats,
        "notes": result.notes,
    }


def _extremes(result: Result, name: str) -> dict[str, Any]:
    values = result[name]
    told = {"first": values[0], "least": values.min(), "largest": values.max(), "last": values[-1]}
    return {"unit": result.unit(name)} | {word: float(value) for word, value in told.items()}


def state_rows(result: Result) -> list[tuple[str, ...]]:
    """Return name, unit, start, how it was decided, least, largest and last value of the states."""
    rows: list[tuple[str, ...]] = []
    for decision in result.initial[:MOST_STATES]:
        values = result[decision.name]
        start, *others = (f"{v:.5g}" for v in (decision.value, values.min(), values.max(), values[-1]))
        rows.append((decision.name, decision.unit, start, decision.reason, *others))
    return rows


def event_rows(result: Result) -> list[tuple[str, str, str]]:
    """Return time, component and what changed, of the first events."""
    rows = []
    for event in result.events[:MOST_EVENTS]:
        impulse = f", impulse {event.impulse:.5g}" if event.impulse is not None else ""
        rows.append((f"{event.time:.6g}", event.component, f"{event.source} → {event.target}{impulse}"))
    return rows


def _table(
    what: str, headers: tuple[str, ...], rows: Sequence[tuple[str, ...]], right: set[int], count: int
) -> Iterator[str]:
    if rows:
        yield ""
        yield from aligned([headers, *rows], right=right)
    if rows and count > len(rows):
        yield f"and {count - len(rows)} more {what}"
