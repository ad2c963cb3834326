"""Units: from the library's unit strings to FMI base units, display units and quantities."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass

BASE = ("kg", "m", "s", "A", "K", "mol", "cd", "rad")
DERIVED = {
    "N": {"kg": 1, "m": 1, "s": -2},
    "J": {"kg": 1, "m": 2, "s": -2},
    "W": {"kg": 1, "m": 2, "s": -3},
    "Pa": {"kg": 1, "m": -1, "s": -2},
    "Hz": {"s": -1},
}
# What a display unit shows is factor times the value in SI.
DISPLAY = {
    "m": {"mm": 1e3, "um": 1e6},
    "m/s": {"mm/s": 1e3, "km/h": 3.6},
    "m/s2": {"g_n": 1 / 9.80665},
    "rad": {"deg": 180 / math.pi, "rev": 0.5 / math.pi},
    "rad/s": {"rpm": 30 / math.pi, "deg/s": 180 / math.pi},
    "N": {"kN": 1e-3},
    "N.m": {"kN.m": 1e-3},
    "N/m": {"N/mm": 1e-3, "kN/m": 1e-3},
    "N.s/m": {"kN.s/m": 1e-3},
    "kg.m2": {"kg.cm2": 1e4},
    "kg": {"g": 1e3},
    "s": {"ms": 1e3},
}
QUANTITY = {
    "m": "Length",
    "m/s": "Velocity",
    "m/s2": "Acceleration",
    "rad": "Angle",
    "rad/s": "AngularVelocity",
    "rad/s2": "AngularAcceleration",
    "N": "Force",
    "N.m": "Torque",
    "N.s": "Impulse",
    "N.m.s": "AngularImpulse",
    "N/m": "TranslationalStiffness",
    "N.s/m": "TranslationalDamping",
    "N.m/rad": "RotationalStiffness",
    "N.m.s/rad": "RotationalDamping",
    "kg": "Mass",
    "kg.m2": "MomentOfInertia",
    "kg/m3": "Density",
    "s": "Time",
    "Hz": "Frequency",
    "J": "Energy",
    "W": "Power",
    "Pa": "Pressure",
}
_FACTOR = re.compile(r"([A-Za-z]+|1)(?:\^?(-?\d+))?")


@dataclass(frozen=True)
class Unit:
    """A unit as FMI wants it told; `base` is None for one that has no exponents (a law of free order)."""

    name: str
    base: dict[str, int] | None
    display: dict[str, float]
    quantity: str


def unit(name: str) -> Unit:
    """Return what FMI wants to know of a unit."""
    return Unit(name, _exponents(name), DISPLAY.get(name, {}), QUANTITY.get(name, ""))


def _exponents(name: str) -> dict[str, int] | None:
    """Return exponents of base units; what follows a slash, up to the next, divides."""
    total: dict[str, int] = {}
    for place, part in enumerate(name.split("/")):
        for factor in part.strip("()").split("."):
            read = _FACTOR.fullmatch(factor)
            if read is None:
                return None
            symbol, exponent = read[1], int(read[2] or 1) * (-1 if place else 1)
            parts = {} if symbol == "1" else DERIVED.get(symbol, {symbol: 1})
            if not parts.keys() <= set(BASE):
                return None
            for base, power in parts.items():
                total[base] = total.get(base, 0) + power * exponent
    return {base: power for base, power in total.items() if power}
