"""Effects of the second generation: where they sit, what shapes them, what they do to a rig or a channel."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from itertools import accumulate

import numpy as np
from assembly import Rig, Values
from effects import (
    ACROSS,
    Effect,
    Maker,
    Offer,
    Shape,
    Sized,
    Typical,
    acted,
    assembled,
    channel,
    first_guess,
    forces_on,
    sensed,
)
from scipy.signal import butter, lfilter
from second.excitations import PREROLL
from stepper import Array, Drive, simulate

Rng = np.random.Generator
SERIES = ("backlash", "compliance")
OUTSIDE = ("impacts", "jam", "softening", "bent_gauge", "drive_limit")
ONE_LAW = {  # Bouc and Wen's law with the exponent 1 is Dahl's; Iwan's is one of cells, as all these have
    "presliding_friction": ("presliding_friction", "hysteresis", "iwan_hysteresis"),
    "hysteresis": ("hysteresis", "presliding_friction", "iwan_hysteresis"),
}


def places(rig: Rig) -> list[Offer]:
    """Return every (kind, place, sites) of the vocabulary that a rig offers."""
    return [(kind, place, _sites(rig, place, kind)) for place, kinds in rig.kinds.items() for kind in kinds]


def rivals(rig: Rig) -> list[Offer]:
    """Return what a diagnosis may take an effect for: all a rig offers, and a force on each motion."""
    offers = places(rig)
    return offers + [force for force in forces_on(rig) if force not in offers]


def outside(rig: Rig) -> list[Offer]:
    """Return every (kind, place, sites) a rig offers that the vocabulary lacks."""
    held = {place for place in rig.motions if any(kind in rig.kinds.get(place, ()) for kind in STAYING)}
    found: list[Offer] = [
        (kind, place, rig.motions[place].sites)
        for kind in ("impacts", "jam", "softening")
        for place in sorted(held)
    ]
    found += [("bent_gauge", name, (name,)) for name in rig.outputs]
    return found + [("drive_limit", place, ()) for place in rig.loads if rig.loads[place] == "loop"]


STAYING = ("cubic_stiffness", "hysteresis", "position_ripple")  # where travel is bounded


def _sites(rig: Rig, place: str, kind: str) -> tuple[str, ...]:
    if place in rig.channels:
        return (place,)
    if kind in SERIES:
        return rig.bonds[place].sites
    return rig.nodes[place] if kind == "added_inertia" else rig.motions[place].sites


def draw(offer: Offer, rng: Rng, duration: float) -> Effect:
    """Draw the shape of an effect: numbers that say what it looks like, whatever its size."""
    kind, place, sites = offer
    shape = SHAPES[kind](rng) if kind in SHAPES else {}
    if kind == "jam":
        shape["from"] *= duration
    return Effect(kind, place, sites, {name: float(value) for name, value in shape.items()})


def _sign(rng: Rng) -> float:
    return float(rng.choice([-1, 1]))


def _turn(rng: Rng) -> float:
    return float(rng.uniform(0, 2 * np.pi))


SHAPES: dict[str, Callable[[Rng], Shape]] = {
    "stribeck_friction": lambda r: {
        "surplus": r.uniform(0.6, 1.5),
        "speed": r.uniform(0.1, 0.4),
        "exponent": r.uniform(0.8, 1.5),
    },
    "asymmetric_friction": lambda r: {"skew": _sign(r) * r.uniform(0.4, 0.8)},
    "friction_drift": lambda r: {"time": r.uniform(15.0, 60.0)},
    "viscous_drift": lambda r: {"time": r.uniform(10.0, 40.0)},
    "presliding_friction": lambda r: {"creep": r.uniform(0.05, 0.3), "cells": float(r.uniform() < 0.5)},
    "position_dependent_friction": lambda r: {
        "variation": _sign(r) * r.uniform(0.5, 0.9),
        "centre": r.uniform(-1, 1),
    },
    "position_ripple": lambda r: {"period": r.uniform(0.4, 1.6), "phase": _turn(r)},
    "harmonic_ripple": lambda r: {
        "period": r.uniform(0.8, 2.0),
        "phase": _turn(r),
        "second": r.uniform(0.5, 1.0),
        "of_second": _turn(r),
        "third": r.uniform(0.3, 0.7),
        "of_third": _turn(r),
    },
    "bilinear_stiffness": lambda r: {"ratio": r.uniform(0.0, 0.3), "side": _sign(r)},
    "hysteresis": lambda r: {"yield": r.uniform(0.6, 2.0), "power": r.choice([0.0, 1.0, 2.0])},
    "constant_force": lambda r: {"sign": _sign(r)},
    "arm_gravity": lambda r: {"mounted": _turn(r)},
    "sensor_delay": lambda r: {"sign": _sign(r), "filtered": float(r.uniform() < 0.5)},
    "sensor_bias": lambda r: {"sign": _sign(r)},
    "sensor_gain": lambda r: {"sign": _sign(r)},
    "sensor_drift": lambda r: {"sign": _sign(r), "curve": r.uniform(0.8, 1.3)},
    "bent_gauge": lambda r: {"sign": _sign(r)},
    "impacts": lambda r: {"side": _sign(r)},
    "jam": lambda r: {"from": r.uniform(0.3, 0.8)},
    "softening": lambda r: {"time": r.uniform(2.0, 6.0)},
}


def _dry(size: float, t: Typical, shape: Shape) -> tuple[str, tuple[float, ...]]:
    level, speed = size * t.force, shape.get("speed", 1.0) * t.speed
    p = (level, level, shape.get("surplus", 0.0), speed, shape.get("exponent", 1.0), 0, 0, 0, 0, 0)
    if not shape.get("creep"):
        return "FRICTION", p
    stiffness = level / (shape["creep"] * t.travel)
    return "LUGRE", (*p, stiffness, 0.02 * level / t.speed)


def _presliding(size: float, t: Typical, shape: Shape) -> tuple[str, tuple[float, ...]]:
    """LuGre's bristles, or Maxwell's slip in cells, which reach the same level."""
    if not shape["cells"]:
        return _dry(size, t, shape)
    longest = 2 * shape["creep"] * t.travel
    return "JENKINS", (2 * size * t.force / longest, longest, 1.0)


def _varying(size: float, t: Typical, shape: Shape) -> tuple[str, tuple[float, ...]]:
    level = size * t.force
    p = (level, level, 0, 1, 1, 0, 0, 0, 0, 0, 0, 0)
    return "FRICTION", (*p, shape["variation"], shape["centre"] * t.travel, 2.5 * t.travel)


def _harmonics(size: float, t: Typical, q: Shape) -> tuple[str, tuple[float, ...]]:
    of = (q["second"], q["of_second"], q["third"], q["of_third"])
    return "RIPPLE", (size * t.force, q["period"] * t.travel, q["phase"], *of)


def _jam(size: float, t: Typical, shape: Shape) -> tuple[str, tuple[float, ...]]:
    begin = PREROLL + shape["from"]
    return "FRICTION", (size * t.force, size * t.force, 0, 1, 1, 0, 0, 0, begin, begin + 0.5)


LAWS: dict[str, Maker] = {
    **ACROSS,
    "coulomb_friction": _dry,
    "stribeck_friction": _dry,
    "presliding_friction": _presliding,
    "position_dependent_friction": _varying,
    "harmonic_ripple": _harmonics,
    "hysteresis": lambda s, t, q: ("JENKINS", (s * t.force / t.travel, q["yield"] * t.travel, q["power"])),
    "arm_gravity": lambda s, t, q: ("RIPPLE", (s * t.force, 2 * np.pi, q["mounted"])),
    "cubic_damping": lambda s, t, _: ("POWER_OF_SPEED", (s * t.force / t.speed**3, 3.0)),
    "viscous_drift": lambda s, t, q: (
        "POWER_OF_SPEED",
        (3 * s * t.force / t.speed, 1.0, 0, 0, 0, 0, 0, q["time"]),
    ),
    "softening": lambda s, t, q: (
        "POWER_OF_TRAVEL",
        (-s * t.force / t.travel, 1.0, 0, 0, 0, 0, 0, q["time"]),
    ),
    "jam": _jam,
    "drive_limit": lambda s, t, _: ("LIMITED", (3.5 * t.load / (1 + s),)),
}


def signals(
    rig: Rig,
    values: Values,
    drive: Drive,
    effects: list[Sized],
    typical: Mapping[str, Typical],
    step: float,
    duration: float,
) -> Array:
    """Return what a perfect instrument would see, input first, (steps, channels), at the stepping rate."""
    commanded = drive.w if rig.prescribed else drive.u
    for effect, size in effects:
        if effect.place == rig.input:
            drive = _acted(effect, size, drive, step, rig.amplitude)
    rows, assembly = assembled(rig, values, effects, typical, LAWS)
    seen = np.column_stack([commanded, simulate(assembly.system(), drive, rows, step)])
    for effect, size in effects:
        if effect.place in rig.outputs:
            column, usual = 1 + rig.outputs.index(effect.place), typical[channel(effect.place)]
            seen[:, column] = _sensed(effect, size, seen[:, column], usual, step, duration)
    return seen


def guess(effect: Effect, rig: Rig, drive: Drive, step: float) -> float:
    """Return a size from which the search for a severity begins."""
    known = {
        "actuator_delay": 1e-3,
        "actuator_saturation": 0.5,
        "actuator_backlash": 0.03 * rig.amplitude,
        "drive_limit": 0.5,
    }
    return known.get(effect.kind) or first_guess(effect, rig, drive, step)


def _acted(effect: Effect, size: float, drive: Drive, step: float, usual: float) -> Drive:
    """Return what an actuator does of what it is told."""
    if effect.kind == "actuator_backlash":
        w = _play(drive.w, size)
        return Drive(_play(drive.u, size), w, np.gradient(w, step), drive.wdd)
    if effect.kind == "actuator_saturation":
        limit = 3 * usual / (1 + size)
        return Drive(drive.u / (1 + np.abs(drive.u / limit) ** 12) ** (1 / 12), drive.w, drive.wd, drive.wdd)
    return acted(effect, size, drive, step)


def _play(signal: Array, half: float) -> Array:
    def follow(at: float, pulled: float) -> float:
        return min(max(at, pulled - half), pulled + half)

    return np.array(list(accumulate(signal.tolist(), follow, initial=0.0))[1:])


def _sensed(
    effect: Effect, size: float, signal: Array, usual: Typical, step: float, duration: float
) -> Array:
    """Return what a sensor makes of its signal; its bias and drift are the same in every record."""
    sign = effect.shape.get("sign", 1.0)
    if effect.kind == "sensor_delay" and sign > 0 and effect.shape["filtered"]:
        return np.asarray(lfilter(*butter(2, np.sqrt(2) / size / np.pi * step), signal))  # group delay: size
    if effect.kind == "bent_gauge":
        return signal * (1 + sign * size * (signal / (2 * usual.travel)) ** 2)
    if effect.kind == "sensor_drift":
        t = np.clip((np.arange(len(signal)) * step - PREROLL) / duration, 0, None)
        return np.asarray(signal + sign * size * usual.travel * t ** effect.shape["curve"])
    return sensed(effect, size, signal, usual, step)
