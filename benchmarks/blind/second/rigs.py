"""The rigs of the second generation, each written as energy and virtual work of its own coordinates.

Nominal values and paths are those of the nominal models in `models/`. A coordinate that moves with nothing
stands for a rig without states, one without mass for the integral of a controller.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import pi

import numpy as np
from assembly import Assembly, Bond, Motion, Rig, Values
from stepper import NMAX, Array, Row

DAMPING = ("quadratic_damping", "cubic_damping", "viscous_drift")
STIFFNESS = ("cubic_stiffness", "bilinear_stiffness", "hysteresis")
RIPPLE = ("position_ripple", "harmonic_ripple")
DRY = (
    "coulomb_friction",
    "stribeck_friction",
    "asymmetric_friction",
    "friction_drift",
    "presliding_friction",
    "position_dependent_friction",
)
COMMAND = ("actuator_delay", "actuator_lag")
DRIVE = (*COMMAND, "actuator_dead_zone", "actuator_saturation", "actuator_backlash")
SENSOR = ("sensor_delay", "sensor_bias", "sensor_gain", "sensor_drift")


def _at(i: int, value: float = 1.0) -> Array:
    row = np.zeros(NMAX)
    row[i] = value
    return row


CART = Motion(("cart", "spring", "damper"), (1.0,))


def _cart(values: Values, without: str, extra: Mapping[str, float]) -> tuple[Assembly, list[Row]]:
    rig = Assembly(1)
    rig.mass(values["cart.m"], 1.0)
    rig.link(CART, values["spring.k"] * (without != "spring"), values["damper.d"])
    rig.gu[0] = 1.0
    return rig, [Row(q=_at(0))]


OSCILLATOR = Rig(
    name="oscillator",
    parameters={"cart.m": 2.0, "spring.k": 800.0, "damper.d": 8.0},
    channels={"F": ("push.f", "N"), "x": ("cart.s", "m")},
    prescribed=False,
    assemble=_cart,
    motions={"cart": CART},
    bonds={"spring": Bond(CART, "spring.k", 0.0, ("spring",))},
    nodes={},
    loads={},
    kinds={
        "cart": (*DAMPING, *STIFFNESS, *RIPPLE, *DRY, "constant_force"),
        "spring": ("backlash",),
        "F": DRIVE,
        "x": SENSOR,
    },
    scale=10.0,
    amplitude=10.0,
    band=(0.3, 10.0),
)

STROKE = Motion(("specimen", "slider"), (0.0,), 1.0)


def _bench(values: Values, without: str, extra: Mapping[str, float]) -> tuple[Assembly, list[Row]]:
    rig = Assembly(1)
    rig.mass(1.0, 1.0)  # moves with nothing
    if without != "specimen":
        rig.link(STROKE, values["specimen.k"], values["specimen.d"])
    rig.reaction.wdd = 1.2
    return rig, [rig.reaction]


BENCH = Rig(
    name="bench",
    parameters={"specimen.k": 2.0e4, "specimen.d": 900.0},
    channels={"x": ("actuator.s_ref", "m"), "F": ("load_cell.f", "N")},
    prescribed=True,
    assemble=_bench,
    motions={"stroke": STROKE},
    bonds={"specimen": Bond(STROKE, "specimen.k", "specimen.d", ("specimen",))},
    nodes={},
    loads={},
    kinds={
        "stroke": (*DAMPING, *STIFFNESS, *RIPPLE, *DRY, "constant_force"),
        "specimen": ("backlash", "compliance"),
        "x": COMMAND,
        "F": SENSOR,
    },
    scale=200.0,
    amplitude=6e-3,
    band=(0.2, 6.0),
    resolution=1e-7,
)

KP, KD, KI = 60.0, 1.5, 100.0
MOTOR = Motion(("motor",), (1.0, 0.0, 0.0))
ARM = Motion(("arm", "bearing"), (0.0, 1.0, 0.0))
ELASTIC = Motion(("shaft",), (-1.0, 1.0, 0.0))


@dataclass(frozen=True)
class Loop(Bond):
    """A controller: its command is the force of the bond."""

    def force(self, values: Values) -> Row:
        """Return KP (w - q) - KD v + KI times the integral of w - q."""
        return Row(q=_at(0, -KP) + _at(2, KI), v=_at(0, -KD), w=KP)


LOOP = Loop(MOTOR, KP, KD, ())


def _servo(values: Values, without: str, extra: Mapping[str, float]) -> tuple[Assembly, list[Row]]:
    rig = Assembly(3)
    rig.mass(0.01, *MOTOR.b)
    rig.mass(values["arm.J"], *ARM.b)
    rig.link(ARM, 0.0, values["bearing.d"])
    if without != "shaft":
        rig.link(ELASTIC, values["shaft.c"], values["shaft.d"])
    rig.K[0] += [KP, 0.0, -KI]
    rig.C[0, 0] += KD
    rig.gw[0] += KP
    rig.C[2, 2], rig.K[2, 0], rig.gw[2] = 1.0, 1.0, 1.0
    return rig, [Row(q=_at(0)), LOOP.force(values)]


SERVO = Rig(
    name="servo",
    parameters={"arm.J": 0.05, "bearing.d": 0.2, "shaft.c": 300.0, "shaft.d": 0.3},
    channels={"r": ("error.u1", ""), "phi": ("motor.phi", "rad"), "tau": ("drive.tau", "N.m")},
    prescribed=True,
    assemble=_servo,
    motions={"motor": MOTOR, "arm": ARM, "shaft": ELASTIC},
    bonds={
        "shaft": Bond(ELASTIC, "shaft.c", "shaft.d", ("shaft",)),
        "loop": LOOP,
    },
    nodes={"motor": ("motor",)},
    loads={"motor": "loop"},
    kinds={
        "motor": (*RIPPLE, "coulomb_friction", "quadratic_damping", "constant_force"),
        "arm": (*DRY, "arm_gravity", "cubic_damping", "viscous_drift", "hysteresis", "constant_force"),
        "shaft": ("backlash", "cubic_stiffness"),
        "r": (*COMMAND, "actuator_backlash"),
        "phi": SENSOR,
        "tau": ("sensor_delay", "sensor_bias", "sensor_gain", "sensor_drift"),
    },
    scale=5.0,
    amplitude=0.4,
    band=(0.2, 4.0),
    resolution=1e-6,
)

ROTOR = Motion(("rotor", "front_bearing"), (1.0, 0.0))
WHEEL = Motion(("wheel", "rear_bearing"), (0.0, 1.0))
BELT = Motion(("belt",), (-1.0, 1.0))


def _spindle(values: Values, without: str, extra: Mapping[str, float]) -> tuple[Assembly, list[Row]]:
    rig = Assembly(2)
    rig.mass(4.0e-3, *ROTOR.b)
    rig.mass(values["wheel.J"], *WHEEL.b)
    rig.link(ROTOR, 0.0, values["front_bearing.d"])
    rig.link(WHEEL, 0.0, values["rear_bearing.d"])
    if without != "belt":
        rig.link(BELT, values["belt.c"], values["belt.d"])
    rig.gu[0] = 1.0
    return rig, [Row(v=_at(0)), Row(v=_at(1))]


SPINDLE = Rig(
    name="spindle",
    parameters={
        "front_bearing.d": 0.01,
        "rear_bearing.d": 0.02,
        "belt.c": 20.0,
        "belt.d": 0.02,
        "wheel.J": 0.01,
    },
    channels={"m": ("torque.tau", "N.m"), "w1": ("rotor.w", "rad/s"), "w2": ("wheel.w", "rad/s")},
    prescribed=False,
    assemble=_spindle,
    motions={"rotor": ROTOR, "wheel": WHEEL, "belt": BELT},
    bonds={"belt": Bond(BELT, "belt.c", "belt.d", ("belt",))},
    nodes={"rotor": ("rotor",)},
    loads={"wheel": "belt"},
    kinds={
        "rotor": ("coulomb_friction", "quadratic_damping", "viscous_drift", "asymmetric_friction"),
        "wheel": (
            "coulomb_friction",
            "stribeck_friction",
            "friction_drift",
            "load_dependent_friction",
            "quadratic_damping",
            "cubic_damping",
            "viscous_drift",
            "constant_force",
        ),
        "belt": ("backlash", "cubic_stiffness", "hysteresis"),
        "m": DRIVE,
        "w1": ("sensor_delay", "sensor_gain", "sensor_bias", "sensor_drift"),
        "w2": ("sensor_delay", "sensor_gain"),
    },
    scale=1.0,
    amplitude=0.8,
    band=(0.2, 8.0),
)

MOUNT = Motion(("mount",), (1.0, 0.0), -1.0)
INNER = Motion(("inner",), (-1.0, 1.0))
LOADED = Motion(("payload", "frame"), (0.0, 1.0))  # of either, what pulls at it at rest shows in F alone


def _isolator(values: Values, without: str, extra: Mapping[str, float]) -> tuple[Assembly, list[Row]]:
    rig = Assembly(2)
    rig.mass(20.0 + extra.get("frame", 0.0), 1.0, 0.0)
    rig.mass(6.0 + extra.get("payload", 0.0), 0.0, 1.0)
    if without != "mount":
        rig.link(MOUNT, values["mount.k"], values["mount.d"])
    if without != "inner":
        rig.link(INNER, values["inner.k"], values["inner.d"])
    return rig, [rig.reaction, Row(a=_at(0)), Row(a=_at(1))]


ISOLATOR = Rig(
    name="isolator",
    parameters={"mount.k": 4.0e4, "mount.d": 150.0, "inner.k": 2.5e4, "inner.d": 60.0},
    channels={
        "z": ("table.s_ref", "m"),
        "F": ("load_cell.f", "N"),
        "a1": ("frame.a", "m/s2"),
        "a2": ("payload.a", "m/s2"),
    },
    prescribed=True,
    assemble=_isolator,
    motions={"mount": MOUNT, "inner": INNER, "loaded": LOADED},
    bonds={
        "mount": Bond(MOUNT, "mount.k", "mount.d", ("mount",)),
        "inner": Bond(INNER, "inner.k", "inner.d", ("inner",)),
    },
    nodes={"frame": ("frame",), "payload": ("payload",)},
    loads={},
    kinds={
        **{
            place: (*STIFFNESS, "quadratic_damping", "cubic_damping", *DRY[:1], *DRY[4:])
            for place in ("mount", "inner")
        },
        "frame": ("added_inertia",),
        "payload": ("added_inertia",),
        "z": COMMAND,
        "F": ("sensor_delay", "sensor_gain", "sensor_bias", "sensor_drift"),
        "a1": ("sensor_delay", "sensor_gain"),
        "a2": ("sensor_delay", "sensor_gain", "sensor_drift"),
    },
    scale=80.0,
    amplitude=2e-3,
    band=(0.5, 15.0),
    resolution=1e-7,
)

FIRST = Motion(("spring_1", "cart_1"), (1.0, 0.0))
SECOND = Motion(("spring_2", "cart_2"), (0.0, 1.0))
LINK = Motion(("link",), (-1.0, 1.0))


def _carts(values: Values, without: str, extra: Mapping[str, float]) -> tuple[Assembly, list[Row]]:
    rig = Assembly(2)
    rig.mass(3.0 + extra.get("cart_1", 0.0), 1.0, 0.0)
    rig.mass(1.5 + extra.get("cart_2", 0.0), 0.0, 1.0)
    rig.link(FIRST, values["spring_1.k"], values["spring_1.d"])
    rig.link(SECOND, values["spring_2.k"], values["spring_2.d"])
    if without != "link":
        rig.link(LINK, values["link.k"], values["link.d"])
    rig.gu[0] = 1.0
    return rig, [Row(q=_at(0)), Row(q=_at(1))]


CARTS = Rig(
    name="carts",
    parameters={
        **{f"spring_{i}.{x}": v for i in (1, 2) for x, v in (("k", 1500.0), ("d", 6.0))},
        "link.k": 900.0,
        "link.d": 4.0,
    },
    channels={"F": ("push.f", "N"), "x1": ("cart_1.s", "m"), "x2": ("cart_2.s", "m")},
    prescribed=False,
    assemble=_carts,
    motions={"first": FIRST, "second": SECOND, "link": LINK},
    bonds={"link": Bond(LINK, "link.k", "link.d", ("link",))},
    nodes={"cart_1": ("cart_1",), "cart_2": ("cart_2",)},
    loads={},
    kinds={
        **{
            place: (*DAMPING, *STIFFNESS, *DRY, "position_ripple", "constant_force")
            for place in ("first", "second")
        },
        "link": (*STIFFNESS, "backlash", "quadratic_damping", "coulomb_friction"),
        "cart_1": ("added_inertia",),
        "cart_2": ("added_inertia",),
        "F": DRIVE,
        "x1": SENSOR,
        "x2": SENSOR,
    },
    scale=15.0,
    amplitude=15.0,
    band=(0.3, 9.0),
)

RIGS = {rig.name: rig for rig in (OSCILLATOR, BENCH, SERVO, SPINDLE, ISOLATOR, CARTS)}
MASSES = {  # kg, kg.m2
    "frame": 20.0,
    "payload": 6.0,
    "cart_1": 3.0,
    "cart_2": 1.5,
    "motor": 0.01,
    "rotor": 4e-3,
}
BIAS = {"spindle": 0.5}  # mean torque [N.m]: it turns, to one side in one record, to the other in another
FILED = {"m": ("mm", 1e-3), "rad": ("deg", pi / 180)}  # units that files may be in, and what they are in SI
