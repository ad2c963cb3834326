"""Designs: the points of a sweep."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any, cast

import numpy as np

from ...base import Array, ModelError, demand, is_number, listed, named, shown, whole

Ranges = Mapping[str, Any]
MOST_POINTS = 50_000_000


@dataclass(frozen=True)
class Design:
    """The points of a sweep: values of the parameters `names`, point by point.

    Attributes:
        second_order: whether it was made by `saltelli` with points for interactions; None if it was not.
    """

    names: tuple[str, ...]
    points: tuple[tuple[Any, ...], ...]
    second_order: bool | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "names", listed("names", self.names))
        points: Any = self.points
        if not (isinstance(points, Sequence) and all(isinstance(point, Sequence) for point in points)):
            raise ModelError(f"points are rows of values, one for each parameter, got {shown(self.points)}")
        for number, point in enumerate(self.points):
            if len(point) != len(self.names):
                raise ModelError(f"point {number} has {len(point)} values for {len(self.names)} parameters")
        if not (self.names and self.points):
            raise ModelError("a design needs at least one parameter and one point")

    def __len__(self) -> int:
        return len(self.points)


def grid(values: Mapping[str, Iterable[Any]]) -> Design:
    """Return all combinations of the values of each parameter, the last one running fastest.

    Example:
        >>> from inertance.sweeps import grid
        >>> len(grid({"strut.damper.d": [1e3, 2e3, 3e3], "strut.inerter.b": [50.0, 100.0]}))
        6
    """
    values = named("a grid", values)
    for name, given in values.items():
        if isinstance(given, str) or not isinstance(given, Iterable):
            raise ModelError(f"'{name}': a grid takes a list of values, got {given!r}; write [{given!r}]")
    return Design(tuple(values), tuple(product(*map(_plain, values.values()))))


def monte_carlo(ranges: Ranges, count: int, *, seed: int = 0) -> Design:
    """Return independent random points.

    Args:
        ranges: for each parameter (least, greatest), uniform between, or a distribution of `scipy.stats`.
        count: how many points.
        seed: of the random numbers.
    """
    check(ranges, count, seed)
    return drawn(ranges, np.random.default_rng(seed).random((count, len(ranges))))


def latin_hypercube(ranges: Ranges, count: int, *, seed: int = 0) -> Design:
    """Return random points, one in each of `count` equally likely slices of every parameter.

    Args as for `monte_carlo`. Source: McKay, Beckman & Conover, Technometrics 21 (1979) 239-245.
    """
    from scipy.stats import qmc

    check(ranges, count, seed)
    return drawn(ranges, qmc.LatinHypercube(len(ranges), rng=seed).random(count))


def sobol_sequence(ranges: Ranges, count: int, *, seed: int = 0) -> Design:
    """Return points of a scrambled Sobol sequence, which fill the ranges evenly.

    Args as for `monte_carlo`; `count` is a power of 2, which keeps them balanced.

    Source: I. M. Sobol, USSR Comput. Math. Math. Phys. 7 (1967) 86-112.
    """
    from scipy.stats import qmc

    check(ranges, count, seed)
    check_power_of_two(count)
    return drawn(ranges, qmc.Sobol(len(ranges), rng=seed).random(count))


def check(ranges: Ranges, count: int, seed: int) -> None:
    """Refuse what no points can be drawn from."""
    if not named("ranges", ranges):
        raise ModelError("a design needs at least one parameter and one point")
    if whole(1)(count):
        told = "a design needs at least one point, a whole number of them"
        raise ModelError(f"{told}, got count={shown(count)}")
    if count > MOST_POINTS:
        told = f"does not fit any memory; take {MOST_POINTS:.0e} or fewer"
        raise ModelError(f"a design of {count:.3g} points {told}")
    demand("a design", seed=(seed, whole(0)))


def check_power_of_two(count: int) -> None:
    """Refuse a number of points for which a Sobol sequence is not balanced."""
    if count & (count - 1):
        near = 1 << max(count, 1).bit_length()
        raise ModelError(f"a Sobol sequence is balanced for powers of 2: take {near}, not {count}")


def drawn(ranges: Ranges, unit: Array, second_order: bool | None = None) -> Design:
    """Return points given between 0 and 1, each parameter's by its quantiles."""
    quantiles = [_quantile(name, given) for name, given in ranges.items()]
    columns = [quantile(column) for quantile, column in zip(quantiles, unit.T, strict=True)]
    return Design(tuple(ranges), tuple(zip(*map(_plain, columns), strict=True)), second_order)


def _quantile(name: str, given: Any) -> Callable[[Array], Array]:
    if hasattr(given, "ppf"):
        return cast(Callable[[Array], Array], given.ppf)
    pair = isinstance(given, Sequence) and len(given) == 2 and all(map(is_number, given))
    if not (pair and given[0] < given[1]):
        raise ModelError(
            f"'{name}': a range is (least, greatest) or a distribution such as scipy.stats.norm(5.0, 0.1), "
            f"got {given!r}"
        )
    low, high = given
    return lambda u: low + (high - low) * u


def _plain(values: Iterable[Any]) -> list[Any]:
    """Return values as plain Python ones, which compare and print alike everywhere."""
    return [value.item() if isinstance(value, np.generic) else value for value in values]
