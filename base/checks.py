"""What options and arguments may be: each check says what a value must be if it is not."""

from collections.abc import Callable, Iterable, Mapping
from inspect import signature
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
    """Check arguments, each given as (value, check); raise a ModelError that tells all that is wrong."""
    problems = [
        f"{name} {told}, got {shown(value)}"
        for name, (value, check) in given.items()
        if (told := check(value))
    ]
    if problems:
        raise ModelError(f"{where}: these arguments cannot be used:", problems)


def check_keywords(where: str, given: Iterable[str], taker: Callable[..., Any]) -> None:
    """Check keywords that a function passes on to `taker`; raise a ModelError for those it does not know."""
    names = list(given)
    if not names:
        return
    known = [p.name for p in signature(taker).parameters.values() if p.kind is p.KEYWORD_ONLY]
    unknown = [f"there is no argument '{name}'{nearest(name, known)}" for name in names if name not in known]
    if unknown:
        raise ModelError(f"{where} takes {', '.join(known)}:", unknown)


def shown(value: Any) -> str:
    """Return a value as an error shows it: short."""
    return _shown.repr(value)


def is_number(value: Any) -> bool:
    """Return whether a value is a finite number (and no truth value)."""
    return not number(value) and abs(value) <= float_info.max


def number(value: Any) -> str:
    """Say that a value must be a number as floats are, finite or not."""
    real = isinstance(value, Real) and type(value) not in TRUTH
    beyond = isinstance(value, int) and abs(value) > float_info.max
    return "" if real and not beyond else "must be a number"


def must(told: str, good: Callable[[Any], bool]) -> Check:
    """Return a check that says what a value must be unless it is good."""
    return lambda value: "" if good(value) else f"must {told}"


def finite(unit: str = "") -> Check:
    """Return a check for finite numbers."""
    return lambda value: _wrong_number(value, unit)


def above(low: float, unit: str = "") -> Check:
    """Return a check for finite numbers above another."""
    return _within(f"above {low:g}", unit, lambda value: value > low)


def at_least(low: float, unit: str = "") -> Check:
    """Return a check for finite numbers that are not below another."""
    return _within(f"at least {low:g}", unit, lambda value: value >= low)


def between(low: float, high: float, unit: str = "") -> Check:
    """Return a check for numbers from `low` to `high`."""
    return _within(f"from {low:g} to {high:g}", unit, lambda value: low <= value <= high)


def whole(low: int) -> Check:
    """Return a check for whole numbers from `low` upwards."""
    return must(
        f"be a whole number, at least {low}",
        lambda value: isinstance(value, Integral) and is_number(value) and int(value) >= low,
    )


def numbers(check: Check) -> Check:
    """Return a check for a number or an array of numbers, each as `check` wants it."""

    def all_good(value: Any) -> str:
        try:
            flat = np.asarray(value).ravel()
        except (TypeError, ValueError):
            flat = np.array([None])
        if flat.size and flat.dtype == np.float64:
            flat = np.array([flat.min(), flat.max()])  # checks of floats are of ranges; NaN is in both
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


def instance(*kinds: type) -> Check:
    """Return a check for what a value is an instance of."""
    return must(
        f"be a {' or '.join(kind.__name__ for kind in kinds)}", lambda value: isinstance(value, kinds)
    )


def optional(check: Check) -> Check:
    """Return a check that lets None pass."""
    return lambda value: "" if value is None else check(value)


def by_name(check: Check) -> Check:
    """Return a check for a mapping of names to values, each as `check` wants it."""

    def all_good(value: Any) -> str:
        if not _maps_names(value):
            return "must map names to values, such as {'mass.s': 0.1}"
        wrong = {name: told for name, item in value.items() if (told := check(item))}
        return "; ".join(f"'{name}' {told}" for name, told in wrong.items())

    return all_good


def rows(what: str, width: int, good: Callable[[list[tuple[float, ...]]], bool]) -> Check:
    """Return a check for rows of `width` finite numbers that are good; `what` says what they must be."""

    def check(value: Any) -> str:
        try:
            given = [tuple(float(number) for number in row) for row in value]
        except (TypeError, ValueError):
            return what
        all_finite = all(len(row) == width and all(map(isfinite, row)) for row in given)
        return "" if given and all_finite and good(given) else what

    return check


def named(what: str, given: Any) -> dict[str, Any]:
    """Return values by name, none for None; raise a ModelError for what does not map names to values."""
    if given is None:
        return {}
    if not _maps_names(given):
        told = f"{what} maps names to values, such as {what}={{'mass.s': 0.1}}; got {shown(given)}"
        raise ModelError("these values cannot be used:", [told])
    return dict(given)


def listed(what: str, given: Any) -> tuple[str, ...]:
    """Return names that were given as one text or several; raise a ModelError for anything else."""
    several = (given,) if isinstance(given, str) else given
    if isinstance(several, Iterable) and not isinstance(several, Mapping | bytes):
        names = tuple(several)
        if all(isinstance(name, str) for name in names):
            return names
    raise ModelError(f"{what} is a list of names, such as ['mass.s'], got {shown(given)}")


def _wrong_number(value: Any, unit: str) -> str:
    kind = "" if number(value) else " finite"
    return "" if is_number(value) else f"must be a{kind} number{f' [{unit}]' if unit else ''}"


def _within(told: str, unit: str, good: Callable[[Any], bool]) -> Check:
    check = must(f"be {told}{f' {unit}' if unit else ''}", good)
    return lambda value: _wrong_number(value, unit) or check(value)


def _maps_names(value: Any) -> bool:
    return isinstance(value, Mapping) and all(isinstance(name, str) for name in value)


def _lists_texts(value: Any) -> bool:
    listing = isinstance(value, Iterable) and not isinstance(value, str | Mapping)
    return listing and all(isinstance(item, str) for item in value)


def _is_quantity(value: Any) -> bool:
    return isinstance(value, ca.SX | ca.MX | ca.DM) or not numbers(between(-1e60, 1e60))(value)


def _is_quantity_above_0(value: Any) -> bool:
    """Return whether the numbers of a quantity are above 0, by more than a rounding error."""
    return isinstance(value, ca.SX | ca.MX) or not numbers(between(1e-60, 1e60))(value)


boolean = must("be True or False", lambda value: type(value) in TRUTH)
counting = whole(1)
function = must("be a function", callable)
instant = must("be None or a finite number", lambda value: value is None or is_number(value))
quantity = must("be a finite number, an array of such, or a symbol", _is_quantity)
quantity_above_0 = must("be above 0, or a symbol", _is_quantity_above_0)
smoothing = must("be None or a number above 0", lambda value: value is None or not above(0)(value))
text = must("be a text in quotes", lambda value: isinstance(value, str))
texts = must("be a list of texts", _lists_texts)
one_name = must("be the name of one signal", lambda value: isinstance(value, str) and "*" not in value)
