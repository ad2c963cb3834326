"""Steps of the descent grow while they keep their promise."""

import numpy as np
import pytest
from inertance import SimulationError
from inertance.diagnosis.search.least_squares import descend
from numpy.typing import NDArray

Array = NDArray[np.float64]


def test_what_was_expected_far_off_is_reached_in_a_few_steps() -> None:
    asked = []

    def residual(vector: Array, slopes: bool) -> tuple[Array, Array]:
        asked.append(slopes)
        far = vector - [300.0, 1.0]
        return 10 * far + 0.01 * far**2, np.diag(10 + 0.02 * far)

    free = np.array([-np.inf, -np.inf]), np.array([np.inf, np.inf])
    found, cost = descend(residual, np.zeros(2), free)
    assert found == pytest.approx([300.0, 1.0], abs=0.2)
    assert cost < 5.0
    assert len(asked) < 25


def test_slopes_that_are_lost_end_the_descent_where_it_is() -> None:
    def residual(vector: Array, slopes: bool) -> tuple[Array, Array]:
        lost = np.nan if vector[0] > 0.5 else 1.0
        return np.exp(10 * (1.0 - vector)), -10 * lost * np.diag(np.exp(10 * (1.0 - vector)))

    free = np.array([-np.inf]), np.array([np.inf])
    found, cost = descend(residual, np.zeros(1), free)
    assert found[0] > 0.3
    assert np.isfinite(cost)
    with pytest.raises(SimulationError, match="not finite"):
        descend(residual, np.array([0.9]), free)


def test_a_long_bent_valley_is_followed_to_its_end() -> None:
    def residual(vector: Array, slopes: bool) -> tuple[Array, Array]:
        x, y = vector
        return np.array([10 * (y - np.sin(x)), x - 30.0]), np.array([[-10 * np.cos(x), 10.0], [1.0, 0.0]])

    free = np.array([-np.inf, -np.inf]), np.array([np.inf, np.inf])
    assert descend(residual, np.zeros(2), free)[1] < 2.0
