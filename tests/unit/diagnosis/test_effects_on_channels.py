"""What sensors and actuators do to signals: delays of either sign, limits, play."""

import inertance as ia
import numpy as np
import pytest
from inertance.diagnosis.effects.effect import effect_of
from inertance.diagnosis.effects.hypothesis import Hypothesis
from inertance.diagnosis.effects.shaping import Shapes
from inertance.diagnosis.effects.sites import Site
from inertance.identification import Campaign, Record
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
