"""Machines of the third generation: masses, springs, dampers, one thing more; Runge and Kutta's method."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Extra = Callable[[float, Array, Array], Array]  # (t, elongation, speed) -> force, for each record


@dataclass(frozen=True)
class Joint:
    """Where something may act: between coordinates, by the components of the model that are there."""

    row: tuple[float, ...]
    sites: tuple[str, ...]
    k: str = ""
    d: str = ""


@dataclass(frozen=True)
class Machine:
    """A nominal machine: inertias, joints with the names of their constants, and what is measured.

    Attributes:
        values: parameters of the nominal model by path; `uncertain` are those that are off.
        inertias: path or number of each coordinate's.
        outputs: channel -> (coordinate, 1 for its speed else 0, path in the model, unit).
        drive: rms of the input, and its band [Hz].
    """

    name: str
    values: dict[str, float]
    uncertain: tuple[str, ...]
    inertias: tuple[float, ...]
    joints: dict[str, Joint]
    outputs: dict[str, tuple[int, int, str, str]]
    input: tuple[str, str]
    drive: tuple[float, float, float]
    free: bool = False


MACHINES = {
    "slide": Machine(
        "slide",
        {"spring.k": 900.0, "spring.d": 9.0},
        ("spring.k", "spring.d"),
        (1.6,),
        {"rail": Joint((1.0,), ("spring", "block"), "spring.k", "spring.d")},
        {"x": (0, 0, "block.s", "m")},
        ("push.f", "N"),
        (12.0, 0.3, 6.0),
    ),
    "pair": Machine(
        "pair",
        {
            "left.k": 700.0,
            "left.d": 7.0,
            "middle.k": 500.0,
            "middle.d": 4.0,
            "right.k": 800.0,
            "right.d": 5.0,
        },
        ("left.k", "middle.k", "right.k", "middle.d"),
        (1.2, 0.9),
        {
            "left": Joint((1.0, 0.0), ("left", "first"), "left.k", "left.d"),
            "middle": Joint((-1.0, 1.0), ("middle",), "middle.k", "middle.d"),
            "right": Joint((0.0, 1.0), ("right", "second"), "right.k", "right.d"),
        },
        {"x1": (0, 0, "first.s", "m"), "x2": (1, 0, "second.s", "m")},
        ("push.f", "N"),
        (14.0, 0.4, 7.0),
    ),
    "rotor": Machine(
        "rotor",
        {"coupling.c": 40.0, "coupling.d": 0.03, "bearing.d": 0.12, "brake.d": 0.1},
        ("coupling.c", "bearing.d", "brake.d"),
        (0.02, 0.03),
        {
            "bearing": Joint((1.0, 0.0), ("bearing", "motor"), "", "bearing.d"),
            "coupling": Joint((-1.0, 1.0), ("coupling",), "coupling.c", "coupling.d"),
            "brake": Joint((0.0, 1.0), ("brake", "load"), "", "brake.d"),
        },
        {"w": (0, 1, "motor.w", "rad/s"), "angle": (1, 0, "load.phi", "rad")},
        ("drive.tau", "N.m"),
        (1.2, 0.2, 4.0),
        free=True,
    ),
}


@dataclass(frozen=True)
class Cause:
    """What acts beside the model: a force, a share of an inertia or of a stiffness over time.

    Attributes:
        loose: mass, half the room and stiffness of a part that rattles on the first coordinate.
    """

    joint: str = ""
    force: Extra | None = None
    inertia: Callable[[float], float] = lambda t: 1.0
    stiffness: Callable[[float], float] = lambda t: 1.0
    loose: tuple[float, float, float] | None = None


def run(
    machine: Machine, values: dict[str, float], cause: Cause, drive: Array, step: float
) -> tuple[Array, Array]:
    """Return coordinates and speeds, (steps, records, coordinates), under a force given at half steps."""
    n, records = len(machine.inertias), drive.shape[1]
    rows = {name: np.array(joint.row) for name, joint in machine.joints.items()}
    K, D = np.zeros((n, n)), np.zeros((n, n))
    for name, joint in machine.joints.items():
        square = np.outer(rows[name], rows[name])
        K += values.get(joint.k, 0.0) * square
        D += values.get(joint.d, 0.0) * square
    part = np.zeros((n, n))
    if cause.joint:
        part = values.get(machine.joints[cause.joint].k, 0.0) * np.outer(rows[cause.joint], rows[cause.joint])
    masses, at = np.array(machine.inertias), rows.get(cause.joint)
    loose = cause.loose

    def rate(t: float, y: Array, u: Array) -> Array:
        q, v = y[:, :n], y[:, n : 2 * n]
        f = -q @ (K + (cause.stiffness(t) - 1) * part) - v @ D
        f[:, 0] += u
        if cause.force is not None:
            f -= cause.force(t, q @ at, v @ at)[:, None] * at
        further = []
        if loose is not None:
            mass, room, k = loose
            away, speed = y[:, 2 * n] - q[:, 0], y[:, 2 * n + 1] - v[:, 0]
            deep = np.maximum(np.abs(away) - room, 0.0)
            push = np.sign(away) * np.maximum(
                k * deep + 0.02 * (mass * k) ** 0.5 * np.sign(away) * speed, 0.0
            )
            push = np.where(deep > 0, push, 0.0)
            f[:, 0] += push
            further = [y[:, 2 * n + 1], -push / mass]
        share = np.ones(n)
        share[0] = cause.inertia(t)
        return np.column_stack([v, f / (masses * share), *further])

    y = np.zeros((records, 2 * n + 2 * (loose is not None)))
    seen = np.zeros(((len(drive) - 1) // 2 + 1, records, 2 * n))
    for number in range(len(seen)):
        seen[number] = y[:, : 2 * n]
        if number + 1 == len(seen):
            break
        t, u = number * step, drive[2 * number : 2 * number + 3]
        a = rate(t, y, u[0])
        b = rate(t + step / 2, y + step / 2 * a, u[1])
        c = rate(t + step / 2, y + step / 2 * b, u[1])
        d = rate(t + step, y + step * c, u[2])
        y = y + step / 6 * (a + 2 * b + 2 * c + d)
    return seen[:, :, :n], seen[:, :, n:]
