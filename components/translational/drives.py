"""Sources whose force depends on speed, a constant speed, and a motion given with its rates."""

import casadi as ca

from ..language import Expression, RealInput, Stated, der, option, parameter, variable
from .sources import DrivenFlange


class SpeedDependentForce(DrivenFlange):
    """A force that depends on the speed of the flange: flange.f = -f.

    With `ForceDirection` it has one direction whichever way it moves, f(-v) = f(v); else it turns round,
    f(-v) = -f(v): a load if f_nominal is negative. A subclass gives `turning(x)`,
    f/f_nominal over x = v/v_nominal where it turns round.
    """

    f_nominal = parameter("N", "force at v_nominal; negative is a load for v > 0")
    v_nominal = parameter("m/s", "speed at which the force is f_nominal", above=0)
    ForceDirection = option(
        "whether the force has the same direction for both directions of motion",
        default=True,
        choices=(True, False),
    )
    v = variable("m/s", "speed against the support", state="avoid")
    s = variable("m", "position against the support", state="avoid")
    f = variable("N", "driving force")

    def lasting(self, x: Expression) -> Expression:
        """Return the force over f_nominal at a speed over v_nominal, where it has one direction."""
        return ca.fabs(self.turning(x))

    def equations(self) -> Stated:
        law = self.lasting if self.ForceDirection else self.turning
        yield self.s == self.flange.s - self.support.s
        yield self.v == der(self.s)
        yield self.f == self.f_nominal * law(self.v / self.v_nominal)
        yield self.flange.f == -self.f


class LinearSpeedDependentForce(SpeedDependentForce):
    """A force in proportion to speed: f = f_nominal |v|/v_nominal, or f_nominal v/v_nominal.

    Source: MSL Translational.Sources.LinearSpeedDependentForce.
    """

    def turning(self, x: Expression) -> Expression:
        return x


class QuadraticSpeedDependentForce(SpeedDependentForce):
    """A force in proportion to the square of speed: f = f_nominal (v/v_nominal)^2, or with its sign.

    Source: MSL Translational.Sources.QuadraticSpeedDependentForce.
    """

    def turning(self, x: Expression) -> Expression:
        return x * ca.fabs(x)


class InverseSpeedDependentForce(SpeedDependentForce):
    """A force of constant power: f = f_nominal v_nominal/|v| above v0.

    Below v0 it is what it is at v0; or goes straight to zero with speed, if it turns round.

    Source: MSL Translational.Sources.InverseSpeedDependentForce.
    """

    v0 = parameter("m/s", "speed below which it is regularised", above=0, default=0.1)
    least = property(lambda self: self.v0 / self.v_nominal)

    def turning(self, x: Expression) -> Expression:
        return x / ca.fmax(ca.fabs(x), self.least) ** 2

    def lasting(self, x: Expression) -> Expression:
        return 1 / ca.fmax(ca.fabs(x), self.least)


class ConstantSpeed(DrivenFlange):
    """A constant speed, exactly: der(s) = v_fixed, from the start position s.

    Source: MSL Translational.Sources.ConstantSpeed.
    """

    v_fixed = parameter("m/s", "speed")
    s = variable("m", "position against the support")

    def equations(self) -> Stated:
        yield self.s == self.flange.s - self.support.s
        yield der(self.s) == self.v_fixed


class Move(DrivenFlange):
    """A motion that is given with its rates: s_ref, v_ref and a_ref, which must fit each other.

    der(v) = a_ref + 2 o (v_ref - v) + o^2 (s_ref - s) with v = der(s), o = 2 pi f_crit, from
    s_ref and v_ref. No derivative of a signal is needed; where they fit each other, it follows exactly.

    Source: MSL Translational.Sources.Move, which takes one vector u.
    """

    s_ref = RealInput("m", "position")
    v_ref = RealInput("m/s", "speed, the rate of s_ref")
    a_ref = RealInput("m/s2", "acceleration, the rate of v_ref")
    f_crit = parameter("Hz", "frequency with which it is held on s_ref", default=50.0, above=0)
    s = variable("m", "position against the support", follows="s_ref")
    v = variable("m/s", "speed against the support", follows="v_ref")

    def equations(self) -> Stated:
        o = 2 * ca.pi * self.f_crit
        yield self.s == self.flange.s - self.support.s
        yield self.v == der(self.s)
        behind = self.s_ref - self.s
        yield der(self.v) == self.a_ref + 2 * o * (self.v_ref - self.v) + o**2 * behind
