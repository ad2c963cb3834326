"""The five topologies, each written as energy and virtual work of its own coordinates.

Nominal values and paths are those of the nominal models, see case.py. Sites that are one physical motion
(rigidly joined, or massless in series) stand together: every one of them is a right answer.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import pi

import numpy as np
from assembly import Assembly, Bond, Motion, Rig, Values
from stepper import NMAX, Element, Row

GEAR = 5.0
LEAD = 0.010
TURNS = 2 * pi / LEAD

SMOOTH = ("quadratic_damping", "cubic_stiffness", "bilinear_stiffness", "hysteresis", "position_ripple")
DRY = ("coulomb_friction", "stribeck_friction", "asymmetric_friction", "friction_drift")
OF_OUTPUTS = ("sensor_delay", "sensor_bias", "sensor_gain", "sensor_drift")
OF_INPUTS = ("actuator_lag", "actuator_dead_zone")


def _at(i: int, value: float = 1.0) -> np.ndarray:
    row = np.zeros(NMAX)
    row[i] = value
    return row


ROD = Motion(("inerter", "inerter.screw", "inerter.screw.nut"), (0.0,), 1.0)
SCREW = Motion(("inerter.screw.thread", "inerter.screw.friction", "inerter.flywheel"), (1.0,))
CONTACT = Motion(("inerter.screw.contact",), (-1.0,), 1.0)
PLANETS = 4 * (1.66e-5 * ((0.050 - 0.017) / 0.017) ** 2 + 1.02e-4)


def _pfi(values: Values, without: str, extra: Mapping[str, float]) -> tuple[Assembly, list[Row]]:
    rig = Assembly(1)
    rig.mass(TURNS**2 * (values["inerter.flywheel.J_s"] + PLANETS), 1.0)
    rig.link(SCREW, 0.0, TURNS**2 * values["inerter.screw.friction.d"])
    level = TURNS * values["inerter.screw.friction.tau_s"]
    rig.elements.append(Element("FRICTION", np.array([1.0]), p=(level, level, 0.0, 1.0, 1.0)))
    if without != "contact":
        rig.link(CONTACT, values["inerter.screw.k"], values["inerter.screw.d"])
    rig.reaction.wdd = 1.701 + extra.get("nut", 0.0)
    return rig, [rig.reaction]


PFI = Rig(
    name="pfi",
    parameters={
        "inerter.screw.k": 1.168e7,
        "inerter.screw.d": 1.223e3,
        "inerter.screw.friction.tau_s": 0.2231,
        "inerter.screw.friction.d": 2.703e-3,
        "inerter.flywheel.J_s": 3.17e-4,
    },
    channels={"x": ("actuator.s_ref", "m"), "F": ("load_cell.f", "N")},
    prescribed=True,
    assemble=_pfi,
    motions={"rod": ROD, "screw": SCREW},
    bonds={
        "contact": Bond(
            CONTACT,
            "inerter.screw.k",
            "inerter.screw.d",
            ("inerter.screw.contact", "inerter.screw.thread", "inerter.screw", "inerter"),
        )
    },
    nodes={"nut": ("inerter.screw.nut", "inerter.screw", "inerter")},
    loads={"screw": "contact"},
    kinds={
        "rod": (*SMOOTH, *DRY, "linear_stiffness"),
        "screw": (
            "stribeck_friction",
            "asymmetric_friction",
            "friction_drift",
            "position_ripple",
            "quadratic_damping",
        ),
        "contact": ("backlash",),
        "nut": ("added_inertia",),
    },
    scale=1000.0,
    amplitude=3e-3,
    resolution=1e-8,
    warp=("contact", "lead_error", (1.0,), LEAD),
)

CARRIAGE = Motion(("carriage", "spring", "guide", "inerter", "inerter.screw", "inerter.flywheel"), (1.0,))
CARRIAGE_OF_TWO = Motion(CARRIAGE.sites, (1.0, 0.0))
SHAFT_OF_DISK = Motion(("inerter", "inerter.screw", "inerter.flywheel"), (1.0, -1.0))


def _disk(values: Values, without: str, extra: Mapping[str, float]) -> tuple[Assembly, list[Row]]:
    inertance = TURNS**2 * (values["inerter.flywheel.m"] * 0.040**2 / 2 + 2.8e-5)
    apart = without == "drive_line"
    rig = Assembly(2 if apart else 1)
    rig.mass(25.0, *((1.0, 0.0) if apart else (1.0,)))
    rig.mass(inertance, *((0.0, 1.0) if apart else (1.0,)))
    main = CARRIAGE_OF_TWO if apart else CARRIAGE
    rig.link(main, values["spring.k"] * (without != "spring"), values["guide.d"])
    rig.gu[0] = 1.0
    return rig, [Row(q=_at(0)), Row(a=_at(0))]


DISK = Rig(
    name="disk",
    parameters={"spring.k": 6.0e4, "guide.d": 900.0, "inerter.flywheel.m": 0.60},
    channels={"u": ("shaker.f", "N"), "s": ("carriage.s", "m"), "a": ("carriage.a", "m/s2")},
    prescribed=False,
    assemble=_disk,
    motions={"main": CARRIAGE},
    bonds={
        "drive_line": Bond(SHAFT_OF_DISK, 1e8, 2e4, SHAFT_OF_DISK.sites),
        "spring": Bond(CARRIAGE, "spring.k", 0.0, ("spring",)),
    },
    nodes={},
    loads={},
    kinds={
        "main": (*SMOOTH, *DRY),
        "drive_line": ("backlash", "compliance"),
        "spring": ("backlash",),
    },
    scale=300.0,
    amplitude=300.0,
)

TYRE = Motion(("tyre",), (1.0, 0.0, 0.0), -1.0)
STRUT = Motion(("spring", "damper"), (-1.0, 1.0, 0.0))
CAR_LINK = Motion(("link",), (-1.0, 0.0, 1.0))
CAR_INERTER = Motion(("inerter",), (0.0, 1.0, -1.0))


def _car(values: Values, without: str, extra: Mapping[str, float]) -> tuple[Assembly, list[Row]]:
    rig = Assembly(3)
    rig.mass(35.0 + extra.get("wheel", 0.0), 1.0, 0.0, 0.0)
    rig.mass(250.0 + extra.get("body", 0.0), 0.0, 1.0, 0.0)
    rig.mass(values["inerter.b"], *CAR_INERTER.b)
    rig.link(TYRE, values["tyre.k"], values["tyre.d"])
    rig.link(STRUT, values["spring.k"], values["damper.d"] * (without != "damper"))
    if without != "link":
        rig.link(CAR_LINK, values["link.k"], values["link.d"])
    return rig, [Row(a=_at(1)), Row(a=_at(0)), Row(q=_at(1) - _at(0))]


CAR = Rig(
    name="car",
    parameters={
        "tyre.k": 1.5e5,
        "tyre.d": 150.0,
        "spring.k": 2.2e4,
        "damper.d": 1100.0,
        "link.k": 2.4e4,
        "link.d": 900.0,
        "inerter.b": 90.0,
    },
    channels={
        "z": ("road.s_ref", "m"),
        "ab": ("body.a", "m/s2"),
        "aw": ("wheel.a", "m/s2"),
        "st": ("travel.s_rel", "m"),
    },
    prescribed=True,
    assemble=_car,
    motions={"strut": STRUT, "link": CAR_LINK, "inerter": CAR_INERTER, "tyre": TYRE},
    bonds={
        "link": Bond(CAR_LINK, "link.k", "link.d", ("link", "inerter")),
        "damper": Bond(STRUT, 0.0, "damper.d", ("damper",)),
    },
    nodes={"wheel": ("wheel",), "body": ("body",)},
    loads={"inerter": "link"},
    kinds={
        "strut": (*SMOOTH, *DRY),
        "inerter": (*SMOOTH, *DRY, "viscous_damping", "linear_stiffness"),
        "tyre": ("cubic_stiffness", "bilinear_stiffness"),
        "link": ("backlash", "compliance", "hysteresis"),
        "damper": ("compliance",),
        "wheel": ("added_inertia",),
        "body": ("added_inertia",),
    },
    scale=400.0,
    amplitude=0.006,
    resolution=1e-7,
)

STOREYS = [
    Motion(("storey_1",), (1.0, 0.0, 0.0, 0.0), -1.0),
    Motion(("storey_2",), (-1.0, 1.0, 0.0, 0.0)),
    Motion(("storey_3",), (0.0, -1.0, 1.0, 0.0)),
]
FRAME_LINK = Motion(("link",), (0.0, 0.0, 0.0, 1.0), -1.0)
FRAME_INERTER = Motion(("inerter",), (1.0, 0.0, 0.0, -1.0))


def _frame(values: Values, without: str, extra: Mapping[str, float]) -> tuple[Assembly, list[Row]]:
    rig = Assembly(4)
    for i, storey in enumerate(STOREYS):
        rig.mass(100.0 + extra.get(f"floor_{i + 1}", 0.0), *_at(i)[:4])
        rig.link(storey, values[f"storey_{i + 1}.k"], values[f"storey_{i + 1}.d"])
    rig.mass(values["inerter.b"], *FRAME_INERTER.b)
    if without != "link":
        rig.link(FRAME_LINK, values["link.k"], values["link.d"])
    return rig, [Row(a=_at(i)) for i in range(3)]


FRAME = Rig(
    name="frame",
    parameters={
        **{f"storey_{i}.{x}": v for i in (1, 2, 3) for x, v in (("k", 1.8e5), ("d", 120.0))},
        "link.k": 2.4e4,
        "link.d": 500.0,
        "inerter.b": 60.0,
    },
    channels={
        "g": ("table.s_ref", "m"),
        **{f"a{i}": (f"floor_{i}.a", "m/s2") for i in (1, 2, 3)},
    },
    prescribed=True,
    assemble=_frame,
    motions={
        **{f"storey_{i + 1}": storey for i, storey in enumerate(STOREYS)},
        "link": FRAME_LINK,
        "inerter": FRAME_INERTER,
    },
    bonds={"link": Bond(FRAME_LINK, "link.k", "link.d", ("link", "inerter"))},
    nodes={f"floor_{i}": (f"floor_{i}",) for i in (1, 2, 3)},
    loads={"inerter": "link"},
    kinds={
        **{f"storey_{i}": (*SMOOTH, *DRY) for i in (1, 2, 3)},
        "inerter": (*DRY, *SMOOTH, "viscous_damping", "linear_stiffness"),
        "link": ("backlash", "compliance"),
        **{f"floor_{i}": ("added_inertia",) for i in (1, 2, 3)},
    },
    scale=300.0,
    amplitude=0.003,
    resolution=1e-7,
)

MOTOR = Motion(("motor", "bearing"), (1.0, 0.0))
LOAD = Motion(("load", "load_bearing", "spiral", "gear"), (0.0, 1.0))
SHAFT = Motion(("shaft",), (-1.0, GEAR))


def _drive(values: Values, without: str, extra: Mapping[str, float]) -> tuple[Assembly, list[Row]]:
    rig = Assembly(2)
    rig.mass(2.0e-3 + extra.get("motor", 0.0), 1.0, 0.0)
    rig.mass(0.08 + extra.get("load", 0.0), 0.0, 1.0)
    rig.link(MOTOR, 0.0, values["bearing.d"])
    rig.link(LOAD, values["spiral.c"], values["load_bearing.d"])
    if without != "shaft":
        rig.link(SHAFT, values["shaft.c"], values["shaft.d"])
    rig.gu[0] = 1.0
    return rig, [Row(v=_at(0)), Row(v=_at(1))]


DRIVE = Rig(
    name="drive",
    parameters={
        "bearing.d": 4.0e-3,
        "shaft.c": 60.0,
        "shaft.d": 0.03,
        "load_bearing.d": 0.15,
        "spiral.c": 4.0,
    },
    channels={
        "m": ("torque.tau", "N.m"),
        "wm": ("motor.w", "rad/s"),
        "wl": ("load.w", "rad/s"),
    },
    prescribed=False,
    assemble=_drive,
    motions={"motor": MOTOR, "load": LOAD, "shaft": SHAFT},
    bonds={"shaft": Bond(SHAFT, "shaft.c", "shaft.d", ("shaft", "gear"))},
    nodes={"motor": ("motor",), "load": ("load",)},
    loads={"load": "shaft"},
    kinds={
        "motor": (*DRY, "quadratic_damping", "position_ripple", "hysteresis"),
        "load": (*SMOOTH, *DRY),
        "shaft": ("cubic_stiffness", "backlash", "compliance", "hysteresis"),
    },
    scale=1.0,
    amplitude=1.5,
    warp=("shaft", "varying_ratio", (0.0, 1.0), 2 * pi),
)

RIGS = {rig.name: rig for rig in (PFI, DISK, CAR, FRAME, DRIVE)}
