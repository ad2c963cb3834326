"""Inerters as two-terminal machines: flange_a is the rod, flange_b the housing."""

from typing import Any

from ...components import (
    CompliantNutScrew,
    DiskFlywheel,
    Gyroscope,
    NutScrew,
    PlanetaryFlywheel,
    RackPinion,
    SliderCrank,
    TwoFlanges,
    rotational,
)
from ...components.language import Component, RotationalFlange, Stated, variable


class FlywheelInerter(TwoFlanges):
    """A rod that turns a flywheel through a transmission, both in one housing."""

    support = RotationalFlange("what keeps the housing from turning", optional=True)
    f = variable("N", "force of the housing, positive when it pulls the flanges together")

    def equations(self) -> Stated:
        yield self.f == self.flange_b.f

    def joined(self, transmission: Any) -> Stated:
        """Join rod, transmission, flywheel and housing."""
        yield self.flange_a, transmission.flange_t
        yield transmission.flange_r, self.flywheel.flange
        yield self.flange_b, transmission.support_t
        yield self.support, transmission.support_r, self.flywheel.support


class BallScrewInerter(FlywheelInerter):
    """A ball screw that turns a flywheel: f = b a_rel with b = (2 pi/lead)^2 J if both are ideal.

    Args:
        screw: `NutScrew`, or `CompliantNutScrew` for a real one.
        flywheel: `DiskFlywheel` or any other.

    Source: Ge & Wang on the planetary flywheel inerter (see `machines.ge_wang`), eqs. (1), (2).

    Example:
        >>> from inertance import DiskFlywheel, NutScrew
        >>> from inertance.machines import BallScrewInerter
        >>> inerter = BallScrewInerter(screw=NutScrew(lead=0.01), flywheel=DiskFlywheel(m=0.78, R=0.05))
    """

    screw: Component = NutScrew()  # type: ignore[call-arg]  # to be replaced
    flywheel: Component = DiskFlywheel()  # type: ignore[call-arg]

    def connections(self) -> Stated:
        yield from self.joined(self.screw)


class PlanetaryFlywheelInerter(BallScrewInerter):
    """A ball screw that turns planets revolving in a ring: f = b a_rel, plus what real parts add.

    Args:
        screw: `CompliantNutScrew`, or `NutScrew` for an ideal one.
        flywheel: `PlanetaryFlywheel`, or `IdealPlanetaryFlywheel` without compliance and friction.

    The prototype of the source is `ge_wang.planetary_inerter()`.

    Source: Ge & Wang on the planetary flywheel inerter (see `machines.ge_wang`), eqs. (16)-(27).
    """

    screw: Component = CompliantNutScrew()  # type: ignore[call-arg]
    flywheel: Component = PlanetaryFlywheel()  # type: ignore[call-arg]


class RackPinionInerter(FlywheelInerter):
    """A rack that turns a flywheel through its pinion: f = b a_rel with b = J/R^2.

    Args:
        pinion: the `RackPinion`.
        flywheel: `DiskFlywheel` or any other, on the pinion's shaft.

    Source: M. C. Smith, IEEE Trans. Automat. Contr. 47 (2002) 1648-1662, section III.
    """

    pinion = RackPinion()  # type: ignore[call-arg]
    flywheel: Component = DiskFlywheel()  # type: ignore[call-arg]

    def connections(self) -> Stated:
        yield from self.joined(self.pinion)


class GyroInerter(RackPinionInerter):
    """A rack that turns a gyroscope: b = (H^2/c + J_g + J_t)/R^2 while it precesses slowly and little.

    The precession's damper is a damper in series with that inertance, its inertia one more spring.

    Args:
        pinion: the `RackPinion`.
        flywheel: the `Gyroscope`, with the spring c against precession; without one, it is a spring.
    """

    flywheel: Component = Gyroscope()  # type: ignore[call-arg]


class CrankInerter(FlywheelInerter):
    """A rod that turns a flywheel by a crank: an inertance that grows towards the dead centres.

    f = b a_rel + b' v_rel^2/2 with b = J/(ds/dphi)^2, which is J/r^2 where the crank stands across, phi =
    pi/2, and the rod is long. Start it there: `start={"...crank.phi": pi/2}`.

    Args:
        crank: the `SliderCrank`.
        flywheel: `DiskFlywheel` or any other, on the crank's shaft.

    Limits: between the dead centres, which stop the rod.
    """

    crank = SliderCrank()  # type: ignore[call-arg]
    flywheel: Component = DiskFlywheel()  # type: ignore[call-arg]

    def connections(self) -> Stated:
        yield from self.joined(self.crank)


class MechatronicInerter(FlywheelInerter):
    """A ball screw that turns a flywheel and a motor, whose terminals a circuit joins.

    b = (2 pi/lead)^2 (J + k^2 C) at low frequencies: the capacitor acts as an inertia, resistance and
    inductance in series with it.

    Args:
        screw: `NutScrew` or `CompliantNutScrew`.
        flywheel: rotor and disk.
        motor: `rotational.ShuntedMotor`, with the circuit.

    Source: F.-C. Wang, H.-A. Chan, Vehicle suspensions with a mechatronic network strut, Vehicle System
    Dynamics 49 (2011) 811-830.
    """

    screw: Component = NutScrew()  # type: ignore[call-arg]
    flywheel: Component = DiskFlywheel()  # type: ignore[call-arg]
    motor = rotational.ShuntedMotor()  # type: ignore[call-arg]

    def connections(self) -> Stated:
        yield from self.joined(self.screw)
        yield self.screw.flange_r, self.motor.flange_b
        yield self.support, self.motor.flange_a
