"""Agreement: a course against another, in outputs and in the instants of events."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .check_probe import Probe, Subject
from .check_report import Finding, measured
from .check_runs import Course, Experiment

Array = NDArray[np.float64]
EVENTS = 1e-6
SETTLED = 1e-9
SEEN = 0.05
MOST_BISECTED = 20


@dataclass(frozen=True, eq=False)
class Reference:
    """What a course is compared with: values on the same grid, their sizes, and the instants of events."""

    course: Course
    sizes: Array

    @property
    def events(self) -> Array:
        """Instants of events."""
        return np.zeros(0) if self.course.events is None else self.course.events


def outputs_finding(subject: str, course: Course, reference: Reference, limit: float) -> Finding:
    """Return the greatest difference of any variable, as a share of its size.

    Points closer to an event than the tolerance of its instant are left out.
    """
    time, wanted = reference.course.time, reference.course.values
    apart = np.ones(len(time), dtype=bool)
    for events in (reference.course.events, course.events):
        if events is not None and len(events):
            apart &= np.abs(time[:, None] - events[None, :]).min(axis=1) > EVENTS
    shares = np.abs(course.values - wanted) / reference.sizes
    shares[~apart] = 0
    if not shares.size:
        return Finding(subject, "outputs", None, told="there is nothing to compare")
    shares[~np.isfinite(shares)] = np.inf
    row, column = np.unravel_index(np.argmax(shares), shares.shape)
    told = f"of size, {course.names[column]} at {time[row]:.6g} s; {shares.shape[1]} variables"
    return measured(subject, "outputs", shares.max(), limit, told)


def events_finding(subject: str, found: Array, wanted: Array) -> Finding:
    """Return the greatest distance of an event from the one that should be there."""
    if not len(wanted):
        told = f"{len(found)} events that change nothing" if len(found) else "no events"
        return measured(subject, "events", 0.0, EVENTS, told)
    if not len(found):
        return Finding(subject, "events", False, np.inf, EVENTS, f"none of {len(wanted)} events")
    distances = np.abs(wanted[:, None] - found[None, :]).min(axis=1)
    worst = int(np.argmax(distances))
    told = f"s, of {len(wanted)} events the one at {wanted[worst]:.9g} s"
    return measured(subject, "events", distances.max(), EVENTS, told)


def bisected_finding(
    subject: Subject, names: Sequence[str], experiment: Experiment, before: Array, after: Array, events: Array
) -> Finding:
    """Find the instants of events in Co-Simulation without event mode, by steps from a saved state.

    Args:
        subject: the FMU.
        names: variables to tell by whether an event has happened.
        experiment: what is run.
        before: their values right before each event.
        after: and right after.
        events: where the events should be; those that lie alone are looked for.
    """
    label = subject.label("CS")
    width = 0.2 * experiment.step
    lonely = _lonely(events, width, experiment)
    sizes = np.maximum(np.abs(before).max(axis=0, initial=0), np.abs(after).max(axis=0, initial=0)) + 1e-300
    jumps = np.abs(after - before) / sizes
    chosen = [k for k in lonely if jumps[k].max(initial=0) > SEEN]
    picked = sorted({chosen[i] for i in np.linspace(0, len(chosen) - 1, MOST_BISECTED).astype(int)} if chosen else ())
    if not picked:
        return Finding(label, "events", None, told=f"none of {len(events)} events can be told apart by steps")
    worst, place, t = -1.0, 0, experiment.begin
    with subject.probe("CS") as probe:
        probe.begin(experiment.begin, experiment.stop, experiment.rtol, experiment.inputs)
        for k in picked:
            column = int(np.argmax(jumps[k]))
            start = float(events[k] - width)
            for target in experiment.grid:
                if t < target < start:
                    probe.advance(t, float(target))
                    t = float(target)
            probe.advance(t, start)
            t = start
            sides = before[k, column], after[k, column]
            found = _bisected(probe, names[column], t, t + 2 * width, sides)
            if abs(found - events[k]) > worst:
                worst, place = abs(found - events[k]), k
    told = f"s, of {len(picked)} events the one at {events[place]:.9g} s"
    return measured(label, "events", worst, EVENTS, told)


def _lonely(events: Array, width: float, experiment: Experiment) -> list[int]:
    edges = np.concatenate([[experiment.begin], events, [experiment.stop]])
    gaps = np.diff(edges)
    return [k for k in range(len(events)) if min(gaps[k], gaps[k + 1]) > 2.5 * width]


def _bisected(probe: Probe, name: str, t: float, high: float, sides: tuple[float, float]) -> float:
    """Return when a variable leaves the one side for the other."""
    state, low, begin = probe.kept(), t, t
    while high - low > 1e-9 * max(1.0, abs(high)):
        middle = 0.5 * (low + high)
        probe.back(state)
        probe.advance(begin, middle)
        value = probe.values([name])[0]
        if abs(value - sides[0]) < abs(value - sides[1]):
            low = middle
        else:
            high = middle
    probe.back(state)
    probe.forget(state)
    return high
