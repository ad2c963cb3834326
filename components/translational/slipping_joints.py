"""Joints that slip bit by bit before they slide: bolted laps, stranded ropes, leaf springs."""

from ..iwan import IwanCells
from ..language import Component, Expression, Stated, parameter, variable
from .compliances import CompliantWithSpeed


class IwanCell(Component):
    """A cell of an `Iwan` joint: how far it is stretched."""

    z = variable("m", "stretch of the cell")


class Iwan(CompliantWithSpeed, IwanCells):
    """A joint that slips bit by bit: f = k mean(z_i), cells that yield one after the other, the last at s_y.

    Cell i of n yields at y_i = s_y ((i - 1/2)/n)^p, rounded by Bouc and Wen's law: z_i' = v_rel if v_rel z_i
    <= 0, else v_rel (1 - |z_i/y_i|^8). Pulled on, it slides at k s_y/(1 + p). With many cells the loops are
    those of Masing, and before it slides a loop of the amplitude a loses a^(2 + 1/p): p = 1/(1 + chi) of the
    four-parameter Iwan joint, whose chi is between -1 and 0.

    Six cells are within 2 % of the force of many sharp ones where it moves by s_y and more, and within 4 %
    where it moves by a tenth; but what it loses there may be half too much, and is nothing below the first
    yield. Twenty cells are within 11 %, 40 within 6 %, with p of 1 and more.

    Source: W. D. Iwan, A distributed-element model for hysteresis and its steady-state dynamic response, J.
    Appl. Mech. 33 (1966) 893-900; D. J. Segalman, A four-parameter Iwan model for lap-type joints, J. Appl.
    Mech. 72 (2005) 752-760.

    Example:
        >>> from inertance import Iwan
        >>> lap = Iwan(k=1e7, s_y=1e-5, p=2.0)
    """

    k = parameter("N/m", "stiffness before it slips", min=0)
    s_y = parameter("m", "stretch at which the last cell yields", above=0)

    @property
    def speed(self) -> Expression:
        return self.v_rel

    @property
    def stiffness(self) -> Expression:
        return self.k

    @property
    def slip_stretch(self) -> Expression:
        return self.s_y

    def cell(self) -> Component:
        return IwanCell()

    def equations(self) -> Stated:
        yield self.f == self.restoring
