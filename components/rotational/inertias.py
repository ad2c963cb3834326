"""Ground, inertia and disc."""

from math import pi

from ..language import Component, Expression, RotationalFlange, Stated, der, energy, parameter, variable


class Fixed(Component):
    """A flange held at a constant angle: phi = phi0.

    Source: MSL Rotational.Components.Fixed.
    """

    has_law = False
    flange = RotationalFlange("held flange")
    phi0 = parameter("rad", "angle", default=0.0)

    def equations(self) -> Stated:
        yield self.flange.phi == self.phi0


class Inertia(Component):
    """A turning body: J a = tau, w = der(phi), a = der(w).

    Source: MSL Rotational.Components.Inertia.
    """

    flange = RotationalFlange("where it is joined", free=True)
    J = parameter("kg.m2", "moment of inertia", above=0)
    phi = variable("rad", "angle")
    w = variable("rad/s", "speed")
    a = variable("rad/s2", "acceleration")
    kinetic = energy(lambda self: self.J * self.w**2 / 2)

    def equations(self) -> Stated:
        yield self.flange.phi == self.phi
        yield self.w == der(self.phi)
        yield self.a == der(self.w)
        yield self.J * self.a == self.flange.tau


class Disc(Inertia):
    """A homogeneous disc, solid or with a bore: J = pi rho l (r^4 - r_i^4) / 2.

    Example:
        >>> from inertance import rotational
        >>> disc = rotational.Disc(r=0.05, l=0.01, rho=7850.0)
        >>> round(disc.m, 4)
        0.6165
    """

    r = parameter("m", "radius", above=0)
    r_i = parameter("m", "radius of the bore", min=0, default=0.0)
    l = parameter("m", "thickness", above=0)  # noqa: E741
    rho = parameter("kg/m3", "density", above=0)
    J = parameter(
        "kg.m2",
        "moment of inertia",
        above=0,
        default=lambda self: pi / 2 * self.rho * self.l * (self.r**4 - self.r_i**4),
    )

    @property
    def m(self) -> Expression:
        """Mass [kg], pi rho l (r^2 - r_i^2)."""
        return pi * self.rho * self.l * (self.r**2 - self.r_i**2)
