"""Brake: friction on a support that a signal switches on."""

from ..language import Stated, TranslationalFlange, der, parameter, variable
from ..pressed import PressedStickSlip


class Brake(PressedStickSlip):
    """A sliding part held by friction on a support: f = mu(|v|) cgeo fn against v while sliding.

    fn = fn_max max(f_normalized, 0); |f| <= peak mu(0) cgeo fn while stuck; free when fn = 0.
    The support, which takes -f, is the ground when left unconnected.

    Source: MSL Translational.Components.Brake.
    """

    flange = TranslationalFlange("what slides")
    support = TranslationalFlange("what it slides on", optional=True)
    cgeo = parameter("1", "friction faces, weighted by the distribution of pressure", above=0, default=1.0)
    s = variable("m", "position against the support", state="prefer")
    v = variable("m/s", "velocity against the support", state="prefer")
    a = variable("m/s2", "acceleration against the support")
    f = variable("N", "braking force, positive against positive velocity")

    quantities = "f", "v", "a"

    def equations(self) -> Stated:
        yield self.s == self.flange.s - self.support.s
        yield self.v == der(self.s)
        yield self.a == der(self.v)
        yield self.flange.f == self.f
        yield self.support.f == -self.f
