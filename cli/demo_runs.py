"""The runs of `inertance demo`: sinusoidal tests of two inerters, and responses to random displacement."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from math import ceil, sqrt
from typing import TypeVar

import numpy as np

from ..base import Array, Complex
from ..components import Component
from ..machines import RandomDisplacement, Sinusoid, ge_wang, rig_response, run_on_rig
from ..networks import ToolchainError

TESTS = (Sinusoid(0.020, 0.1), Sinusoid(0.010, 3.0), Sinusoid(0.007, 5.0), Sinusoid(0.0015, 10.0))
INERTERS = {"planetary": ge_wang.planetary_inerter, "disk": ge_wang.disk_inerter}
RANDOM = tuple(RandomDisplacement(seed, period=8.0) for seed in (1, 2))
SETTLING_SECONDS = 2.0
Found = TypeVar("Found")


@dataclass(frozen=True)
class Cycle:
    """One cycle of a sinusoidal test, once the start has died away.

    Attributes:
        t: time within the cycle [s].
        x, v, a: motion of the rod [m, m/s, m/s2].
        F: force on the rod [N].
        stuck: share of the cycle in which the screw stands still.
    """

    t: Array
    x: Array
    v: Array
    a: Array
    F: Array
    stuck: float

    @property
    def force(self) -> float:
        """Greatest force [N]."""
        return float(np.abs(self.F).max())

    @property
    def inertance(self) -> float:
        """Force in phase with acceleration, over acceleration [kg]."""
        return float(np.trapezoid(self.F * self.a, self.t) / np.trapezoid(self.a**2, self.t))

    @property
    def inertial(self) -> bool:
        """Whether the force follows acceleration more than velocity."""
        return self._share(self.a) > self._share(self.v)

    @property
    def energy(self) -> float:
        """Energy dissipated in the cycle [J]."""
        return float(np.trapezoid(self.F, self.x))

    def _share(self, motion: Array) -> float:
        return abs(float(np.trapezoid(self.F * motion, self.t))) / sqrt(np.trapezoid(motion**2, self.t))


@dataclass(frozen=True)
class Responses:
    """H(f) of both inerters under random displacement."""

    f: Array
    planetary: Complex
    disk: Complex

    @property
    def ratio(self) -> Array:
        """Gain of the planetary inerter over that of the disk."""
        return np.abs(self.planetary) / np.abs(self.disk)


def last_cycle(make: Callable[[], Component], test: Sinusoid) -> Cycle:
    """Return the last cycle of a test long enough for the start to die away."""
    period = 1 / test.frequency
    stop = max(2, ceil(SETTLING_SECONDS / period)) * period
    run = run_on_rig(make(), test, stop, step=period / 500)
    begin = stop - period
    t = np.linspace(0, period, 501)
    w = 2 * np.pi * test.frequency
    x, v = test.amplitude * np.sin(w * t), test.amplitude * w * np.cos(w * t)
    F = run.at("inerter.flange_a.f", begin + t)
    stuck = run.share("inerter.screw.friction.mode", "stuck", begin=begin)
    return Cycle(t, x, v, -(w**2) * x, F, stuck)


def random_tests() -> Responses:
    """Return frequencies and the responses of both inerters to random displacement."""
    found = {name: by_c(partial(rig_response, make(), RANDOM, settle=1.0)) for name, make in INERTERS.items()}
    (f, planetary), (_, disk) = found["planetary"], found["disk"]
    return Responses(f, planetary, disk)


def by_c(simulated: Callable[..., Found]) -> Found:
    """Return what a long run gives with solver "compiled", or with another where C cannot be compiled."""
    try:
        return simulated(solver="compiled")
    except ToolchainError:
        return simulated()
