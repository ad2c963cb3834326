"""The filter and the smoother in C do what they do in NumPy, whatever the records."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from inertance.diagnosis.law import compiled_passes, smoother, stacked_passes
from inertance.diagnosis.law.course import Course, Roughness
from numpy.typing import NDArray

Array = NDArray[np.float64]


def course(seed: int, points: int, own: int, states: int = 3) -> Course:
    """A machine with two outputs and two sites, at uneven instants, not all of them measured."""
    rng = np.random.default_rng(seed)
    outputs, sites, shared = 2, 2, 2

    def some(*shape: int) -> Array:
        return rng.standard_normal(shape)

    to_x, to_f = some(points, outputs, states), some(points, outputs, sites)
    lost = rng.uniform(size=(points, outputs)) < 0.3
    to_x[lost], to_f[lost] = 0.0, 0.0
    return Course(
        t=np.cumsum(rng.uniform(0.5, 1.5, points)),
        map=0.5 * some(points - 1, states, states),
        here=some(points - 1, states, sites),
        there=some(points - 1, states, sites),
        to_x=to_x,
        to_f=to_f,
        columns=some(points, outputs, 1 + shared + own),
        shared=shared,
        priors=np.zeros(own),
    )


@pytest.mark.parametrize("states", [0, 1, 3])
@pytest.mark.parametrize("order", [1, 2])
def test_both_find_one_force(order: int, states: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """A rig that prescribes all motion has no states, and may have far more columns."""
    courses = [course(1, 40, 1, states), course(2, 25, 30, states)]
    rough = Roughness(order, np.array([0.7, 2.0]), np.array([3.0, 9.0]))
    if compiled_passes.compiled_passes() is None:
        pytest.skip("no C compiler")
    fast = smoother.filtered(courses, rough)
    force, error = smoother.smoothed(fast)
    monkeypatch.setattr(smoother, "compiled_passes", lambda: None)
    plain = smoother.filtered(courses, rough)
    expected, deviation = smoother.smoothed(plain)
    assert fast.evidence == pytest.approx(plain.evidence, rel=1e-10)
    assert fast.unknown == pytest.approx(plain.unknown, rel=1e-5, abs=1e-8)
    for number, one in enumerate(courses):
        assert force[: len(one.t), number] == pytest.approx(
            expected[: len(one.t), number], rel=1e-8, abs=1e-10
        )
        assert error[: len(one.t), number] == pytest.approx(
            deviation[: len(one.t), number], rel=1e-6, abs=1e-8
        )


def test_nothing_is_kept_where_no_smoother_follows() -> None:
    rough = Roughness(1, np.array([0.7, 2.0]), np.array([3.0, 9.0]))
    passes = compiled_passes.compiled_passes() or stacked_passes
    kept, left = (passes.forward([course(3, 12, 0)], rough, keep) for keep in (True, False))
    assert len(kept.rows) == 12
    assert len(left.rows) == len(left.gains) == len(left.ahead) == 0
    assert left.innovations == pytest.approx(kept.innovations)


def test_the_filter_is_the_best_line_through_all_that_was_measured() -> None:
    """Held against Gauss: the covariance of all measurements at once, and what it tells of the force."""
    one = replace(course(4, 9, 0), shared=0)
    one = replace(one, columns=one.columns[:, :, :1])
    rough = Roughness(1, np.array([0.7, 2.0]), np.array([3.0, 9.0]))
    force, error = smoother.smoothed(found := smoother.filtered([one], rough))
    for site in range(2):
        far = np.abs(one.t[:, None] - one.t)
        prior = rough.size[site] ** 2 * np.exp(-far / rough.time[site])
        answers = np.zeros((9, 2, 9))
        state = np.zeros((3, 9))
        for k in range(9):
            answers[k] = one.to_x[k] @ state
            answers[k, :, k] += one.to_f[k, :, site]
            if k < 8:
                state = one.map[k] @ state
                state[:, k] += one.here[k, :, site]
                state[:, k + 1] += one.there[k, :, site]
        G, y = answers[one.measured], one.columns[:, :, 0][one.measured]
        whole = G @ prior @ G.T + np.eye(len(y))
        gain = prior @ G.T @ np.linalg.inv(whole)
        assert force[:, 0, site] == pytest.approx(gain @ y, rel=1e-8, abs=1e-9)
        assert error[:, 0, site] == pytest.approx(np.sqrt(np.diag(prior - gain @ G @ prior)), rel=1e-7)
        evidence = -0.5 * (y @ np.linalg.solve(whole, y) + np.linalg.slogdet(whole)[1])
        assert found.evidence[site] == pytest.approx(evidence, rel=1e-9)
