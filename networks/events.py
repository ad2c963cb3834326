"""Events: watch indicators, locate crossings, find the modes that are consistent afterwards."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from ..components.base import SimulationError
from .closed import Closed
from .crossing import Crossing
from .impacts import partners, solve_impact
from .stepper import Tolerance
from .switching import Change

Array = NDArray[np.float64]
FLOOR = 1e-12
RELATIVE = 1e-12
FLAT = 1e-10
UNRESOLVED = 1e-3
REGULAR = 1e-6
INSIDE = 1e-9


@dataclass(frozen=True)
class Event:
    """A change of mode, or a shock."""

    time: float
    component: str
    mode: str
    source: str
    target: str
    impulse: float | None = None


@dataclass(eq=False)
class Point:
    """Where a run stands: time, states, algebraic unknowns and what is constant in the segment."""

    t: float
    x: Array
    z: Array
    q: Array


@dataclass(eq=False)
class Switcher:
    """Knows the transitions of a DAE and applies them."""

    closed: Closed
    notes: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        dae = self.closed.dae
        self.switching, self.functions = dae.switching, self.closed.switch_functions
        self.muted = np.zeros(len(dae.switching.changes), dtype=bool)
        self.seen = np.zeros(len(dae.switching.changes))
        self.fastest = np.ones(len(dae.switching.changes))
        self._adrift: list[str] = []
        self.modes_at = dae.p.numel()
        self.impulses_at = self.modes_at + dae.modes.numel()
        self.completion_at = self.impulses_at + dae.impulses.numel()

    def modes(self, q: Array) -> Array:
        """Return the view of the modes in q."""
        return q[self.modes_at : self.impulses_at]

    def active(self, q: Array) -> NDArray[np.bool_]:
        """Tell which transitions can fire in the present modes."""
        return self._leavable(q) & ~self.muted

    def _leavable(self, q: Array) -> NDArray[np.bool_]:
        present: NDArray[np.bool_] = self.modes(q)[self.functions.mode_of] == self.functions.sources
        return present

    def soonest(self, point: Point) -> tuple[float, int]:
        """Return how soon an indicator will cross at its present rate, and which."""
        values, rates = self.watch(point)
        ahead = self.active(point.q) & (rates > 0) & (values < -self.tolerance())
        if not ahead.any():
            return np.inf, -1
        delays = np.where(ahead, -values / np.where(ahead, rates, 1.0), np.inf)
        first = int(delays.argmin())
        return float(delays[first]), first

    def hopped(self, point: Point, duration: float, indicator: int, tolerance: Tolerance) -> Point | None:
        """Return the crossing a very short time later (or earlier), or None if it is too far for one step.

        One step of the trapezoidal rule, corrected twice; the second correction bounds its error.
        """
        later = Point(point.t, point.x, point.z, point.q)
        self.move(later, duration)
        before, change = self._motion(point), np.zeros(0)
        for _ in range(2):
            corrected = point.x + 0.5 * duration * (before + self._motion(later))
            change, later.x = np.abs(corrected - later.x), corrected
            self._solve_algebraic(later)
        allowed = 0.1 * (tolerance.rtol * np.abs(point.x) + tolerance.atol)
        if (change > allowed).any():
            return None
        return later if self._shift(later, indicator) else None

    def _shift(self, point: Point, indicator: int) -> bool:
        """Move a point that is very near a crossing onto it, along its velocity; tell whether it is there."""
        for _ in range(2):
            values, rates = self.watch(point)
            if rates[indicator] <= 0:
                return False
            self.move(point, -float(values[indicator] / rates[indicator]))
        return bool(abs(self.watch(point)[0][indicator]) <= self.tolerance()[indicator])

    def move(self, point: Point, duration: float) -> None:
        """Move a point by a very short time, along its velocity."""
        point.x = point.x + duration * self._motion(point)
        point.t += duration
        self._solve_algebraic(point)

    def _motion(self, point: Point) -> Array:
        return self.functions.motion(point.x, point.z, point.q, point.t)[0]

    def watch(self, point: Point) -> tuple[Array, Array]:
        """Return indicators and their rates at a point; remember their size."""
        values, rates = self.functions.watch(point.x, point.z, point.q, point.t)
        np.maximum(self.seen, np.abs(values), out=self.seen)
        np.maximum(self.fastest, np.abs(rates), out=self.fastest)
        return values, rates

    def watch_nodes(self, t: Array, x: Array, z: Array, q: Array) -> tuple[Array, Array]:
        """Return indicators and their rates at the nodes of a stretch, (indicators, nodes)."""
        values, rates = self.functions.watch_nodes(x, z, q, t[:, None])
        np.maximum(self.seen, np.abs(values).max(axis=0, initial=0.0), out=self.seen)
        np.maximum(self.fastest, np.abs(rates).max(axis=0, initial=0.0), out=self.fastest)
        return values.T, rates.T

    def resolved(self, point: Point, times: Array) -> bool:
        """Tell whether nodes are close enough for what time itself does to the indicators.

        No state need move for a force to come and go, so the integrator's steps do not tell.
        """
        watched = self.functions.timed & self._leavable(point.q)
        if not watched.any():
            return True
        halfway = times + 0.5 * (times[1] - times[0])
        at, between = (
            self.functions.watch_nodes(point.x, point.z, point.q, t[:, None])[0] for t in (times, halfway)
        )
        cubic = (9 * (at[1:-2] + at[2:-1]) - at[:-3] - at[3:]) / 16
        error = np.abs(between[1:-2] - cubic).max(axis=0)
        allowed = UNRESOLVED * np.ptp(at, axis=0) + self.tolerance()
        return bool((error <= allowed)[watched].all())

    def flat_at(self, point: Point, crossing: Crossing) -> bool:
        """Tell whether a crossing is where the stretch began, though the indicator does not rise there."""
        _, indicator, t = crossing
        return t <= point.t and self.watch(point)[1][indicator] <= FLAT * self.fastest[indicator]

    def tolerance(self) -> Array:
        """Return the size below which each indicator counts as zero."""
        return np.maximum(FLOOR, RELATIVE * self.seen)

    def settle(self, point: Point, forced: int | None = None) -> list[Event]:
        """Fire transitions at an instant until none is left, changing `point` in place."""
        happened: list[Event] = []
        visited: set[tuple[float, ...]] = set()
        one_by_one = False
        self.complete(point)
        for _ in range(200):
            fired = self._fired(point, forced)
            forced = None
            if not fired:
                self._check_adrift(point.t)
                return happened
            key = (*self.modes(point.q), *point.x, *(float(i) for i in fired))
            one_by_one = one_by_one or key in visited
            visited.add(key)
            happened += self._apply(point, fired[:1] if one_by_one else fired)
        self._check_adrift(point.t)
        names = sorted({event.component for event in happened[-20:]})
        raise SimulationError(
            f"no consistent set of modes at t = {point.t:.9g} s; these switch for ever: {', '.join(names)}"
        )

    def _fired(self, point: Point, forced: int | None) -> list[int]:
        (g, rate), near = self.watch(point), self.tolerance()
        rising = rate > FLAT * self.fastest
        ready = self.active(point.q) & ((g > near) | ((g > -near) & rising))
        leaving = (g <= 10 * near) & (rate < -FLAT * self.fastest)
        ready &= ~leaving
        if forced is not None:
            same_mode = self.functions.mode_of == self.functions.mode_of[forced]
            twins = same_mode & (g == g[forced]) & (rate == rate[forced])
            ready |= self.active(point.q) & twins
        candidates = np.flatnonzero(ready)
        if not len(candidates):
            return []
        everything = self._everything(point)
        changes = self.switching.changes
        allowed = [i for i in candidates if _allowed(changes[i], everything)]
        strongest: dict[int, int] = {}
        for i in sorted(allowed, key=lambda i: float(g[i] / near[i])):
            strongest[changes[i].mode] = int(i)
        return sorted(strongest.values())

    def _apply(self, point: Point, fired: list[int]) -> list[Event]:
        changes = [self.switching.changes[i] for i in fired]
        everything = self._everything(point)
        shocks = [c for c in changes if c.impulse is not None]
        impulses: dict[int, float] = {}
        if shocks:
            shocks += partners(self.switching, self.modes(point.q), shocks)
            impulses = self._strike(point, shocks, everything)
            everything = self._everything(point)
            others = [c for c in changes if c.impulse is None]
            changes = [*others, *(c for c in shocks if c.impulse in impulses)]
        for change in changes:
            self.modes(point.q)[change.mode] = change.target
            self.muted[self.functions.mode_of == change.mode] = False
        self.complete(point)
        resets = {r[0]: r[1] * everything[r[2]] for c in changes for r in c.resets}
        if resets:
            self._reset(point, resets)
        self._solve_algebraic(point)
        return [self._event(point.t, c, impulses) for c in changes]

    def _everything(self, point: Point) -> Array:
        return self.functions.everything(point.x, point.z, point.q, point.t)[0]

    def _event(self, t: float, change: Change, impulses: dict[int, float]) -> Event:
        values = self.switching.mode_values[change.mode]
        impulse = impulses.get(change.impulse) if change.impulse is not None else None
        name = self.switching.mode_names[change.mode]
        return Event(t, change.component, name, values[change.source], values[change.target], impulse)

    def _strike(self, point: Point, shocks: list[Change], everything: Array) -> dict[int, float]:
        """Find the impulses that give the velocities wanted, and let them act."""
        q = point.q.copy()
        modes = self.modes(q)
        for number, table in enumerate(self.switching.in_shock):
            modes[number] = table.get(int(modes[number]), modes[number])
        during = Point(point.t, point.x, point.z, q)
        self.complete(during)
        assert self.functions.shock is not None
        shock = self.functions.shock(point.x, point.z, q, point.t)
        response = shock[0].reshape(len(self.switching.impulse_names), len(point.x)).T
        slopes = shock[1].reshape(len(point.x), len(everything)).T
        impulses, step = solve_impact(shocks, response, slopes, everything)
        point.x = point.x + step
        return impulses

    def _reset(self, point: Point, resets: dict[int, float]) -> None:
        """Give variables new values: states directly, others by the least change of states."""
        others = [v for v in resets if v not in self.functions.state_of]
        for variable in resets.keys() - others:
            point.x[self.functions.state_of[variable]] = resets[variable]
        if others:
            value, slope = self.functions.reset(point.x, point.z, point.q, point.t)
            rows = [self.functions.reset_of[v] for v in others]
            missing = np.array([resets[v] for v in others]) - value[rows]
            slope = slope.reshape(len(point.x), len(value)).T[rows]
            point.x = point.x + np.linalg.lstsq(slope, missing, rcond=1e-10)[0]

    def complete(self, point: Point) -> None:
        """Set the completion of blocks that the present modes leave singular."""
        if not self.closed.dae.blocks:
            return
        slopes = self.functions.slopes(point.x, point.z, point.q, point.t)[0]
        self._adrift = []
        start = 0
        for block in self.closed.dae.blocks:
            size = len(block.torn)
            part = slice(start, start + size**2)
            completion, singular = _completion(slopes[part].tobytes(), size)
            point.q[self.completion_at :][part] = completion
            start = part.stop
            if singular:
                freed = np.abs(completion.reshape(size, size, order="F")).max(axis=0)
                loose = freed > 1e-6 * freed.max()
                if self.functions.is_rate[block.torn][loose].any():
                    self._adrift += block.labels
                else:
                    self.tell_shared(block.labels)

    def tell_inside(self, point: Point) -> None:
        """Note what begins beyond the point at which it strikes."""
        self.complete(point)
        values = self.watch(point)[0]
        for i in np.flatnonzero(self._leavable(point.q) & (values > INSIDE)):
            change = self.switching.changes[i]
            note = (
                f"{change.component} begins {values[i]:.4g} beyond where it strikes, and holds or rebounds "
                "there; give it another start"
            )
            if change.impulse is not None and note not in self.notes:
                self.notes.append(note)

    def _check_adrift(self, t: float) -> None:
        """Raise if nothing determines an acceleration in the present modes."""
        if self._adrift:
            raise SimulationError(
                f"at t = {t:.9g} s nothing with inertia moves with {', '.join(self._adrift)}, which no "
                "longer holds; join a Mass (or an Inertia) where it slides"
            )

    def tell_shared(self, labels: list[str]) -> None:
        """Note that components share a load in a way no equation tells."""
        note = (
            f"{', '.join(labels)}: in some mode these hold a motion that is already held; their forces "
            "are then not unique and the ones of least norm are taken"
        )
        if note not in self.notes:
            self.notes.append(note)

    def _solve_algebraic(self, point: Point) -> None:
        if not self.closed.dae.z.numel():
            return
        for _ in range(50):
            value, slope = self.functions.algebraic(point.x, point.z, point.q, point.t)
            slope = slope.reshape(len(value), -1).T
            step = np.linalg.lstsq(slope, -value, rcond=1e-12)[0]
            point.z = point.z + step
            if np.abs(step).max() <= 1e-12 * (1 + np.abs(point.z).max()):
                return


def _allowed(change: Change, everything: Array) -> bool:
    return change.allowed is None or bool(everything[change.allowed])


@lru_cache(maxsize=256)
def _completion(entries: bytes, size: int) -> tuple[Array, bool]:
    """Return what makes a singular matrix regular such that solutions have least norm, by columns."""
    matrix = np.frombuffer(entries).reshape(size, size, order="F")
    scale = np.abs(matrix).max(axis=1, initial=0.0)
    scale[scale == 0] = 1.0
    if abs(np.linalg.det(matrix / scale[:, None])) > REGULAR:
        return np.zeros(size**2), False
    left, strength, right = np.linalg.svd(matrix / scale[:, None])
    weak = strength <= 1e-10 * max(strength.max(initial=0.0), 1.0)
    if not weak.any():
        return np.zeros(size**2), False
    completion = scale[:, None] * (left[:, weak] @ right[weak])
    return completion.ravel(order="F"), True
