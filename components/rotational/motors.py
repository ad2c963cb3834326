"""Electric machines: a motor behind an amplifier, and one whose terminals a circuit joins."""

from ..language import (
    RealInput,
    RotationalFlange,
    Stated,
    der,
    dissipation,
    energy,
    mode,
    parameter,
    supply,
    variable,
)
from ..limits import limited
from ..lossy import Lossy
from .compliances import Dissipative


class DCMotor(Lossy):
    """Motor with permanent magnets behind an amplifier: L i' = v - R i - k w, torque k i on the shaft.

    v is u between -u_max and u_max. At |i| = i_max the amplifier chops the voltage, so that the current stays
    there until it would fall by itself.

    Limits: the amplifier takes back what the motor generates; no friction, no inertia, no cogging.
    """

    flange = RotationalFlange("shaft")
    support = RotationalFlange("housing", optional=True)
    u = RealInput("V", "voltage wanted")
    k = parameter("N.m/A", "torque constant, and that of the induced voltage", nonzero=True)
    R = parameter("V/A", "resistance", above=0)
    L = parameter("V.s/A", "inductance", above=0)
    u_max = parameter("V", "largest voltage", above=0)
    i_max = parameter("A", "largest current", above=0)
    limit = mode("free", "forward", "backward", doc="whether the current is limited, and which way")
    i = variable("A", "current")
    w = variable("rad/s", "speed of the shaft against the housing")
    phi = variable("rad", "angle of the shaft against the housing", state="avoid")
    excess = variable("V", "voltage that would change the current")
    induced = property(lambda self: self.k * self.w)
    potential = energy(lambda self: self.L * self.i**2 / 2)
    lossPower = dissipation(lambda self: self.R * self.i**2)
    supplyPower = supply(lambda self: (self.L * der(self.i) + self.R * self.i + self.induced) * self.i)

    def equations(self) -> Stated:
        applied = limited(self.u, -self.u_max, self.u_max)
        yield self.phi == self.flange.phi - self.support.phi
        yield self.w == der(self.phi)
        yield self.excess == applied - self.R * self.i - self.induced
        yield self.L * der(self.i) == self.limit.choose(free=self.excess, forward=0.0, backward=0.0)
        yield self.flange.tau == -self.k * self.i
        yield self.support.tau == self.k * self.i

    def transitions(self) -> Stated:
        yield self.limit.goes("free", "forward", when=self.i > self.i_max, reset={"i": self.i_max})
        yield self.limit.goes("free", "backward", when=-self.i > self.i_max, reset={"i": -self.i_max})
        yield self.limit.goes("forward", "free", when=self.excess < 0)
        yield self.limit.goes("backward", "free", when=self.excess > 0)


class ShuntedMotor(Dissipative):
    """Motor whose terminals a coil, a resistance and a capacitor join in series: tau = k i.

    L i' + R i + q/C = k w_rel with q' = i: its torque resists. With a capacitor alone it is an inertia of
    k^2 C; R and L stand in series with that. L and R include the winding's.

    Source: F.-C. Wang, H.-A. Chan, Vehicle suspensions with a mechatronic network strut, Vehicle System
    Dynamics 49 (2011) 811-830.
    """

    k = parameter("N.m/A", "torque constant, and that of the induced voltage", nonzero=True)
    L = parameter("V.s/A", "inductance of the circuit", above=0)
    R = parameter("V/A", "resistance of the circuit", above=0)
    elastance = parameter("V/(A.s)", "1/C of the capacitor, 0 without one", min=0, default=0.0)
    i = variable("A", "current")
    q = variable("A.s", "charge of the capacitor")
    potential = energy(lambda self: (self.L * self.i**2 + self.elastance * self.q**2) / 2)
    lossPower = dissipation(lambda self: self.R * self.i**2)

    def equations(self) -> Stated:
        yield der(self.q) == self.i
        yield self.L * der(self.i) == self.k * self.w_rel - self.R * self.i - self.elastance * self.q
        yield self.tau == self.k * self.i
