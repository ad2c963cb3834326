"""Elastic rods with mass."""

from ..bars import Bar, LumpedBar, ModalBar, Moving, Triple
from ..language import Component, Stated, TranslationalFlange, der, parameter, variable


class RodShape(Component):
    """A coordinate of an elastic rod: how far a wave or lump is off the straight line between the ends."""

    q = variable("m", "how far it is off", nominal=1e-3)
    v = variable("m/s", "its rate", nominal=1e-3)
    a = variable("m/s2", "the rate's rate")

    def equations(self) -> Stated:
        yield self.v == der(self.q)
        yield self.a == der(self.v)


class ElasticRod(Bar):
    """Elastic rod: mass m = rho A L, stiffness k = E A/L and damping d over all of it."""

    flange_a = TranslationalFlange("left end")
    flange_b = TranslationalFlange("right end")
    m = parameter("kg", "mass", above=0)
    k = parameter("N/m", "stiffness", above=0)
    d = parameter("N.s/m", "damping constant", min=0, default=0.0)
    L = parameter("m", "length", default=0.0)
    v_a = variable("m/s", "velocity of the left end")
    v_b = variable("m/s", "velocity of the right end")
    a_a = variable("m/s2", "acceleration of the left end")
    a_b = variable("m/s2", "acceleration of the right end")
    shape = RodShape

    @property
    def solid(self) -> Triple:
        return self.m, self.k, self.d

    @property
    def ends(self) -> tuple[Moving, Moving]:
        a, b = self.flange_a.s, self.flange_b.s - self.L
        return (a, self.v_a, self.a_a), (b, self.v_b, self.a_b)

    @property
    def inner(self) -> list[Moving]:
        shapes = [getattr(self, f"shape{n}") for n in range(1, self.shapes + 1)]
        return [(shape.q, shape.v, shape.a) for shape in shapes]

    def equations(self) -> Stated:
        f_a, f_b, laws = self.forces
        yield self.v_a == der(self.flange_a.s)
        yield self.v_b == der(self.flange_b.s)
        yield self.a_a == der(self.v_a)
        yield self.a_b == der(self.v_b)
        yield self.flange_a.f == f_a
        yield self.flange_b.f == f_b
        for law in laws:
            yield law == 0


class ModalRod(ElasticRod, ModalBar):
    """Flexible rod of uniform section by its modes: a straight line between its ends and half waves on it.

    `frequency_error(n)` tells how far its n-th natural frequency n pi sqrt(k/m), both ends free, is too
    high: the first by 10 % with one mode, 0.4 % with two, 0.1 % with four.

    Source: R. R. Craig, M. C. C. Bampton, AIAA Journal 6 (1968) 1313-1319.

    Example:
        >>> from inertance import ModalRod
        >>> rod = ModalRod(m=7.85, k=2.1e8, modes=4)  # a metre of steel, 1000 mm2
        >>> 0 < rod.frequency_error(1) < 2e-3
        True
    """


class LumpedRod(ElasticRod, LumpedBar):
    """Flexible rod of uniform section in lumps: springs in a row, masses between, halves at the ends.

    `frequency_error(n)` tells how far its n-th natural frequency n pi sqrt(k/m), both ends free, is too low:
    the first by 2.6 % with four segments, and a quarter of that with twice as many.
    """
