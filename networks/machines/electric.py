"""Electric machines whole: a shaker, and a servo as it is sold."""

from ...components import (
    Component,
    Mass,
    RealInput,
    RotationalFlange,
    SpringDamper,
    TranslationalFlange,
    TwoFlanges,
    rotational,
    signals,
    variable,
)
from ...components.language import Stated, parameter
from ...components.translational import VoiceCoil


class Shaker(TwoFlanges):
    """Electrodynamic shaker: a coil drives its armature, flange_b, on a suspension in the frame, flange_a.

    Bl i pushes armature and frame apart, L i' = u - R i - Bl v. Fed by a voltage `u`.

    Args:
        m: mass of the armature [kg]; k, d: suspension [N/m, N.s/m].
        Bl: force constant [N/A]; R: resistance [V/A]; L: inductance [V.s/A].
    """

    flange_b = TranslationalFlange("armature", free=True)
    u = RealInput("V", "voltage")
    m = parameter("kg", "mass of the armature", above=0)
    k = parameter("N/m", "stiffness of the suspension", min=0)
    d = parameter("N.s/m", "damping constant of the suspension", min=0)
    Bl = parameter("N/A", "force constant, magnetic field times length of wire", nonzero=True)
    R = parameter("V/A", "resistance", above=0)
    L = parameter("V.s/A", "inductance", above=0)
    i = variable("A", "current")

    armature = Mass(m=m)
    suspension = SpringDamper(k=k, d=d)
    coil = VoiceCoil(Bl=Bl, R=R, L=L)

    def equations(self) -> Stated:
        yield self.i == self.coil.i

    def connections(self) -> Stated:
        yield self.u, self.coil.u
        yield self.flange_a, self.suspension.flange_a, self.coil.flange_a
        yield self.flange_b, self.suspension.flange_b, self.coil.flange_b, self.armature.flange


class Servo(Component):
    """Servo as it is sold: a sampled PD controller with dead band and delay on a motor with a gear.

    Each `period` the angle of the horn is read, and u = k_p dead(reference - phi) - k_d w put out `delay`
    later, in V at the motor. What the motor can is that of `rotational.DCMotor`.

    Args:
        k_p: gain [V/rad]; k_d: damping gain [V.s/rad]; band: half of the dead band [rad].
        period: of sampling [s]; delay: from sample to voltage [s], shorter than the period.
        ratio: of the gear; J: inertia of the rotor [kg.m2]; k, R, L, u_max, i_max: of the motor.
    """

    flange = RotationalFlange("horn")
    support = RotationalFlange("case", optional=True)
    reference = RealInput("rad", "angle wanted")
    k_p = parameter("V/rad", "gain", min=0)
    k_d = parameter("V.s/rad", "damping gain", min=0, default=0.0)
    band = parameter("rad", "half of the dead band", min=0, default=0.0)
    period = parameter("s", "period of sampling", above=0)
    delay = parameter("s", "from sample to voltage, shorter than the period", min=0, default=0.0)
    ratio = parameter("1", "turns of the motor for one of the horn", nonzero=True)
    J = parameter("kg.m2", "inertia of the rotor", above=0)
    k = parameter("N.m/A", "torque constant of the motor", nonzero=True)
    R = parameter("V/A", "resistance of the motor", above=0)
    L = parameter("V.s/A", "inductance of the motor", above=0)
    u_max = parameter("V", "largest voltage", above=0)
    i_max = parameter("A", "largest current", above=0)
    phi = variable("rad", "angle of the horn against the case")

    motor = rotational.DCMotor(k=k, R=R, L=L, u_max=u_max, i_max=i_max)
    rotor = rotational.Inertia(J=J)
    gear: Component = rotational.IdealGear(ratio=ratio)
    angle = rotational.RelativeAngleSensor()
    speed = rotational.RelativeSpeedSensor()
    error = signals.Add(k2=-1.0)
    dead = signals.DeadZone(u_max=band)
    law = signals.Add(k1=k_p, k2=lambda self: -self.k_d)
    hold = signals.SampleHold(period=period, delay=delay)

    def equations(self) -> Stated:
        yield self.phi == self.angle.phi_rel

    def connections(self) -> Stated:
        yield self.support, self.motor.support, self.gear.support, self.angle.flange_a, self.speed.flange_a
        yield self.flange, self.gear.flange_b, self.angle.flange_b, self.speed.flange_b
        yield self.motor.flange, self.rotor.flange, self.gear.flange_a
        yield self.reference, self.error.u1
        yield self.angle.phi_rel, self.error.u2
        yield self.error.y, self.dead.u
        yield self.dead.y, self.law.u1
        yield self.speed.w_rel, self.law.u2
        yield self.law.y, self.hold.u
        yield self.hold.y, self.motor.u
