"""How heavy a planetary flywheel must be for its inertance, against a disk.

Source of all formulas: Ge & Wang on the planetary flywheel inerter (see `machines.ge_wang`), eqs. (2) and
(7)-(15). They take numbers, arrays or symbols.
"""

from dataclasses import dataclass, fields
from math import pi
from typing import Any

import numpy as np

from ...base import demand, quantity, quantity_above_0


def screw_inertance(J_e: Any, lead: Any) -> Any:
    """Return b = (2 pi/lead)^2 J_e [kg], eq. (2).

    Args:
        J_e: equivalent moment of inertia on the screw [kg.m2].
        lead: travel of the nut for one turn [m].
    """
    demand("screw_inertance()", J_e=(J_e, quantity), lead=(lead, quantity_above_0))
    return (2 * pi / lead) ** 2 * J_e


def equivalent_inertia(N: Any, lam: Any, J_s: Any, J_p: Any, J_r: Any) -> Any:
    """Return J_e = J_s + N (J_p ((Z2 - Z1)/Z1)^2 + J_r) [kg.m2], eq. (7).

    Args:
        N: number of planets.
        lam: teeth (or radius) of a planet over those of the ring, Z1/Z2 = r/R.
        J_s: inertia of bracket and screw [kg.m2].
        J_p: inertia of a planet in spin [kg.m2].
        J_r: inertia of a planet in revolution [kg.m2].
    """
    others = {name: (value, quantity) for name, value in (("J_s", J_s), ("J_p", J_p), ("J_r", J_r))}
    demand("equivalent_inertia()", N=(N, quantity), lam=(lam, quantity_above_0), **others)
    return J_s + N * (J_p * ((1 - lam) / lam) ** 2 + J_r)


def disk_mass(J: Any, R: Any) -> Any:
    """Return the mass 2 J/R^2 [kg] of the homogeneous disk of radius R with inertia J, eq. (14)."""
    demand("disk_mass()", J=(J, quantity), R=(R, quantity_above_0))
    return 2 * J / R**2


@dataclass(frozen=True)
class PlanetaryGeometry:
    """A planetary flywheel of homogeneous cylinders, screw not included.

    Args:
        N: number of planets.
        lam: r/R, pitch radius of a planet over that of the ring.
        beta: s/r, radius of a pin over that of its planet.
        tau: l/L, thickness of the planets over that of the bracket.
        R: pitch radius of the ring and radius of the bracket [m].
        L: thickness of the bracket [m].
        rho: density [kg/m3].

    Example:
        >>> from inertance.machines import PlanetaryGeometry
        >>> round(PlanetaryGeometry(N=4, lam=0.34, beta=0.5, tau=2.0).gain, 3)
        1.095
    """

    N: Any
    lam: Any
    beta: Any
    tau: Any
    R: Any = 0.05
    L: Any = 0.0075
    rho: Any = 7850.0

    def __post_init__(self) -> None:
        demand("a PlanetaryGeometry", **{f.name: (getattr(self, f.name), quantity) for f in fields(self)})

    @property
    def r(self) -> Any:
        """Pitch radius of a planet [m]."""
        return self.lam * self.R

    @property
    def s(self) -> Any:
        """Radius of a pin [m]."""
        return self.beta * self.r

    @property
    def l(self) -> Any:  # noqa: E743
        """Thickness of the planets [m]."""
        return self.tau * self.L

    @property
    def m_s(self) -> Any:
        """Mass of the bracket with its pins [kg], eq. (9)."""
        return pi * self.rho * (self.L * self.R**2 + self.N * self.l * self.s**2)

    @property
    def m_p(self) -> Any:
        """Mass of a planet [kg], eq. (9)."""
        return pi * self.rho * self.l * (self.r**2 - self.s**2)

    @property
    def J_s(self) -> Any:
        """Inertia of the bracket with its pins [kg.m2], eq. (10)."""
        pins = self.N * self.l * self.s**2 * (self.R - self.r) ** 2
        return pi * self.rho * (self.L * self.R**4 / 2 + pins)

    @property
    def J_p(self) -> Any:
        """Inertia of a planet in spin [kg.m2], eq. (10)."""
        return self.m_p * self.r**2 / 2

    @property
    def J_r(self) -> Any:
        """Inertia of a planet in revolution [kg.m2], eq. (10)."""
        return self.m_p * (self.R - self.r) ** 2

    @property
    def J_e(self) -> Any:
        """Equivalent inertia [kg.m2], eq. (11)."""
        planets = self.N * self.tau * self.lam**2 * (3 - self.beta**2) * (1 - self.lam) ** 2
        return pi * self.rho * self.R**4 * self.L * (1 + planets) / 2

    @property
    def mass(self) -> Any:
        """Mass of bracket, pins and planets [kg]."""
        return self.m_s + self.N * self.m_p

    @property
    def A(self) -> Any:
        """Inertia per mass J_e/(m_s + N m_p) [m2], eq. (13)."""
        return self.R**2 / 2 * self.gain

    @property
    def gain(self) -> Any:
        """Inertia per mass over that of a disk of radius R, A/A', eq. (15)."""
        share = self.N * self.tau * self.lam**2
        return 1 + share * ((3 - self.beta**2) * (1 - self.lam) ** 2 - 1) / (1 + share)

    @property
    def threshold(self) -> Any:
        """Ratio lam below which the gain exceeds one, 1 - 1/sqrt(3 - beta^2), eq. (15)."""
        return 1 - 1 / np.sqrt(3 - self.beta**2)

    @property
    def adjacency_limit(self) -> Any:
        """Ratio lam at which neighbouring planets touch, sin(pi/N)/(1 + sin(pi/N)), eq. (12)."""
        return np.sin(pi / self.N) / (1 + np.sin(pi / self.N))
