"""Joints that slip bit by bit before they turn: splines, clamped hubs, wound springs."""

from ..iwan import IwanCells
from ..language import Component, Expression, Stated, parameter, variable
from .compliances import CompliantWithSpeed


class IwanCell(Component):
    """A cell of an `Iwan` joint: how far it is twisted."""

    z = variable("rad", "twist of the cell")


class Iwan(CompliantWithSpeed, IwanCells):
    """A joint that slips bit by bit: tau = c mean(z_i), cells that yield one after the other, up to phi_y.

    Cell i of n yields at y_i = phi_y ((i - 1/2)/n)^p, rounded by Bouc and Wen's law: z_i' = w_rel if w_rel
    z_i <= 0, else w_rel (1 - |z_i/y_i|^8). Twisted on, it slides at c phi_y/(1 + p).

    How many cells it takes, as of the translational one.

    Source: as the translational `Iwan`, written for turning.

    Example:
        >>> from inertance import rotational
        >>> hub = rotational.Iwan(c=1e5, phi_y=1e-4, p=2.0)
    """

    c = parameter("N.m/rad", "stiffness before it slips", min=0)
    phi_y = parameter("rad", "twist at which the last cell yields", above=0)

    @property
    def speed(self) -> Expression:
        return self.w_rel

    @property
    def stiffness(self) -> Expression:
        return self.c

    @property
    def slip_stretch(self) -> Expression:
        return self.phi_y

    def cell(self) -> Component:
        return IwanCell()

    def equations(self) -> Stated:
        yield self.tau == self.restoring
