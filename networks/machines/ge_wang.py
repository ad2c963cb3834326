"""The prototype of a planetary flywheel inerter, and a disk inerter of equal inertance.

Source: Ge & Wang, Modeling, Testing, and Characteristic Analysis of a Planetary Flywheel Inerter,
Tables 1-4.

The Stribeck speed of Table 2 is kept as printed. No screw reaches 5.4e8 rad/s, so the friction never
falls from tau_s to tau_c. The printed mass of the disk, from which the saving of 17.7 % follows, is
more than the 0.780 kg that eq. (14) gives for a solid disk of 100 mm.
"""

from __future__ import annotations

from typing import Any

from ...components import CompliantNutScrew, DiskFlywheel, IdealPlanetaryFlywheel, NutScrew, PlanetaryFlywheel
from ...components.rotational import StribeckFriction
from .elements import BallScrewInerter, PlanetaryFlywheelInerter
from .planetary_design import PlanetaryGeometry, disk_mass, equivalent_inertia, screw_inertance

J_SCREW = 2.80e-5
M_BRACKET, M_PLANET, M_DISK = 0.426, 0.094, 0.974
LEAD = 0.010
GEARS: dict[str, Any] = {"R": 0.050, "r": 0.017, "J_s": 2.89e-4 + J_SCREW, "J_p": 1.66e-5, "J_r": 1.02e-4}
GEOMETRY = PlanetaryGeometry(N=4, lam=17 / 50, beta=9.5 / 17, tau=15 / 7.5, R=0.050, L=0.0075)

FRICTION: dict[str, Any] = {"tau_c": 0.1975, "tau_s": 0.2231, "w_s": 5.437e8, "d": 2.703e-3}
SCREW: dict[str, Any] = {"lead": LEAD, "m_r": 1.701, "k": 1.168e7, "d": 1.223e3, "eps": 1.006e-7}
MESH: dict[str, Any] = {"k_r": 1.353e9, "c_r": 4.671e4, "g_r": 1.838e-9, "T_pm": 8.067e-4, "T_pv": 1.366e-4}

J_E = equivalent_inertia(GEOMETRY.N, GEOMETRY.lam, GEARS["J_s"], GEARS["J_p"], GEARS["J_r"])
B = screw_inertance(J_E, LEAD)


def planetary_inerter(*, lumped: bool = True, regularised: float | None = None) -> PlanetaryFlywheelInerter:
    """Return the prototype.

    Args:
        lumped: whether one coordinate stands for all four planets.
        regularised: speed [rad/s] that smooths friction; None for true sticking.
    """
    flywheel = PlanetaryFlywheel(N=4, lumped=lumped, regularised=regularised, **GEARS, **MESH)
    return PlanetaryFlywheelInerter(screw=screw(regularised), flywheel=flywheel)


def disk_inerter(*, regularised: float | None = None) -> BallScrewInerter:
    """Return an inerter on the same screw with a solid disk of 100 mm and the prototype's inertance."""
    R = GEARS["R"]
    flywheel = DiskFlywheel(m=disk_mass(J_E - J_SCREW, R), R=R, J_s=J_SCREW)
    return BallScrewInerter(screw=screw(regularised), flywheel=flywheel)


def ideal_inerter() -> PlanetaryFlywheelInerter:
    """Return the prototype without nut mass, compliance, clearance and friction: f = b a_rel."""
    flywheel = IdealPlanetaryFlywheel(N=4, **GEARS)
    return PlanetaryFlywheelInerter(screw=NutScrew(lead=LEAD), flywheel=flywheel)


def screw(regularised: float | None = None) -> CompliantNutScrew:
    """Return the prototype's ball screw."""
    friction = StribeckFriction(**FRICTION, regularised=regularised)
    return CompliantNutScrew(**SCREW, friction=friction)
