"""Agreement: a course against another, in outputs and in the instants of events."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ...base import Array, Flags
from .probe import CheckedFMU, Probe
from .report import MOTION, Finding, measured
from .runs import Course, Scenario

EVENT_TOLERANCE = 1e-6  # of an instant [s]
EVENT_SPACING = 10 * EVENT_TOLERANCE  # that two need to be told apart by steps [s]
JUMP_SHARE = 0.05  # of a variable's size, by which a step shows an event
BISECTED_EVENTS = 20
MOTION_SHARE = 1e-6  # of a variable's size


@dataclass(frozen=True, eq=False)
class Reference:
    """What a course is compared with, on the same grid, and how large its variables get."""

    course: Course
    sizes: Array

    @staticmethod
    def of(course: Course, nominals: Array) -> Reference:
        """Return a course with the sizes that it shows itself."""
        return Reference(course, sizes(course.values, nominals))


def sizes(values: Array, nominals: Array) -> Array:
    """Return how large each variable gets, at least a ten-thousandth of what is nominal."""
    found: Array = np.maximum(np.abs(values).max(axis=0, initial=0.0), 1e-4 * nominals)
    return found


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


def motion_findings(subject: str, reference: Reference) -> Iterator[Finding]:
    """Yield a finding if nothing moves, so that there is little in what agrees."""
    course = reference.course
    if not course.names:
        told = "the FMU shows no output and no state: nothing is compared; give outputs= that move"
        yield Finding(subject, MOTION, None, told=told)
    elif not (np.ptp(course.values, axis=0) > MOTION_SHARE * reference.sizes).any():
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
    differ: Flags = np.not_equal(found.values, wanted.values) & apart[:, None]
    told = f"{len(found.names)} modes"
    agree: Flags = np.all(_shares(course, reference) <= limit, axis=1)
    if differ.any():
        points, columns = np.nonzero(differ)
        first, last = (float(course.time[k]) for k in (points[0], points[-1]))
        among = "where states and rates agree" if agree[points].all() else "and not only in name"
        told = f"{found.names[columns[0]]} differs between {first:.6g} and {last:.6g} s, {among}"
    return measured(subject, "modes", float((differ.any(axis=1) & ~agree).sum()), 0, told)


def _apart(course: Course, reference: Reference) -> Flags:
    """Return which points lie apart from events."""
    apart = np.ones(len(course.time), dtype=bool)
    for events in (reference.course.events, course.events):
        if events is not None and len(events):
            apart &= np.abs(course.time[:, None] - events[None, :]).min(axis=1) > EVENT_TOLERANCE
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
        return measured(subject, "events", 0.0, EVENT_TOLERANCE, told)
    if not len(found):
        return Finding(subject, "events", False, np.inf, EVENT_TOLERANCE, f"none of {len(wanted)} events")
    distances = np.abs(wanted[:, None] - found[None, :]).min(axis=1)
    worst = int(np.argmax(distances))
    told = f"s, of {len(wanted)} events the one at {wanted[worst]:.9g} s"
    return measured(subject, "events", distances.max(), EVENT_TOLERANCE, told)


def bisected_finding(
    fmu: CheckedFMU, scenario: Scenario, reference: Reference, events: Array, before: Array, after: Array
) -> Finding:
    """Locate events in Co-Simulation without event mode, by bisection from a saved state.

    Only events apart from others are looked for, and each by the variable that jumps most there, `before` and
    `after` being the values right beside the events.
    """
    label, names = fmu.label("CS"), reference.course.names
    gaps = np.diff([scenario.begin, *events, scenario.stop])
    widths = 0.2 * np.minimum(np.minimum(gaps[1:], gaps[:-1]), scenario.step)
    jumps = np.abs(after - before) / reference.sizes
    chosen = np.flatnonzero((widths > EVENT_SPACING) & (jumps.max(axis=1, initial=0) > JUMP_SHARE))
    if not len(chosen):
        return Finding(label, "events", None, told=f"none of {len(events)} events can be told apart by steps")
    picked = np.unique(chosen[np.linspace(0, len(chosen) - 1, BISECTED_EVENTS).astype(int)]).tolist()
    missed: dict[int, float] = {}
    t, grid = scenario.begin, scenario.grid
    with Probe(fmu, "CS") as probe:
        probe.begin(scenario.begin, scenario.stop, scenario.rtol, scenario.inputs)
        for k in picked:
            start, stop = (float(events[k] + side * widths[k]) for side in (-1, 1))
            for target in (*grid[(grid > t) & (grid < start)].tolist(), start):
                probe.advance(t, target)
                t = target
            column = int(np.argmax(jumps[k]))
            sides = before[k, column], after[k, column]
            missed[k] = abs(_bisected(probe, names[column], t, stop, sides) - float(events[k]))
    worst = max(missed, key=missed.__getitem__)
    told = f"s, of {len(picked)} events the one at {events[worst]:.9g} s"
    return measured(label, "events", missed[worst], EVENT_TOLERANCE, told)


def _bisected(probe: Probe, name: str, begin: float, high: float, sides: tuple[float, float]) -> float:
    """Return when a variable leaves the one side for the other."""
    state, low = probe.save_state(), begin
    while high - low > 1e-9 * max(1.0, abs(high)):
        middle = 0.5 * (low + high)
        probe.restore_state(state)
        probe.advance(begin, middle)
        value = probe.values([name])[0]
        if abs(value - sides[0]) < abs(value - sides[1]):
            low = middle
        else:
            high = middle
    probe.restore_state(state)
    probe.free_state(state)
    return high
