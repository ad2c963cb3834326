"""Elastic shafts with inertia."""

from ...base import counting, demand
from ..bars import End, lumped_bar, lumped_error, modal_bar, modal_error, one_up_to
from ..language import (
    Component,
    Expression,
    RotationalFlange,
    Stated,
    der,
    option,
    parameter,
    variable,
)


class ShaftShape(Component):
    """A coordinate of an elastic shaft: how far a wave or lump is off the straight line between the ends."""

    q = variable("rad", "how far it is off", nominal=1e-3)
    w = variable("rad/s", "its rate", nominal=1e-3)
    a = variable("rad/s2", "the rate's rate")

    def equations(self) -> Stated:
        yield self.w == der(self.q)
        yield self.a == der(self.w)


class ElasticShaft(Component):
    """Elastic shaft: inertia J = rho I_p L, stiffness c = G I_p/L and damping d over all of it.

    A subclass says how many coordinates it has between its ends, and what torques they take.
    """

    flange_a = RotationalFlange("left end")
    flange_b = RotationalFlange("right end")
    J = parameter("kg.m2", "inertia", above=0)
    c = parameter("N.m/rad", "stiffness", above=0)
    d = parameter("N.m.s/rad", "damping constant", min=0, default=0.0)
    w_a = variable("rad/s", "speed of the left end")
    w_b = variable("rad/s", "speed of the right end")
    a_a = variable("rad/s2", "acceleration of the left end")
    a_b = variable("rad/s2", "acceleration of the right end")

    @property
    def shapes(self) -> int:
        """Number of coordinates between the ends."""
        raise NotImplementedError

    def torques(
        self, ends: tuple[End, End], inner: list[End]
    ) -> tuple[Expression, Expression, list[Expression]]:
        """Return the torques into the ends, and what vanishes for each coordinate."""
        raise NotImplementedError

    def parts(self) -> dict[str, Component]:
        """Return the coordinates."""
        return {f"shape{n}": ShaftShape() for n in range(1, self.shapes + 1)}

    def equations(self) -> Stated:
        a, b = self.flange_a, self.flange_b
        yield self.w_a == der(a.phi)
        yield self.w_b == der(b.phi)
        yield self.a_a == der(self.w_a)
        yield self.a_b == der(self.w_b)
        ends = (a.phi, self.w_a, self.a_a), (b.phi, self.w_b, self.a_b)
        shapes = [getattr(self, f"shape{n}") for n in range(1, self.shapes + 1)]
        tau_a, tau_b, laws = self.torques(ends, [(shape.q, shape.w, shape.a) for shape in shapes])
        yield a.tau == tau_a
        yield b.tau == tau_b
        for law in laws:
            yield law == 0


class ModalShaft(ElasticShaft):
    """Elastic shaft of uniform section by its modes: a straight line between its ends and half waves on it.

    `frequency_error(n)` tells how far its n-th natural frequency n pi sqrt(c/J), both ends free, is too
    high: the first by 10 % with one mode, 0.4 % with two, 0.1 % with four.

    Source: R. R. Craig, M. C. C. Bampton, AIAA Journal 6 (1968) 1313-1319.

    Example:
        >>> from inertance import rotational
        >>> shaft = rotational.ModalShaft(J=1.2e-4, c=1240.0, modes=4)  # a metre of steel, 10 mm in radius
        >>> 0 < shaft.frequency_error(1) < 2e-3
        True
    """

    modes = option("number of modes", default=4, check=counting)

    shapes = property(lambda self: self.modes)

    def frequency_error(self, mode: int) -> float:
        """Return by what share a natural frequency, both ends free, is too high.

        Args:
            mode: its number, from 1 to modes + 1.

        Raises:
            ModelError: for a mode that it has not.
        """
        demand("frequency_error()", mode=(mode, one_up_to(self.modes + 1)))
        return modal_error(self.modes, mode)

    def torques(
        self, ends: tuple[End, End], inner: list[End]
    ) -> tuple[Expression, Expression, list[Expression]]:
        return modal_bar(self.J, self.c, self.d, ends, inner)


class LumpedShaft(ElasticShaft):
    """Elastic shaft of uniform section in lumps: springs in a row, inertias between, halves at the ends.

    `frequency_error(n)` tells how far its n-th natural frequency n pi sqrt(c/J), both ends free, is too low:
    the first by 2.6 % with four segments, and a quarter of that with twice as many.
    """

    segments = option("number of springs", default=8, check=counting)

    shapes = property(lambda self: self.segments - 1)

    def frequency_error(self, mode: int) -> float:
        """Return by what share a natural frequency, both ends free, is off: below 0, as it is too low.

        Args:
            mode: its number, from 1 to segments.

        Raises:
            ModelError: for a mode that it has not.
        """
        demand("frequency_error()", mode=(mode, one_up_to(self.segments)))
        return lumped_error(self.segments, mode)

    def torques(
        self, ends: tuple[End, End], inner: list[End]
    ) -> tuple[Expression, Expression, list[Expression]]:
        return lumped_bar(self.J, self.c, self.d, ends, inner)
