"""Units of foreign FMUs: what they declare, and how to convert to and from it."""

from __future__ import annotations

import re
from dataclasses import dataclass
from math import pi
from typing import Any
from xml.etree import ElementTree

from ..errors import FMUError

BASES = ("kg", "m", "s", "A", "K", "mol", "cd", "rad")
PREFIXES = {
    "n": 1e-9, "u": 1e-6, "µ": 1e-6, "m": 1e-3, "c": 1e-2, "d": 1e-1, "": 1.0, "k": 1e3, "M": 1e6, "G": 1e9,
}  # fmt: skip
SYMBOLS: dict[str, tuple[float, dict[str, int]]] = {
    "m": (1.0, {"m": 1}),
    "g": (1e-3, {"kg": 1}),
    "s": (1.0, {"s": 1}),
    "A": (1.0, {"A": 1}),
    "K": (1.0, {"K": 1}),
    "rad": (1.0, {"rad": 1}),
    "N": (1.0, {"kg": 1, "m": 1, "s": -2}),
    "J": (1.0, {"kg": 1, "m": 2, "s": -2}),
    "W": (1.0, {"kg": 1, "m": 2, "s": -3}),
    "Pa": (1.0, {"kg": 1, "m": -1, "s": -2}),
    "bar": (1e5, {"kg": 1, "m": -1, "s": -2}),
    "V": (1.0, {"kg": 1, "m": 2, "s": -3, "A": -1}),
    "Hz": (1.0, {"s": -1}),
    "t": (1e3, {"kg": 1}),
}
PLAIN: dict[str, tuple[float, dict[str, int]]] = {
    "min": (60.0, {"s": 1}),
    "h": (3600.0, {"s": 1}),
    "deg": (pi / 180, {"rad": 1}),
    "rev": (2 * pi, {"rad": 1}),
    "rpm": (pi / 30, {"rad": 1, "s": -1}),
    "in": (0.0254, {"m": 1}),
    "ft": (0.3048, {"m": 1}),
    "lbf": (4.4482216152605, {"kg": 1, "m": 1, "s": -2}),
    "%": (0.01, {}),
}
ANGLE = BASES.index("rad")
SAME = 1e-6
TRUE = "true", "1"


@dataclass(frozen=True)
class Unit:
    """A unit as its relation to SI: value in SI = factor * value + offset; exponents in order of BASES."""

    name: str
    exponents: tuple[int, ...]
    factor: float = 1.0
    offset: float = 0.0

    @property
    def si_name(self) -> str:
        """The SI unit of the same dimension: its own name if it is one."""
        return self.name if (self.factor, self.offset) == (1.0, 0.0) else self.si_base

    @property
    def si_base(self) -> str:
        """The SI unit of the same dimension in base units."""
        powers = [f"{b}{e if e != 1 else ''}" for b, e in zip(BASES, self.exponents, strict=True) if e]
        return ".".join(powers) or "1"

    def to_si(self, value: float) -> float:
        """Return a value of this unit in SI."""
        return self.factor * value + self.offset

    def from_si(self, value: float) -> float:
        """Return an SI value in this unit."""
        return (value - self.offset) / self.factor

    def fits(self, other: Unit) -> bool:
        """Tell whether both measure the same; rad counts as 1, as usage varies, but Hz is not rad/s."""
        if _without_angle(self.exponents) != _without_angle(other.exponents):
            return False
        turning = [unit.exponents[ANGLE] != 0 for unit in (self, other)]
        return turning[0] == turning[1] or not any("Hz" in unit.name for unit in (self, other))

    @property
    def bare(self) -> bool:
        """Whether it is declared as SI, though its name has another factor: `mm` as if it were m."""
        if (self.factor, self.offset) != (1.0, 0.0):
            return False
        try:
            named = parsed(self.name)
        except FMUError:
            return False
        return named.exponents == self.exponents and abs(named.factor - 1.0) > SAME


def _without_angle(exponents: tuple[int, ...]) -> tuple[int, ...]:
    return exponents[:ANGLE] + exponents[ANGLE + 1 :]


def parsed(text: str) -> Unit:
    """Read a unit such as `kN/m`, `N.m`, `m/s2`, `rev/min`, `1/(m.s)`.

    Raises:
        FMUError: for a unit that is not understood.
    """
    factor, powers = 1.0, [0] * len(BASES)
    numerator, _, denominator = text.replace(" ", "").replace("·", ".").replace("*", ".").partition("/")
    for side, sign in ((numerator, 1), (denominator.replace("/", "."), -1)):
        for piece in filter(None, side.strip("()").split(".")):
            match = re.fullmatch(r"([^\d^-]+|1)\^?(-?\d+)?", piece)
            if match is None:
                raise FMUError(f"the unit '{text}' is not understood at '{piece}'")
            size, dimensions = _symbol(text, match[1])
            power = sign * int(match[2] or 1)
            factor *= size**power
            for base, exponent in dimensions.items():
                powers[BASES.index(base)] += power * exponent
    return Unit(text, tuple(powers), factor)


def _symbol(text: str, symbol: str) -> tuple[float, dict[str, int]]:
    if symbol == "1":
        return 1.0, {}
    if symbol in PLAIN:
        return PLAIN[symbol]
    for prefix, size in sorted(PREFIXES.items(), key=lambda item: len(item[0])):
        if symbol.startswith(prefix) and symbol[len(prefix) :] in SYMBOLS:
            factor, dimensions = SYMBOLS[symbol[len(prefix) :]]
            return size * factor, dimensions
    raise FMUError(f"the unit '{text}' is not understood at '{symbol}'; use SI units such as 'kN/m' or 'mm'")


def declared_units(definitions: list[Any], inverse: set[str]) -> dict[str, Unit]:
    """Return the units that an FMU defines, its display units included (under the unit they display).

    Args:
        definitions: units as FMPy reads them.
        inverse: display units that show the reciprocal of a value, which is no unit of it.
    """
    units: dict[str, Unit] = {}
    for definition in definitions:
        base = definition.baseUnit
        if base is None:
            continue
        exponents = tuple(getattr(base, name) for name in BASES)
        unit = Unit(definition.name, exponents, base.factor, base.offset)
        units[unit.name] = unit
        for display in definition.displayUnits:
            if display.name in inverse:
                continue
            factor = unit.factor / display.factor
            offset = unit.offset - factor * display.offset
            units.setdefault(display.name, Unit(display.name, exponents, factor, offset))
    return units


def inverse_units(description: ElementTree.Element) -> set[str]:
    """Return the names of display units that show the reciprocal of a value."""
    displays = description.iterfind("UnitDefinitions/Unit/DisplayUnit")
    return {display.get("name", "") for display in displays if display.get("inverse") in TRUE}


def relative_names(description: ElementTree.Element) -> set[str]:
    """Return the names of variables that say of themselves that they are relative quantities."""
    variables = description.iterfind("ModelVariables/*")
    return {v.get("name", "") for v in variables if any(e.get("relativeQuantity") in TRUE for e in (v, *v))}
