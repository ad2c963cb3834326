"""Units as FMI wants them told: powers of base units, display units and quantities."""

from __future__ import annotations

from ...base import BASES, ModelError, unit_of

# By unit: its quantity, and the units in which its values may be shown (g_n: FMI has one name for a unit,
# whatever it displays).
QUANTITIES = {
    "m": ("Length", "mm", "um"),
    "m/s": ("Velocity", "mm/s", "km/h"),
    "m/s2": ("Acceleration", "g_n"),
    "rad": ("Angle", "deg", "rev"),
    "rad/s": ("AngularVelocity", "rpm", "deg/s"),
    "rad/s2": ("AngularAcceleration",),
    "N": ("Force", "kN"),
    "N.m": ("Torque", "kN.m"),
    "N.s": ("Impulse",),
    "N.m.s": ("AngularImpulse",),
    "N/m": ("TranslationalStiffness", "N/mm", "kN/m"),
    "N.s/m": ("TranslationalDamping", "kN.s/m"),
    "N.m/rad": ("RotationalStiffness",),
    "N.m.s/rad": ("RotationalDamping",),
    "kg": ("Mass", "g"),
    "kg.m2": ("MomentOfInertia", "kg.cm2"),
    "kg/m3": ("Density",),
    "s": ("Time", "ms"),
    "Hz": ("Frequency",),
    "J": ("Energy",),
    "W": ("Power",),
    "Pa": ("Pressure",),
}


def quantity(name: str) -> str:
    """Return the quantity of a unit, empty if it is none of its own."""
    return QUANTITIES.get(name, ("",))[0]


def base_units(name: str) -> dict[str, int] | None:
    """Return the powers of base units; None for a unit that has none (of a law of free order)."""
    try:
        exponents = unit_of(name).exponents
    except ModelError:
        return None
    return {base: power for base, power in zip(BASES, exponents, strict=True) if power}


def display_units(name: str) -> dict[str, float]:
    """Return the units in which values may be shown, by what a value in SI is multiplied for that."""
    return {shown: 1 / unit_of(shown).factor for shown in QUANTITIES.get(name, ())[1:]}
