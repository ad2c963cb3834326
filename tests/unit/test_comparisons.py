"""Whole arrays are near by the rule by which their numbers are, one by one."""

from itertools import product
from typing import Any

import numpy as np
import pytest

NUMBERS = [0.0, 1.0, 1.0 + 9e-7, 1.0 + 2e-6, 1e-13, 1e-11, -1.0, 3.0, np.inf, -np.inf, np.nan, 1e308]
TOLERANCES: list[dict[str, Any]] = [
    {},
    {"rel": 1e-3},
    {"abs": 0.1},
    {"rel": 0.5, "abs": 2.0},
    {"abs": np.inf},
]


@pytest.mark.parametrize("tolerance", TOLERANCES, ids=str)
@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_arrays_are_as_near_as_their_numbers(tolerance: dict[str, Any]) -> None:
    for actual, expected in product(NUMBERS, NUMBERS):
        one = actual == pytest.approx(expected, **tolerance)
        for beside in ([], [1.0]):
            whole = np.array([actual, *beside]) == pytest.approx(np.array([expected, *beside]), **tolerance)
            assert whole == one, (actual, expected)


def test_arrays_of_other_shapes_and_negative_tolerances_are_refused() -> None:
    assert np.zeros(2) != pytest.approx(np.zeros(3))
    assert np.zeros((2, 1)) != pytest.approx(np.zeros((1, 2)))
    with pytest.raises(ValueError, match="negative"):
        assert np.zeros(2) == pytest.approx(np.ones(2), abs=-1.0)
