"""Units as FMI wants them told: powers of base units, display units and quantities."""

from __future__ import annotations

from ...base import BASES, ModelError, unit_of

# g_n, as FMI has one name for a display unit, whatever it displays.
DISPLAY = {
    "m": ("mm", "um"),
    "m/s": ("mm/s", "km/h"),
    "m/s2": ("g_n",),
    "rad": ("deg", "rev"),
    "rad/s": ("rpm", "deg/s"),
    "N": ("kN",),
    "N.m": ("kN.m",),
    "N/m": ("N/mm", "kN/m"),
    "N.s/m": ("kN.s/m",),
    "kg.m2": ("kg.cm2",),
    "kg": ("g",),
    "s": ("ms",),
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


def base_units(name: str) -> dict[str, int] | None:
    """Return the powers of base units; None for a unit that has none (of a law of free order)."""
    try:
        exponents = unit_of(name).exponents
    except ModelError:
        return None
    return {base: power for base, power in zip(BASES, exponents, strict=True) if power}


def display_units(name: str) -> dict[str, float]:
    """Return the units in which values may be shown, by what a value in SI is multiplied for that."""
    return {shown: 1 / unit_of(shown).factor for shown in DISPLAY.get(name, ())}
