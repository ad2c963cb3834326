"""What translational elements are made from: two flanges, and a force between them."""

from ..language import Component, Stated, TranslationalFlange, der, variable


class TwoFlanges(Component):
    """Two flanges and the distance between them: s_rel = flange_b.s - flange_a.s."""

    flange_a = TranslationalFlange("left flange")
    flange_b = TranslationalFlange("right flange")
    s_rel = variable("m", "distance of the flanges", state="avoid")

    def equations(self) -> Stated:
        yield self.s_rel == self.flange_b.s - self.flange_a.s


class Compliant(TwoFlanges):
    """Two flanges without mass between them: f = flange_b.f = -flange_a.f, tension positive."""

    f = variable("N", "force between the flanges, positive when it pulls them together")

    def equations(self) -> Stated:
        yield self.flange_b.f == self.f
        yield self.flange_a.f == -self.f


class CompliantWithSpeed(Compliant):
    """A compliant element whose law uses the relative velocity v_rel = der(s_rel)."""

    v_rel = variable("m/s", "relative velocity of the flanges", state="avoid")

    def equations(self) -> Stated:
        yield self.v_rel == der(self.s_rel)
