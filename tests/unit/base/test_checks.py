"""Checks of arrays: as strict as of each of their numbers, and no slower for being long."""

from math import inf, nan

import numpy as np
import pytest
from inertance.base.checks import above, between, finite, numbers


def test_a_long_array_is_not_checked_one_by_one() -> None:
    asked = []

    def check(value: float) -> str:
        asked.append(value)
        return ""

    assert not numbers(check)(np.arange(1e6))
    assert asked == [0.0, 999_999.0]


@pytest.mark.parametrize("place", [0, 500, 999])
@pytest.mark.parametrize("wrong", [nan, inf, -inf, -1.0, 11.0])
def test_a_wrong_number_is_found_wherever_it_is(place: int, wrong: float) -> None:
    values = np.linspace(0.5, 10.0, 1000)
    for check in (finite(), between(0, 10), above(0)):
        assert not numbers(check)(values)
    values[place] = wrong
    assert bool(numbers(finite())(values)) == (not np.isfinite(wrong))
    assert numbers(between(0, 10))(values)
    assert bool(numbers(above(0))(values.reshape(10, 100))) == (not 0 < wrong < inf)
