"""Sensors: motion and torque as signals, without effect on what they measure."""

from ..language import Component, RealOutput, RotationalFlange, Stated, der, variable
from .compliances import TwoFlanges


class _Absolute(Component):
    has_law = False
    flange = RotationalFlange("where it is measured")

    def equations(self) -> Stated:
        yield self.flange.tau == 0


class AngleSensor(_Absolute):
    """Angle as a signal: phi = flange.phi.

    Source: MSL Rotational.Sensors.AngleSensor.
    """

    phi = RealOutput("rad", "angle")

    def equations(self) -> Stated:
        yield self.phi == self.flange.phi


class SpeedSensor(_Absolute):
    """Angular velocity as a signal: w = der(flange.phi).

    Source: MSL Rotational.Sensors.SpeedSensor.
    """

    w = RealOutput("rad/s", "angular velocity")

    def equations(self) -> Stated:
        yield self.w == der(self.flange.phi)


class AccelerationSensor(_Absolute):
    """Angular acceleration as a signal: a = der(w), w = der(flange.phi).

    Source: MSL Rotational.Sensors.AccSensor.
    """

    a = RealOutput("rad/s2", "angular acceleration")
    w = variable("rad/s", "angular velocity", state="avoid")

    def equations(self) -> Stated:
        yield self.w == der(self.flange.phi)
        yield self.a == der(self.w)


class RelativeAngleSensor(TwoFlanges):
    """Angle between two flanges as a signal: phi_rel = flange_b.phi - flange_a.phi.

    Source: MSL Rotational.Sensors.RelAngleSensor.
    """

    has_law = False
    phi_rel = RealOutput("rad", "angle between the flanges")

    def equations(self) -> Stated:
        yield self.flange_a.tau == 0
        yield self.flange_b.tau == 0


class RelativeSpeedSensor(RelativeAngleSensor):
    """Relative angular velocity as a signal: w_rel = der(phi_rel).

    Source: MSL Rotational.Sensors.RelSpeedSensor.
    """

    w_rel = RealOutput("rad/s", "relative angular velocity")

    def equations(self) -> Stated:
        yield self.w_rel == der(self.phi_rel)


class RelativeAccelerationSensor(RelativeSpeedSensor):
    """Relative angular acceleration as a signal: a_rel = der(w_rel).

    Source: MSL Rotational.Sensors.RelAccSensor.
    """

    a_rel = RealOutput("rad/s2", "relative angular acceleration")

    def equations(self) -> Stated:
        yield self.a_rel == der(self.w_rel)


class TorqueSensor(Component):
    """Torque as a signal, between flanges that turn as one: tau = flange_a.tau.

    tau is positive where what is joined to flange_a turns flange_b forward.

    Source: MSL Rotational.Sensors.TorqueSensor.
    """

    has_law = False
    flange_a = RotationalFlange("left flange")
    flange_b = RotationalFlange("right flange")
    tau = RealOutput("N.m", "torque from flange_a to flange_b")

    def equations(self) -> Stated:
        yield self.flange_a.phi == self.flange_b.phi
        yield self.tau == self.flange_a.tau
        yield self.flange_a.tau == -self.flange_b.tau


class PowerSensor(TorqueSensor):
    """Power as a signal, between flanges that move as one: power = tau der(flange_a.phi).

    It is positive where what is joined to flange_a drives what is joined to flange_b.

    Source: MSL Rotational.Sensors.PowerSensor.
    """

    power = RealOutput("W", "power from flange_a to flange_b")
    w = variable("rad/s", "angular velocity of the flanges", state="avoid")

    def equations(self) -> Stated:
        yield self.w == der(self.flange_a.phi)
        yield self.power == self.tau * self.w


class MultiSensor(PowerSensor):
    """Angular velocity, torque and power as signals: w, tau and power = tau w.

    Source: MSL Rotational.Sensors.MultiSensor.
    """

    w = RealOutput("rad/s", "angular velocity of the flanges")
