"""Elastic rods with mass."""

from ...base import counting, demand
from ..bars import End, lumped_bar, lumped_error, modal_bar, modal_error, one_up_to
from ..language import (
    Component,
    Expression,
    Stated,
    TranslationalFlange,
    der,
    option,
    parameter,
    variable,
)


class RodShape(Component):
    """A coordinate of an elastic rod: how far a wave or lump is off the straight line between the ends."""

    q = variable("m", "how far it is off", nominal=1e-3)
    v = variable("m/s", "its rate", nominal=1e-3)
    a = variable("m/s2", "the rate's rate")

    def equations(self) -> Stated:
        yield self.v == der(self.q)
        yield self.a == der(self.v)


class ElasticRod(Component):
    """Elastic rod: mass m = rho A L, stiffness k = E A/L and damping d over all of it.

    A subclass says how many coordinates it has between its ends, and what forces they take.
    """

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

    @property
    def shapes(self) -> int:
        """Number of coordinates between the ends."""
        raise NotImplementedError

    def forces(
        self, ends: tuple[End, End], inner: list[End]
    ) -> tuple[Expression, Expression, list[Expression]]:
        """Return the forces into the ends, and what vanishes for each coordinate."""
        raise NotImplementedError

    def parts(self) -> dict[str, Component]:
        """Return the coordinates."""
        return {f"shape{n}": RodShape() for n in range(1, self.shapes + 1)}

    def equations(self) -> Stated:
        a, b = self.flange_a, self.flange_b
        yield self.v_a == der(a.s)
        yield self.v_b == der(b.s)
        yield self.a_a == der(self.v_a)
        yield self.a_b == der(self.v_b)
        ends = (a.s, self.v_a, self.a_a), (b.s - self.L, self.v_b, self.a_b)
        shapes = [getattr(self, f"shape{n}") for n in range(1, self.shapes + 1)]
        f_a, f_b, laws = self.forces(ends, [(shape.q, shape.v, shape.a) for shape in shapes])
        yield a.f == f_a
        yield b.f == f_b
        for law in laws:
            yield law == 0


class ModalRod(ElasticRod):
    """Elastic rod of uniform section by its modes: a straight line between its ends and half waves on it.

    `frequency_error(n)` tells how far its n-th natural frequency n pi sqrt(k/m), both ends free, is too
    high: the first by 10 % with one mode, 0.4 % with two, 0.1 % with four.

    Source: R. R. Craig, M. C. C. Bampton, AIAA Journal 6 (1968) 1313-1319.

    Example:
        >>> from inertance import ModalRod
        >>> rod = ModalRod(m=7.85, k=2.1e8, modes=4)  # a metre of steel, 1000 mm2
        >>> 0 < rod.frequency_error(1) < 2e-3
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

    def forces(
        self, ends: tuple[End, End], inner: list[End]
    ) -> tuple[Expression, Expression, list[Expression]]:
        return modal_bar(self.m, self.k, self.d, ends, inner)


class LumpedRod(ElasticRod):
    """Elastic rod of uniform section in lumps: springs in a row, masses between, halves at the ends.

    `frequency_error(n)` tells how far its n-th natural frequency n pi sqrt(k/m), both ends free, is too low:
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

    def forces(
        self, ends: tuple[End, End], inner: list[End]
    ) -> tuple[Expression, Expression, list[Expression]]:
        return lumped_bar(self.m, self.k, self.d, ends, inner)
