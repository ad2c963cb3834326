"""Turning into sliding: screw, pinion and wheel without loss, and a ball screw as it is built."""

from math import pi

from ..language import Component, RotationalFlange, Stated, TranslationalFlange, der, parameter, variable
from ..rotational import Damper
from ..translational import Backlash, Mass


class Transmission(Component):
    """A turning flange and a sliding one, each with a housing that takes the reaction."""

    flange_r = RotationalFlange("what turns")
    flange_t = TranslationalFlange("what slides")
    support_r = RotationalFlange("housing, against turning", optional=True)
    support_t = TranslationalFlange("housing, against sliding", optional=True)
    phi = variable("rad", "angle against the housing", state="prefer")
    w = variable("rad/s", "speed of turning against the housing", state="prefer")
    s = variable("m", "travel against the housing", state="avoid")

    def equations(self) -> Stated:
        yield self.phi == self.flange_r.phi - self.support_r.phi
        yield self.w == der(self.phi)
        yield self.s == self.flange_t.s - self.support_t.s
        yield self.support_r.tau == -self.flange_r.tau
        yield self.support_t.f == -self.flange_t.f


class NutScrew(Transmission):
    """Ideal ball screw: phi = (2 pi/lead) s and f + (2 pi/lead) tau = 0.

    `flange_t` is the nut if the nut slides and the screw turns in the housing's bearing.

    Source: Ge & Wang on the planetary flywheel inerter (see `machines.ge_wang`), eqs. (2), (27).
    """

    lead = parameter("m", "travel of the nut for one turn of the screw", above=0)

    def equations(self) -> Stated:
        turns = 2 * pi / self.lead
        yield self.phi == turns * self.s
        yield self.flange_t.f + turns * self.flange_r.tau == 0


class RollingWheel(Transmission):
    """A wheel that rolls without slip: s = R phi and R f + tau = 0.

    `flange_t` is its hub, `support_r` the body that carries the torque's reaction, `support_t` the road.

    Source: MSL Rotational.Components.IdealRollingWheel.
    """

    R = parameter("m", "rolling radius", above=0)

    def equations(self) -> Stated:
        yield self.s == self.R * self.phi
        yield self.R * self.flange_t.f + self.flange_r.tau == 0


class RackPinion(RollingWheel):
    """A pinion of pitch radius R that rolls on a rack: s = R phi and R f + tau = 0.

    Source: MSL Rotational.Components.IdealGearR2T with ratio 1/R.
    """


class CompliantNutScrew(Component):
    """A ball screw with nut mass, axial compliance, clearance and friction.

    Nut, axial contact and an ideal screw stand in a row; the screw rubs on the housing. With nut
    at x1, housing at x2 and screw at x3:

        F = F_d + m_r x1''
        F_d = P + D behind the clearance eps,  P = k (x1 - x3),  D = d (x1' - x3')
        theta = (2 pi/lead)(x3 - x2),  T = (lead/2 pi) F_d - friction

    `friction` is any rotational friction element; without one the screw turns freely.

    Source: Ge & Wang on the planetary flywheel inerter (see `machines.ge_wang`), eqs. (22)-(27).
    """

    flange_r = RotationalFlange("the screw")
    flange_t = TranslationalFlange("the nut")
    support_r = RotationalFlange("housing, against turning", optional=True)
    support_t = TranslationalFlange("housing, against sliding", optional=True)
    lead = parameter("m", "travel of the nut for one turn of the screw", above=0)
    m_r = parameter("kg", "mass of nut and rod", above=0)
    k = parameter("N/m", "axial stiffness", min=0)
    d = parameter("N.s/m", "axial damping", min=0)
    eps = parameter("m", "half the axial clearance of nut and bearings", min=0, default=0.0)

    nut = Mass(m=m_r)
    contact = Backlash(k=k, d=d, eps=eps)
    thread = NutScrew(lead=lead)
    friction = Damper(d=0.0)

    def connections(self) -> Stated:
        yield self.flange_t, self.nut.flange, self.contact.flange_a
        yield self.contact.flange_b, self.thread.flange_t
        yield self.flange_r, self.thread.flange_r, self.friction.flange_b
        yield self.support_r, self.thread.support_r, self.friction.flange_a
        yield self.support_t, self.thread.support_t
