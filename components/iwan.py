"""Joints that slip bit by bit: cells in parallel that yield one after the other, sliding or turning."""

import casadi as ca

from ..base import counting
from .hysteresis import LEAST_HYSTERESIS
from .language import Component, Expression, Stated, der, dissipation, energy, option, parameter
from .lossy import Rubbing

CELLS = 6
CELL_SHARPNESS = 8.0  # [1] n of Bouc and Wen's law of a cell: within 2 % of sharp cells where all slip


def yields_of(largest: Expression, p: Expression, cells: int) -> list[Expression]:
    """Return where cells of equal stiffness yield: largest u^p at the middles u of equal shares of them."""
    return [largest * ((i + 0.5) / cells) ** p for i in range(cells)]


def slip_share(v: Expression, z: Expression, z_y: Expression) -> Expression:
    """Return with which share of its speed a cell slips: |z/z_y|^n while it is stretched on, else none.

    That is Bouc and Wen's law with beta = gamma, told so that the rate of what slips wholly has few errors.
    """
    size = ca.fmax(ca.fabs(z), LEAST_HYSTERESIS)
    return (size / z_y) ** CELL_SHARPNESS * (1 + ca.sign(v) * ca.sign(z)) / 2


class IwanCells(Rubbing):
    """A spring made of cells that yield one after the other: f = k mean(z_i), z_i' = v (1 - slip_i).

    Each cell is Bouc and Wen's, with n = 8. A subclass gives what a cell is in `cell()`, the relative
    `speed`, the `stiffness` k and `slip_stretch`, where the last cell yields, and states the force.
    """

    p = parameter("1", "how the yields spread: 0 all at once, 1 evenly, above 1 more of them early", min=0)
    cells = option("number of cells", default=CELLS, check=counting)
    restoring = property(lambda self: self.stiffness * sum(self.stretches) / self.cells)
    potential = energy(lambda self: self.stiffness * sum(z**2 for z in self.stretches) / 2 / self.cells)
    lossPower = dissipation(
        lambda self: self.stiffness * self.speed * sum(z * slip for z, slip in self.slipping) / self.cells
    )

    def cell(self) -> Component:
        """Return a cell, which declares its stretch z."""
        raise NotImplementedError

    @property
    def stiffness(self) -> Expression:
        """Stiffness before it slips."""
        raise NotImplementedError

    @property
    def slip_stretch(self) -> Expression:
        """The stretch at which the last cell yields."""
        raise NotImplementedError

    def parts(self) -> dict[str, Component]:
        """Return the cells."""
        return {f"cell{i}": self.cell() for i in range(1, self.cells + 1)}

    @property
    def stretches(self) -> list[Expression]:
        """The stretch of each cell."""
        return [getattr(self, f"cell{i}").z for i in range(1, self.cells + 1)]

    @property
    def slipping(self) -> list[tuple[Expression, Expression]]:
        """The stretch of each cell, and the share of the speed with which it slips."""
        yields = yields_of(self.slip_stretch, self.p, self.cells)
        return [(z, slip_share(self.speed, z, y)) for z, y in zip(self.stretches, yields, strict=True)]

    def equations(self) -> Stated:
        for z, slip in self.slipping:
            yield der(z) == self.speed * (1 - slip)
