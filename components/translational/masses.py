"""Ground, rod and mass."""

from ..language import Component, Stated, TranslationalFlange, der, parameter, variable


class Fixed(Component):
    """A flange held at a constant position: s = s0.

    Source: MSL Translational.Components.Fixed.
    """

    has_law = False
    flange = TranslationalFlange("held flange")
    s0 = parameter("m", "position", default=0.0)

    def equations(self) -> Stated:
        yield self.flange.s == self.s0


class Rod(Component):
    """A rigid rod without mass: flange_b.s = flange_a.s + L.

    Source: MSL Translational.Components.Rod.
    """

    has_law = False
    flange_a = TranslationalFlange("left flange", free=True)
    flange_b = TranslationalFlange("right flange", free=True)
    L = parameter("m", "length from flange_a to flange_b", default=0.0)

    def equations(self) -> Stated:
        yield self.flange_b.s == self.flange_a.s + self.L
        yield self.flange_a.f == -self.flange_b.f


class Mass(Component):
    """A sliding mass: m a = f, v = der(s), a = der(v).

    Source: MSL Translational.Components.Mass; a body with length is a mass and a `Rod`.
    """

    flange = TranslationalFlange("where it is joined", free=True)
    m = parameter("kg", "mass", above=0)
    s = variable("m", "position")
    v = variable("m/s", "velocity")
    a = variable("m/s2", "acceleration")

    def equations(self) -> Stated:
        yield self.flange.s == self.s
        yield self.v == der(self.s)
        yield self.a == der(self.v)
        yield self.m * self.a == self.flange.f
