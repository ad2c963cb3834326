"""What samples weigh where a filter has changed the top of what a channel passes."""

from __future__ import annotations

from math import inf

import numpy as np
import pytest
from inertance.identification import NoiseFloor, Weighing

COUNT, RATE, SIGMA = 3000, 250.0, 0.02


def weighing(passed: float, counted: np.ndarray | None = None, count: int = COUNT) -> Weighing:
    counts = np.ones(count, dtype=bool) if counted is None else counted
    return Weighing(NoiseFloor(SIGMA, "stated", passed=passed), counts, RATE)


def holed() -> np.ndarray:
    """Samples, of which some at both ends and in the middle do not count."""
    at = np.arange(COUNT)
    return np.asarray((at > 14) & (at < COUNT - 40) & ((at < 900) | (at > 1100)))


def test_without_a_filter_each_sample_weighs_alone() -> None:
    rng, counted = np.random.default_rng(0), holed()
    for columns in (rng.normal(size=COUNT), rng.normal(size=(COUNT, 3)), np.zeros((COUNT, 0))):
        alone = columns * np.reshape(counted / SIGMA, (-1, *[1] * (columns.ndim - 1)))
        for same in (weighing(inf, counted), weighing(2 * RATE, counted)):
            assert same.is_whole
            assert same.share == 1.0
            for weighed in (same(columns), same.back(columns)):
                np.testing.assert_allclose(weighed, alone, rtol=1e-15)


@pytest.mark.parametrize("passed", [10.0, 40.0, 110.0])
def test_noise_is_one_share_in_every_sample(passed: float) -> None:
    """At the ends and beside gaps, too, where less is averaged."""
    rng, counted = np.random.default_rng(1), holed()
    weighed = weighing(passed, counted)
    noise = weighed(SIGMA * rng.standard_normal((COUNT, 400)))
    assert weighed.share == pytest.approx(passed / RATE, rel=0.15)
    power = np.mean(noise**2, axis=1)
    assert not power[~counted].any()
    np.testing.assert_allclose(power[counted], weighed.share, rtol=0.5)
    assert np.mean(power[counted]) == pytest.approx(weighed.share, rel=0.02)
    assert weighed.noise == pytest.approx(SIGMA * weighed.share**0.5)


def test_what_is_slow_stays_and_what_a_filter_has_changed_goes() -> None:
    time, passed = np.arange(COUNT) / RATE, 30.0
    inner, weighed = slice(200, -200), weighing(passed)
    for frequency, left in ((0.25 * passed, 1.0), (0.9 * passed, 0.0), (3 * passed, 0.0)):
        wave = np.sin(2 * np.pi * frequency * time)
        np.testing.assert_allclose(SIGMA * weighed(wave)[inner], left * wave[inner], atol=0.02)


def test_the_transposed_is_that_of_the_same_weighing() -> None:
    rng, weighed = np.random.default_rng(2), weighing(25.0, holed())
    one, other = rng.normal(size=(2, COUNT))
    assert weighed(one) @ other == pytest.approx(one @ weighed.back(other), rel=1e-9)


def test_a_record_of_few_periods_is_weighed_whole() -> None:
    assert weighing(2.0, count=600).is_whole
    assert not weighing(2.0, count=6000).is_whole
