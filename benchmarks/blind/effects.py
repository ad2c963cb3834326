"""Effects as the truth knows them: where they sit, what shapes them, what they do to a rig or a channel."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from assembly import Assembly, Rig, Values
from excitations import DURATION, STEP
from rigs import OF_INPUTS, OF_OUTPUTS
from scipy.signal import lfilter
from stepper import Array, Drive, Element, Row, simulate

Rng = np.random.Generator
Shape = dict[str, float]
Offer = tuple[str, str, tuple[str, ...]]  # kind, place, sites
UNKNOWN = ("impacts", "lead_error", "jam", "varying_ratio")


@dataclass(frozen=True)
class Effect:
    """One effect at one place, its size apart.

    Attributes:
        kind: a kind of the vocabulary, or one of UNKNOWN.
        place: name of a motion, bond, node or channel of the rig.
        sites: every site that is a right answer.
        shape: what its draw has fixed.
    """

    kind: str
    place: str
    sites: tuple[str, ...]
    shape: Shape


@dataclass(frozen=True)
class Typical:
    """How a motion usually goes: root mean square of travel and speed, the force that is usual there."""

    travel: float
    speed: float
    force: float
    load: float


def places(rig: Rig) -> list[Offer]:
    """Return every offer of a rig from the vocabulary."""
    found = []
    for place, kinds in rig.kinds.items():
        for kind in kinds:
            sites = _sites(rig, place, kind)
            if kind != "load_dependent_friction" and sites:
                found.append((kind, place, sites))
    found += [("load_dependent_friction", place, rig.motions[place].sites) for place in rig.loads]
    found += [(kind, channel, (channel,)) for kind in OF_OUTPUTS for channel in rig.outputs]
    found += [(kind, rig.input, (rig.input,)) for kind in OF_INPUTS[: 1 if rig.prescribed else 2]]
    return found


def forces_on(rig: Rig) -> list[Offer]:
    """Return a force that stays, on each motion of a rig."""
    return [("constant_force", place, motion.sites) for place, motion in rig.motions.items()]


def rivals(rig: Rig) -> list[Offer]:
    """Return what a diagnosis may take an effect for: all a rig offers, forces that stay, a late command."""
    return [*places(rig), *forces_on(rig), ("actuator_delay", rig.input, (rig.input,))]


def outside(rig: Rig) -> list[Offer]:
    """Return every offer of a rig that the vocabulary lacks."""
    moving = [(place, motion.sites) for place, motion in rig.motions.items() if any(motion.b)]
    found = [(kind, place, sites) for kind in ("impacts", "jam") for place, sites in moving]
    if rig.warp:
        found.append((rig.warp[1], rig.warp[0], rig.bonds[rig.warp[0]].sites))
    return found


def draw(kind: str, place: str, sites: tuple[str, ...], rng: Rng) -> Effect:
    """Draw the shape of an effect: numbers that say what it looks like, whatever its size."""
    uniform = rng.uniform
    shape = {
        "coulomb_friction": lambda: {"bristles": float(uniform() < 1 / 3)},
        "stribeck_friction": lambda: {
            "surplus": uniform(0.6, 1.5),
            "speed": uniform(0.1, 0.4),
            "exponent": uniform(0.8, 1.5),
            "bristles": float(uniform() < 1 / 3),
        },
        "asymmetric_friction": lambda: {"skew": rng.choice([-1, 1]) * uniform(0.4, 0.8)},
        "friction_drift": lambda: {"time": uniform(15.0, 60.0)},
        "position_ripple": lambda: {"period": uniform(0.4, 1.6), "phase": uniform(0, 2 * np.pi)},
        "bilinear_stiffness": lambda: {"ratio": uniform(0.0, 0.3), "side": float(rng.choice([-1, 1]))},
        "hysteresis": lambda: {"yield": uniform(0.3, 1.2)},
        "cubic_stiffness": lambda: {"sign": 1.0},
        "sensor_bias": lambda: {"sign": float(rng.choice([-1, 1]))},
        "sensor_gain": lambda: {"sign": float(rng.choice([-1, 1]))},
        "sensor_drift": lambda: {"sign": float(rng.choice([-1, 1])), "curve": uniform(0.9, 1.3)},
        "jam": lambda: {"from": uniform(0.3, 0.8)},
        "impacts": lambda: {"side": float(rng.choice([-1, 1]))},
        "lead_error": lambda: {"period": uniform(0.5, 1.5), "phase": uniform(0, 2 * np.pi)},
        "varying_ratio": lambda: {"period": 1 / rng.integers(1, 4), "phase": uniform(0, 2 * np.pi)},
    }.get(kind, dict)()
    return Effect(kind, place, sites, {name: float(value) for name, value in shape.items()})


Sized = tuple[Effect, float]


def signals(
    rig: Rig,
    values: Values,
    drive: Drive,
    effects: list[Sized],
    typical: Mapping[str, Typical],
    step: float = STEP,
) -> Array:
    """Return what a perfect instrument would see, input first, (steps, channels), at the stepping rate."""
    commanded = drive
    for effect, size in effects:
        if effect.place == rig.input:
            drive = acted(effect, size, drive, step)
    rows, assembly = assembled(rig, values, effects, typical)
    y = simulate(assembly.system(), drive, rows, step)
    seen = np.column_stack([commanded.w if rig.prescribed else commanded.u, y])
    for effect, size in effects:
        if effect.kind in OF_OUTPUTS:
            column = 1 + rig.outputs.index(effect.place)
            seen[:, column] = sensed(effect, size, seen[:, column], typical[channel(effect.place)], step)
    return seen


def typical_of(rig: Rig, drive: Drive, step: float = STEP) -> dict[str, Typical]:
    """Return how every motion and output of a rig usually goes, from its nominal under one excitation."""
    assembly, outputs = rig.assemble(rig.parameters, "", {})
    rows = [row for motion in rig.motions.values() for row in (motion.travel(), motion.speed())]
    loads = [rig.bonds[rig.loads[m]].force(rig.parameters) if m in rig.loads else Row() for m in rig.motions]
    y = np.std(simulate(assembly.system(), drive, rows + loads + outputs, step), axis=0)
    count = len(rig.motions)
    motions = {
        name: Typical(y[2 * i], y[2 * i + 1], rig.scale, y[2 * count + i] or 1.0)
        for i, name in enumerate(rig.motions)
    }
    seen = zip(rig.outputs, y[3 * count :], strict=True)
    return motions | {channel(name): Typical(size, 1.0, 1.0, 1.0) for name, size in seen}


def channel(name: str) -> str:
    """Return the name under which the usual size of an output is kept."""
    return f"channel {name}"


def first_guess(effect: Effect, rig: Rig, drive: Drive, step: float = STEP) -> float:
    """Return a size from which the search for a severity begins."""
    if effect.kind in ("backlash", "compliance"):
        bond = rig.bonds[effect.place]
        k, d = bond.numbers(rig.parameters)
        if effect.kind == "compliance":
            return 0.1 / (k + 20 * d)
        rest = "" if effect.place != "drive_line" else effect.place
        assembly, _ = rig.assemble(rig.parameters, rest, {})
        if rest:
            assembly.link(bond.motion, k, d)
        return 0.1 * float(np.std(simulate(assembly.system(), drive, [bond.motion.travel()], step)))
    if effect.kind == "added_inertia":
        return 1e-3 * rig.scale
    if effect.kind == "actuator_dead_zone":
        return 0.05 * float(np.std(drive.u))
    return {"sensor_delay": 1e-3, "actuator_delay": 1e-3, "actuator_lag": 1e-3}.get(effect.kind, 0.02)


def _sites(rig: Rig, place: str, kind: str) -> tuple[str, ...]:
    if kind in ("backlash", "compliance"):
        return rig.bonds[place].sites
    if kind == "added_inertia":
        return rig.nodes[place]
    return rig.motions[place].sites


def assembled(
    rig: Rig,
    values: Values,
    effects: list[Sized],
    typical: Mapping[str, Typical],
    makers: Mapping[str, Maker] | None = None,
) -> tuple[list[Row], Assembly]:
    """Return the rows of the outputs and the rig with its effects put in."""
    series = [
        (e, s) for e, s in effects if e.kind in ("backlash", "compliance", "lead_error", "varying_ratio")
    ]
    without = series[0][0].place if series else ""
    extra = {e.place: s for e, s in effects if e.kind == "added_inertia"}
    assembly, rows = rig.assemble(values, without, extra)
    for effect, size in series:
        _put_in_series(rig, values, assembly, effect, size)
    for effect, size in effects:
        maker = (makers or ACROSS).get(effect.kind)
        if maker:
            motion = rig.motions[effect.place]
            law, p = maker(size, typical[effect.place], effect.shape)
            loaded = law in ("LOADED", "LIMITED")
            load = rig.bonds[rig.loads[effect.place]].force(values) if loaded else None
            b = np.pad(motion.b, (0, len(assembly.M) - len(motion.b)))
            assembly.elements.append(
                Element("FRICTION" if law == "LOADED" else law, b, motion.cw, p, load=load)
            )
    return rows, assembly


def _put_in_series(rig: Rig, values: Values, assembly: Assembly, effect: Effect, size: float) -> None:
    bond = rig.bonds[effect.place]
    k, d = bond.numbers(values)
    b, cw = np.array(bond.motion.b), bond.motion.cw
    if effect.kind == "backlash":
        assembly.elements.append(Element("CLEARANCE", b, cw, (k, d, size)))
    elif effect.kind == "compliance" and effect.place == "drive_line":
        assembly.link(bond.motion, 1 / size, 2e-4 / size)
    elif effect.kind == "compliance":
        assembly.elements.append(Element("MAXWELL", b, cw, (1 / size, k, d)))
    elif rig.warp:
        _, _, warp, turn = rig.warp
        p = (k, d, 0, 0, 0, size * turn, effect.shape["period"] * turn, effect.shape["phase"])
        assembly.elements.append(Element("WARPED", b, cw, p, warp=np.array(warp)))


def _friction(size: float, t: Typical, shape: Shape) -> tuple[str, tuple[float, ...]]:
    level, surplus = size * t.force, shape.get("surplus", 0.0)
    speed = shape.get("speed", 1.0) * t.speed
    p = (level, level, surplus, speed, shape.get("exponent", 1.0), 0, 0, 0, 0, 0)
    if shape.get("bristles"):
        return "BRISTLES", (*p, 1 / (0.01 * t.travel) * level)
    return "FRICTION", p


def _bilinear(size: float, t: Typical, shape: Shape) -> tuple[str, tuple[float, ...]]:
    k = size * t.force / t.travel
    pair = (k, k * shape["ratio"])
    return "BILINEAR", pair if shape["side"] > 0 else pair[::-1]


def _impacts(size: float, t: Typical, shape: Shape) -> tuple[str, tuple[float, ...]]:
    gaps = (1.7 * t.travel, 1e9) if shape["side"] < 0 else (1e9, 1.7 * t.travel)
    return "CONTACT", (
        size * 20 * t.force / t.travel,
        0.05 * size * t.force / t.speed,
        *gaps,
        0.05 * t.travel,
    )


def _jam(size: float, t: Typical, shape: Shape) -> tuple[str, tuple[float, ...]]:
    level, begin = size * t.force, shape["from"] * DURATION
    return "FRICTION", (level, level, 0, 1, 1, 0, 0, 0, begin, begin + 0.5)


Maker = Callable[[float, Typical, Shape], tuple[str, tuple[float, ...]]]
ACROSS: dict[str, Maker] = {
    "viscous_damping": lambda s, t, _: ("POWER_OF_SPEED", (s * t.force / t.speed, 1.0)),
    "quadratic_damping": lambda s, t, _: ("POWER_OF_SPEED", (s * t.force / t.speed**2, 2.0)),
    "coulomb_friction": _friction,
    "stribeck_friction": _friction,
    "asymmetric_friction": lambda s, t, q: (
        "FRICTION",
        (s * t.force * (1 + q["skew"]), s * t.force * (1 - q["skew"]), 0, 1, 1),
    ),
    "load_dependent_friction": lambda s, t, _: ("LOADED", (0, 0, 0, 1, 1, s * t.force / t.load)),
    "friction_drift": lambda s, t, q: ("FRICTION", (0, 0, 0, 1, 1, 0, 3 * s * t.force, q["time"])),
    "position_ripple": lambda s, t, q: (
        "RIPPLE",
        (s * t.force, q["period"] * t.travel, q["phase"]),
    ),
    "linear_stiffness": lambda s, t, _: ("POWER_OF_TRAVEL", (s * t.force / t.travel, 1.0)),
    "cubic_stiffness": lambda s, t, _: ("POWER_OF_TRAVEL", (s * t.force / t.travel**3, 3.0)),
    "bilinear_stiffness": _bilinear,
    "hysteresis": lambda s, t, q: ("IWAN", (s * t.force / t.travel, q["yield"] * 2 * t.travel)),
    "constant_force": lambda s, t, q: ("CONSTANT", (q["sign"] * s * t.force,)),
    "impacts": _impacts,
    "jam": _jam,
}


def acted(effect: Effect, size: float, drive: Drive, step: float) -> Drive:
    """Return what an actuator does of what it is told; dead zones are for forces."""
    if effect.kind == "actuator_dead_zone":
        return Drive(drive.u - np.clip(drive.u, -size, size), drive.w, drive.wd, drive.wdd)
    size, shift = (
        (size, lagged) if effect.kind == "actuator_lag" else (effect.shape.get("sign", 1.0) * size, late)
    )
    return Drive(*(shift(signal, size, step) for signal in (drive.u, drive.w, drive.wd, drive.wdd)))


def late(signal: Array, delay: float, step: float) -> Array:
    """Return a signal as it was a delay before."""
    t = np.arange(len(signal)) * step
    return np.interp(t - delay, t, signal)


def lagged(signal: Array, lag: float, step: float) -> Array:
    """First-order lag, by the exact recursion for a signal linear between samples."""
    decay = np.exp(-step / lag)
    mean = lag / step * (1 - decay)
    return np.asarray(lfilter([1 - mean, mean - decay], [1, -decay], signal))


def sensed(effect: Effect, size: float, signal: Array, usual: Typical, step: float) -> Array:
    """Return what a sensor makes of its signal; its bias and drift are the same in every record."""
    scale = usual.travel
    t = np.arange(len(signal)) * step
    sign = effect.shape.get("sign", 1.0)
    if effect.kind == "sensor_delay":
        return late(signal, sign * size, step)
    if effect.kind == "sensor_gain":
        return signal * (1 + sign * size)
    if effect.kind == "sensor_bias":
        return signal + sign * size * scale
    return signal + sign * size * scale * (t / DURATION) ** effect.shape["curve"]
