"""Runs with events: integrate, watch for crossings, land on the first, switch, go on."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass, field

import numpy as np

from ....base import Array, SimulationError
from ..integrator import IntegratorError, Stepper, Stretch
from ..point import Point, solve_algebraic
from ..progress import Progress
from ..run import Run, attempt, enter_next_leg, integrate, record_here
from ..settings import Tolerance
from .constants import CHATTER_COUNT, CHATTER_WINDOW, CROWD_COUNT, HOP, NARROWEST
from .functions import NODES as NODES
from .indicators import Indicators
from .root_finding import Crossing, first_crossing, followed
from .stride import FINE_EXPONENT, LEAST_EXPONENT, Pace
from .switcher import Switcher

SHORTEST_SPAN = 1e-12  # share of t: shorter stretches are not tried
STRETCH_STEPS = NODES / 4  # of the longest allowed, in a stretch at most
MOST_STEPS = 500


def run_hybrid(
    run: Run, switcher: Switcher, stepper: Stepper, outputs: Array, progress: Progress, first: bool = False
) -> None:
    """Integrate between events, at a pace that keeps calls few and crossings visible; maybe to the first."""
    loop = _EventLoop(run, switcher, stepper, Pace(outputs))
    while loop.pace.next < len(outputs) and not (first and run.events):
        if enter_next_leg(run):
            loop.pace.entered(run)
        elif loop.advance():
            progress.at(run.point.t)


@dataclass(eq=False)
class _EventLoop:
    """A run in whose stretches events are located, landed on and fired."""

    run: Run
    switcher: Switcher
    stepper: Stepper
    pace: Pace
    recent: deque[float] = field(default_factory=lambda: deque(maxlen=CROWD_COUNT))

    def advance(self) -> bool:
        """Go on by a stretch at most, up to the first event; tell whether a stretch was integrated."""
        run, pace, point = self.run, self.pace, self.run.point
        delay, indicator = self.switcher.indicators.soonest(point)
        if self._hop(delay, indicator):
            pace.limit = np.inf
            self._watch_chatter()
            return False
        end, intervals = pace.stretch(point.t, delay, run.leg.end, STRETCH_STEPS * run.max_step)
        span = end - point.t
        stretch = self._tried(span)
        if stretch is None:
            pace.failed(end, intervals)
            return False
        times = point.t + span * np.arange(self.stepper.nodes + 1) / self.stepper.nodes
        crossing, follows = self._crossing(times, stretch)
        if pace.exponent > LEAST_EXPONENT and not (follows and self._plain(times, crossing)):
            pace.retry(intervals)
            return False
        self._record_outputs(intervals, stretch, self.stepper.nodes if crossing is None else crossing[0])
        if crossing is None:
            run.point = Point(end, stretch.states[-1], stretch.algebraic[-1], point.q)
            pace.passed()
        else:
            pace.crossed()
            self._land(times, stretch, crossing)
            self._watch_chatter()
        return True

    def _hop(self, delay: float, indicator: int) -> bool:
        """Go to a crossing that is too near to integrate to; tell whether that was possible."""
        run, pace = self.run, self.pace
        if delay >= HOP * pace.interval:
            return False
        later = _hopped(self.switcher.indicators, run.point, delay, indicator, run.settings.tolerance)
        if later is None or later.t >= min(pace.outputs[pace.next], run.leg.end):
            return False
        self._arrive(later, indicator)
        return True

    def _tried(self, span: float) -> Stretch | None:
        """Integrate a stretch; None if that fails, maybe beyond an event that a shorter one comes upon."""
        try:
            return attempt(self.run, self.stepper, self.run.point, span)
        except IntegratorError:
            if self.pace.exponent > LEAST_EXPONENT and span > SHORTEST_SPAN * abs(self.run.point.t):
                return None
            record_here(self.run)
            raise

    def _plain(self, times: Array, crossing: Crossing | None) -> bool:
        """Tell whether a stretch is short enough for its nodes to show what happens in it."""
        indicators, point = self.switcher.indicators, self.run.point
        if crossing is not None and indicators.flat_at(point, crossing):
            return False
        return self.pace.exponent <= FINE_EXPONENT or indicators.resolved(point, times)

    def _crossing(self, times: Array, stretch: Stretch) -> tuple[Crossing | None, bool]:
        """Return the first crossing, and whether the nodes follow the indicators at all."""
        point, indicators = self.run.point, self.switcher.indicators
        x, z = np.vstack([point.x, stretch.states]), np.vstack([point.z, stretch.algebraic])
        values, rates = indicators.watch_nodes(times, x, z, point.q)
        near = indicators.tolerance()
        indicators.muted &= values[:, -1] > -near
        watched = times, values, rates, indicators.active(point.q), near
        return first_crossing(*watched), followed(*watched)

    def _record_outputs(self, intervals: int, stretch: Stretch, kept: int) -> None:
        """Record the nodes that are outputs, up to node `kept`."""
        stride = len(stretch.states) // intervals if intervals else kept + 1
        count, first = kept // stride, self.pace.next
        chosen = np.arange(1, count + 1) * stride - 1
        if count:
            times = self.pace.outputs[first : first + count]
            self.run.record(times, stretch.states[chosen], stretch.algebraic[chosen])
        self.pace.next += count

    def _land(self, times: Array, stretch: Stretch, crossing: Crossing) -> None:
        """Integrate onto a crossing, fire what fires there and open the next segment."""
        node, sought, t = crossing
        point, indicators = self.run.point, self.switcher.indicators
        x, z = (stretch.states[node - 1], stretch.algebraic[node - 1]) if node else (point.x, point.z)
        start = Point(float(times[node]), x.copy(), z.copy(), point.q)
        end, earliest = float(times[node + 1]), np.inf
        landed, reached = self._approach_crossing(start, end, t, sought)
        while (passed := indicators.passed(start, landed)) not in (None, sought) and landed.t < earliest:
            sought, earliest = passed, landed.t
            landed, reached = self._approach_crossing(start, earliest, earliest, sought)
        self._arrive(landed, sought if reached else None)

    def _arrive(self, landed: Point, indicator: int | None) -> None:
        """Fire what fires where an indicator crosses, and open the next segment."""
        self.run.point = landed
        record_here(self.run)
        happened = self.switcher.settle(landed, forced=indicator)
        self.run.events += happened
        if happened:
            self.run.open_segment()
        elif indicator is not None:
            self.switcher.indicators.muted[indicator] = True

    def _approach_crossing(self, start: Point, end: float, t: float, indicator: int) -> tuple[Point, bool]:
        """Integrate from `start` onto the instant at which an indicator rises through zero.

        Return where this ends, and whether zero was reached: nodes can make believe in a crossing.
        """
        run, indicators = self.run, self.switcher.indicators
        low, high = start.t, end
        g, rate = (float(m[indicator]) for m in indicators.watch(start))
        beyond = g > indicators.tolerance()[indicator] or (g >= 0 and rate < 0)
        while True:
            narrow = high - low < NARROWEST * max(1.0, abs(t))
            t = high if narrow else t
            if t <= start.t:
                return start, True
            stretch = integrate(run, self.stepper, start, t - start.t)
            landed = Point(t, stretch.states[-1].copy(), stretch.algebraic[-1].copy(), start.q)
            g, rate = (float(m[indicator]) for m in indicators.watch(landed))
            newton = t - g / rate if rate > 0 and not beyond else np.inf
            close = abs(newton - t) < HOP * (end - start.t) and low <= newton <= high
            if close or (narrow and start.t < newton < end):
                hit = _hopped(indicators, landed, newton - t, indicator, run.settings.tolerance)
                if hit is not None:
                    return hit, True
            if narrow:
                return landed, g >= 0
            low, high = (t, high) if (rate < 0 if beyond else g < 0) else (low, t)
            t = newton if low < newton < high else 0.5 * (low + high)

    def _watch_chatter(self) -> None:
        """Raise if there are very many events in next to no time, or too many in an interval to be meant."""
        recent = self.recent
        recent.append(self.run.point.t)
        for count, most in ((CHATTER_COUNT, CHATTER_WINDOW), (CROWD_COUNT, 1.0)):
            if len(recent) >= count and recent[-1] - recent[-count] < most * self.pace.interval:
                names = sorted({event.component for event in self.run.events[-count:]})
                raise SimulationError(
                    f"chattering: {count} events within {recent[-1] - recent[-count]:.3g} s at t = "
                    f"{recent[-1]:.9g} s, from {', '.join(names)}; give it a resting speed, hysteresis or "
                    "some compliance"
                )


def _hopped(
    indicators: Indicators, point: Point, duration: float, indicator: int, tolerance: Tolerance
) -> Point | None:
    """Return the crossing a very short time later (or earlier), or None if it is too far for one step.

    One step of the trapezoidal rule, corrected twice; the second correction bounds its error.
    """
    later = Point(point.t, point.x, point.z, point.q)
    _go_on(indicators, later, duration)
    before, change = _motion(indicators, point), np.zeros(0)
    for _ in range(2):
        corrected = point.x + 0.5 * duration * (before + _motion(indicators, later))
        change, later.x = np.abs(corrected - later.x), corrected
        solve_algebraic(indicators.closed, later)
    allowed = 0.1 * (tolerance.rtol * np.abs(point.x) + tolerance.atol)
    if (change > allowed).any() or not _shift(indicators, later, indicator):
        return None
    return later if indicators.passed(point, later) is None else None


def _shift(indicators: Indicators, point: Point, indicator: int) -> bool:
    """Move a point that is very near a crossing onto it, along its velocity; tell whether it is there."""
    for _ in range(2):
        values, rates = indicators.watch(point)
        if rates[indicator] <= 0:
            return False
        _go_on(indicators, point, -float(values[indicator] / rates[indicator]))
    return bool(abs(indicators.watch(point)[0][indicator]) <= indicators.tolerance()[indicator])


def _go_on(indicators: Indicators, point: Point, duration: float) -> None:
    """Move a point by a very short time, along its velocity."""
    point.x = point.x + duration * _motion(indicators, point)
    point.t += duration
    solve_algebraic(indicators.closed, point)


def _motion(indicators: Indicators, point: Point) -> Array:
    return indicators.functions.motion(point.x, point.z, point.q, point.t)[0]
