"""What looks like noise: as strong everywhere in what a filter has left, and at all times."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from inertance.identification import is_noise
from numpy.typing import NDArray
from scipy.signal import butter, sosfilt

Array = NDArray[np.float64]
RATE, COUNT = 250.0, 4000
Made = Callable[[np.random.Generator], Array]


def low_passed(rng: np.random.Generator, order: int, cutoff: float) -> Array:
    sections = butter(order, cutoff, fs=RATE, output="sos")
    noise: Array = np.asarray(sosfilt(sections, rng.standard_normal(COUNT + 500))[500:])
    return np.asarray(noise / noise.std())


def share(made: Made) -> float:
    """Return how often something that is made is taken for noise, beside a motion up to 8 Hz."""
    rng = np.random.default_rng(7)
    found = [is_noise(made(rng), 50 * low_passed(rng, 6, 8.0), RATE, 16) for _ in range(60)]
    return float(np.mean(found))


@pytest.mark.parametrize(
    "made",
    [
        lambda rng: rng.standard_normal(COUNT),
        lambda rng: np.round(rng.standard_normal(COUNT)),
        lambda rng: low_passed(rng, 1, 40.0),
        lambda rng: low_passed(rng, 2, 40.0),
        lambda rng: low_passed(rng, 4, 60.0),
    ],
    ids=["white", "coarse", "first order", "second order", "fourth order"],
)
def test_noise_is_noise_filtered_or_not(made: Made) -> None:
    assert share(made) > 0.9


@pytest.mark.parametrize(
    "made",
    [
        lambda rng: rng.standard_normal(COUNT) + low_passed(rng, 2, 8.0),
        lambda rng: rng.standard_normal(COUNT) + 1.4 * np.sin(2 * np.pi * 5.3 * np.arange(COUNT) / RATE),
        lambda rng: rng.standard_normal(COUNT) * (1 + 2 * (np.arange(COUNT) % 1000 < 200)),
        lambda rng: low_passed(rng, 2, 8.0),
        lambda rng: np.sin(2 * np.pi * 5.3 * np.arange(COUNT) / RATE),
    ],
    ids=["error in noise", "sine in noise", "bursts", "an error alone, where the machine moves", "a sine"],
)
def test_what_follows_the_motion_is_no_noise(made: Made) -> None:
    assert share(made) < 0.1


@pytest.mark.parametrize("size", [3.0, 1.0, 0.3])
def test_noise_about_a_motion_as_small_as_itself_is_noise(size: float) -> None:
    """Most of what such a channel shows where it should be weak is noise itself."""
    rng = np.random.default_rng(9)
    found = []
    for _ in range(40):
        noise = low_passed(rng, 4, 92.0)
        found.append(is_noise(noise, size * low_passed(rng, 6, 8.0) + noise, RATE, 16))
    assert np.mean(found) > 0.9


def test_noise_about_a_channel_that_rests_is_noise() -> None:
    noise = np.random.default_rng(8).standard_normal(COUNT)
    assert is_noise(noise, np.zeros(COUNT), RATE, 16)


def test_what_has_a_mean_is_no_noise() -> None:
    """A sensor's zero, or a force that is always there, is as even in time and frequency as noise."""
    noise = np.random.default_rng(5).normal(size=COUNT)
    signal = 50 * low_passed(np.random.default_rng(6), 6, 8.0)
    assert is_noise(noise, signal, RATE, 16)
    assert is_noise(noise + 0.05, signal, RATE, 16)
    assert not is_noise(noise + 0.5, signal, RATE, 16)


@pytest.mark.parametrize(("known", "noise"), [(1.0, True), (0.1, False)])
def test_what_is_quiet_now_and_then_is_noise_if_that_is_known(known: float, noise: bool) -> None:
    """As a coarse sensor is quiet that stands still, and impacts are between each other."""
    rng = np.random.default_rng(0)
    left = rng.standard_normal(COUNT) * np.where(np.arange(COUNT) % 500 < 300, 1.0, 0.05)
    assert is_noise(left, 50 * low_passed(rng, 6, 8.0), RATE, 8, known) is noise
