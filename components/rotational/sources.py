"""Sources: torques and prescribed motions, from a signal."""

from ..filtered import Filtered
from ..language import Component, RealInput, RotationalFlange, Stated, der, parameter, variable


class DrivenFlange(Component):
    """A flange that is driven, and the support that takes the reaction."""

    has_law = False
    flange = RotationalFlange("what is driven")
    support = RotationalFlange("what reacts", optional=True)

    def equations(self) -> Stated:
        yield self.support.tau == -self.flange.tau


class Torque(DrivenFlange):
    """A torque that acts on a flange: flange.tau = -tau, so positive tau accelerates it.

    Source: MSL Rotational.Sources.Torque.
    """

    tau = RealInput("N.m", "driving torque")

    def equations(self) -> Stated:
        yield self.flange.tau == -self.tau


class ConstantTorque(DrivenFlange):
    """A constant torque: flange.tau = -tau_constant.

    Source: MSL Rotational.Sources.ConstantTorque.
    """

    tau_constant = parameter("N.m", "driving torque")

    def equations(self) -> Stated:
        yield self.flange.tau == -self.tau_constant


class Position(Filtered, DrivenFlange):
    """A prescribed angle: flange.phi - support.phi = phi_ref. Its speed and acceleration follow.

    Where phi_ref bends or jumps, what that takes acts as a shock, whose impulse is an event of the run; a
    jump that takes infinite forces is refused. With `exact=False` a Bessel filter of order 2 follows
    phi_ref: der(w) = ((phi_ref - phi) o - 1.3617 w) o/0.6180 with w = der(phi), o = 2 pi f_crit, from
    phi = phi_ref at rest; lead = phi + w/o.

    Source: MSL Rotational.Sources.Position.
    """

    phi_ref = RealInput("rad", "angle")
    phi = variable("rad", "angle against the support", follows="phi_ref")
    lead = variable("rad", "angle ahead, by which the filter moves", follows="phi_ref")

    def equations(self) -> Stated:
        yield self.flange.phi - self.support.phi == self.phi
        yield from self.follow_position(self.phi_ref, self.phi, self.lead)


class Speed(Filtered, DrivenFlange):
    """A prescribed speed: der(phi) = w_ref, from the start angle phi.

    Where w_ref jumps, what that takes acts as a shock, whose impulse is an event of the run. With
    `exact=False` a filter of order 1 follows w_ref: der(w) = 2 pi f_crit (w_ref - w), from w = w_ref.

    Source: MSL Rotational.Sources.Speed.
    """

    w_ref = RealInput("rad/s", "speed")
    phi = variable("rad", "angle against the support")
    w = variable("rad/s", "speed against the support", follows="w_ref")

    def equations(self) -> Stated:
        yield self.phi == self.flange.phi - self.support.phi
        yield der(self.phi) == self.w
        yield from self.follow_speed(self.w_ref, self.w)


class Accelerate(DrivenFlange):
    """A prescribed acceleration: der(w) = a_ref, from the start angle phi and speed w.

    Source: MSL Rotational.Sources.Accelerate.
    """

    a_ref = RealInput("rad/s2", "acceleration")
    phi = variable("rad", "angle against the support")
    w = variable("rad/s", "speed against the support")

    def equations(self) -> Stated:
        yield self.phi == self.flange.phi - self.support.phi
        yield self.w == der(self.phi)
        yield der(self.w) == self.a_ref
