"""Shocks: what a jump of a prescribed motion, or of its slope, does to a network in no time at all.

A jump d is a ramp that takes no time. While signals pass through it, states and forces are moved by

    dx/ds = e (f(x, u(s), d/e) - f(x, u(s), 0)),   s from 0 to 1,

d/e being the slope of a ramp of e seconds, so short that finite forces count for nothing.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from itertools import pairwise
from typing import TYPE_CHECKING

import casadi as ca
import numpy as np

from ....base import Array, SimulationError
from ...evaluation.compiled import Compiled, dense
from ...flattening.vectors import pick
from ...reduction.jumps import Jumps
from ..integrator import nominal_sizes
from ..point import Point
from . import constants

if TYPE_CHECKING:
    from ..bound_dae import BoundDAE


class Shocks:
    """The jumps of a network with its inputs put in."""

    def __init__(self, closed: BoundDAE, jumps: Jumps) -> None:
        dae = closed.dae
        self.jumps = jumps
        starts = np.cumsum([0, *(s.course.numel() for s in jumps.signals)])
        self._parts = [slice(a, b) for a, b in pairwise(starts.tolist())]
        self._signs = np.array([sign for s in jumps.signals for sign in s.signs], dtype=float)
        self._place = {variable: k for k, variable in enumerate(jumps.reads)}
        self._seen = closed.compiled("seen", closed.close(pick(dae.variables, jumps.reads)))
        told = [jumps.before, jumps.after, dae.constants, dae.time]
        self._jump = Compiled(ca.Function("jump", told, dense(jumps.jump, jumps.size)))
        self._constants = dae.constants.numel()
        self._first_impulse = dae.p.numel() + dae.modes.numel()
        self._motion = _motion(closed, jumps)
        self._far = np.zeros(dae.x.numel())
        self.own_modes = set(ca.jacobian_sparsity(jumps.jump, dae.modes).get_col())
        self._nx, self._nz = dae.x.numel(), dae.z.numel()
        self._sizes = np.append(nominal_sizes(dae, dae.states), np.ones(jumps.forces.numel()))

    def seen(self, point: Point) -> Array:
        """Return the variables that tell how far signals jump from here."""
        return self._seen(point.x, point.z, point.q, point.t)[0]

    def since(self, seen: Array, point: Point, resets: dict[int, float]) -> Array:
        """Return by how much signals have jumped since they were seen, zero where that is rounding.

        `point` is after the jump; `resets` are variables that were given new values.
        """
        before = seen.copy()
        for variable in resets.keys() & self._place.keys():
            before[self._place[variable]] = resets[variable]
        q = point.q[: self._constants]
        jump, size = self._jump(before, self.seen(point), q, point.t)
        last = [part.stop - 1 for part in self._parts]
        steeper = np.append(np.abs(jump[1:]), 0.0)
        steeper[last] = 0.0
        late = constants.JUMP_LATE * max(1.0, abs(point.t)) * steeper
        jump[np.abs(jump) <= constants.JUMP_ROUNDING * size + late] = 0.0
        jump[last] = 0.0
        signed: Array = jump * self._signs
        return signed

    def begins(self, point: Point, jump: Array) -> Array:
        """Return how states and impulses begin to move where signals have jumped."""
        self._far = self._thrown(point, jump)
        return self._rates(point, jump, np.append(point.x, np.zeros(len(self.jumps.motions))), 0.0)

    def act(self, point: Point, jump: Array) -> Array:
        """Move the states of a point, where signals have jumped; return the impulses of the motions.

        Raises:
            SimulationError: if that takes forces beyond all bounds.
        """
        self.begins(point, jump)
        rates = partial(self._rates, point, jump)
        path = np.append(point.x, np.zeros(len(self.jumps.motions)))
        s, h = 0.0, 1.0
        while s < 1.0:
            h = min(h, 1.0 - s)
            whole, half = _runge_kutta(rates, path, s, h), _runge_kutta(rates, path, s, h / 2)
            half = _runge_kutta(rates, half, s + h / 2, h / 2)
            scale = np.maximum(self._sizes, np.abs(half))
            if (
                h > constants.JUMP_STEP
                and not (np.abs(whole - half) <= constants.JUMP_ACCURACY * scale).all()
            ):
                h /= 2
            else:
                path, s, h = half, s + h, 2 * h
        rates(path, 1.0)
        point.x = path[: self._nx]
        return path[self._nx :]

    def passed(self, point: Point, impulses: dict[int, float]) -> Array:
        """Return what motions give when contacts pass a shock on, by the impulses of these."""
        struck = Point(point.t, point.x, point.z, point.q.copy())
        struck.q[self._first_impulse + np.array([*impulses])] = [*impulses.values()]
        still = np.zeros(self.jumps.courses.numel())
        return (self._at(struck, point.x, still) - self._at(point, point.x, still))[self._nx :]

    def _rates(self, point: Point, jump: Array, path: Array, s: float) -> Array:
        """Return how states and impulses move with s.

        Raises:
            SimulationError: if they move the faster, the shorter the ramp.
        """
        rates, shorter = (
            self._moved(point, jump, path, s, e)
            for e in (constants.RAMP, constants.RAMP * constants.RAMP_SHORTER)
        )
        bound = constants.JUMP_UNBOUNDED * (np.abs(rates).max(initial=0.0) + self._sizes)
        if not (np.abs(rates - shorter) <= bound).all():
            raise SimulationError(self._told(point.t, jump, "a force that grows faster than speed"))
        return rates

    def _moved(self, point: Point, jump: Array, path: Array, s: float, e: float) -> Array:
        still, moving = (s - 1) * jump, (s - 1) * jump
        for part in self._parts:
            moving[part][1:] += jump[part][:-1] / e
        x = path[: self._nx]
        far = x + constants.RAMP / e * self._far
        return e * (self._at(point, far, moving * self._signs) - self._at(point, x, still * self._signs))

    def _at(self, point: Point, x: Array, course: Array) -> Array:
        """Return rates of states and forces while signals are off by a course."""
        z = point.z
        moved, missed, slope = self._motion(x, z, point.q, point.t, course)
        for _ in range(constants.NEWTON_ROUNDS if self._nz else 0):
            slope = slope.reshape(self._nz, self._nz).T
            if not (np.isfinite(missed).all() and np.isfinite(slope).all()):
                break
            change = np.linalg.lstsq(slope, -missed, rcond=1e-12)[0]
            z = z + change
            moved, missed, slope = self._motion(x, z, point.q, point.t, course)
            if np.abs(change).max() <= constants.NEWTON_CLOSE * (1 + np.abs(z).max()):
                break
        return moved

    def _thrown(self, point: Point, jump: Array) -> Array:
        """Return how far states are off while a position jumps that relative velocities follow.

        Raises:
            SimulationError: if that takes forces, as where it moves what has inertia.
        """
        course = np.zeros(len(jump))
        for part in self._parts:
            course[part][2:] = jump[part][:-2] / constants.RAMP
        thrown = self._at(point, point.x, course * self._signs) - self._at(point, point.x, 0 * course)
        bound = thrown[self._nx :] if self.jumps.motions else thrown
        if not (np.abs(bound) <= constants.JUMP_UNBOUNDED).all():
            raise SimulationError(self._told(point.t, jump, "an infinite acceleration of what has inertia"))
        return thrown[: self._nx]

    def _told(self, t: float, jump: Array, what: str) -> str:
        told = ", ".join(
            f"{signal.name} (by {np.abs(jump[part]).max():.6g})"
            for signal, part in zip(self.jumps.signals, self._parts, strict=True)
            if jump[part].any()
        )
        return (
            f"at t = {t:.9g} s what prescribes a motion jumps: {told}, which takes {what}; give a ramp "
            "instead of the jump, a Speed instead of a Position, or exact=False, which filters it"
        )


def _runge_kutta(rates: Callable[[Array, float], Array], path: Array, s: float, h: float) -> Array:
    first = rates(path, s)
    second = rates(path + h / 2 * first, s + h / 2)
    third = rates(path + h / 2 * second, s + h / 2)
    last = rates(path + h * third, s + h)
    return path + h / 6 * (first + 2 * second + 2 * third + last)


def _motion(closed: BoundDAE, jumps: Jumps) -> Compiled:
    """Return a function of (x, z, q, t, course): rates and forces, residuals and their slopes."""
    dae = closed.dae
    moving = [ca.vertcat(jumps.ode, jumps.forces), jumps.alg, ca.jacobian(jumps.alg, dae.z)]
    inner = ca.Function("inner", [*dae.arguments(), jumps.courses], dense(*moving))
    course = type(closed.x).sym("course", jumps.courses.numel())
    q = closed.q[: dae.constants.numel()]
    found = inner(closed.x, closed.z, closed.u, q, closed.t, course)
    return Compiled(ca.Function("moving", [closed.x, closed.z, closed.q, closed.t, course], dense(*found)))
