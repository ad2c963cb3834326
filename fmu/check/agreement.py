"""Agreement: a course against another, in outputs and in the instants of events."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...base import Array
from .probe import Probe, Subject
from .report import MOTION, Finding, measured
from .runs import Course, Experiment

EVENTS = 1e-6
LONELY = 10 * EVENTS
SEEN = 0.05
MOST_BISECTED = 20
STANDS = 1e-6


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
    shares = _shares(course, reference)
    if not shares.size:
        return Finding(subject, "outputs", None, told="there is nothing to compare")
    row, column = np.unravel_index(np.argmax(shares), shares.shape)
    where = f"{course.names[int(column)]} at {course.time[row]:.6g} s"
    told = f"of size, {where}; {shares.shape[1]} variables{course.solver and f'; {course.solver}'}"
    return measured(subject, "outputs", shares.max(), limit, told)


def motion_findings(subject: str, course: Course, size: Array) -> Iterator[Finding]:
    """Yield a finding if nothing moves, so that there is little in what agrees."""
    if not course.names:
        told = "the FMU shows no output and no state: nothing is compared; give outputs= that move"
        yield Finding(subject, MOTION, None, told=told)
    elif not (np.ptp(course.values, axis=0) > STANDS * size).any():
        told = (
            f"nothing moves: each of {len(course.names)} variables is constant; give inputs=, start= or stop="
        )
        yield Finding(subject, MOTION, None, told=told)


def modes_finding(
    subject: str, modes: tuple[Course, Course], course: Course, reference: Reference, limit: float
) -> Finding:
    """Return at how many points modes differ.

    A mode may differ where states and rates agree: a body that creeps to rest under friction is "sliding"
    or "stuck" as the last digit has it, and moves the same.
    """
    found, wanted = modes
    apart = _apart(course, reference)
    differ: NDArray[np.bool_] = np.not_equal(found.values, wanted.values) & apart[:, None]
    told = f"{len(found.names)} modes"
    agree: NDArray[np.bool_] = np.all(_shares(course, reference) <= limit, axis=1)
    if differ.any():
        points, columns = np.nonzero(differ)
        first, last = (float(course.time[k]) for k in (points[0], points[-1]))
        among = "where states and rates agree" if agree[points].all() else "and not only in name"
        told = f"{found.names[columns[0]]} differs between {first:.6g} and {last:.6g} s, {among}"
    return measured(subject, "modes", float((differ.any(axis=1) & ~agree).sum()), 0, told)


def _apart(course: Course, reference: Reference) -> NDArray[np.bool_]:
    """Return which points lie apart from events."""
    apart = np.ones(len(course.time), dtype=bool)
    for events in (reference.course.events, course.events):
        if events is not None and len(events):
            apart &= np.abs(course.time[:, None] - events[None, :]).min(axis=1) > EVENTS
    return apart


def _shares(course: Course, reference: Reference) -> Array:
    """Return differences as shares of the sizes of variables."""
    shares: Array = np.abs(course.values - reference.course.values) / reference.sizes
    shares[~_apart(course, reference)] = 0
    shares[~np.isfinite(shares)] = np.inf
    return shares


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
    subject: Subject, experiment: Experiment, reference: Reference, before: Array, after: Array
) -> Finding:
    """Find the instants of events in Co-Simulation without event mode, by steps from a saved state.

    Args:
        subject: the FMU.
        experiment: what is run.
        reference: where the events should be, those apart from others being looked for; and variables to
            tell by whether one has happened.
        before: their values right before each event.
        after: and right after.
    """
    label, names, events = subject.label("CS"), reference.course.names, reference.events
    widths = _widths(events, experiment)
    jumps = np.abs(after - before) / reference.sizes
    chosen = np.flatnonzero((widths > LONELY) & (jumps.max(axis=1, initial=0) > SEEN))
    if not len(chosen):
        return Finding(label, "events", None, told=f"none of {len(events)} events can be told apart by steps")
    picked = np.unique(chosen[np.linspace(0, len(chosen) - 1, MOST_BISECTED).astype(int)]).tolist()
    worst, place, t = -1.0, 0, experiment.begin
    with subject.probe("CS") as probe:
        probe.begin(experiment.begin, experiment.stop, experiment.rtol, experiment.inputs)
        for k in picked:
            column = int(np.argmax(jumps[k]))
            start = float(events[k] - widths[k])
            for target in experiment.grid:
                if t < target < start:
                    probe.advance(t, float(target))
                    t = float(target)
            probe.advance(t, start)
            t = start
            sides = before[k, column], after[k, column]
            found = _bisected(probe, names[column], t, t + 2 * float(widths[k]), sides)
            missed = abs(found - float(events[k]))
            if missed > worst:
                worst, place = missed, k
    told = f"s, of {len(picked)} events the one at {events[place]:.9g} s"
    return measured(label, "events", worst, EVENTS, told)


def _widths(events: Array, experiment: Experiment) -> Array:
    """Return how far around each event it is looked for: not as far as its neighbours."""
    gaps = np.diff(np.concatenate([[experiment.begin], events, [experiment.stop]]))
    nearest: Array = np.minimum(np.minimum(gaps[1:], gaps[:-1]), experiment.step)
    return 0.2 * nearest


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
