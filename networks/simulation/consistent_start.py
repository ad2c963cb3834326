"""A consistent start: start values and modes that imply each other."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ...base import Array, InitialConditionError, SimulationError
from .blame import with_remedies
from .bound_dae import BoundDAE
from .events.constants import JUST_BEFORE, START_ROUNDS
from .events.switcher import Event, Switcher
from .initialization import StartValues, initial_values
from .point import Point, solve_algebraic
from .run import Run
from .settings import Settings


def started(closed: BoundDAE, settings: Settings, q: Array, wanted: StartValues) -> Run:
    """Find start values and the modes they imply.

    Raises:
        InitialConditionError: if they do not agree in the modes at rest, nor in those that motion or
            what breaks away implies.
    """
    refusals = []
    for modes in _first_modes(closed, q, settings.begin, wanted):
        tried = modes.copy()
        try:
            return replace(_agreed(closed, settings, modes, wanted), tried=tried)
        except InitialConditionError as error:
            refusals.append(error)
    raise refusals[min(1, len(refusals) - 1)]


def begun(closed: BoundDAE, q: Array, time: float, wanted: StartValues) -> Run:
    """Return a run that stands where it begins, at `time` [s]."""
    return started(closed, Settings(time, time + 1.0, 1.0), q, wanted)


def _agreed(closed: BoundDAE, settings: Settings, q: Array, wanted: StartValues) -> Run:
    """Find start values in given modes, then modes, again until both agree."""
    t = settings.begin
    switcher = Switcher(closed) if closed.dae.hybrid or closed.dae.blocks else None
    for _ in range(START_ROUNDS):
        if switcher is not None:
            guess = Point(t, np.zeros(closed.dae.x.numel()), np.zeros(closed.dae.z.numel()), q)
            switcher.completion.update(guess)
        point, decisions = initial_values(closed, q, t, wanted)
        run = Run(closed, settings, point, switcher, decisions)
        if switcher is None:
            return run
        switcher.tell_inside(point)
        before = point.x.copy()
        run.events = _settled(switcher, point)
        mentions_others = any(v not in closed.dae.states for v in wanted.fixed)
        struck = any(event.impulse is not None for event in run.events)
        if not run.events or not mentions_others or struck:
            return run
        again, _ = initial_values(closed, point.q, t, wanted)
        if any(np.allclose(again.x, x, rtol=1e-12, atol=1e-14) for x in (point.x, before)):
            return run  # what transitions reset, as the first sample of a sampler, comes on top
        q = point.q
    raise InitialConditionError(
        f"'{closed.dae.name}': start values and modes do not agree with each other; fix states instead "
        "of accelerations or forces"
    )


def _first_modes(closed: BoundDAE, q: Array, t: float, wanted: StartValues) -> Iterator[Array]:
    """Yield modes to try: at rest, those that positions and speeds imply, and each way out of holding."""
    yield q.copy()
    if not closed.dae.hybrid:
        return
    fixed = {v: value for v, value in wanted.fixed.items() if v in closed.dae.derivative}
    point, _ = initial_values(closed, q.copy(), t, StartValues(fixed, wanted.guesses))
    switcher = Switcher(closed)
    _settled(switcher, point)
    yield point.q.copy()
    switching, modes = closed.dae.switching, switcher.indicators.modes
    held = [k for k, stands in enumerate(switching.in_shock) if int(modes(point.q)[k]) in stands]
    for chosen in [held, *([k] for k in held if len(held) > 1)]:
        for value in range(max((len(switching.mode_values[k]) for k in held), default=0)):
            moving = point.q.copy()
            for k in chosen:
                modes(moving)[k] = min(value, len(switching.mode_values[k]) - 1)
            yield moving


def _settled(switcher: Switcher, point: Point) -> list[Event]:
    """Find the modes in which a run begins; a signal that jumps in its first instant acts on the start."""
    try:
        happened = _go_to_just_before(switcher, point)
        return [*(happened or []), *switcher.settle(point, begins=happened is None)]
    except SimulationError as error:
        dae = switcher.closed.dae
        raise SimulationError(f"'{dae.name}': {with_remedies(dae, str(error))}") from error


def _go_to_just_before(switcher: Switcher, point: Point) -> list[Event] | None:
    """Take a point through what happens just before a run begins, if a signal jumps then; tell what did."""
    own = sorted(switcher.shocks.own_modes) if switcher.shocks else []
    if not own:
        return None
    instants = point.t - max(JUST_BEFORE, 8 * float(np.spacing(abs(point.t)))), point.t
    earlier, now = map(point.copy, instants)
    try:
        happened = switcher.copy().settle(earlier, begins=True)
        switcher.copy().settle(now, begins=True)
    except SimulationError:
        return None
    modes = switcher.indicators.modes
    if np.array_equal(modes(earlier.q)[own], modes(now.q)[own]):
        return None
    point.x, point.z, point.q = earlier.x, earlier.z, earlier.q
    solve_algebraic(switcher.closed, point)
    return [replace(event, time=point.t) for event in happened]
