"""What sensors and actuators do to signals: delays of either sign, limits, play."""

import inertance as ia
import numpy as np
import pytest
from inertance.diagnosis.effects.effect import effect_of
from inertance.diagnosis.effects.hypothesis import Hypothesis, acted
from inertance.diagnosis.effects.shaping import Shapes
from inertance.diagnosis.effects.sites import Site
from inertance.identification import Campaign, Experiment, Record
from numpy.typing import NDArray

Array = NDArray[np.float64]
TIME = 3.0 + np.arange(501) / 250.0  # a record need not begin at 0
WAVE = np.sin(2 * np.pi * 8.0 * TIME + 0.4)  # nor at rest


def changed(kind: str, values: Array, **sizes: float) -> Array:
    effect = effect_of(kind)
    assert effect.change is not None
    return effect.change(TIME, values, sizes)


@pytest.mark.parametrize("delay", [0.0113, -0.0113])
def test_a_shifted_sensor_shows_what_was_or_will_be(delay: float) -> None:
    shown = changed("sensor_delay", WAVE, delay=delay)
    inside = (TIME - delay > TIME[0]) & (TIME - delay < TIME[-1])
    true = np.sin(2 * np.pi * 8.0 * (TIME - delay) + 0.4)
    assert shown[inside] == pytest.approx(true[inside], abs=2e-4)
    assert shown == pytest.approx(true, abs=0.2)  # beyond the record it goes on with its speed


@pytest.mark.parametrize("lag", [1e-5, 0.0016, 0.012, 0.4])
def test_a_lag_is_that_of_the_curve_through_the_samples(lag: float) -> None:
    """Also of less than a sample: straight between samples, a sine would be 5e-3 smaller."""
    turning = 2 * np.pi * 8.0
    wave, answer = np.exp(1j * turning * TIME), 1 / (1 + 1j * turning * lag)
    sine, true = np.real(wave), np.real(answer * wave)
    true += (sine[0] - true[0]) * np.exp(-(TIME - TIME[0]) / lag)
    assert changed("actuator_lag", sine, T=lag) == pytest.approx(true, abs=3e-4)


@pytest.mark.parametrize("delay", [0.0113, -0.0113])
def test_a_shifted_command_steps_where_it_should(delay: float) -> None:
    """Between samples it is curved, as runs take it, and so it rings for a few of them."""
    step = np.where(TIME > 4.0, 2.0, -1.0)
    missed = changed("actuator_delay", step, delay=delay) - np.where(TIME - delay > 4.002, 2.0, -1.0)
    assert (np.abs(missed) > 0.01).sum() <= 10
    assert np.abs(missed).max() <= 3.0


def test_shifts_are_linear_as_slopes_take_them() -> None:
    other = np.cos(TIME) ** 3
    for kind in ("sensor_delay", "actuator_delay"):
        both = changed(kind, 2 * WAVE - 3 * other, delay=0.007)
        apart = 2 * changed(kind, WAVE, delay=0.007) - 3 * changed(kind, other, delay=0.007)
        assert both == pytest.approx(apart, abs=1e-12)


def test_a_hard_limit_clips_and_a_soft_one_bends() -> None:
    hard = changed("actuator_saturation", 3 * WAVE, share=1.0, limit=2.0)
    assert hard == pytest.approx(np.clip(3 * WAVE, -2.0, 2.0))
    soft = changed("actuator_saturation", 3 * WAVE, share=0.5, limit=2.0)
    assert soft.max() == pytest.approx(2.0 + 0.5 * (3 * WAVE.max() - 2.0))
    assert changed("actuator_saturation", 3 * WAVE, share=0.0, limit=2.0) == pytest.approx(3 * WAVE)


def test_play_is_crossed_wherever_a_command_turns() -> None:
    course = np.concatenate([np.linspace(0, 2, 200), np.linspace(2, -2, 200), np.linspace(-2, 0, 101)])
    followed = changed("actuator_backlash", course, width=0.3)
    assert followed[:30] == pytest.approx(0.0, abs=1e-3)  # from the middle of the play
    assert followed[199] == pytest.approx(1.7)
    assert followed[205] == followed[199]
    assert followed[399] == pytest.approx(-1.7)
    assert changed("actuator_backlash", course, width=0.0) == pytest.approx(course)


def acted_on(kind: str, initial: str, values: Array, **sizes: float) -> Array:
    record = Record("cut", TIME, {"u": values, "x": values})
    experiment = Experiment(record, "cut", initial)
    return acted(effect_of(kind), experiment, TIME, values, sizes)


@pytest.mark.parametrize("phase", [0.0, 0.4, 1.6, 3.0])
@pytest.mark.parametrize("T", [0.0007, 0.004, 0.012])
def test_an_actuator_lags_from_the_first_sample_of_a_record_in_motion(T: float, phase: float) -> None:
    """What it follows was moving before; at rest it was not."""
    w = 2 * np.pi * 3.0
    course = np.sin(w * (TIME - TIME[0]) + phase)
    true = np.sin(w * (TIME - TIME[0]) + phase - np.arctan(w * T)) / np.hypot(1, w * T)
    assert acted_on("actuator_lag", "fit", course, T=T) == pytest.approx(true, abs=6 * (w * T) ** 3 + 2e-3)
    rested = acted_on("actuator_lag", "rest", course, T=T)
    assert rested[0] == course[0]
    assert rested[TIME[0] + 10 * T + 0.1 < TIME] == pytest.approx(
        true[TIME[0] + 10 * T + 0.1 < TIME], abs=2e-3
    )


def test_the_play_of_a_command_that_rises_is_taken_up_from_the_first_sample() -> None:
    rising = 5.0 + 2.0 * (TIME - TIME[0])
    assert acted_on("actuator_backlash", "fit", rising, width=0.3) == pytest.approx(rising - 0.3)
    assert acted_on("actuator_backlash", "rest", rising, width=0.3)[0] == rising[0]


def test_limits_are_looked_for_where_the_input_goes() -> None:
    site = Site("F", "channel", "push.f", "", frozenset({"channel"}), travel=20.0)
    limits = [shape["limit"] for shape in effect_of("actuator_saturation").shaped("channel", site)]
    assert min(limits) == pytest.approx(6.0)
    assert max(limits) == pytest.approx(19.0)
    placed = Hypothesis(effect_of("actuator_saturation"), site, "limit_1", {"share": 1.0, "limit": 10.0})
    bounds = Shapes((np.zeros(2), np.full(2, np.inf)), [placed], [placed.scales]).bounds(np.ones(2))
    assert (bounds[0] * placed.scales)[1] == pytest.approx(5.0)


def test_the_limit_of_an_actuator_is_in_the_unit_of_its_channel() -> None:
    net = ia.Network("cart", push=ia.Force(), mass=ia.Mass(m=1.0))
    net.connect(net.push.flange, net.mass.flange)
    record = Record("run", TIME - 3.0, {"F": WAVE, "s": WAVE})
    channels = {"F": {"input": "push.f", "unit": "kN"}, "s": {"output": "mass.s", "unit": "m"}}
    campaign = Campaign(net, channels, {"mass.m": {"rel": 0.1}}, [{"record": record}])
    site = Site("F", "channel", "push.f", "", frozenset({"channel"}))
    placed = Hypothesis(effect_of("actuator_saturation"), site, "limit_1", {"share": 1.0, "limit": 1.0})
    assert placed.units(campaign) == {"share": "1", "limit": "N"}
