"""What rotational elements are made from: two flanges, and a torque between them."""

from ..language import Component, RotationalFlange, Stated, der, variable


class TwoFlanges(Component):
    """Two flanges and the angle between them: phi_rel = flange_b.phi - flange_a.phi."""

    flange_a = RotationalFlange("left flange")
    flange_b = RotationalFlange("right flange")
    phi_rel = variable("rad", "angle between the flanges", state="avoid")

    def equations(self) -> Stated:
        yield self.phi_rel == self.flange_b.phi - self.flange_a.phi


class Compliant(TwoFlanges):
    """Two flanges without inertia between them: tau = flange_b.tau = -flange_a.tau."""

    tau = variable("N.m", "torque between the flanges, positive when it turns b back towards a")

    def equations(self) -> Stated:
        yield self.flange_b.tau == self.tau
        yield self.flange_a.tau == -self.tau


class CompliantWithSpeed(Compliant):
    """A compliant element whose law uses the relative speed w_rel = der(phi_rel)."""

    w_rel = variable("rad/s", "relative speed of the flanges", state="avoid")

    def equations(self) -> Stated:
        yield self.w_rel == der(self.phi_rel)
