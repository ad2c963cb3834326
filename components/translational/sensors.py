"""Sensors: motion and force as signals, without effect on what they measure."""

from ..language import Component, RealOutput, Stated, TranslationalFlange, der, variable
from .compliances import TwoFlanges


class _Absolute(Component):
    has_law = False
    flange = TranslationalFlange("where it is measured")

    def equations(self) -> Stated:
        yield self.flange.f == 0


class PositionSensor(_Absolute):
    """Position as a signal: s = flange.s.

    Source: MSL Translational.Sensors.PositionSensor.
    """

    s = RealOutput("m", "position")

    def equations(self) -> Stated:
        yield self.s == self.flange.s


class SpeedSensor(_Absolute):
    """Velocity as a signal: v = der(flange.s).

    Source: MSL Translational.Sensors.SpeedSensor.
    """

    v = RealOutput("m/s", "velocity")

    def equations(self) -> Stated:
        yield self.v == der(self.flange.s)


class AccelerationSensor(_Absolute):
    """Acceleration as a signal: a = der(v), v = der(flange.s).

    Source: MSL Translational.Sensors.AccSensor.
    """

    a = RealOutput("m/s2", "acceleration")
    v = variable("m/s", "velocity", state="avoid")

    def equations(self) -> Stated:
        yield self.v == der(self.flange.s)
        yield self.a == der(self.v)


class RelativePositionSensor(TwoFlanges):
    """Distance as a signal: s_rel = flange_b.s - flange_a.s.

    Source: MSL Translational.Sensors.RelPositionSensor.
    """

    has_law = False
    s_rel = RealOutput("m", "distance of the flanges")

    def equations(self) -> Stated:
        yield self.flange_a.f == 0
        yield self.flange_b.f == 0


class RelativeSpeedSensor(RelativePositionSensor):
    """Relative velocity as a signal: v_rel = der(s_rel).

    Source: MSL Translational.Sensors.RelSpeedSensor.
    """

    v_rel = RealOutput("m/s", "relative velocity")

    def equations(self) -> Stated:
        yield self.v_rel == der(self.s_rel)


class RelativeAccelerationSensor(RelativeSpeedSensor):
    """Relative acceleration as a signal: a_rel = der(v_rel).

    Source: MSL Translational.Sensors.RelAccSensor.
    """

    a_rel = RealOutput("m/s2", "relative acceleration")

    def equations(self) -> Stated:
        yield self.a_rel == der(self.v_rel)


class ForceSensor(Component):
    """Force as a signal, between flanges that move as one: f = flange_a.f.

    f is positive where what is joined to flange_a pushes flange_b forward.

    Source: MSL Translational.Sensors.ForceSensor.
    """

    has_law = False
    flange_a = TranslationalFlange("left flange")
    flange_b = TranslationalFlange("right flange")
    f = RealOutput("N", "force from flange_a to flange_b")

    def equations(self) -> Stated:
        yield self.flange_a.s == self.flange_b.s
        yield self.f == self.flange_a.f
        yield self.flange_a.f == -self.flange_b.f


class PowerSensor(ForceSensor):
    """Power as a signal, between flanges that move as one: power = f der(flange_a.s).

    It is positive where what is joined to flange_a drives what is joined to flange_b.

    Source: MSL Translational.Sensors.PowerSensor.
    """

    power = RealOutput("W", "power from flange_a to flange_b")
    v = variable("m/s", "velocity of the flanges", state="avoid")

    def equations(self) -> Stated:
        yield self.v == der(self.flange_a.s)
        yield self.power == self.f * self.v


class MultiSensor(PowerSensor):
    """Velocity, force and power as signals: v, f and power = f v.

    Source: MSL Translational.Sensors.MultiSensor.
    """

    v = RealOutput("m/s", "velocity of the flanges")
