"""Steps of a descent grow while they keep their promise; slopes are computed with each, or learnt."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from inertance import SimulationError
from inertance.identification import Ending, descent
from numpy.typing import NDArray

Array = NDArray[np.float64]
Found = tuple[Array, float]
ENDING = Ending(relative=1e-4, absolute=1.0, radius=1e-3, steps=100)


def descend(residual: Any, start: Array, bounds: tuple[Array, Array], learnt: bool = True) -> Found:
    """Return where a descent ends, and the sum of squares there."""
    *_, end = descent(residual, start, bounds, ENDING, learnt)
    return end.vector, end.cost


@pytest.mark.parametrize("learnt", [True, False])
def test_what_was_expected_far_off_is_reached_in_a_few_steps(learnt: bool) -> None:
    asked = []

    def residual(vector: Array, slopes: bool) -> tuple[Array, Array]:
        asked.append(slopes)
        far = vector - [300.0, 1.0]
        return 10 * far + 0.01 * far**2, np.diag(10 + 0.02 * far)

    free = np.array([-np.inf, -np.inf]), np.array([np.inf, np.inf])
    found, cost = descend(residual, np.zeros(2), free, learnt)
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


def test_slopes_that_grow_beyond_all_numbers_are_lost_without_a_word() -> None:
    """Those of a chaotic run do; a warning of NumPy tells nobody what to do."""

    def residual(vector: Array, slopes: bool) -> tuple[Array, Array]:
        return np.ones(2), np.outer(1e300 * np.exp(vector), [1e10, 1.0])

    with pytest.raises(SimulationError, match="not finite"):
        descend(residual, np.zeros(2), (np.full(2, -np.inf), np.full(2, np.inf)))


@pytest.mark.parametrize("learnt", [True, False])
def test_a_long_bent_valley_is_followed_to_its_end(learnt: bool) -> None:
    def residual(vector: Array, slopes: bool) -> tuple[Array, Array]:
        x, y = vector
        return np.array([10 * (y - np.sin(x)), x - 30.0]), np.array([[-10 * np.cos(x), 10.0], [1.0, 0.0]])

    free = np.array([-np.inf, -np.inf]), np.array([np.inf, np.inf])
    assert descend(residual, np.zeros(2), free, learnt)[1] < 2.0


@pytest.mark.parametrize("learnt", [True, False])
def test_what_cannot_come_where_another_has_been_is_left(learnt: bool) -> None:
    def residual(vector: Array, slopes: bool) -> tuple[Array, Array]:
        x, y = vector
        told = np.array([10 * (y - np.sin(x)), x - 30.0, 300.0])
        return told, np.array([[-10 * np.cos(x), 10.0], [1.0, 0.0], [0.0, 0.0]])

    def steps(known: float) -> tuple[int, float]:
        free = np.array([-np.inf, -np.inf]), np.array([np.inf, np.inf])
        *_, end = descent(residual, np.zeros(2), free, replace(ENDING, known=known), learnt)
        return end.number, end.cost

    alone, lowest = steps(np.inf)
    assert steps(1.001 * lowest) == (alone, lowest)
    assert steps(0.5 * lowest)[0] < 0.5 * alone


def test_learnt_slopes_are_computed_less_often() -> None:
    def counted(learnt: bool) -> int:
        sloped = 0

        def residual(vector: Array, slopes: bool) -> tuple[Array, Array]:
            nonlocal sloped
            sloped += slopes
            return 100 * (vector + 0.1 * vector**2 - 0.5), np.diag(100 + 20 * vector)

        free = np.full(2, -np.inf), np.full(2, np.inf)
        assert descend(residual, np.zeros(2), free, learnt)[1] < 0.1
        return sloped

    assert counted(learnt=True) < counted(learnt=False)


def test_steps_that_only_seem_to_lead_down_are_taken_back() -> None:
    """Without slopes too little is told to be left, as where starts are taken to answer in a line."""
    costs = []

    def residual(vector: Array, slopes: bool) -> tuple[Array, Array]:
        left = 100.0 * np.arctan(10.0 * vector) * (1.0 if slopes else 0.5)
        if slopes:
            costs.append(float(left @ left))
        return left, np.diag(1000.0 / (1.0 + (10.0 * vector) ** 2))

    free = np.array([-np.inf]), np.array([np.inf])
    _, cost = descend(residual, np.array([0.3]), free)
    assert costs[1] > costs[0]
    assert cost < 1.0
    assert len(costs) < 8


def test_what_lies_outside_ends_at_its_bound() -> None:
    def residual(vector: Array, slopes: bool) -> tuple[Array, Array]:
        return 10 * (vector - [2.0, 0.3]), 10 * np.eye(2)

    found, _ = descend(residual, np.zeros(2), (np.array([-1.0, -1.0]), np.array([0.5, 1.0])))
    assert found[0] == 0.5
    assert found[1] == pytest.approx(0.3)
