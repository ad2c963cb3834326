"""What options may be: each check says what a value must be if it is not."""

from __future__ import annotations

from collections.abc import Callable
from math import isfinite
from numbers import Integral, Real
from typing import Any


def counting(value: Any) -> str:
    """Say that a value must be a whole number from 1 upwards."""
    good = isinstance(value, Integral) and int(value) >= 1
    return "" if good else "must be a whole number, at least 1"


def smoothing(value: Any) -> str:
    """Say that a value must be None or a positive number."""
    good = value is None or (isinstance(value, Real) and 0 < float(value) < float("inf"))
    return "" if good else "must be None or a number above 0"


def instant(value: Any) -> str:
    """Say that a value must be None or a finite number."""
    good = value is None or (isinstance(value, Real) and isfinite(float(value)))
    return "" if good else "must be None or a finite number"


def rows(what: str, width: int, good: Callable[[list[tuple[float, ...]]], bool]) -> Callable[[Any], str]:
    """Return a check for rows of finite numbers.

    Args:
        what: what they must be, in words.
        width: how many numbers a row has.
        good: whether rows are as they must be.
    """

    def check(value: Any) -> str:
        try:
            given = [tuple(float(number) for number in row) for row in value]
        except (TypeError, ValueError):
            return what
        numbers = all(len(row) == width and all(map(isfinite, row)) for row in given)
        return "" if given and numbers and good(given) else what

    return check
