"""Steps of small changes are exponentials, soft or stiff, and of however many intervals at a time."""

from __future__ import annotations

from math import factorial

import casadi as ca
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from inertance.networks.evaluation.compiled import FEW, MOST_POINTS, Batch
from inertance.networks.evaluation.transition_matrices import BLOCK, SOFT, _single
from scipy.linalg import expm


def exact(Z: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Return exp(Z) and its integral times b, as one exponential of both."""
    n, count = Z.shape[0], b.shape[1]
    whole = np.zeros((n + count, n + count))
    whole[:n, :n], whole[:n, n:] = Z, b
    return np.asarray(expm(whole)[:n])


@given(st.integers(0, 10**6), st.floats(1e-6, 1.0), st.integers(1, 5), st.integers(1, 4))
def test_what_is_soft_is_exact_to_many_digits(seed: int, size: float, states: int, columns: int) -> None:
    rng = np.random.default_rng(seed)
    A, B = rng.normal(size=(3, states, states)), rng.uniform(-1, 1, size=(3, states, columns))
    A, B = (m / np.linalg.norm(m, axis=(1, 2), keepdims=True) for m in (A, B))
    scale = 10.0 ** rng.uniform(-2, 2, size=(states, 1))
    A *= scale / scale.T
    found = _single(np.full(3, size), A, B * scale, scale)
    for step, a, b in zip(found, A, B * scale, strict=True):
        wanted = exact(size * a, size * b)
        sizes = np.concatenate([scale / scale.T, np.tile(scale, columns)], axis=1)
        assert np.abs((step - wanted) / sizes).max() < 1.11 / factorial(10)


def test_what_is_stiff_dies_out_beside_what_is_soft() -> None:
    """One interval of a stop among soft ones, over more intervals than are treated at a time."""
    count, rates = BLOCK + 7, np.array([1e7, 2.0])
    A = np.tile(np.diag([0.0, -2.0]), (count, 1, 1))
    A[5, 0, 0] = -rates[0]
    found = _single(np.full(count, 0.1), A, np.ones((count, 2, 1)), np.ones((2, 1)))
    assert np.abs(A[5]).max() * 0.1 > SOFT
    assert found[:, 1, 1] == pytest.approx(np.exp(-0.2), rel=1e-7)
    assert found[5, 0, 0] == pytest.approx(0.0, abs=1e-5)
    assert np.delete(found[:, 0, 0], 5) == pytest.approx(1.0)
    assert np.delete(found[:, 0, 2], 5) == pytest.approx(0.1)


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
