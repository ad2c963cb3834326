"""Simulate: run a DAE segment by segment, from event to event."""

from __future__ import annotations

import time as clock
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..components.base import SimulationError
from .closed import Closed
from .crossing import first_crossing
from .dae import DAE
from .events import Event, Point, Switcher
from .initial import Decision, Wishes, initial_values, wishes
from .progress import Progress
from .result import Result, Segment
from .sensitivity import Sensitivities
from .stepper import Array, IntegratorError, Stepper, Tolerance

NODES_BETWEEN_EVENTS = 64
NODES_SMOOTH = 512
CHATTER = 200


@dataclass(frozen=True)
class Settings:
    """What a run is asked to be."""

    begin: float
    stop: float
    step: float
    rtol: float
    atol: float
    solver: str
    progress: bool | None

    @property
    def outputs(self) -> NDArray[np.float64]:
        """Output instants; the step is adjusted to divide the run."""
        count = max(1, round((self.stop - self.begin) / self.step))
        return np.linspace(self.begin, self.stop, count + 1)


@dataclass(eq=False)
class Run:
    """A run in progress: where it stands and what it has recorded."""

    closed: Closed
    settings: Settings
    point: Point
    switcher: Switcher | None
    initial: list[Decision]
    segments: list[Segment] = field(default_factory=list)
    events: list[Event] = field(default_factory=list)
    calls: int = 0

    def record(self, times: Any, states: Any, algebraic: Any) -> None:
        """Append points to the present segment."""
        self.segments[-1].extend(
            np.atleast_1d(times), np.atleast_2d(states), np.atleast_2d(algebraic)
        )

    def open_segment(self) -> None:
        """Start a segment at the present point, with its modes."""
        p = self.point
        self.segments.append(Segment(p.q.copy()))
        self.record(p.t, p.x, p.z)


def simulate(
    dae: DAE,
    settings: Settings,
    start: Mapping[str, float],
    guess: Mapping[str, float],
    inputs: Mapping[str, Any],
    parameters: Mapping[str, float],
    sensitivities: tuple[str, ...],
) -> Result:
    """Run a DAE; see `DAE.simulate`."""
    began = clock.perf_counter()
    closed = Closed(dae, inputs)
    numbers = dae.system.flat.table.values(dict(parameters))
    others = dae.constants.numel() - len(numbers)
    q = np.concatenate([numbers, np.zeros(others)])
    run = _started(closed, settings, q, wishes(dae, start, guess))
    outputs = settings.outputs
    nodes = _node_count(dae, len(outputs) - 1)
    stepper = Stepper(closed, settings.solver, Tolerance(settings.rtol, settings.atol), nodes)
    follow = Sensitivities(dae, sensitivities, run.point) if sensitivities else None
    run.open_segment()
    with Progress(dae.name, settings.begin, settings.stop, settings.progress) as progress:
        try:
            if run.switcher is None:
                _run_smooth(run, stepper, outputs, progress, follow)
            else:
                _run_hybrid(run, run.switcher, stepper, outputs, progress)
        except (IntegratorError, SimulationError) as error:
            partial = _result(run, stepper, began, follow)
            raise SimulationError(_failure(run, error), partial) from error
    return _result(run, stepper, began, follow)


def _started(closed: Closed, settings: Settings, q: Array, wanted: Wishes) -> Run:
    """Find start values and the modes they imply, again until both agree."""
    t = settings.begin
    switcher = Switcher(closed) if closed.dae.hybrid or closed.dae.blocks else None
    while True:
        if switcher is not None:
            guess = Point(t, np.zeros(closed.dae.x.numel()), np.zeros(closed.dae.z.numel()), q)
            switcher.complete(guess)
        x, z, decisions = initial_values(closed, q, t, wanted)
        point = Point(t, x, z, q)
        run = Run(closed, settings, point, switcher, decisions)
        if switcher is None:
            return run
        run.events = switcher.settle(point)
        mentions_others = any(v not in closed.dae.states for v in wanted.fixed)
        if not run.events or not mentions_others:
            return run
        again = initial_values(closed, point.q, t, wanted)
        if np.allclose(again[0], point.x, rtol=1e-12, atol=1e-14):
            return run
        q = point.q


def _node_count(dae: DAE, outputs: int) -> int:
    if dae.hybrid:
        return NODES_BETWEEN_EVENTS
    chunks = -(-outputs // NODES_SMOOTH)
    return -(-outputs // chunks)


def _run_smooth(
    run: Run, stepper: Stepper, outputs: Array, progress: Progress, follow: Sensitivities | None
) -> None:
    """Integrate in equal chunks; the last one starts early so that all outputs are nodes."""
    count, nodes = len(outputs) - 1, stepper.nodes
    span = (outputs[-1] - outputs[0]) / count * nodes
    done = 0
    while done < count:
        begin = min(done, count - nodes)
        segment = run.segments[-1]
        x, z = segment.state(begin)
        if follow is not None:
            follow.advance(stepper, Point(outputs[begin], x, z, run.point.q), span, begin)
        states, algebraic = _integrate(run, stepper, Point(outputs[begin], x, z, run.point.q), span)
        new = slice(done - begin, nodes)
        run.record(outputs[done + 1 : begin + nodes + 1], states[new], algebraic[new])
        done = begin + nodes
        run.point = Point(float(outputs[done]), states[-1], algebraic[-1], run.point.q)
        progress.at(run.point.t)


def _integrate(run: Run, stepper: Stepper, point: Point, span: float) -> tuple[Array, Array]:
    """Integrate one stretch; when that fails, save what can be reached and fail with the place."""
    run.calls += 1
    try:
        return stepper.run(point.t, point.x, point.z, point.q, span)
    except IntegratorError as error:
        _approach(run, stepper, point, span)
        raise error


def _approach(run: Run, stepper: Stepper, point: Point, span: float) -> None:
    """Advance towards a failure in ever smaller strides, recording what is reached."""
    t, x, z = point.t, point.x, point.z
    smallest = max(1e-9 * span, 1e-14 * abs(t))
    while span > smallest:
        span /= 2
        try:
            states, algebraic = stepper.run(t, x, z, point.q, span)
        except IntegratorError:
            continue
        if not np.isfinite(states).all():
            continue
        times = t + span * np.arange(1, stepper.nodes + 1) / stepper.nodes
        run.record(times, states, algebraic)
        t, x, z = float(times[-1]), states[-1], algebraic[-1]
    run.point = Point(t, x, z, point.q)


def _run_hybrid(
    run: Run, switcher: Switcher, stepper: Stepper, outputs: Array, progress: Progress
) -> None:
    """Integrate between events; stretches are power-of-two multiples of the output interval."""
    interval = float(outputs[1] - outputs[0])
    next_output, exponent = 1, 3
    recent: list[float] = []
    while next_output < len(outputs):
        point = run.point
        remaining = len(outputs) - next_output
        on_grid = point.t == outputs[next_output - 1]
        intervals = 2**exponent if on_grid and exponent >= 0 else 1
        while intervals > remaining:
            intervals //= 2
        end = outputs[next_output + intervals - 1]
        span = float(end - point.t)
        if exponent < 0 and span > interval * 2.0**exponent:
            span, intervals = interval * 2.0**exponent, 0
        states, algebraic = _integrate(run, stepper, point, span)
        steps = stepper.last_steps
        times = point.t + span * np.arange(stepper.nodes + 1) / stepper.nodes
        crossing = _crossing(run, switcher, times, states, algebraic)
        if steps > 4 * stepper.nodes and exponent > -30:
            exponent -= 1
            continue
        kept = stepper.nodes if crossing is None else crossing[0]
        next_output = _record_outputs(run, outputs, next_output, intervals, states, algebraic, kept)
        if crossing is None:
            t = float(outputs[next_output - 1]) if intervals else float(times[-1])
            run.point = Point(t, states[-1], algebraic[-1], point.q)
            exponent += 1 if steps < stepper.nodes and exponent < 6 else 0
        else:
            _land(run, switcher, stepper, times, states, algebraic, crossing)
            recent = _watch_chatter(run, recent, interval)
        progress.at(run.point.t)


def _crossing(
    run: Run, switcher: Switcher, times: Array, states: Array, algebraic: Array
) -> tuple[int, int, float] | None:
    point = run.point
    x = np.vstack([point.x, states]).T
    z = np.vstack([point.z, algebraic]).T
    values, rates = switcher.watch(times[None, :], x, z, point.q)
    switcher.muted &= values[:, -1] > -switcher.tolerance()
    return first_crossing(times, values, rates, switcher.active(point.q), switcher.tolerance())


def _record_outputs(
    run: Run, outputs: Array, first: int, intervals: int, states: Array, algebraic: Array, kept: int
) -> int:
    """Record the nodes that are outputs, up to node `kept`; return the next output."""
    if not intervals:
        return first
    stride = len(states) // intervals
    count = kept // stride
    chosen = np.arange(1, count + 1) * stride - 1
    if count:
        run.record(outputs[first : first + count], states[chosen], algebraic[chosen])
    return first + count


def _land(
    run: Run,
    switcher: Switcher,
    stepper: Stepper,
    times: Array,
    states: Array,
    algebraic: Array,
    crossing: tuple[int, int, float],
) -> None:
    """Integrate onto a crossing, fire what fires there and open the next segment."""
    node, indicator, t = crossing
    point = run.point
    x, z = (point.x, point.z) if node == 0 else (states[node - 1], algebraic[node - 1])
    start = Point(float(times[node]), x.copy(), z.copy(), point.q)
    landed = _approach_crossing(run, switcher, stepper, start, float(times[node + 1]), t, indicator)
    run.record(landed.t, landed.x, landed.z)
    run.point = landed
    happened = switcher.settle(landed, forced=indicator)
    run.events += happened
    if happened:
        run.open_segment()
    else:
        switcher.muted[indicator] = True


def _approach_crossing(
    run: Run,
    switcher: Switcher,
    stepper: Stepper,
    start: Point,
    end: float,
    t: float,
    indicator: int,
) -> Point:
    """Integrate from `start` onto the instant at which an indicator rises through zero."""
    low, high = start.t, end
    while t > start.t:
        states, algebraic = _integrate(run, stepper, start, t - start.t)
        landed = Point(t, states[-1].copy(), algebraic[-1].copy(), start.q)
        values, rates = switcher.watch(t, landed.x, landed.z, landed.q)
        g, rate = float(values[indicator, 0]), float(rates[indicator, 0])
        if rate > 0 and abs(g) <= 1e-6 * rate * (end - start.t):
            switcher.shift(landed, indicator)
            return landed
        if g >= 0 and high - low < 1e-13 * max(1.0, abs(t)):
            return landed
        low, high = (t, high) if g < 0 else (low, t)
        newton = t - g / rate if rate > 0 else np.inf
        t = newton if low < newton < high else 0.5 * (low + high)
        t = high if high - low < 1e-13 * max(1.0, abs(t)) else t
    return start


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


def _failure(run: Run, error: Exception) -> str:
    """Say when a run ended and which state was moving fastest for its tolerance."""
    dae, point, settings = run.closed.dae, run.point, run.settings
    if isinstance(error, SimulationError):
        return f"'{dae.name}': {error}"
    rate = run.closed.evaluator(dae.ode)(point.x, point.z, point.q, point.t).full().ravel()
    weight = np.abs(rate) / (settings.rtol * np.abs(point.x) + settings.atol)
    worst = int(np.argmax(np.where(np.isfinite(weight), weight, np.inf)))
    name = dae.state_names[worst] if len(rate) else "no state"
    state = f"{name} = {point.x[worst]:.6g} with rate {rate[worst]:.6g}" if len(rate) else name
    reason = str(error).strip().splitlines()[-1]
    return (
        f"'{dae.name}': integration failed at t = {point.t:.9g} s; the state that limited the step is "
        f"{state}. Results up to there are kept in the error's `result`. Solver: {reason}"
    )


def _result(run: Run, stepper: Stepper, began: float, follow: Sensitivities | None) -> Result:
    by_component: dict[str, int] = {}
    for event in run.events:
        by_component[event.component] = by_component.get(event.component, 0) + 1
    stats = {
        "solver": stepper.solver,
        "steps": stepper.steps,
        "integrator calls": run.calls,
        "events": len(run.events),
        "events by component": by_component,
        "seconds": clock.perf_counter() - began,
    }
    notes = run.switcher.notes if run.switcher else []
    sensitivities = follow.collected() if follow else {}
    return Result(run.closed, run.segments, run.events, stats, run.initial, notes, sensitivities)
