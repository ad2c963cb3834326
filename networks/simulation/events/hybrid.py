"""Runs with events: integrate, watch for crossings, land on the first, switch, go on."""

from __future__ import annotations

from collections import deque

import numpy as np

from ....base import Array, SimulationError
from ..integrator import IntegratorError, Stepper, Stretch
from ..point import Point
from ..progress import Progress
from ..run import Run, attempt, enter_next_leg, integrate, record_here
from .constants import CHATTER_COUNT, CHATTER_WINDOW, CROWD_COUNT, HOP, NARROWEST
from .functions import NODES as NODES
from .root_finding import Crossing, first_crossing, followed
from .short_steps import hopped
from .stride import FINE, LEAST, Pace
from .switcher import Switcher

RESOLUTION = 1e-12
RESOLVING = NODES / 4
MOST_STEPS = 500


def run_hybrid(
    run: Run, switcher: Switcher, stepper: Stepper, outputs: Array, progress: Progress, first: bool = False
) -> None:
    """Integrate between events, at a pace that keeps calls few and crossings visible; maybe to the first."""
    pace = Pace(outputs)
    recent: deque[float] = deque(maxlen=CROWD_COUNT)
    while pace.next < len(outputs) and not (first and run.events):
        if enter_next_leg(run):
            pace.entered(run)
            continue
        point = run.point
        delay, indicator = switcher.indicators.soonest(point)
        if _hop(run, switcher, delay, indicator, pace):
            pace.limit = np.inf
            _watch_chatter(run, recent, pace.interval)
            continue
        end, intervals = pace.stretch(point.t, delay, run.leg.end, RESOLVING * run.max_step)
        span = end - point.t
        stretch = _tried(run, stepper, span, pace)
        if stretch is None:
            pace.failed(end, intervals)
            continue
        times = point.t + span * np.arange(stepper.nodes + 1) / stepper.nodes
        crossing, follows = _crossing(run, switcher, times, stretch)
        if pace.exponent > LEAST and not (follows and _plain(switcher, point, times, crossing, pace)):
            pace.retry(intervals)
            continue
        kept = stepper.nodes if crossing is None else crossing[0]
        pace.next = _record_outputs(run, outputs, pace.next, intervals, stretch, kept)
        if crossing is None:
            run.point = Point(end, stretch.states[-1], stretch.algebraic[-1], point.q)
            pace.passed()
        else:
            pace.crossed()
            _land(run, switcher, stepper, times, stretch, crossing)
            _watch_chatter(run, recent, pace.interval)
        progress.at(run.point.t)


def _hop(run: Run, switcher: Switcher, delay: float, indicator: int, pace: Pace) -> bool:
    """Go to a crossing that is too near to integrate to; tell whether that was possible."""
    if delay >= HOP * pace.interval:
        return False
    later = hopped(switcher.indicators, run.point, delay, indicator, run.settings.tolerance)
    if later is None or later.t >= min(pace.outputs[pace.next], run.leg.end):
        return False
    _arrive(run, switcher, later, indicator)
    return True


def _tried(run: Run, stepper: Stepper, span: float, pace: Pace) -> Stretch | None:
    """Integrate a stretch; None if that fails, maybe beyond an event that a shorter one comes upon."""
    point = run.point
    try:
        return attempt(run, stepper, point, span)
    except IntegratorError:
        if pace.exponent > LEAST and span > RESOLUTION * abs(point.t):
            return None
        record_here(run)
        raise


def _plain(switcher: Switcher, point: Point, times: Array, crossing: Crossing | None, pace: Pace) -> bool:
    """Tell whether a stretch is short enough for its nodes to show what happens in it."""
    if crossing is not None and switcher.indicators.flat_at(point, crossing):
        return False
    return pace.exponent <= FINE or switcher.indicators.resolved(point, times)


def _crossing(run: Run, switcher: Switcher, times: Array, stretch: Stretch) -> tuple[Crossing | None, bool]:
    """Return the first crossing, and whether the nodes follow the indicators at all."""
    point = run.point
    x = np.vstack([point.x, stretch.states])
    z = np.vstack([point.z, stretch.algebraic])
    values, rates = switcher.indicators.watch_nodes(times, x, z, point.q)
    near = switcher.indicators.tolerance()
    switcher.indicators.muted &= values[:, -1] > -near
    watched = times, values, rates, switcher.indicators.active(point.q), near
    return first_crossing(*watched), followed(*watched)


def _record_outputs(run: Run, outputs: Array, first: int, intervals: int, stretch: Stretch, kept: int) -> int:
    """Record the nodes that are outputs, up to node `kept`; return the next output."""
    if not intervals:
        return first
    stride = len(stretch.states) // intervals
    count = kept // stride
    chosen = np.arange(1, count + 1) * stride - 1
    if count:
        times = outputs[first : first + count]
        run.record(times, stretch.states[chosen], stretch.algebraic[chosen])
    return first + count


def _land(
    run: Run,
    switcher: Switcher,
    stepper: Stepper,
    times: Array,
    stretch: Stretch,
    crossing: Crossing,
) -> None:
    """Integrate onto a crossing, fire what fires there and open the next segment."""
    node, indicator, t = crossing
    point = run.point
    x, z = point.x, point.z
    if node:
        x, z = stretch.states[node - 1], stretch.algebraic[node - 1]
    start = Point(float(times[node]), x.copy(), z.copy(), point.q)
    sought, end, earliest = indicator, float(times[node + 1]), np.inf
    landed, reached = _approach_crossing(run, switcher, stepper, start, end, t, sought)
    while (passed := switcher.indicators.passed(start, landed)) not in (None, sought) and landed.t < earliest:
        sought, earliest = passed, landed.t
        landed, reached = _approach_crossing(run, switcher, stepper, start, earliest, earliest, sought)
    _arrive(run, switcher, landed, sought if reached else None)


def _arrive(run: Run, switcher: Switcher, landed: Point, indicator: int | None) -> None:
    """Fire what fires where an indicator crosses, and open the next segment."""
    run.point = landed
    record_here(run)
    happened = switcher.settle(landed, forced=indicator)
    run.events += happened
    if happened:
        run.open_segment()
    elif indicator is not None:
        switcher.indicators.muted[indicator] = True


def _approach_crossing(
    run: Run,
    switcher: Switcher,
    stepper: Stepper,
    start: Point,
    end: float,
    t: float,
    indicator: int,
) -> tuple[Point, bool]:
    """Integrate from `start` onto the instant at which an indicator rises through zero.

    Return where this ends, and whether zero was reached: nodes can make believe in a crossing.
    """
    low, high = start.t, end
    g, rate = (float(m[indicator]) for m in switcher.indicators.watch(start))
    beyond = g > switcher.indicators.tolerance()[indicator] or (g >= 0 and rate < 0)
    while True:
        narrow = high - low < NARROWEST * max(1.0, abs(t))
        t = high if narrow else t
        if t <= start.t:
            return start, True
        stretch = integrate(run, stepper, start, t - start.t)
        landed = Point(t, stretch.states[-1].copy(), stretch.algebraic[-1].copy(), start.q)
        values, rates = switcher.indicators.watch(landed)
        g, rate = float(values[indicator]), float(rates[indicator])
        newton = t - g / rate if rate > 0 and not beyond else np.inf
        close = abs(newton - t) < HOP * (end - start.t) and low <= newton <= high
        if close or (narrow and start.t < newton < end):
            hit = hopped(switcher.indicators, landed, newton - t, indicator, run.settings.tolerance)
            if hit is not None:
                return hit, True
        if narrow:
            return landed, g >= 0
        low, high = (t, high) if (rate < 0 if beyond else g < 0) else (low, t)
        t = newton if low < newton < high else 0.5 * (low + high)


def _watch_chatter(run: Run, recent: deque[float], interval: float) -> None:
    """Raise if there are very many events in next to no time, or more in an interval than can be meant."""
    recent.append(run.point.t)
    for count, most in ((CHATTER_COUNT, CHATTER_WINDOW), (CROWD_COUNT, 1.0)):
        if len(recent) >= count and recent[-1] - recent[-count] < most * interval:
            names = sorted({event.component for event in run.events[-count:]})
            raise SimulationError(
                f"chattering: {count} events within {recent[-1] - recent[-count]:.3g} s at t = "
                f"{recent[-1]:.9g} s, from {', '.join(names)}; give it a resting speed, hysteresis or "
                "some compliance"
            )
