"""Flywheels: a disk, and planets, rigid or with elastic meshes, clearance and friction."""

from math import pi

import casadi as ca

from ...base import counting, smoothing
from ..contact import clearance_energy, past_clearance
from ..language import (
    Component,
    Expression,
    RotationalFlange,
    Stated,
    der,
    dissipation,
    energy,
    option,
    parameter,
    variable,
)
from ..rotational import Inertia
from ..stickslip import StickSlip


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

    Source: Ge & Wang on the planetary flywheel inerter (see `machines.ge_wang`), eq. (14).
    """

    m = parameter("kg", "mass", above=0)
    R = parameter("m", "radius", above=0)
    J_s = parameter("kg.m2", "inertia of the screw that turns with it", min=0, default=0.0)
    J_e = property(lambda self: self.m * self.R**2 / 2 + self.J_s)
    kinetic = energy(lambda self: self.J_e * self.w**2 / 2)

    def equations(self) -> Stated:
        yield self.flange.tau == self.J_e * self.a
        yield self.support.tau == 0


class IdealPlanetaryFlywheel(Flywheel):
    """N planets that roll in a ring without compliance, clearance or friction: J_e a = tau.

    J_e = J_s + N (J_p ((R - r)/r)^2 + J_r). The ring, fixed to the housing, turns planets by
    J_p ((R - r)/r) (R/r) a each.

    Limits: the housing may move but must not accelerate in turning; `kinetic` holds where it does not turn.

    Source: Ge & Wang on the planetary flywheel inerter (see `machines.ge_wang`), eqs. (5), (7).
    """

    N = option("number of planets", default=4, check=counting)
    R = parameter("m", "pitch radius of the ring", above=0)
    r = parameter("m", "pitch radius of a planet", above=0)
    J_s = parameter("kg.m2", "inertia of bracket and screw", min=0)
    J_p = parameter("kg.m2", "inertia of a planet in spin", min=0)
    J_r = parameter("kg.m2", "inertia of a planet in revolution", min=0)
    spin = property(lambda self: (self.R - self.r) / self.r)
    J_e = property(lambda self: self.J_s + self.N * (self.J_p * self.spin**2 + self.J_r))
    kinetic = energy(lambda self: self.J_e * self.w**2 / 2)

    def equations(self) -> Stated:
        yield self.flange.tau == self.J_e * self.a
        yield self.support.tau == -self.N * self.J_p * self.spin * self.R / self.r * self.a


class PlanetGear(Component):
    """The parameters of a planet on its pin and in its ring."""

    R = parameter("m", "pitch radius of the ring", above=0)
    r = parameter("m", "pitch radius of the planet", above=0)
    alpha = parameter("rad", "pressure angle", min=0, default=pi / 9)
    J_p = parameter("kg.m2", "inertia of the planet in spin", above=0)
    J_r = parameter("kg.m2", "inertia of the planet in revolution", min=0)
    k_r = parameter("N/m", "mesh stiffness", min=0)
    c_r = parameter("N.s/m", "mesh damping", min=0)
    g_r = parameter("m", "half the mesh clearance", min=0, default=0.0)
    T_pm = parameter("N.m", "Coulomb friction of the planet", min=0, default=0.0)
    T_pv = parameter("N.m.s/rad", "viscous friction of the planet", min=0, default=0.0)


class Planet(PlanetGear, StickSlip):
    """Planets on a bracket that mesh with a ring; one coordinate stands for `count` equal ones.

    Along the line of action, with r_c = R - r and r_b = r cos(alpha):

        s_rel = x_s - x_p,   x_s = r_c cos(alpha) theta_s,   x_p = r_b theta_p
        P = k_r s_rel,   D = c_r v_rel
        F_p = P + D behind the clearance g_r
        J_p theta_p'' = F_p r_b - T_fp,   T_fp = T_pm sgn(theta_p') + T_pv theta_p'

    theta_s is the bracket's angle and theta_p the planet's spin, both against the ring and counted
    in opposite senses. At rest T_pm truly sticks; see `StickSlip` for `regularised` [rad/s].

    Source: Ge & Wang on the planetary flywheel inerter (see `machines.ge_wang`), eqs. (16)-(21).
    """

    bracket = RotationalFlange("bracket that carries the pin")
    ring = RotationalFlange("ring gear, fixed to the housing", optional=True)
    count = parameter("1", "number of equal planets", above=0, default=1.0)
    theta_s = variable("rad", "angle of the bracket against the ring", state="prefer")
    theta_p = variable("rad", "spin of the planet against the ring", state="prefer")
    w_s = variable("rad/s", "speed of the bracket against the ring", state="prefer")
    w_p = variable("rad/s", "speed of spin against the ring", state="prefer")
    w_ring = variable("rad/s", "speed of the ring", state="avoid")
    a_s = variable("rad/s2", "acceleration of the bracket against the ring")
    a_p = variable("rad/s2", "acceleration of spin against the ring")
    a_ring = variable("rad/s2", "acceleration of the ring")
    s_rel = variable("m", "approach of the flanks along the line of action", state="avoid")
    v_rel = variable("m/s", "speed of approach", state="avoid")
    F_p = variable("N", "mesh force along the line of action")
    T_fp = variable("N.m", "friction torque on the planet")

    quantities = "T_fp", "w_p", "a_p"
    elastic = property(lambda self: past_clearance(self.k_r * self.s_rel, self.k_r * self.g_r))
    kinetic = energy(
        lambda self: (
            self.count
            * (self.J_p * (self.w_p - self.w_ring) ** 2 + self.J_r * (self.w_s + self.w_ring) ** 2)
            / 2
        )
    )
    potential = energy(lambda self: self.count * clearance_energy(self.s_rel, self.k_r, self.g_r))
    lossPower = dissipation(
        lambda self: self.count * (self.T_fp * self.w_p + (self.F_p - self.elastic) * self.v_rel)
    )

    def sliding(self, speed: Expression) -> Expression:
        """Friction torque at a speed of spin."""
        return self.T_pm + self.T_pv * speed

    def equations(self) -> Stated:
        yield self.theta_s == self.bracket.phi - self.ring.phi
        yield self.w_s == der(self.theta_s)
        yield self.a_s == der(self.w_s)
        yield self.w_p == der(self.theta_p)
        yield self.a_p == der(self.w_p)
        yield self.w_ring == der(self.ring.phi)
        yield self.a_ring == der(self.w_ring)
        F_p, T_fp, cos = self.F_p, self.T_fp, ca.cos(self.alpha)
        r_c, r_b = self.R - self.r, self.r * cos
        yield self.s_rel == r_c * cos * self.theta_s - r_b * self.theta_p
        yield self.v_rel == der(self.s_rel)
        P, D = self.k_r * self.s_rel, self.c_r * self.v_rel
        yield F_p == past_clearance(P + D, self.k_r * self.g_r)
        yield self.J_p * (self.a_p - self.a_ring) == F_p * r_b - T_fp
        revolution = self.J_r * (self.a_s + self.a_ring)
        yield self.bracket.tau == self.count * (F_p * r_c * cos + revolution)
        yield self.ring.tau == self.count * (T_fp - F_p * self.R * cos)


class PlanetaryFlywheel(PlanetGear):
    """A bracket with N planets that revolve and spin in a ring gear.

    Lumped, one coordinate stands for all planets, which are equal. With `lumped=False` each has its
    own mesh and coordinate, is named `planet_1` to `planet_N`, and may be replaced by one with other
    parameters.

    Source: Ge & Wang on the planetary flywheel inerter (see `machines.ge_wang`), eqs. (16)-(21).
    """

    flange = RotationalFlange("where the screw is joined", free=True)
    support = RotationalFlange("housing that holds the ring", optional=True)
    N = option("number of planets", default=4, check=counting)
    lumped = option("whether one coordinate stands for all planets", default=True, choices=(True, False))
    regularised = option(
        "speed of spin [rad/s] over which planet friction is smoothed", default=None, check=smoothing
    )
    J_s = parameter("kg.m2", "inertia of bracket and screw", above=0)

    bracket = Inertia(J=J_s)

    def parts(self) -> dict[str, Component]:
        shared = {**PlanetGear.fields, "regularised": self.regularised}
        if self.lumped:
            return {"planet": Planet(count=self.N, **shared)}
        return {f"planet_{i}": Planet(**shared) for i in range(1, self.N + 1)}

    def connections(self) -> Stated:
        planets = [part for name, part in self._parts.items() if name != "bracket"]
        yield self.flange, self.bracket.flange, *(planet.bracket for planet in planets)
        yield self.support, *(planet.ring for planet in planets)
