"""Turning into sliding, without loss: screw, pinion and wheel."""

from math import pi

from ..language import Component, RotationalFlange, Stated, TranslationalFlange, parameter, variable


class Transmission(Component):
    """A turning flange and a sliding one, each with a housing that takes the reaction."""

    flange_r = RotationalFlange("what turns")
    flange_t = TranslationalFlange("what slides")
    support_r = RotationalFlange("housing, against turning", optional=True)
    support_t = TranslationalFlange("housing, against sliding", optional=True)
    phi = variable("rad", "angle against the housing", state="prefer")
    s = variable("m", "travel against the housing", state="avoid")

    def equations(self) -> Stated:
        yield self.phi == self.flange_r.phi - self.support_r.phi
        yield self.s == self.flange_t.s - self.support_t.s
        yield self.support_r.tau == -self.flange_r.tau
        yield self.support_t.f == -self.flange_t.f


class NutScrew(Transmission):
    """Ideal ball screw: phi = (2 pi/lead) s and f + (2 pi/lead) tau = 0.

    `flange_t` is the nut if the nut slides and the screw turns in the housing's bearing.

    Source: Ge & Wang, Modeling, Testing, and Characteristic Analysis of a Planetary Flywheel Inerter,
    eqs. (2), (27).
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
