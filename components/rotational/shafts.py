"""Elastic shafts with inertia."""

from ..bars import Bar, LumpedBar, ModalBar, Moving, Triple
from ..language import Component, RotationalFlange, Stated, der, parameter, variable


class ShaftShape(Component):
    """A coordinate of an elastic shaft: how far a wave or lump is off the straight line between the ends."""

    q = variable("rad", "how far it is off", nominal=1e-3)
    w = variable("rad/s", "its rate", nominal=1e-3)
    a = variable("rad/s2", "the rate's rate")

    def equations(self) -> Stated:
        yield self.w == der(self.q)
        yield self.a == der(self.w)


class ElasticShaft(Bar):
    """Elastic shaft: inertia J = rho I_p L, stiffness c = G I_p/L and damping d over all of it."""

    flange_a = RotationalFlange("left end")
    flange_b = RotationalFlange("right end")
    J = parameter("kg.m2", "inertia", above=0)
    c = parameter("N.m/rad", "stiffness", above=0)
    d = parameter("N.m.s/rad", "damping constant", min=0, default=0.0)
    w_a = variable("rad/s", "speed of the left end")
    w_b = variable("rad/s", "speed of the right end")
    a_a = variable("rad/s2", "acceleration of the left end")
    a_b = variable("rad/s2", "acceleration of the right end")
    shape = ShaftShape

    @property
    def solid(self) -> Triple:
        return self.J, self.c, self.d

    @property
    def ends(self) -> tuple[Moving, Moving]:
        a, b = self.flange_a.phi, self.flange_b.phi
        return (a, self.w_a, self.a_a), (b, self.w_b, self.a_b)

    @property
    def inner(self) -> list[Moving]:
        shapes = [getattr(self, f"shape{n}") for n in range(1, self.shapes + 1)]
        return [(shape.q, shape.w, shape.a) for shape in shapes]

    def equations(self) -> Stated:
        tau_a, tau_b, laws = self.forces
        yield self.w_a == der(self.flange_a.phi)
        yield self.w_b == der(self.flange_b.phi)
        yield self.a_a == der(self.w_a)
        yield self.a_b == der(self.w_b)
        yield self.flange_a.tau == tau_a
        yield self.flange_b.tau == tau_b
        for law in laws:
            yield law == 0


class ModalShaft(ElasticShaft, ModalBar):
    """Flexible shaft of uniform section by its modes: a straight line between its ends and half waves on it.

    `frequency_error(n)` tells how far its n-th natural frequency n pi sqrt(c/J), both ends free, is too
    high: the first by 10 % with one mode, 0.4 % with two, 0.1 % with four.

    Source: R. R. Craig, M. C. C. Bampton, AIAA Journal 6 (1968) 1313-1319.

    Example:
        >>> from inertance import rotational
        >>> shaft = rotational.ModalShaft(J=1.2e-4, c=1240.0, modes=4)  # a metre of steel, 10 mm in radius
        >>> 0 < shaft.frequency_error(1) < 2e-3
        True
    """


class LumpedShaft(ElasticShaft, LumpedBar):
    """Flexible shaft of uniform section in lumps: springs in a row, inertias between, halves at the ends.

    `frequency_error(n)` tells how far its n-th natural frequency n pi sqrt(c/J), both ends free, is too low:
    the first by 2.6 % with four segments, and a quarter of that with twice as many.
    """
