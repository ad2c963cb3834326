"""Laws of a force given by points, over position, speed or both."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from .curves import area, between, over_grid
from .language import Expression, option
from .tables import increasing, of_equal_length


def law(position: str, speed: str, force: str) -> Any:
    """Declare rows (x, force) or (position, speed, force); the default is no force."""
    columns = f"({position}, {force}), ({speed}, {force}) or ({position}, {speed}, {force})"
    what = (
        "takes at least two rows (x, force) of finite numbers, x increasing, or rows (position, speed, "
        "force) that fill a grid of at least two of each"
    )
    check = of_equal_length(what, 2, _is_law)
    return option(f"rows {columns}", default=((0.0, 0.0), (1.0, 0.0)), check=check)


def variable_of_law() -> Any:
    """Declare what the first of two columns is."""
    told = "what rows of two numbers are over"
    return option(told, default="speed", choices=("position", "speed"))


def oddness() -> Any:
    """Declare whether a law is turned about its origin."""
    return option(
        "whether the points are one half, and F(-x) = -F(x) the other", default=False, choices=(False, True)
    )


class PointLaw:
    """The force of a table at a position and a speed, and the part of it that a rest at that position has."""

    def __init__(self, table: Any, over: str, how: str, odd: bool) -> None:
        rows = np.array([tuple(map(float, row)) for row in table])
        self.rows, self.how = [tuple(row) for row in (_turned(rows) if odd else rows).tolist()], how
        self.over = "both" if rows.shape[1] == 3 else over
        self.map = over_grid(self.rows, how) if self.over == "both" else None

    def force(self, position: Expression, speed: Expression) -> Expression:
        """Return the force."""
        if self.map is not None:
            return self.map.value(position, speed)
        return between(self.rows, position if self.over == "position" else speed, self.how)

    def at_rest(self, position: Expression) -> Expression:
        """Return the force that is stored."""
        return 0.0 if self.over == "speed" else self.force(position, 0.0)

    def stored(self, position: Expression) -> Expression:
        """Return the energy that it takes to come from 0 to a position slowly."""
        if self.map is not None:
            return self.map.area(position, 0.0)
        return area(self.rows, position, self.how) if self.over == "position" else 0.0


def _turned(rows: Any) -> Any:
    """Return rows with those turned about the origin, each place once."""
    places = {tuple(row[:-1] + 0.0): row[-1] for row in np.vstack([-rows, rows])}
    origin = tuple(np.zeros(rows.shape[1] - 1))
    if origin in places:
        places[origin] = 0.0
    return np.array(sorted((*place, force) for place, force in places.items()))


def _is_law(given: Sequence[tuple[float, ...]]) -> bool:
    width = len(given[0])
    if width == 2:
        return len(given) > 1 and increasing(given)
    pairs = {row[:2] for row in given}
    first, other = {a for a, _ in pairs}, {b for _, b in pairs}
    full = len(given) == len(pairs) == len(first) * len(other)
    return width == 3 and full and min(len(first), len(other)) > 1
