"""Rigid flywheels: a disk, and planets without compliance or friction."""

from ...base import counting
from ..language import Component, RotationalFlange, Stated, der, option, parameter, variable


class Flywheel(Component):
    """What turns with a screw inside a housing; angle and speed are those of `flange`."""

    flange = RotationalFlange("where the screw is joined", free=True)
    support = RotationalFlange("housing", optional=True)
    w = variable("rad/s", "angular velocity")
    a = variable("rad/s2", "angular acceleration")

    def equations(self) -> Stated:
        yield self.w == der(self.flange.phi)
        yield self.a == der(self.w)


class DiskFlywheel(Flywheel):
    """A homogeneous disk: (m R^2/2 + J_s) a = tau; its housing feels nothing.

    Source: Ge & Wang, cited in full by `ge_wang`, eq. (14).
    """

    m = parameter("kg", "mass", above=0)
    R = parameter("m", "radius", above=0)
    J_s = parameter("kg.m2", "inertia of the screw that turns with it", min=0, default=0.0)

    def equations(self) -> Stated:
        yield self.flange.tau == (self.m * self.R**2 / 2 + self.J_s) * self.a
        yield self.support.tau == 0


class IdealPlanetaryFlywheel(Flywheel):
    """N planets that roll in a ring without compliance, clearance or friction: J_e a = tau.

    J_e = J_s + N (J_p ((R - r)/r)^2 + J_r). The ring, fixed to the housing, turns planets by
    J_p ((R - r)/r) (R/r) a each.

    Limits: the housing may move but must not accelerate in turning.

    Source: Ge & Wang, cited in full by `ge_wang`, eqs. (5), (7).
    """

    N = option("number of planets", default=4, check=counting)
    R = parameter("m", "pitch radius of the ring", above=0)
    r = parameter("m", "pitch radius of a planet", above=0)
    J_s = parameter("kg.m2", "inertia of bracket and screw", min=0)
    J_p = parameter("kg.m2", "inertia of a planet in spin", min=0)
    J_r = parameter("kg.m2", "inertia of a planet in revolution", min=0)

    def equations(self) -> Stated:
        spin = (self.R - self.r) / self.r
        J_e = self.J_s + self.N * (self.J_p * spin**2 + self.J_r)
        yield self.flange.tau == J_e * self.a
        yield self.support.tau == -self.N * self.J_p * spin * self.R / self.r * self.a
