"""Units: a text such as `kN/m` as powers of SI base units, a factor and an offset."""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import cache
from math import pi
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from .errors import ModelError, nearest

BASES: tuple[str, ...] = ("kg", "m", "s", "A", "K", "mol", "cd", "rad")
ANGLE = BASES.index("rad")
G, INCH = 9.80665, 0.0254
POUND = 0.45359237 * G
PREFIXES = {"": 1.0, "n": 1e-9, "u": 1e-6, "m": 1e-3, "c": 1e-2, "d": 1e-1, "k": 1e3, "M": 1e6, "G": 1e9}
FORCE, PRESSURE, TORQUE = {"kg": 1, "m": 1, "s": -2}, {"kg": 1, "m": -1, "s": -2}, {"kg": 1, "m": 2, "s": -2}
Value = TypeVar("Value", float, NDArray[np.float64])
Size = tuple[float, dict[str, int]]
PREFIXED: dict[str, Size] = {
    **{base: (1.0, {base: 1}) for base in BASES if base != "kg"},
    "g": (1e-3, {"kg": 1}), "t": (1e3, {"kg": 1}), "bar": (1e5, PRESSURE), "N": (1.0, FORCE),
    "Nm": (1.0, TORQUE), "J": (1.0, TORQUE), "Pa": (1.0, PRESSURE), "W": (1.0, {"kg": 1, "m": 2, "s": -3}),
    "V": (1.0, {"kg": 1, "m": 2, "s": -3, "A": -1}), "Hz": (1.0, {"s": -1}),
}  # fmt: skip
PLAIN_UNITS: dict[str, Size] = {
    "1": (1.0, {}), "%": (1e-2, {}), "min": (60.0, {"s": 1}), "h": (3600.0, {"s": 1}),
    "deg": (pi / 180, {"rad": 1}), "rev": (2 * pi, {"rad": 1}), "rpm": (pi / 30, {"rad": 1, "s": -1}),
    "in": (INCH, {"m": 1}), "mil": (1e-3 * INCH, {"m": 1}), "ft": (0.3048, {"m": 1}),
    "lbf": (POUND, FORCE), "kgf": (G, FORCE), "Nmm": (1e-3, TORQUE), "Ncm": (1e-2, TORQUE),
    "g_n": (G, {"m": 1, "s": -2}), "degC": (1.0, {"K": 1}), "kg": (1.0, {"kg": 1}),
}  # fmt: skip
OFFSETS = {"degC": 273.15}
GRAVITY = {"g": PLAIN_UNITS["g_n"]}
UNIT_SPELLINGS = str.maketrans(
    {"µ": "u", "μ": "u", "·": ".", "⋅": ".", "*": ".", "°": "deg", '"': "in"}
    | dict(zip("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-", strict=True))
)
# What laboratories write, by the SI unit of each quantity; of like dimensions the first names a quantity.
USUAL_UNITS = {
    "m": "mm cm um nm in mil ft", "m/s": "mm/s cm/s in/s km/h", "m/s2": "mm/s2 g in/s2",
    "rad": "mrad deg rev", "rad/s": "deg/s rpm", "rad/s2": "deg/s2",
    "N": "kN MN mN lbf kgf", "N.m": "kN.m mN.m N.mm N.cm lbf.in lbf.ft", "N.s": "", "N.m.s": "",
    "N/m": "kN/m N/mm", "N.s/m": "kN.s/m N.s/mm", "N.m/rad": "kN.m/rad N.m/deg", "N.m.s/rad": "",
    "kg": "g t", "kg.m2": "kg.cm2", "kg/m3": "", "s": "ms us min", "1/s": "", "Hz": "kHz",
    "J": "kJ", "W": "kW", "Pa": "kPa MPa bar", "V": "mV", "A": "mA", "K": "degC", "1": "%",
}  # fmt: skip


@dataclass(frozen=True)
class Unit:
    """A unit as its relation to SI: value in SI = factor * value + offset; exponents in order of BASES."""

    name: str
    exponents: tuple[int, ...] = (0,) * len(BASES)
    factor: float = 1.0
    offset: float = 0.0

    def to_si(self, value: Value) -> Value:
        """Return values of this unit in SI."""
        return self.factor * value + self.offset

    def from_si(self, value: Value) -> Value:
        """Return SI values in this unit."""
        return (value - self.offset) / self.factor

    def fits(self, other: Unit) -> bool:
        """Tell whether both measure the same; rad counts as 1, as usage varies, but Hz is not rad/s."""
        dimensions = [unit.exponents[:ANGLE] + unit.exponents[ANGLE + 1 :] for unit in (self, other)]
        if dimensions[0] != dimensions[1]:
            return False
        turning = [unit.exponents[ANGLE] != 0 for unit in (self, other)]
        return turning[0] == turning[1] or not any("Hz" in unit.name for unit in (self, other))

    @property
    def si_name(self) -> str:
        """The SI unit of the same dimension by its usual name: `N` for kN; in base units if it has none."""
        alike = [si for si in USUAL_UNITS if unit_of(si).exponents == self.exponents]
        if alike:
            return min(alike, key=lambda si: self.name not in (si, *USUAL_UNITS[si].split()))
        powers = {base: power for base, power in zip(BASES, self.exponents, strict=True) if power}
        return _written(powers)


def unit_of(text: str, like: Unit | None = None) -> Unit:
    """Return a unit by its text: `kN/m`, `N.m`, `m/s2`, `rev/min`, `1/(m.s)`, `N·m`, `µm`, `°/s`.

    What follows a slash divides, to the end of its bracket. What `g` means, the dimension that is
    wanted decides: gravity (9.80665 m/s2) where that of `like` fits, otherwise a gram. No text is "1".
    What is not understood raises a ModelError with the nearest unit.
    """
    readings = _readings(text)
    return next((unit for unit in readings if like is not None and unit.fits(like)), readings[0])


def unit_for(text: str, wanted: str) -> Unit:
    """Return the unit of what is wanted in an SI unit; raise a ModelError if it measures another quantity.

    What has no unit takes any.
    """
    target = unit_of(wanted)
    given = unit_of(text, target)
    if wanted in ("", "1"):
        return Unit(text) if any(given.exponents) else given
    if not given.fits(target):
        measured = " or ".join(unit.si_name for unit in _readings(text))
        raise ModelError(
            f"'{text}' measures {measured}, the quantity of the model is in {wanted}; "
            f"give one of {', '.join(units_like(target))}"
        )
    return given


def units_like(unit: Unit) -> dict[str, float]:
    """Return the usual units that measure the same as a unit, each with its size in SI."""
    si = unit.si_name
    return {name: unit_of(name, unit).factor for name in (si, *USUAL_UNITS.get(si, "").split())}


def rate_unit(unit: str, order: int = 1) -> str:
    """Return the unit of a time derivative: m/s of m, N/m of N.s/m; none of a quantity without unit."""
    if not order or not unit:
        return unit
    try:
        powers = _powers(unit)
    except ModelError:
        return f"{unit}/s{order if order > 1 else ''}"
    powers["s"] = powers.pop("s", 0) - order
    return _written(powers)


@cache
def _readings(text: str) -> tuple[Unit, ...]:
    """Return what a text may mean: two units if there is a g in it, the one with grams first."""
    powers = _powers(text)
    grams = any(symbol not in PLAIN_UNITS and symbol[-1] == "g" for symbol in powers)
    return tuple(_product(text, powers, known) for known in (PREFIXED, PREFIXED | GRAVITY)[: 1 + grams])


def _product(text: str, powers: dict[str, int], known: dict[str, Size]) -> Unit:
    factor, total = 1.0, dict.fromkeys(BASES, 0)
    for symbol, power in powers.items():
        size, dimensions = _size(text, symbol, known)
        factor = factor * size**power if power > 0 else factor / size**-power
        for base, exponent in dimensions.items():
            total[base] += power * exponent
    offset = OFFSETS.get(next(iter(powers)), 0.0) if list(powers.values()) == [1] else 0.0
    return Unit(text, tuple(total.values()), factor, offset)


def _size(text: str, symbol: str, known: dict[str, Size]) -> Size:
    if symbol in PLAIN_UNITS:
        return PLAIN_UNITS[symbol]
    for prefix, size in PREFIXES.items():
        if symbol.startswith(prefix) and symbol[len(prefix) :] in known:
            factor, dimensions = known[symbol[len(prefix) :]]
            return size * factor, dimensions
    raise _unknown(text, symbol)


def _powers(text: str) -> dict[str, int]:
    """Return the symbols in a unit with their powers."""
    spelt = re.sub(r"\s*([./()])\s*", r"\1", text.strip().replace("**", "^").translate(UNIT_SPELLINGS)) or "1"
    powers: dict[str, int] = {}
    sign, outer = 1, [1]
    for piece in filter(None, re.split(r"([./()]|\s+)", spelt)):
        if piece == "(":
            outer.append(sign)
        elif piece == ")" and len(outer) > 1:
            sign = outer.pop()
        elif piece == "/":
            sign = -outer[-1]
        elif piece != "." and not piece.isspace():
            found = re.fullmatch(r"(1|[^\d^()-]+)\^?(-?\d+)?", piece)
            if found is None or (found[1] == "1" and found[2]):
                raise _unknown(text, piece)
            powers[found[1]] = powers.get(found[1], 0) + sign * int(found[2] or 1)
    if not powers or len(outer) > 1:
        raise _unknown(text, spelt)
    return powers


def _written(powers: dict[str, int]) -> str:
    """Return a unit as the library writes it."""
    above, below = _raised(powers, 1), _raised(powers, -1)
    divisor = f"({'.'.join(below)})" if len(below) > 1 else "".join(below)
    return ".".join(above or "1") + (f"/{divisor}" if divisor else "")


def _raised(powers: dict[str, int], sign: int) -> list[str]:
    """Return the symbols whose powers have this sign, with these powers."""
    alike = {symbol: sign * power for symbol, power in powers.items() if sign * power > 0 and symbol != "1"}
    return [f"{symbol}{power}" if power > 1 else symbol for symbol, power in alike.items()]


def _unknown(text: str, piece: str) -> ModelError:
    known = [name for si, others in USUAL_UNITS.items() for name in (si, *others.split())]
    told = nearest(text, known) or f"; '{piece}' is not understood, write it by units such as kN, mm, N.s/m"
    return ModelError(f"there is no unit '{text}'{told}")
