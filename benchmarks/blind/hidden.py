"""Machines with a hidden law, by equations of their own that share nothing with the library, run by SciPy."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import inertance as ia
import numpy as np
from inertance.diagnosis.effects.hypothesis import Hypothesis
from numpy.typing import NDArray

Array = NDArray[np.float64]
Push = Callable[[Array | float], Array]
RATE = 100.0  # [Hz] of records
OUTPUTS = {"x1": "carriage.s", "x2": "tool.s"}
DEVIATIONS = {"spring.k": 0.2, "damper.d": 0.5, "leaf.k": 0.2, "pad.d": 0.5}


@dataclass(frozen=True)
class Machine:
    """Two masses in a row or one: m1 on spring and damper against the wall, m2 on another pair against m1."""

    m1: float = 2.0
    k1: float = 900.0
    d1: float = 7.0
    m2: float = 0.0
    k2: float = 500.0
    d2: float = 4.0


@dataclass(frozen=True)
class Law:
    """A force against the relative motion (s, v, z), and the rate of its inner state z."""

    kind: str
    force: Callable[[float, float, float], float]
    rate: Callable[[float, float, float], float] = lambda s, v, z: 0.0


def laws(draw: np.random.Generator, least: float = 0.7, most: float = 1.3) -> dict[str, Law]:
    """Return hidden laws with sizes drawn at random."""
    size = draw.uniform(least, most)
    dry, cubic, drag = 1.2 * size, 6e5 * size, 60.0 * size
    height, pitch = 1.5 * size, 6e-3 * draw.uniform(0.8, 1.2)
    stiff, yielded = 900.0 * size, 1.5e-3 * draw.uniform(0.8, 1.2)

    def turning(s: float, v: float, z: float) -> float:
        return v - 0.5 * (abs(v) * z * abs(z) + v * z * z) / yielded**2

    return {
        "dry friction": Law("coulomb_friction", lambda s, v, z: dry * np.tanh(v / 3e-5)),
        "cubic spring": Law("cubic_stiffness", lambda s, v, z: cubic * s**3),
        "square drag": Law("quadratic_damping", lambda s, v, z: drag * abs(v) * v),
        "ripple": Law("position_ripple", lambda s, v, z: height * np.sin(2 * np.pi * s / pitch)),
        "hysteresis": Law("hysteresis", lambda s, v, z: stiff * z, turning),
    }


def multisine(draw: np.random.Generator, rms: float) -> Push:
    """Return a push of many frequencies [N]."""
    frequencies = np.linspace(0.4, 6.0, 24) * draw.uniform(0.97, 1.03, 24)
    phases = draw.uniform(0, 2 * np.pi, 24)

    def push(t: Array | float) -> Array:
        lines = np.sin(2 * np.pi * np.multiply.outer(t, frequencies) + phases)
        return np.asarray(rms * np.sqrt(2 / 24) * lines.sum(axis=-1))

    return push


def moved(machine: Machine, law: Law, place: int, push: Push, time: Array) -> dict[str, Array]:
    """Return the positions [m] of the masses that there are, from rest at the first instant."""
    from scipy.integrate import solve_ivp

    def slope(t: float, y: Array) -> list[float]:
        x1, v1, x2, v2, z = y
        s, v = (x1, v1) if place == 1 else (x2 - x1, v2 - v1)
        hidden = law.force(s, v, z)
        inner = machine.k2 * (x2 - x1) + machine.d2 * (v2 - v1) + (hidden if place == 2 else 0.0)
        inner *= machine.m2 > 0
        outer = float(push(t)) - machine.k1 * x1 - machine.d1 * v1 - (hidden if place == 1 else 0.0)
        return [v1, (outer + inner) / machine.m1, v2, -inner / (machine.m2 or 1.0), law.rate(s, v, z)]

    method = "LSODA" if law.kind == "coulomb_friction" else "DOP853"
    span = float(time[0]), float(time[-1])
    run = solve_ivp(slope, span, np.zeros(5), method, time, rtol=1e-7, atol=1e-9, max_step=0.01)
    return {name: run.y[2 * n] for n, name in enumerate(OUTPUTS) if name == "x1" or machine.m2}


def one_sided(draw: np.random.Generator, least: float, most: float) -> Law:
    """Return a spring that pushes and does not pull."""
    stiff = 300.0 * draw.uniform(least, most)
    return Law("bilinear_stiffness", lambda s, v, z: stiff * max(s, 0.0))


def network(machine: Machine) -> ia.Network:
    """Return the machine as an engineer would model it, 10 % off in its springs and 20 % in its dampers."""
    net = ia.Network("rig", wall=ia.Fixed(), push=ia.Force(), carriage=ia.Mass(m=machine.m1))
    net.add(spring=ia.Spring(k=1.1 * machine.k1), damper=ia.Damper(d=0.8 * machine.d1))
    net.connect(net.wall.flange, net.spring.flange_a, net.damper.flange_a)
    net.connect(net.push.flange, net.carriage.flange, net.spring.flange_b, net.damper.flange_b)
    if machine.m2:
        net.add(tool=ia.Mass(m=machine.m2), leaf=ia.Spring(k=0.9 * machine.k2), pad=ia.Damper(d=machine.d2))
        net.connect(net.carriage.flange, net.leaf.flange_a, net.pad.flange_a)
        net.connect(net.tool.flange, net.leaf.flange_b, net.pad.flange_b)
    return net


def modelled(machine: Machine) -> dict[str, Any]:
    """Return model, channels and parameters of the machine, as a `Campaign` takes them."""
    outputs = {c: {"output": path, "unit": "m"} for c, path in OUTPUTS.items() if c == "x1" or machine.m2}
    known = DEVIATIONS if machine.m2 else {path: DEVIATIONS[path] for path in ("spring.k", "damper.d")}
    return {
        "model": network(machine),
        "channels": {"F": {"input": "push.f", "unit": "N"}, **outputs},
        "parameters": {path: {"rel": rel} for path, rel in known.items()},
    }


def right(law: Law, place: int, effects: Sequence[Hypothesis]) -> bool:
    """Tell whether effects are the hidden law at its place, or at what shares its two nodes."""
    sites = ("leaf", "pad") if place == 2 else ("spring", "damper", "carriage")
    return [one.effect.kind for one in effects] == [law.kind] and effects[0].site.path in sites
