"""Resistance of a wheel that rolls."""

from math import pi

import casadi as ca

from ..language import (
    Expression,
    RealInput,
    Stated,
    TranslationalFlange,
    der,
    dissipation,
    option,
    parameter,
    variable,
)
from ..limits import limited
from ..lossy import Lossy


class RollingResistance(Lossy):
    """Resistance of a rolling wheel: f = Cr fWeight cos(alpha) r(v), against the motion.

    alpha is the slope of the road, inclination = tan(alpha). r is the sign of the speed v, rounded below v0:
    `reg` "Exp" (tanh(50 v/v0)), "Sine" (sin(pi v/(2 v0))), "Linear" (v/v0)
    or "CoSine" (sgn(v) (1 - cos(pi v/(2 v0)))). So it does not hold a wheel at rest.

    Source: MSL Translational.Components.RollingResistance.
    """

    flange = TranslationalFlange("hub of the wheel")
    support = TranslationalFlange("road", optional=True)
    fWeight = parameter("N", "load on the wheel by gravity", min=0)
    useCrInput = option("whether Cr comes in as cr", default=False, choices=(False, True))
    cr = RealInput("1", "rolling resistance coefficient", when="useCrInput")
    CrConstant = parameter("1", "rolling resistance coefficient", min=0, default=0.01)
    useInclinationInput = option(
        "whether the slope comes in as inclination", default=False, choices=(False, True)
    )
    inclination = RealInput("1", "tangent of the slope", when="useInclinationInput")
    inclinationConstant = parameter("1", "tangent of the slope", default=0.0)
    reg = option("how the sign is rounded", default="Exp", choices=("Exp", "Sine", "Linear", "CoSine"))
    v0 = parameter("m/s", "speed below which the sign is rounded", above=0, default=0.1)
    s = variable("m", "position against the road", state="avoid")
    v = variable("m/s", "speed against the road", state="avoid")
    f = variable("N", "resistance, positive against positive speed")
    lossPower = dissipation(lambda self: self.f * self.v)

    @property
    def direction(self) -> Expression:
        """Sign of the speed, rounded."""
        x = self.v / self.v0
        inside = limited(x, -1, 1)
        rounded = {
            "Exp": ca.tanh(50 * x),
            "Sine": ca.sin(pi / 2 * inside),
            "Linear": inside,
            "CoSine": ca.sign(x) * (1 - ca.cos(pi / 2 * inside)),
        }
        return rounded[self.reg]

    def equations(self) -> Stated:
        coefficient = self.cr if self.useCrInput else self.CrConstant
        slope = self.inclination if self.useInclinationInput else self.inclinationConstant
        yield self.s == self.flange.s - self.support.s
        yield self.v == der(self.s)
        yield self.f == coefficient * self.fWeight / ca.sqrt(1 + slope**2) * self.direction
        yield self.flange.f == self.f
        yield self.support.f == -self.f
