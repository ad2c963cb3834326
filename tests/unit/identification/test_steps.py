"""Steps of a prediction, rounded as a logger's filter rounds them."""

from __future__ import annotations

from dataclasses import replace
from math import inf

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from inertance.identification import Steps, cutoff_of
from numpy.typing import NDArray
from scipy.signal import bessel, butter, sosfilt, sosfiltfilt

Array = NDArray[np.float64]
FINE, EVERY, BEGIN = 20000.0, 80, 137.25
RATE = FINE / EVERY


def stepping(seed: int, seconds: float = 8.0, each: float = 0.11) -> tuple[Array, Steps]:
    """A channel that only steps, on a fine grid, and its steps between samples: one in `each` seconds."""
    rng, count = np.random.default_rng(seed), round(seconds * FINE)
    struck = np.sort(rng.choice(np.arange(200, count - 200), round(seconds / each), replace=False))
    sizes = rng.normal(size=len(struck))
    fine = np.zeros(count)
    np.add.at(fine, struck, sizes)
    time = BEGIN + np.arange(0, count, EVERY) / FINE
    after = -(-struck // EVERY)
    return np.cumsum(fine), Steps(time, BEGIN + (struck - 0.5) / FINE, after, {"a": sizes})


def zero_phase(values: Array, cutoff: float) -> Array:
    return np.asarray(sosfiltfilt(butter(2, cutoff, fs=FINE, output="sos"), values))


@settings(max_examples=20, deadline=None)
@given(cutoff=st.floats(8.0, 110.0), seed=st.integers(0, 100))
def test_rounding_is_what_the_filter_makes_of_steps(cutoff: float, seed: int) -> None:
    sharp, steps = stepping(seed)
    seen = zero_phase(sharp, cutoff)[::EVERY]
    found = sharp[::EVERY] + steps.rounding("a", cutoff)
    inner = slice(round(0.2 * RATE), -round(0.2 * RATE))
    assert found[inner] == pytest.approx(seen[inner], abs=0.02)


def test_no_filter_rounds_nothing_and_a_channel_without_steps_has_none() -> None:
    _, steps = stepping(1)
    assert not steps.rounding("a", inf).any()
    still = replace(steps, sizes={"a": np.zeros(len(steps.at))})
    assert not still.rounding("a", 30.0).any()
    assert cutoff_of("a", [np.ones(len(steps.time))], [still], RATE) == inf


@pytest.mark.parametrize("cutoff", [27.0, 40.0, 100.0, 240.0])
@pytest.mark.parametrize("noise", [0.0, 0.05])
def test_the_cutoff_is_heard_in_what_is_missed(cutoff: float, noise: float) -> None:
    """What is not compared does not count, however wrong."""
    rng, missed, all_steps = np.random.default_rng(7), [], []
    for seed in (1, 2):
        sharp, steps = stepping(seed)
        seen = zero_phase(sharp, cutoff)[::EVERY] + noise * rng.standard_normal(len(steps.time))
        seen[300:400] += 1e3
        missed.append(np.where(np.abs(seen) < 100, seen - sharp[::EVERY], np.nan))
        all_steps.append(steps)
    assert cutoff_of("a", missed, all_steps, RATE) == pytest.approx(cutoff, rel=0.1)


def test_a_filter_is_believed_for_less_where_another_channel_has_it() -> None:
    """Noise of an eighth of a step hides it otherwise; one that is elsewhere tells nothing."""
    rng = np.random.default_rng(8)
    sharp, steps = stepping(6)
    missed = zero_phase(sharp, 100.0)[::EVERY] - sharp[::EVERY] + 0.13 * rng.standard_normal(len(steps.time))
    assert cutoff_of("a", [missed], [steps], RATE) == inf
    assert cutoff_of("a", [missed], [steps], RATE, [20.0]) == inf
    assert cutoff_of("a", [missed], [steps], RATE, [110.0]) == pytest.approx(100.0, rel=0.2)


def test_a_filter_with_phase_is_heard_too_as_it_has_delayed_the_input_as_well() -> None:
    """It takes as much as one without phase of a higher cut-off, which is passed twice."""
    sharp, steps = stepping(3)
    butterworth, thomson = (
        butter(2, 40.0, fs=FINE, output="sos"),
        bessel(4, 40.0, fs=FINE, norm="mag", output="sos"),
    )
    for sections, periods in ((butterworth, np.sqrt(2)), (thomson, 2.114)):
        late = round(float(periods) / (2 * np.pi * 40.0) * FINE)
        seen = np.roll(sosfilt(sections, sharp), -late)[::EVERY]
        missed = (seen - sharp[::EVERY])[: -round(0.2 * RATE)]
        steps_before = replace(steps, time=steps.time[: len(missed)])
        found = cutoff_of("a", [missed], [steps_before], RATE)
        left = missed - steps_before.rounding("a", found)
        assert 40.0 < found < 55.0
        assert float(left @ left) < 0.1 * float(missed @ missed)


@pytest.mark.parametrize("late", [0.0, 2e-4])
def test_where_nothing_has_filtered_none_is_heard(late: float) -> None:
    """Noise, a slow error of the model, steps a little off in time, and of another size than foreseen."""
    sharp, steps = stepping(4)
    seen = np.roll(sharp, round(late * FINE))[::EVERY]
    rng = np.random.default_rng(5)
    slow = 0.1 * np.sin(2 * np.pi * 3 * steps.time)
    for wrong in (0.03 * rng.standard_normal(len(steps.time)), slow, 0.2 * (seen - seen.mean())):
        assert cutoff_of("a", [seen + wrong - sharp[::EVERY]], [steps], RATE) == inf


def test_steps_at_samples_count_from_there_on() -> None:
    time = np.arange(10) / RATE
    steps = Steps(time, time[[4]], np.array([4]), {"a": np.array([2.0])})
    rounded = steps.rounding("a", 0.2 * RATE)
    assert rounded[4] == -1.0
    assert rounded[3] == pytest.approx(-rounded[5])
    assert rounded[3] > 0
