"""Tables: values given over speed, in between by straight lines."""

from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import Any

import numpy as np

from ..base import rows
from ..base.checks import Check
from .language import Expression, Pieces, option


def over_speed(columns: str, value: str, default: float = 1.0) -> Any:
    """Declare rows (speed, value), whose columns are told with units; the default is one row, at rest."""
    what = f"takes rows (speed, {value}) of finite numbers, speeds increasing from 0, values not below 0"
    check = rows(what, 2, lambda given: _increase(given) and all(y >= 0 for _, y in given))
    return option(f"rows ({columns}), speeds increasing from 0", default=((0.0, default),), check=check)


def over_speed_with_losses(value: Any) -> str:
    """Check rows (speed, eta1, eta2, tau_bf1, tau_bf2)."""
    what = (
        "takes rows (speed, eta1, eta2, tau_bf1, tau_bf2) of finite numbers, speeds increasing from 0, "
        "efficiencies above 0 and at most 1, bearing friction not below 0"
    )
    return rows(what, 5, lambda given: _increase(given) and all(map(_is_loss, given)))(value)


def _is_loss(row: tuple[float, ...]) -> bool:
    return all(0 < eta <= 1 for eta in row[1:3]) and min(row[3:]) >= 0


def _increase(given: list[tuple[float, ...]]) -> bool:
    return given[0][0] == 0 and increasing(given)


def increasing(given: Sequence[Sequence[float]]) -> bool:
    """Return whether the first column of a table increases."""
    return all(a[0] < b[0] for a, b in pairwise(given))


def of_equal_length(what: str, least: int, good: Callable[[list[tuple[float, ...]]], bool]) -> Check:
    """Return a check for rows of equal length, at least some numbers each, that are good."""

    def check(given: Any) -> str:
        try:
            width = len(given[0])
        except (TypeError, IndexError, KeyError):
            return what
        return rows(what, max(width, least), good)(given)

    return check


def interpolated(table: tuple[tuple[float, ...], ...], at: Expression, column: int = 1) -> Expression:
    """Return a column of a table at a value of its first column, its ends extrapolated.

    A table of one row is constant.
    """
    x, y = np.array([(row[0], row[column]) for row in table], dtype=float).T
    return y[0] + 0 * at if len(table) == 1 else Pieces.through(x, y).value(at)
