"""Runs with events: integrate, watch for crossings, land on the first, switch, go on."""

from __future__ import annotations

import numpy as np

from ..components.base import SimulationError
from .crossing import first_crossing
from .events import Point, Switcher
from .progress import Progress
from .run import Run, integrate
from .stepper import Array, Stepper, Stretch
from .switchfunctions import NODES as NODES

CHATTER = 200
LEAST_EXPONENT, FINE_EXPONENT, MOST_EXPONENT = -30, -3, 6
HOP = 1e-3
AHEAD = 2


def run_hybrid(run: Run, switcher: Switcher, stepper: Stepper, outputs: Array, progress: Progress) -> None:
    """Integrate between events; stretches are power-of-two multiples of the output interval."""
    interval = float(outputs[1] - outputs[0])
    next_output, since, exponent = 1, 0, MOST_EXPONENT
    recent: list[float] = []
    while next_output < len(outputs):
        point = run.point
        delay, indicator = switcher.soonest(point)
        if delay < HOP * interval:
            later = switcher.hopped(point, delay, run.settings.tolerance)
            if later is not None and later.t < outputs[next_output]:
                _arrive(run, switcher, later, indicator)
                recent = _watch_chatter(run, recent, interval)
                continue
        remaining = len(outputs) - next_output
        on_grid = point.t == outputs[next_output - 1]
        intervals = 2**exponent if on_grid and exponent >= 0 else 1
        while intervals > remaining or (intervals > 1 and interval * intervals > AHEAD * delay):
            intervals //= 2
        end = outputs[next_output + intervals - 1]
        span = float(end - point.t)
        if exponent < 0 and span > interval * 2.0**exponent:
            span, intervals = interval * 2.0**exponent, 0
        stretch = integrate(run, stepper, point, span)
        times = point.t + span * np.arange(stepper.nodes + 1) / stepper.nodes
        crossing = _crossing(run, switcher, times, stretch)
        if _too_coarse(switcher, point, times, stretch, crossing, exponent):
            exponent = min(exponent, intervals.bit_length() - 1) - 1
            continue
        kept = stepper.nodes if crossing is None else crossing[0]
        next_output = _record_outputs(run, outputs, next_output, intervals, stretch, kept)
        if crossing is None:
            t = float(outputs[next_output - 1]) if intervals else float(times[-1])
            run.point = Point(t, stretch.states[-1], stretch.algebraic[-1], point.q)
            exponent += 1 if stretch.steps < 2 * stepper.nodes and exponent < MOST_EXPONENT else 0
        else:
            exponent = max(exponent - 1, min((next_output - since).bit_length(), MOST_EXPONENT))
            since = next_output
            _land(run, switcher, stepper, times, stretch, crossing)
            recent = _watch_chatter(run, recent, interval)
        progress.at(run.point.t)


def _too_coarse(
    switcher: Switcher,
    point: Point,
    times: Array,
    stretch: Stretch,
    crossing: tuple[int, int, float] | None,
    exponent: int,
) -> bool:
    """Tell whether a stretch is too long for its nodes to show what happens in it."""
    if exponent <= LEAST_EXPONENT:
        return False
    nodes = len(times) - 1
    if stretch.steps > 8 * nodes or (crossing is not None and switcher.flat_at(point, crossing)):
        return True
    return exponent > FINE_EXPONENT and stretch.steps < nodes and not switcher.resolved(point, times)


def _crossing(run: Run, switcher: Switcher, times: Array, stretch: Stretch) -> tuple[int, int, float] | None:
    point = run.point
    x = np.vstack([point.x, stretch.states])
    z = np.vstack([point.z, stretch.algebraic])
    values, rates = switcher.watch_nodes(times, x, z, point.q)
    switcher.muted &= values[:, -1] > -switcher.tolerance()
    return first_crossing(times, values, rates, switcher.active(point.q), switcher.tolerance())


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
    crossing: tuple[int, int, float],
) -> None:
    """Integrate onto a crossing, fire what fires there and open the next segment."""
    node, indicator, t = crossing
    point = run.point
    x, z = point.x, point.z
    if node:
        x, z = stretch.states[node - 1], stretch.algebraic[node - 1]
    start = Point(float(times[node]), x.copy(), z.copy(), point.q)
    end = float(times[node + 1])
    landed, reached = _approach_crossing(run, switcher, stepper, start, end, t, indicator)
    _arrive(run, switcher, landed, indicator if reached else None)


def _arrive(run: Run, switcher: Switcher, landed: Point, indicator: int | None) -> None:
    """Fire what fires where an indicator crosses, and open the next segment."""
    run.record(landed.t, landed.x, landed.z)
    run.point = landed
    happened = switcher.settle(landed, forced=indicator)
    run.events += happened
    if happened:
        run.open_segment()
    elif indicator is not None:
        switcher.muted[indicator] = True


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
    while True:
        narrow = high - low < 1e-13 * max(1.0, abs(t))
        t = high if narrow else t
        if t <= start.t:
            return start, True
        stretch = integrate(run, stepper, start, t - start.t)
        landed = Point(t, stretch.states[-1].copy(), stretch.algebraic[-1].copy(), start.q)
        values, rates = switcher.watch(landed)
        g, rate = float(values[indicator]), float(rates[indicator])
        newton = t - g / rate if rate > 0 else np.inf
        if low <= newton <= high:
            hit = switcher.hopped(landed, newton - t, run.settings.tolerance)
            if hit is not None:
                switcher.shift(hit, indicator)
                return hit, True
        if narrow:
            return landed, g >= 0
        low, high = (t, high) if g < 0 else (low, t)
        t = newton if low < newton < high else 0.5 * (low + high)


def _watch_chatter(run: Run, recent: list[float], interval: float) -> list[float]:
    recent = [*recent, run.point.t][-CHATTER:]
    if len(recent) == CHATTER and recent[-1] - recent[0] < 1e-6 * interval:
        names = sorted({event.component for event in run.events[-CHATTER:]})
        raise SimulationError(
            f"chattering: {CHATTER} events within {recent[-1] - recent[0]:.3g} s at t = "
            f"{recent[-1]:.9g} s, from {', '.join(names)}; give it a resting speed, hysteresis or "
            "some compliance"
        )
    return recent
