"""Steps of small changes are exponentials, soft or stiff, and of however many intervals at a time."""

from __future__ import annotations

import casadi as ca
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from inertance.networks.evaluation.compiled import FEW, MOST_POINTS, Batch
from inertance.networks.evaluation.transition_matrices import BLOCK, DOUBLINGS, SUMMED, _single
from scipy.linalg import expm


def exact(A: np.ndarray, h: float) -> list[np.ndarray]:
    """Return exp(h A), and what forces of 1 that fall to 0, and rise from 0, add over h."""
    n = len(A)
    whole = np.zeros((3 * n, 3 * n))
    whole[:n, :n], whole[:n, n : 2 * n], whole[n : 2 * n, 2 * n :] = A, np.eye(n), np.eye(n) / h
    found = expm(h * whole)[:n]
    rising = found[:, 2 * n :]
    return [found[:, :n], found[:, n : 2 * n] - rising, rising]


@given(st.integers(0, 10**6), st.floats(1e-6, 30.0), st.integers(1, 5))
def test_what_is_soft_or_swings_fast_is_exact_to_many_digits(seed: int, size: float, states: int) -> None:
    rng = np.random.default_rng(seed)
    A = rng.normal(size=(3, states, states))
    if size > 1:
        A -= np.swapaxes(A, 1, 2)
    A /= np.maximum(np.linalg.norm(A, axis=(1, 2), keepdims=True), 1e-3)
    scale = 10.0 ** rng.uniform(-2, 2, size=(states, 1))
    A *= scale / scale.T
    found = _single(np.full(3, size), A, scale)
    for parts in zip(*found, A, strict=True):
        for got, wanted in zip(parts[:3], exact(parts[3], size), strict=True):
            assert np.abs((got - wanted) / (scale / scale.T)).max() < 5e-8 * max(1.0, size)


def test_what_is_stiff_dies_out_beside_what_is_soft() -> None:
    """One interval of a stop among soft ones, over more intervals than are treated at a time."""
    count, rates = BLOCK + 7, np.array([1e7, 2.0])
    A = np.tile(np.diag([0.0, -2.0]), (count, 1, 1))
    A[5, 0, 0] = -rates[0]
    maps, here, there = _single(np.full(count, 0.1), A, np.ones((2, 1)))
    assert np.abs(A[5]).max() * 0.1 > SUMMED * 2**DOUBLINGS
    assert maps[:, 1, 1] == pytest.approx(np.exp(-0.2), rel=1e-7)
    assert maps[5, 0, 0] == pytest.approx(0.0, abs=1e-5)
    assert [here[5, 0, 0], there[5, 0, 0]] == pytest.approx([0.0, 1 / rates[0]], abs=1e-12)
    assert np.delete(maps[:, 0, 0], 5) == pytest.approx(1.0)
    for part in (here, there):
        assert np.delete(part[:, 0, 0], 5) == pytest.approx(0.05)


@pytest.mark.parametrize("points", [0, 1, MOST_POINTS // FEW + 1, MOST_POINTS - 1, 3 * MOST_POINTS + 5])
def test_batches_of_any_size_give_what_single_calls_give(points: int) -> None:
    x, t = ca.SX.sym("x", 2), ca.SX.sym("t")
    batch = Batch(ca.Function("twice", [x, t], [ca.vertcat(x, t) @ x.T, x * t]))
    given_x, given_t = np.random.default_rng(1).normal(size=(points, 2)), np.arange(float(points))[:, None]
    matrix, vector = batch(given_x, given_t)
    both = np.concatenate([given_x, given_t], axis=1)
    assert matrix == pytest.approx(both[:, :, None] * given_x[:, None, :])
    assert vector[:, :, 0] == pytest.approx(given_x * given_t)
    assert matrix.shape == (points, 3, 2)
