"""Sources whose torque depends on speed, a constant speed, and a motion given with its rates."""

import casadi as ca

from ..language import Expression, RealInput, Stated, der, option, parameter, variable
from .sources import DrivenFlange


class SpeedDependentTorque(DrivenFlange):
    """A torque that depends on the speed of the flange: flange.tau = -tau.

    With `TorqueDirection` it has one direction whichever way it moves, tau(-w) = tau(w); else it turns round,
    tau(-w) = -tau(w): a load if tau_nominal is negative. A subclass gives `turning(x)`,
    tau/tau_nominal over x = w/w_nominal where it turns round.
    """

    tau_nominal = parameter("N.m", "torque at w_nominal; negative is a load for w > 0")
    w_nominal = parameter("rad/s", "speed at which the torque is tau_nominal", above=0)
    TorqueDirection = option(
        "whether the torque has the same direction for both directions of motion",
        default=True,
        choices=(True, False),
    )
    w = variable("rad/s", "speed against the support", state="avoid")
    phi = variable("rad", "angle against the support", state="avoid")
    tau = variable("N.m", "driving torque")

    def lasting(self, x: Expression) -> Expression:
        """Return the torque over tau_nominal at a speed over w_nominal, where it has one direction."""
        return ca.fabs(self.turning(x))

    def equations(self) -> Stated:
        law = self.lasting if self.TorqueDirection else self.turning
        yield self.phi == self.flange.phi - self.support.phi
        yield self.w == der(self.phi)
        yield self.tau == self.tau_nominal * law(self.w / self.w_nominal)
        yield self.flange.tau == -self.tau


class LinearSpeedDependentTorque(SpeedDependentTorque):
    """A torque in proportion to speed: tau = tau_nominal |w|/w_nominal, or tau_nominal w/w_nominal.

    Source: MSL Rotational.Sources.LinearSpeedDependentTorque.
    """

    def turning(self, x: Expression) -> Expression:
        return x


class QuadraticSpeedDependentTorque(SpeedDependentTorque):
    """A torque in proportion to the square of speed: tau = tau_nominal (w/w_nominal)^2, or with its sign.

    Source: MSL Rotational.Sources.QuadraticSpeedDependentTorque.
    """

    def turning(self, x: Expression) -> Expression:
        return x * ca.fabs(x)


class InverseSpeedDependentTorque(SpeedDependentTorque):
    """A torque of constant power: tau = tau_nominal w_nominal/|w| above w0.

    Below w0 it is what it is at w0; or goes straight to zero with speed, if it turns round.

    Source: MSL Rotational.Sources.InverseSpeedDependentTorque.
    """

    w0 = parameter("rad/s", "speed below which it is regularised", above=0, default=0.1)
    least = property(lambda self: self.w0 / self.w_nominal)

    def turning(self, x: Expression) -> Expression:
        return x / ca.fmax(ca.fabs(x), self.least) ** 2

    def lasting(self, x: Expression) -> Expression:
        return 1 / ca.fmax(ca.fabs(x), self.least)


class ConstantSpeed(DrivenFlange):
    """A constant speed, exactly: der(phi) = w_fixed, from the start angle phi.

    Source: MSL Rotational.Sources.ConstantSpeed.
    """

    w_fixed = parameter("rad/s", "speed")
    phi = variable("rad", "angle against the support")

    def equations(self) -> Stated:
        yield self.phi == self.flange.phi - self.support.phi
        yield der(self.phi) == self.w_fixed


class Move(DrivenFlange):
    """A motion that is given with its rates: phi_ref, w_ref and a_ref, which must fit each other.

    der(w) = a_ref + 2 o (w_ref - w) + o^2 (phi_ref - phi) with w = der(phi), o = 2 pi f_crit, from
    phi_ref and w_ref. No derivative of a signal is needed; where they fit each other, it follows exactly.

    Source: MSL Rotational.Sources.Move, which takes one vector u.
    """

    phi_ref = RealInput("rad", "angle")
    w_ref = RealInput("rad/s", "speed, the rate of phi_ref")
    a_ref = RealInput("rad/s2", "acceleration, the rate of w_ref")
    f_crit = parameter("Hz", "frequency with which it is held on phi_ref", default=50.0, above=0)
    phi = variable("rad", "angle against the support", follows="phi_ref")
    w = variable("rad/s", "speed against the support", follows="w_ref")

    def equations(self) -> Stated:
        o = 2 * ca.pi * self.f_crit
        yield self.phi == self.flange.phi - self.support.phi
        yield self.w == der(self.phi)
        behind = self.phi_ref - self.phi
        yield der(self.w) == self.a_ref + 2 * o * (self.w_ref - self.w) + o**2 * behind
