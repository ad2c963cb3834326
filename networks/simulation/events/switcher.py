"""Events: which transitions fire at an instant, and the modes that are consistent afterwards."""

from __future__ import annotations

from collections import Counter
from copy import copy
from dataclasses import dataclass

import numpy as np

from ....base import Array, SimulationError
from ...reduction.jumps import Jumps
from ...reduction.transitions import Change, Switching
from ..bound_dae import BoundDAE
from ..point import Point as Point
from ..point import solve_algebraic
from . import constants
from .impacts import partners, solve_impact
from .indicators import Indicators
from .singular_modes import Completion

JUMP = "jump"


@dataclass(frozen=True)
class Event:
    """A change of mode, or a shock; of a prescribed motion that jumps, `mode` is the signal it follows."""

    time: float
    component: str
    mode: str
    source: str
    target: str
    impulse: float | None = None


@dataclass(eq=False)
class Switcher:
    """Knows the transitions of a DAE and applies them."""

    closed: BoundDAE

    def __post_init__(self) -> None:
        self.switching, self.functions = self.closed.dae.switching, self.closed.switch_functions
        self.shocks = self.closed.shocks
        self.indicators, self.completion = Indicators(self.closed), Completion(self.closed)

    @property
    def notes(self) -> list[str]:
        """What there is to know about the modes of a run."""
        return self.completion.notes

    def copy(self) -> Switcher:
        """Return one that knows as much, and goes on by itself."""
        other = copy(self)
        other.indicators, other.completion = self.indicators.copy(), Completion(self.closed)
        return other

    def settle(self, point: Point, forced: int | None = None, begins: bool = False) -> list[Event]:
        """Fire transitions at an instant until none is left, changing `point` in place.

        What is ready fires together until a situation comes back; from then on one at a time, of those of a
        situation another one each time it comes back. The indicator `forced` has crossed here. Where a run
        `begins`, what is prescribed does not jump.
        """
        happened, adrift = list[Event](), list[str]()
        visits, one_by_one = Counter[tuple[float, ...]](), False
        self.completion.update(point)
        for _ in range(constants.FIRING_ROUNDS):
            fired = self._fired(point, forced)
            forced = None
            if not fired:
                self.completion.check_adrift(point.t)
                return happened
            key = (*self.indicators.modes(point.q), *point.x, *(float(i) for i in fired))
            if visits[key] and not one_by_one:
                one_by_one, visits = True, Counter()
            turn = visits[key] % len(fired)
            visits[key] += 1
            happened += self._apply(point, fired[turn : turn + 1] if one_by_one else fired, begins)
            adrift = self.completion.adrift or adrift
        self.completion.adrift = adrift
        self.completion.check_adrift(point.t)
        names = sorted({event.component for event in happened[-constants.FIRING_TOLD :]})
        raise SimulationError(
            f"no consistent set of modes at t = {point.t:.9g} s; these switch for ever: {', '.join(names)}"
        )

    def _fired(self, point: Point, forced: int | None) -> list[int]:
        indicators = self.indicators
        (g, rate), near = indicators.watch(point), indicators.tolerance()
        ready = indicators.active(point.q) & ((g > near) | ((g > -near) & indicators.rising(rate)))
        ready &= ~((g <= constants.LEAVING_RATIO * near) & indicators.falling(rate))
        if forced is not None:
            same_mode = self.functions.mode_of == self.functions.mode_of[forced]
            twins = same_mode & (g == g[forced]) & (rate == rate[forced])
            ready |= indicators.active(point.q) & twins
        if not ready.any():
            return []
        everything, changes = self._everything(point), self.switching.changes
        allowed = [i for i in np.flatnonzero(ready).tolist() if _allowed(changes[i], everything)]
        strongest = {changes[i].mode: i for i in sorted(allowed, key=lambda i: float(g[i] / near[i]))}
        return sorted(strongest.values())

    def _apply(self, point: Point, fired: list[int], begins: bool) -> list[Event]:
        seen = None if begins or self.shocks is None else self.shocks.seen(point)
        changes = [self.switching.changes[i] for i in fired]
        shocks = [c for c in changes if c.impulse is not None]
        impulses: dict[int, float] = {}
        if shocks:
            shocks += partners(self.switching, self.indicators.modes(point.q), shocks)
            impulses = self._strike(point, shocks)
            changes = [c for c in changes if c.impulse is None]
            changes += [c for c in shocks if c.impulse in impulses]
        everything = self._everything(point)
        for change in changes:
            self.indicators.modes(point.q)[change.mode] = change.target
            self.indicators.muted[self.functions.mode_of == change.mode] = False
        self.completion.update(point)
        resets = {r[0]: r[1] * everything[r[2]] for c in changes for r in c.resets}
        if resets:
            self._reset(point, resets)
        solve_algebraic(self.closed, point)
        happened = [self._event(point.t, c, impulses) for c in changes]
        return happened if seen is None else happened + self.jump(point, seen, resets)

    def _everything(self, point: Point) -> Array:
        return self.functions.everything(point.x, point.z, point.q, point.t)[0]

    def _event(self, t: float, change: Change, impulses: dict[int, float]) -> Event:
        impulse = impulses.get(change.impulse) if change.impulse is not None else None
        return changed(self.switching, t, change, change.source, impulse)

    def _strike(self, point: Point, shocks: list[Change]) -> dict[int, float]:
        """Find the impulses that give the velocities wanted, and let them act."""
        everything, during = self._everything(point), self.during(point)
        assert self.functions.shock is not None
        response, slopes = self.functions.shock(point.x, point.z, during.q, point.t)
        response = response.reshape(len(self.switching.impulse_names), -1).T
        slopes = slopes.reshape(-1, len(everything)).T
        impulses, step = solve_impact(shocks, response, slopes, everything)
        point.x = point.x + step
        return impulses

    def during(self, point: Point) -> Point:
        """Return a point with the modes that hold while an impulse acts."""
        during = Point(point.t, point.x, point.z, point.q.copy())
        modes = self.indicators.modes(during.q)
        modes[:] = [table.get(int(m), m) for table, m in zip(self.switching.in_shock, modes, strict=True)]
        self.completion.update(during)
        return during

    def jump(self, point: Point, seen: Array, resets: dict[int, float]) -> list[Event]:
        """Let what jumps since it was `seen` act at a point, and the contacts that pass it on."""
        assert self.shocks is not None
        size = self.shocks.since(seen, point, resets)
        if not size.any():
            return []
        self.indicators.forget_sizes()
        before, during = self._everything(point), self.during(point)
        self._check_modes(during, size)
        pushes = self.shocks.act(during, size)
        if np.array_equal(during.x, point.x) and not pushes.any():
            return []
        self._check_reach(point, before, self._everything(during))
        point.x = during.x
        contacts = partners(self.switching, self.indicators.modes(point.q), [])
        everything = self._everything(during)
        pressed = any(
            everything[c.after] > everything[c.velocity] + constants.PRESSING_SPEED for c in contacts
        )
        passed = self._strike(point, contacts) if pressed else {}
        if passed:
            pushes = pushes + self.shocks.passed(during, passed)
        self.completion.update(point)
        solve_algebraic(self.closed, point)
        told = [self._event(point.t, c, passed) for c in contacts if c.impulse in passed]
        return [*pushed(point.t, self.shocks.jumps, pushes), *told]

    def _reset(self, point: Point, resets: dict[int, float]) -> None:
        """Give variables new values: states directly, others by the least change of states."""
        others = [v for v in resets if v not in self.functions.state_of]
        point.x = point.x.copy()
        for variable in resets.keys() - others:
            point.x[self.functions.state_of[variable]] = resets[variable]
        if others:
            value, slope = self.functions.reset(point.x, point.z, point.q, point.t)
            rows = [self.functions.reset_of[v] for v in others]
            missing = np.array([resets[v] for v in others]) - value[rows]
            slope = slope.reshape(len(point.x), len(value)).T[rows]
            point.x = point.x + np.linalg.lstsq(slope, missing, rcond=constants.IMPACT_RANK)[0]

    def tell_inside(self, point: Point) -> None:
        """Note what begins beyond the point at which it strikes."""
        self.completion.update(point)
        values = self.indicators.watch(point)[0]
        for i in np.flatnonzero(self.indicators.leavable(point.q) & (values > constants.STOP_DEPTH)):
            change = self.switching.changes[i]
            if change.impulse is not None:
                self.completion.note(
                    f"{change.component} begins {values[i]:.4g} beyond where it strikes, and holds or "
                    "rebounds there; give it another start"
                )

    def _check_modes(self, during: Point, size: Array) -> None:
        """Raise if a jump acts through what depends on modes, of which none is known to hold in a jump."""
        assert self.shocks is not None
        known = self.shocks.begins(during, size)
        modes = self.indicators.modes(during.q)
        for k, values in enumerate(self.switching.mode_values):
            present = int(modes[k])
            others = {*range(len(values))} - {present, *self.switching.in_shock[k]}
            for value in others if k not in self.shocks.own_modes else ():
                other = Point(during.t, during.x, during.z, during.q.copy())
                self.indicators.modes(other.q)[k] = value
                self.completion.update(other)
                if not np.allclose(
                    self.shocks.begins(other, size),
                    known,
                    rtol=constants.JUMP_ALIKE,
                    atol=constants.JUMP_ALIKE,
                ):
                    name = self.switching.mode_names[k].rpartition(".")[0]
                    raise SimulationError(
                        f"at t = {during.t:.9g} s '{name}' passes a jump of a prescribed motion on, in its "
                        f"mode '{values[value]}' otherwise than in '{values[present]}', and which one holds "
                        "is not known; give a ramp instead of the jump"
                    )
        self.completion.update(during)

    def _check_reach(self, point: Point, before: Array, after: Array) -> None:
        """Raise if a position jumps onto a stop, or off it."""
        modes = self.indicators.modes(point.q)
        for change in self.switching.changes:
            was, now = before[change.indicator], after[change.indicator]
            present = int(modes[change.mode])
            holds = present in self.switching.in_shock[change.mode]
            onto = not holds and present == change.source and was <= constants.STOP_DEPTH < now
            off = (
                holds and present == change.target != change.source and abs(now - was) > constants.STOP_DEPTH
            )
            if change.impulse is not None and (onto or off):
                raise SimulationError(
                    f"at t = {point.t:.9g} s {change.component} is struck or left at infinite speed, where a "
                    "prescribed position jumps; give a ramp instead of the jump"
                )


def changed(
    switching: Switching, t: float, change: Change, source: int, impulse: float | None = None
) -> Event:
    """Return the event that a transition fires, from a mode's value `source`."""
    name, values = switching.mode_names[change.mode], switching.mode_values[change.mode]
    return Event(t, change.component, name, values[source], values[change.target], impulse)


def pushed(t: float, jumps: Jumps, impulses: Array) -> list[Event]:
    """Return what jumps as events, with the impulses of the motions that feel it."""
    felt = np.flatnonzero(np.abs(impulses) > constants.JUMP_FELT_SHARE * np.abs(impulses).max(initial=0.0))
    if not len(felt):
        return [jumped(t, jumps, len(jumps.motions))]
    return [jumped(t, jumps, int(k), float(impulses[k])) for k in felt]


def jumped(t: float, jumps: Jumps, number: int, impulse: float | None = None) -> Event:
    """Return the event that a motion jumps, or, by the number after them, what no motion feels."""
    name, mode = ", ".join(signal.name for signal in jumps.signals), JUMP
    if number < len(jumps.motions):
        name, mode = jumps.motions[number].component, jumps.motions[number].reference
    return Event(t, name, mode, "before", "after", impulse)


def _allowed(change: Change, everything: Array) -> bool:
    return change.allowed is None or bool(everything[change.allowed])
