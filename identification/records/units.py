"""Units of measurement: what laboratories write, in SI units."""

from __future__ import annotations

from math import pi

import numpy as np
from numpy.typing import NDArray

from ...components import ModelError, nearest

G = 9.80665
INCH = 0.0254
POUND = 0.45359237 * G

UNITS: dict[str, tuple[str, float]] = {
    "m": ("m", 1.0), "mm": ("m", 1e-3), "cm": ("m", 1e-2), "um": ("m", 1e-6), "nm": ("m", 1e-9),
    "in": ("m", INCH), "mil": ("m", 1e-3 * INCH), "ft": ("m", 12 * INCH),
    "m/s": ("m/s", 1.0), "mm/s": ("m/s", 1e-3), "cm/s": ("m/s", 1e-2), "in/s": ("m/s", INCH),
    "km/h": ("m/s", 1 / 3.6),
    "m/s2": ("m/s2", 1.0), "mm/s2": ("m/s2", 1e-3), "g": ("m/s2", G), "in/s2": ("m/s2", INCH),
    "N": ("N", 1.0), "kN": ("N", 1e3), "MN": ("N", 1e6), "mN": ("N", 1e-3), "lbf": ("N", POUND),
    "kgf": ("N", G),
    "N.m": ("N.m", 1.0), "kN.m": ("N.m", 1e3), "mN.m": ("N.m", 1e-3), "N.mm": ("N.m", 1e-3),
    "N.cm": ("N.m", 1e-2), "lbf.in": ("N.m", POUND * INCH), "lbf.ft": ("N.m", 12 * POUND * INCH),
    "rad": ("rad", 1.0), "mrad": ("rad", 1e-3), "deg": ("rad", pi / 180), "rev": ("rad", 2 * pi),
    "rad/s": ("rad/s", 1.0), "deg/s": ("rad/s", pi / 180), "rpm": ("rad/s", pi / 30),
    "rad/s2": ("rad/s2", 1.0), "deg/s2": ("rad/s2", pi / 180),
    "s": ("s", 1.0), "ms": ("s", 1e-3), "us": ("s", 1e-6), "min": ("s", 60.0),
    "kg": ("kg", 1.0), "W": ("W", 1.0), "kW": ("W", 1e3), "J": ("J", 1.0), "Pa": ("Pa", 1.0),
    "bar": ("Pa", 1e5),
    "V": ("V", 1.0), "mV": ("V", 1e-3), "A": ("A", 1.0), "mA": ("A", 1e-3), "1": ("1", 1.0), "%": ("1", 1e-2),
}  # fmt: skip

SPELT = {"µ": "u", "μ": "u", "·": ".", "*": ".", "^": "", "²": "2", "°": "deg", "Nm": "N.m", '"': "in"}


def known_unit(unit: str) -> str:
    """Return a unit as the table spells it.

    Raises:
        ModelError: for an unknown unit, with the nearest one.
    """
    spelt = unit.strip()
    for written, meant in SPELT.items():
        spelt = spelt.replace(written, meant)
    if spelt not in UNITS:
        raise ModelError(f"there is no unit '{unit}'{_nearest(spelt)}")
    return spelt


def factor(unit: str, wanted: str) -> float:
    """Return by what a quantity in `unit` is multiplied to be in the SI unit `wanted`.

    A quantity of the model that has no unit takes any.

    Raises:
        ModelError: for an unknown unit or one of another quantity.
    """
    known = known_unit(unit)
    si, size = UNITS[known]
    if wanted in ("", "1"):
        return size if si == "1" else 1.0
    if si != wanted:
        fitting = ", ".join(name for name, (of, _) in UNITS.items() if of == wanted) or wanted
        raise ModelError(
            f"'{unit}' measures {si}, the quantity of the model is in {wanted}; give one of {fitting}"
        )
    return size


def sizes_of(unit: str) -> dict[str, float]:
    """Return the units that measure the same as a unit, each with its size in the SI unit.

    Raises:
        ModelError: for an unknown unit.
    """
    si = UNITS[known_unit(unit)][0]
    return {name: size for name, (of, size) in UNITS.items() if of == si}


def likely_unit(unit: str, factor: float, share: float) -> str | None:
    """Return the unit in which a column is if its values in `unit` are to be multiplied by a factor.

    None if there is none within a share of the factor, or the factor is all but one.
    """
    sizes = sizes_of(unit)
    near = {name: abs(size / sizes[known_unit(unit)] / factor - 1) for name, size in sizes.items()}
    name = min(near, key=lambda one: near[one])
    return name if near[name] < share and name != known_unit(unit) else None


def converted(values: NDArray[np.float64], unit: str, wanted: str) -> NDArray[np.float64]:
    """Return values given in a unit in the SI unit `wanted`."""
    return values * factor(unit, wanted)


def _nearest(unit: str) -> str:
    return nearest(unit, UNITS) or f"; known are {', '.join(UNITS)}"
