"""What options and arguments may be: each check says what a value must be if it is not."""

from collections.abc import Callable, Iterable, Mapping
from math import isfinite
from numbers import Integral, Real
from reprlib import Repr
from sys import float_info
from typing import Any

import casadi as ca
import numpy as np

from .errors import ModelError, nearest

Check = Callable[[Any], str]
TRUTH: tuple[type, ...] = (bool, np.bool)
_shown = Repr()
_shown.maxstring = _shown.maxother = 80
_shown.maxlong = 40


def demand(where: str, **given: tuple[Any, Check]) -> None:
    """Check the arguments of a public function, each given as (value, check).

    Raises:
        ModelError: telling everything that is wrong at once.
    """
    problems = [
        f"{name} {told}, got {shown(value)}"
        for name, (value, check) in given.items()
        if (told := check(value))
    ]
    if problems:
        raise ModelError(f"{where}: these arguments cannot be used:", problems)


def shown(value: Any) -> str:
    """Return a value as an error shows it: short."""
    return _shown.repr(value)


def is_number(value: Any) -> bool:
    """Return whether a value is a finite number (and no truth value)."""
    return not number(value) and abs(value) <= float_info.max


def counting(value: Any) -> str:
    """Say that a value must be a whole number from 1 upwards."""
    return whole(1)(value)


def smoothing(value: Any) -> str:
    """Say that a value must be None or a positive number."""
    return "" if value is None or not above(0)(value) else "must be None or a number above 0"


def instant(value: Any) -> str:
    """Say that a value must be None or a finite number."""
    return "" if value is None or is_number(value) else "must be None or a finite number"


def number(value: Any) -> str:
    """Say that a value must be a number as floats are, finite or not."""
    real = isinstance(value, Real) and type(value) not in TRUTH
    beyond = isinstance(value, int) and abs(value) > float_info.max
    return "" if real and not beyond else "must be a number"


def finite(unit: str = "") -> Check:
    """Return a check for finite numbers."""
    return lambda value: _wrong_number(value, unit)


def above(low: float, unit: str = "") -> Check:
    """Return a check for finite numbers above another."""
    return lambda value: _wrong_number(value, unit) or _unless(value > low, f"above {low:g}", unit)


def at_least(low: float, unit: str = "") -> Check:
    """Return a check for finite numbers that are not below another."""
    return lambda value: _wrong_number(value, unit) or _unless(value >= low, f"at least {low:g}", unit)


def between(low: float, high: float, unit: str = "") -> Check:
    """Return a check for numbers from `low` to `high`."""
    told = f"from {low:g} to {high:g}"
    return lambda value: _wrong_number(value, unit) or _unless(low <= value <= high, told, unit)


def whole(low: int) -> Check:
    """Return a check for whole numbers from `low` upwards."""
    told = f"must be a whole number, at least {low}"
    return lambda value: (
        "" if isinstance(value, Integral) and is_number(value) and int(value) >= low else told
    )


def numbers(check: Check) -> Check:
    """Return a check for a number or an array of numbers, each as `check` wants it."""

    def all_good(value: Any) -> str:
        try:
            flat = np.asarray(value).ravel()
        except (TypeError, ValueError):
            flat = np.array([None])
        wrong = (told for item in flat.tolist() if (told := check(item)))
        return next(wrong, "" if flat.size else check(None))

    return all_good


def one_of(choices: tuple[str, ...]) -> Check:
    """Return a check for one of some texts."""

    def chosen(value: Any) -> str:
        if isinstance(value, str) and value in choices:
            return ""
        return f"must be one of {', '.join(map(repr, choices))}{nearest(str(value), choices)}"

    return chosen


def text(value: Any) -> str:
    """Say that a value must be a text."""
    return "" if isinstance(value, str) else "must be a text in quotes"


def texts(value: Any) -> str:
    """Say that a value must be several texts."""
    good = isinstance(value, Iterable) and not isinstance(value, str | Mapping)
    return "" if good and all(isinstance(item, str) for item in value) else "must be a list of texts"


def function(value: Any) -> str:
    """Say that a value must be a function."""
    return "" if callable(value) else "must be a function"


def optional(check: Check) -> Check:
    """Return a check that lets None pass."""
    return lambda value: "" if value is None else check(value)


def by_name(check: Check) -> Check:
    """Return a check for a mapping of names to values, each as `check` wants it."""

    def all_good(value: Any) -> str:
        if not isinstance(value, Mapping) or not all(isinstance(name, str) for name in value):
            return "must map names to values, such as {'mass.s': 0.1}"
        wrong = {name: told for name, item in value.items() if (told := check(item))}
        return "; ".join(f"'{name}' {told}" for name, told in wrong.items())

    return all_good


def named(what: str, given: Any) -> dict[str, Any]:
    """Return values by name, none for None.

    Raises:
        ModelError: for what does not map names to values.
    """
    if given is None:
        return {}
    if not isinstance(given, Mapping) or not all(isinstance(name, str) for name in given):
        told = f"{what} maps names to values, such as {what}={{'mass.s': 0.1}}; got {shown(given)}"
        raise ModelError("these values cannot be used:", [told])
    return dict(given)


def listed(what: str, given: Any) -> tuple[str, ...]:
    """Return names that were given as one text or several.

    Raises:
        ModelError: for anything else.
    """
    several = (given,) if isinstance(given, str) else given
    if isinstance(several, Iterable) and not isinstance(several, Mapping | bytes):
        names = tuple(several)
        if all(isinstance(name, str) for name in names):
            return names
    raise ModelError(f"{what} is a list of names, such as ['mass.s'], got {shown(given)}")


def quantity(value: Any) -> str:
    """Say that a value must be a number, an array of numbers, or a symbol."""
    good = isinstance(value, ca.SX | ca.MX | ca.DM) or not numbers(between(-1e60, 1e60))(value)
    return "" if good else "must be a finite number, an array of such, or a symbol"


def quantity_above_0(value: Any) -> str:
    """Say that a value must be a quantity whose numbers are above 0, by more than a rounding error."""
    symbol = isinstance(value, ca.SX | ca.MX)
    return "" if symbol or not numbers(between(1e-60, 1e60))(value) else "must be above 0, or a symbol"


def instance(*kinds: type) -> Check:
    """Return a check for what a value is an instance of."""
    told = " or ".join(kind.__name__ for kind in kinds)
    return lambda value: "" if isinstance(value, kinds) else f"must be a {told}"


def boolean(value: Any) -> str:
    """Say that a value must be True or False."""
    return "" if type(value) in TRUTH else "must be True or False"


def rows(what: str, width: int, good: Callable[[list[tuple[float, ...]]], bool]) -> Check:
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
        all_finite = all(len(row) == width and all(map(isfinite, row)) for row in given)
        return "" if given and all_finite and good(given) else what

    return check


def _wrong_number(value: Any, unit: str) -> str:
    kind = "" if number(value) else " finite"
    return "" if is_number(value) else f"must be a{kind} number{f' [{unit}]' if unit else ''}"


def _unless(good: bool, told: str, unit: str) -> str:
    return "" if good else f"must be {told}{f' {unit}' if unit else ''}"
