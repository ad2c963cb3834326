"""Tables: a signal over one input or two, and several signals over time."""

from itertools import pairwise
from typing import Any

import casadi as ca

from ...base import rows
from ..curves import Map
from ..language import Component, Expression, RealInput, RealOutput, Stated, option
from ..limits import limited
from ..tables import increasing, interpolated, of_equal_length
from .blocks import SISO
from .sources import TimeTable

HELD = option(
    "what it is beyond its ends: straight on, or the last value",
    default="linear",
    choices=("linear", "hold"),
)


MAP = of_equal_length(
    "takes rows of equal length: (0, u2, u2, ...), then (u1, y, y, ...), both inputs increasing",
    3,
    lambda table: len(table) > 2 and increasing(table[1:]) and increasing([*zip(*table, strict=True)][1:]),
)
COLUMNS = of_equal_length(
    "takes rows (time, value, value, ...) of equal length, times not decreasing",
    2,
    lambda table: all(a[0] <= b[0] for a, b in pairwise(table)),
)


class CombiTable1D(SISO):
    """A lookup table over one input, straight lines between its rows. Continuous, so it makes no event.

    Source: MSL Blocks.Tables.CombiTable1Ds with one column and LinearSegments.

    Example:
        >>> from inertance import signals
        >>> valve = signals.CombiTable1D(table=((0.0, 0.0), (1.0, 2.0), (3.0, 2.5)))
    """

    table = option(
        "rows (u, y), u increasing",
        default=((0.0, 0.0), (1.0, 1.0)),
        check=rows("takes rows (u, y) of finite numbers, u increasing", 2, increasing),
    )
    extrapolation = HELD

    def equations(self) -> Stated:
        yield self.y == interpolated(self.table, within(self, self.u, [row[0] for row in self.table]))


class CombiTable2D(Component):
    """A lookup map over two inputs, bilinear between its points. Continuous, so it makes no event.

    Source: MSL Blocks.Tables.CombiTable2Ds with LinearSegments.

    Example:
        >>> from inertance import signals
        >>> engine = signals.CombiTable2D(table=((0, 0, 1), (100, 10, 80), (300, 5, 120)))
    """

    u1 = RealInput("", "input down the first column")
    u2 = RealInput("", "input along the first row")
    y = RealOutput("", "output")
    table = option(
        "rows (0, u2, ...), (u1, y, ...), ...",
        default=((0.0, 0.0, 1.0), (0.0, 0.0, 0.0), (1.0, 0.0, 1.0)),
        check=MAP,
    )
    extrapolation = HELD

    def equations(self) -> Stated:
        (_, *along), *body = self.table
        down = [row[0] for row in body]
        u1, u2 = within(self, self.u1, down), within(self, self.u2, along)
        yield self.y == Map(down, along, [row[1:] for row in body]).value(u1, u2)


def within(block: Any, value: Expression, points: list[float]) -> Expression:
    """Return an input, kept between the ends of a table that holds its last values."""
    held = block.extrapolation == "hold"
    return limited(value, float(points[0]), float(points[-1])) if held else ca.SX(value)


class CombiTimeTable(Component):
    """Several signals of time from one table: part `column1` has the first in its `y`, and so on.

    Each is linear between rows; two rows of equal time make a jump. Before the first row they have their
    first values, after the last row the last ones.

    Source: MSL Blocks.Sources.CombiTimeTable with extrapolation HoldLastPoint; its y[1] is `column1.y`.

    Example:
        >>> from inertance import signals
        >>> weather = signals.CombiTimeTable(table=((0.0, 1.0, 5.0), (2.0, 3.0, 4.0)))
        >>> [name for name in ("column1", "column2", "column3") if hasattr(weather, name)]
        ['column1', 'column2']
    """

    table = option(
        "rows (time [s], value, value, ...), times not decreasing",
        default=((0.0, 0.0),),
        check=COLUMNS,
    )

    def parts(self) -> dict[str, Component]:
        """Return a table for each column."""
        width = len(self.table[0])
        return {
            f"column{k}": TimeTable(table=tuple((row[0], row[k]) for row in self.table))
            for k in range(1, width)
        }
