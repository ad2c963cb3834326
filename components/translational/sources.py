"""Sources: forces and prescribed motions, from a signal."""

from ..filtered import after_position, after_speed, critical_frequency, exactness
from ..language import Component, RealInput, Stated, TranslationalFlange, der, parameter, variable


class _Driven(Component):
    has_law = False
    flange = TranslationalFlange("what is driven")
    support = TranslationalFlange("what reacts", optional=True)

    def equations(self) -> Stated:
        yield self.support.f == -self.flange.f


class Force(_Driven):
    """A force that acts on a flange: flange.f = -f, so positive f accelerates it.

    Source: MSL Translational.Sources.Force.
    """

    f = RealInput("N", "driving force")

    def equations(self) -> Stated:
        yield self.flange.f == -self.f


class Position(_Driven):
    """A prescribed position: flange.s - support.s = s_ref. Its velocity and acceleration follow.

    Where s_ref bends or jumps, what that takes acts as a shock, whose impulse is an event of the run; a
    jump that takes infinite forces is refused. With `exact=False` a Bessel filter of order 2 follows
    s_ref: der(v) = ((s_ref - s) o - 1.3617 v) o/0.6180 with v = der(s), o = 2 pi f_crit, from
    s = s_ref at rest; lead = s + v/o.

    Source: MSL Translational.Sources.Position.
    """

    s_ref = RealInput("m", "position")
    exact = exactness()
    f_crit = critical_frequency()
    s = variable("m", "position against the support", follows="s_ref")
    lead = variable("m", "position ahead, by which the filter moves", follows="s_ref")

    def equations(self) -> Stated:
        yield self.flange.s - self.support.s == self.s
        if self.exact:
            yield self.s == self.s_ref
            yield self.lead == self.s_ref
            return
        rates = after_position(self.s_ref, self.s, self.lead, self.f_crit)
        yield der(self.s) == rates[0]
        yield der(self.lead) == rates[1]


class Speed(_Driven):
    """A prescribed velocity: der(s) = v_ref, from the start position s.

    Where v_ref jumps, what that takes acts as a shock, whose impulse is an event of the run. With
    `exact=False` a filter of order 1 follows v_ref: der(v) = 2 pi f_crit (v_ref - v), from v = v_ref.

    Source: MSL Translational.Sources.Speed.
    """

    v_ref = RealInput("m/s", "velocity")
    exact = exactness()
    f_crit = critical_frequency()
    s = variable("m", "position against the support")
    v = variable("m/s", "velocity against the support", follows="v_ref")

    def equations(self) -> Stated:
        yield self.s == self.flange.s - self.support.s
        yield der(self.s) == self.v
        if self.exact:
            yield self.v == self.v_ref
        else:
            yield der(self.v) == after_speed(self.v_ref, self.v, self.f_crit)


class Accelerate(_Driven):
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


class ConstantForce(_Driven):
    """A constant force, such as weight: flange.f = -f_constant.

    Source: MSL Translational.Sources.ConstantForce.
    """

    f_constant = parameter("N", "driving force")

    def equations(self) -> Stated:
        yield self.flange.f == -self.f_constant
