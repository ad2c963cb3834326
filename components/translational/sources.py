"""Sources: forces and prescribed motions, from a signal."""

from ..filtered import Filtered
from ..language import Component, RealInput, Stated, TranslationalFlange, der, parameter, variable


class DrivenFlange(Component):
    """A flange that is driven, and the support that takes the reaction."""

    has_law = False
    flange = TranslationalFlange("what is driven")
    support = TranslationalFlange("what reacts", optional=True)

    def equations(self) -> Stated:
        yield self.support.f == -self.flange.f


class Force(DrivenFlange):
    """A force that acts on a flange: flange.f = -f, so positive f accelerates it.

    Source: MSL Translational.Sources.Force.
    """

    f = RealInput("N", "driving force")

    def equations(self) -> Stated:
        yield self.flange.f == -self.f


class Position(Filtered, DrivenFlange):
    """A prescribed position: flange.s - support.s = s_ref. Its velocity and acceleration follow.

    Where s_ref bends or jumps, what that takes acts as a shock, whose impulse is an event of the run; a
    jump that takes infinite forces is refused. With `exact=False` a Bessel filter of order 2 follows
    s_ref: der(v) = ((s_ref - s) o - 1.3617 v) o/0.6180 with v = der(s), o = 2 pi f_crit, from
    s = s_ref at rest; lead = s + v/o.

    Source: MSL Translational.Sources.Position.
    """

    s_ref = RealInput("m", "position")
    s = variable("m", "position against the support", follows="s_ref")
    lead = variable("m", "position ahead, by which the filter moves", follows="s_ref")

    def equations(self) -> Stated:
        yield self.flange.s - self.support.s == self.s
        yield from self.follow_position(self.s_ref, self.s, self.lead)


class Speed(Filtered, DrivenFlange):
    """A prescribed velocity: der(s) = v_ref, from the start position s.

    Where v_ref jumps, what that takes acts as a shock, whose impulse is an event of the run. With
    `exact=False` a filter of order 1 follows v_ref: der(v) = 2 pi f_crit (v_ref - v), from v = v_ref.

    Source: MSL Translational.Sources.Speed.
    """

    v_ref = RealInput("m/s", "velocity")
    s = variable("m", "position against the support")
    v = variable("m/s", "velocity against the support", follows="v_ref")

    def equations(self) -> Stated:
        yield self.s == self.flange.s - self.support.s
        yield der(self.s) == self.v
        yield from self.follow_speed(self.v_ref, self.v)


class Accelerate(DrivenFlange):
    """A prescribed acceleration: der(v) = a_ref, from the start position s and velocity v.

    Source: MSL Translational.Sources.Accelerate.
    """

    a_ref = RealInput("m/s2", "acceleration")
    s = variable("m", "position against the support")
    v = variable("m/s", "velocity against the support")

    def equations(self) -> Stated:
        yield self.s == self.flange.s - self.support.s
        yield self.v == der(self.s)
        yield der(self.v) == self.a_ref


class ConstantForce(DrivenFlange):
    """A constant force, such as weight: flange.f = -f_constant.

    Source: MSL Translational.Sources.ConstantForce.
    """

    f_constant = parameter("N", "driving force")

    def equations(self) -> Stated:
        yield self.flange.f == -self.f_constant
